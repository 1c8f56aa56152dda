"""Where midpoints lie between their anchors, and which anchor they lean to."""

from __future__ import annotations

from typing import List, Tuple

import numpy as np

from ._extra import Frame, pandas
from .agreement import means, of_attribute
from .statistics import Estimate, Options, mean_interval, median, ratio

KEPT, NO_DIFFERENCE, NO_ANCHORS = "kept", "no difference", "no anchors"


def pairs(ratings: Frame) -> List[Tuple[str, str, str]]:
    """Midpoints (t = 0.5) of the main phase: (stimulus, anchor A, anchor B) of each."""
    middle = (ratings["phase"] == "main") & (ratings["anchor_a"] != "") & (ratings["t"] == 0.5)
    found = ratings.loc[middle, ["stimulus", "anchor_a", "anchor_b"]].drop_duplicates()
    return sorted(found.itertuples(index=False, name=None))


def places(ratings: Frame, options: Options = Options()) -> Frame:
    """The place of each midpoint's rating between its anchors' ratings, of each participant.

    t_a = (r_mid − r_A) / (r_B − r_A) is 0 at anchor A and 1 at B; each r is the mean of the
    participant's main ratings. Where |r_B − r_A| is less than the guard, the axis does not differ,
    and t_a would be noise over noise. Takes `Study.ratings`. Columns: attribute, subject, pair,
    r_a, r_b, r_mid in points, status (one of this module's constants), t_a (NaN unless kept).
    """
    wide, frames = means(ratings), []
    for stimulus, a, b in pairs(ratings):
        names = {a: "r_a", b: "r_b", stimulus: "r_mid"}
        frame = wide.reindex(columns=list(names)).rename(columns=names).dropna(subset=["r_mid"])
        frame = frame.reset_index().rename_axis(columns=None)
        frame.insert(2, "pair", f"{a} – {b}")
        frames.append(frame)
    columns = ["attribute", "subject", "pair", "r_a", "r_b", "r_mid"]
    nothing = pandas.DataFrame(columns=columns)
    found = pandas.concat(frames, ignore_index=True) if frames else nothing
    found[columns[3:]] = found[columns[3:]].astype(float)
    gap = found["r_b"] - found["r_a"]
    no_difference = gap.abs() < max(options.guard, 1e-9)
    found["status"] = np.select([gap.isna(), no_difference], [NO_ANCHORS, NO_DIFFERENCE], KEPT)
    found["t_a"] = (found["r_mid"] - found["r_a"]) / gap.where(found["status"] == KEPT)
    return found


def inside_rates(found: Frame, options: Options = Options()) -> Frame:
    """The share of midpoints inside the axis, 0 ≤ t_a ≤ 1, bootstrapped over participants.

    Takes what `places` gives. Columns: attribute, value, low, high, n, and counts of participant ×
    pair by status.
    """
    rows = []
    for attribute, group in found.groupby("attribute", sort=False):
        kept = group[group["status"] == KEPT]
        inside = kept["t_a"].between(0, 1).groupby(kept["subject"]).agg(["sum", "count"])
        counts = [int((group["status"] == it).sum()) for it in (KEPT, NO_DIFFERENCE, NO_ANCHORS)]
        rows.append((attribute, *ratio(inside["sum"], inside["count"], options), *counts))
    columns = ["attribute", *Estimate._fields, KEPT, NO_DIFFERENCE, NO_ANCHORS]
    return pandas.DataFrame(rows, columns=columns)


def medians(found: Frame, options: Options = Options()) -> Frame:
    """The median t_a over participants by pair and attribute, bootstrapped.

    Takes what `places` gives. Columns: pair, attribute, value, low, high, n (whose axis differs),
    left_out (the others).
    """
    rows = []
    for (pair, attribute), group in found.groupby(["pair", "attribute"], sort=False):
        estimate = median(group["t_a"], options)
        rows.append((pair, attribute, *estimate, len(group) - estimate.n))
    return pandas.DataFrame(rows, columns=["pair", "attribute", *Estimate._fields, "left_out"])


def dominance(ratings: Frame, options: Options = Options()) -> Frame:
    """The weight w of the higher-rated anchor in a midpoint's rating, with a t interval.

    Of each participant, w = 0.5 + mean of (r_mid − (r_A + r_B) / 2) / mean of |gap|, over pairs. A
    pair's gap is that of its anchors' mean ratings over all participants: a gap of one's own would
    stand on both sides of the fraction, and its noise would bend w. 0.5 is the middle, 1 the higher
    anchor alone; an effect is found where the interval excludes 0.5. Takes `Study.ratings`.
    Columns: attribute, value, low, high, n, pairs, left_out (pairs whose gap is less than the
    guard), found (bool).
    """
    wide, between, rows = means(ratings), pairs(ratings), []
    for attribute in ratings["attribute"].unique() if between else ():
        rated = of_attribute(wide, attribute)
        names = [list(column) for column in zip(*between)]
        mid, a, b = (rated.reindex(columns=column).to_numpy(dtype=float) for column in names)
        low, high = (rated.mean().reindex(column).to_numpy(dtype=float) for column in names[1:])
        gap = np.abs(high - low)
        differs = gap >= max(options.guard, 1e-9)
        lean = (mid - (a + b) / 2)[:, differs]
        # A pair that a participant missed counts on neither side of the fraction.
        has = np.isfinite(lean)
        over, under = np.where(has, lean, 0).sum(1), (has * gap[differs]).sum(1)
        w = mean_interval(0.5 + over[under > 0] / under[under > 0])
        count = int(differs.sum())
        is_found = bool(w.low > 0.5 or w.high < 0.5)
        rows.append((attribute, *w, count, len(between) - count, is_found))
    columns = ["attribute", *Estimate._fields, "pairs", "left_out", "found"]
    return pandas.DataFrame(rows, columns=columns)
