"""How participants agree with Asperity, with each other and with themselves.

Each function takes `Study.ratings` and gives a frame with a row an attribute.
"""

from __future__ import annotations

from typing import Any, Dict, List

import numpy as np
from numpy.typing import NDArray

from ._extra import Frame, pandas, stats
from .statistics import Estimate, Options, bootstrap, kendall_w, mean_interval, ratio

_Array = NDArray[np.float64]


def means(ratings: Frame) -> Frame:
    """Each participant's mean main ratings, in points of 100.

    Rows (attribute, subject), a column a texture; NaN where a texture was not rated.
    """
    main = ratings[ratings["phase"] == "main"]
    wide = main.groupby(["attribute", "subject", "stimulus"])["rating"].mean().unstack("stimulus")
    return wide.reindex(ratings["attribute"].unique(), level="attribute") if len(wide) else wide


def of_attribute(wide: Frame, attribute: str) -> Frame:
    """One attribute's rows of `means`: participants × textures, perhaps none."""
    return wide[wide.index.get_level_values("attribute") == attribute].droplevel("attribute")


def prediction(ratings: Frame, textures: List[Dict[str, Any]], options: Options) -> Frame:
    """How the places that Asperity itself gives textures order them as participants do.

    Spearman's rank correlation (Spearman 1904), over textures, of the mean ratings with the
    ``attributes`` of `Study.textures`; bootstrapped over participants. It tests the software.
    Columns: attribute, value, low, high, n, textures.
    """
    wide, rows = means(ratings), []
    for attribute in ratings["attribute"].unique():
        given = {it["name"]: (it.get("attributes") or {}).get(attribute) for it in textures}
        rated = of_attribute(wide, attribute)
        names = [name for name in rated.columns if given.get(name) is not None]
        values = rated[names].dropna(how="all").to_numpy(dtype=float)
        places = stats.rankdata([given[name] for name in names])
        rho, ends = np.nan, (np.nan, np.nan)
        if len(names) > 2 and len(values):
            rho = float(_spearman(values[None], places)[0])
            ends = bootstrap(lambda draw: _spearman(values[draw], places), len(values), options)
        rows.append((attribute, rho, *ends, len(values), len(names)))
    return pandas.DataFrame(rows, columns=["attribute", *Estimate._fields, "textures"])


def _spearman(values: _Array, places: _Array) -> _Array:
    """Of means over axis 1 of (resamples, participants, textures) with ranks of the textures."""
    rated = np.isfinite(values)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(rated, values, 0).sum(1) / rated.sum(1)
        # A resample without any rating of some texture counts as none.
        ranks = stats.rankdata(np.where(np.isfinite(mean), mean, 0), axis=1)
        ranks[~np.isfinite(mean).all(1)] = np.nan
        x, y = ranks - ranks.mean(1, keepdims=True), places - places.mean()
        rho: _Array = (x * y).sum(1) / np.sqrt((x * x).sum(1) * (y * y).sum())
    return rho


def agreement(ratings: Frame) -> Frame:
    """Kendall's W over participants × main textures.

    The interval jackknifes the mean rank correlation of two participants, (m W − 1) / (m − 1)
    (Arvesen 1969): a bootstrap would draw people twice, who then agree with themselves. Columns:
    attribute, value, low, high, n (who rated every texture), p, textures, left_out (who did not).
    """
    wide, rows = means(ratings), []
    for attribute in ratings["attribute"].unique():
        rated = of_attribute(wide, attribute)
        values = rated.dropna().to_numpy(dtype=float)
        m, (w, p) = len(values), kendall_w(values)
        low = high = np.nan
        if m > 3 and np.isfinite(w):
            without = np.array([kendall_w(np.delete(values, k, axis=0))[0] for k in range(m)])
            pairs = ((m - 1) * without - 1) / (m - 2)
            ends = mean_interval(m * (m * w - 1) / (m - 1) - (m - 1) * pairs)[1:3]
            low, high = ((np.array(ends) * (m - 1) + 1) / m).clip(0, 1)
        rows.append((attribute, w, low, high, m, p, rated.shape[1], len(rated) - m))
    columns = ["attribute", *Estimate._fields, "p", "textures", "left_out"]
    return pandas.DataFrame(rows, columns=columns)


def consistency(ratings: Frame, options: Options) -> Frame:
    """How ratings of catch trials differ from the main ones just before that they repeat.

    Columns: attribute, measure, value, low, high, n, trials (pairs). Measures: the mean absolute
    difference in points, and ICC(1,1), one-way random (Shrout & Fleiss 1979), both bootstrapped
    over participants.
    """
    key = ["subject", "stimulus", "attribute"]
    take = [*key, "trial_index", "rating"]
    catch, main = (ratings.loc[ratings["phase"] == phase, take] for phase in ("catch", "main"))
    both = catch.merge(main, on=key, suffixes=("", "_main"))
    both = both[both["trial_index_main"] < both["trial_index"]].sort_values("trial_index_main")
    both = both.drop_duplicates([*key, "trial_index"], keep="last")
    rows = []
    for attribute in ratings["attribute"].unique():
        pairs = both[both["attribute"] == attribute]
        one, other = pairs["rating"].to_numpy(float), pairs["rating_main"].to_numpy(float)
        apart, total = one - other, one + other
        # Sums of each participant are all that both measures need of a resample.
        each = pandas.DataFrame([np.ones_like(one), abs(apart), apart**2, total, total**2]).T
        sums = each.groupby(pairs["subject"].to_numpy()).sum().to_numpy(dtype=float)
        if len(pairs):
            difference = ratio(sums[:, 1], sums[:, 0], options)
            rows.append((attribute, "mean absolute difference", *difference, len(pairs)))
            ends = bootstrap(lambda draw: _icc(sums[draw].sum(1)), len(sums), options)
            icc = float(_icc(sums.sum(0, keepdims=True))[0])
            rows.append((attribute, "ICC(1,1)", icc, *ends, len(sums), len(pairs)))
    return pandas.DataFrame(rows, columns=["attribute", "measure", *Estimate._fields, "trials"])


def _icc(sums: _Array) -> _Array:
    pairs, _, apart, total, squares = sums.T
    with np.errstate(invalid="ignore", divide="ignore"):
        between = (squares - total**2 / pairs) / 2 / (pairs - 1)
        within = apart / 2 / pairs
        icc: _Array = (between - within) / (between + within)
    return icc
