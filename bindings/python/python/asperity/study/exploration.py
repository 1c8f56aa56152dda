"""How participants explored textures, and what they typed."""

from __future__ import annotations

from typing import Tuple

import numpy as np
from numpy.typing import NDArray

from ._extra import Frame, pandas
from .load import Study
from .statistics import Estimate, Options, median, ratio

SPEEDS = ("0–40", "40–80", "80–120", "120–160", "160–200", "> 200")
"""Bins of tangential speed, mm/s."""
FORCES = ("0–0.5", "0.5–1", "1–1.5", "1.5–2", "2–3", "> 3")
"""Bins of normal force, N."""
VISITED_S = 0.1
"""Seconds from which a bin counts as visited."""


def _chosen(study: Study, kind: str) -> NDArray[np.bool_]:
    is_kind = study.trials["trial_type"] == kind
    if kind == "texture-rating":
        is_kind &= study.trials["phase"] == "main"
    return np.asarray(is_kind, dtype=bool)


def seconds_by_bin(study: Study, kind: str = "texture-rating") -> Tuple[NDArray[np.float64], int]:
    """Seconds in contact over speed × force, shape (6, 6), a row a bin of speed; and participants.

    The mean over participants of what each spent in main ratings, or in trials of another kind; NaN
    where nobody explored.
    """
    chosen = _chosen(study, kind) & np.isfinite(study.seconds).all(1)
    sums = pandas.DataFrame(study.seconds[chosen])
    sums = sums.groupby(study.trials["subject"].to_numpy()[chosen]).sum().to_numpy(dtype=float)
    mean = sums.mean(0) if len(sums) else np.full(study.seconds.shape[1], np.nan)
    return mean.reshape(len(SPEEDS), len(FORCES)), len(sums)


def effort(study: Study, options: Options = Options()) -> Frame:
    """How much was explored: medians over participants of each one's median, bootstrapped.

    Coverage is the share of the 36 bins with at least 0.1 s, of a trial and of all of a
    participant's trials together. Columns: trials, measure, value, low, high, n.
    """
    rows = []
    for kind, name in (("texture-rating", "main ratings"), ("prompt", "prompts")):
        chosen = _chosen(study, kind)
        trials = study.trials[chosen]
        seconds = pandas.DataFrame(study.seconds[chosen], index=trials.index).dropna()
        coverage = (seconds >= VISITED_S).mean(axis=1)
        columns = {"contact, s": trials["contact_s"], "coverage of a trial": coverage}
        columns = {"strokes": trials["strokes"], "taps": trials["taps"], **columns}
        values = {key: it.groupby(trials["subject"]).median() for key, it in columns.items()}
        together = seconds.groupby(trials["subject"]).sum()
        values["coverage of all"] = (together >= VISITED_S).mean(axis=1)
        rows += [(name, key, *median(each, options)) for key, each in values.items() if len(trials)]
    return pandas.DataFrame(rows, columns=["trials", "measure", *Estimate._fields])


def prompts(study: Study, options: Options = Options()) -> Frame:
    """The share of prompts that were refined, and of tried prompts by the certainty reported.

    Bootstrapped over participants. Columns: measure, value, low, high, n, count, of (all of them).
    """
    tries, rows = study.tries, []
    is_refined = tries.groupby(["subject", "trial_index"])["order"].max() > 1
    table = {"refined": is_refined.groupby("subject")} if len(tries) else {}
    for certainty in sorted(tries["certainty"].unique()):
        is_it = tries["certainty"] == certainty
        table[f"certainty: {certainty}"] = is_it.groupby(tries["subject"])
    for name, groups in table.items():
        it = groups.agg(["sum", "count"]).astype(int)
        counts = (it["sum"].sum(), it["count"].sum())
        rows.append((name, *ratio(it["sum"], it["count"], options), *counts))
    return pandas.DataFrame(rows, columns=["measure", *Estimate._fields, "count", "of"])
