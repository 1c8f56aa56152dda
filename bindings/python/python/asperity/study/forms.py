"""Scores of questionnaires and shares of their answers.

Each function takes one of `Study.forms` and `Study.answers`.
"""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np

from ._extra import Frame, pandas
from .statistics import Estimate, cronbach_alpha, mean_interval

TOTAL = ("A", "I", "R", "H", "D")
"""Factors of the HXI's total A + I + R + H + (8 − D)."""


def scales(form: Dict[str, Any]) -> List[Dict[str, Any]]:
    """The items of a form that are answered on a scale, not in words."""
    return [item for item in form["items"] if not item.get("text")]


def scores(form: Dict[str, Any], answers: Frame) -> Frame:
    """A form's scores and items, with t intervals over participants, in points of the scale.

    NASA-TLX is raw: the mean of its six items, unweighted (Hart 2006). Where items name factors, as
    the HXI's do, a factor is the mean of its items, reversed ones turned round as least + most −
    value, and with factors A, I, R, H and D the total is A + I + R + H + (8 − D), 8 being least +
    most. Other forms have the mean of their items, where these share a scale. Who filled a form
    more than once counts with the mean. Columns: score, items, value, low, high, n, left_out
    (participants who missed an item of it), alpha, alpha_low, alpha_high (`cronbach_alpha`).
    """
    items = scales(form)
    of_form = answers[answers["form"] == form["name"]]
    wide = of_form.groupby(["subject", "item"])["value"].mean().unstack("item")
    wide = wide.reindex(columns=[item["name"] for item in items]).astype(float)
    turned = wide.copy()
    factors: Dict[str, List[str]] = {}
    for item in items:
        if item.get("reversed"):
            turned[item["name"]] = item["least"] + item["most"] - wide[item["name"]]
        if item.get("factor"):
            factors.setdefault(item["factor"], []).append(item["name"])
    if not factors and len(items) > 1 and len({(it["least"], it["most"]) for it in items}) == 1:
        is_tlx = form.get("kind") == "tlx"
        factors = {"raw TLX" if is_tlx else "mean of items": [item["name"] for item in items]}
    rows: List[Tuple[Any, ...]] = []
    means = {name: turned[members].mean(axis=1, skipna=False) for name, members in factors.items()}
    for name, members in factors.items():
        alpha = cronbach_alpha(turned[members].dropna().to_numpy(dtype=float))
        rows.append((name, len(members), means[name], *alpha[:3]))
    if all(name in factors for name in TOTAL):
        a, i, r, h, d = (means[name] for name in TOTAL)
        last = next(item for item in items if item.get("factor") == "D")
        total = a + i + r + h + (last["least"] + last["most"] - d)
        rows.append(("total", sum(len(factors[name]) for name in TOTAL), total, *[np.nan] * 3))
    rows += [(f"item {it['name']}", 1, wide[it["name"]], *[np.nan] * 3) for it in items]
    told = [
        (name, count, *mean_interval(values), int(values.isna().sum()), *alpha)
        for name, count, values, *alpha in rows
    ]
    columns = ["score", "items", *Estimate._fields, "left_out", "alpha", "alpha_low", "alpha_high"]
    return pandas.DataFrame(told, columns=columns)


def shares(form: Dict[str, Any], answers: Frame) -> Frame:
    """How answers spread over the steps of the scale: rows are items, from 0 to 1.

    A scale of more than 11 steps is cut into five equal parts. The last column is n, the answers.
    Empty where the items have no scale in common.
    """
    items = scales(form)
    ends = {(item["least"], item["most"], item.get("step") or 1) for item in items}
    if len(ends) != 1:
        return pandas.DataFrame()
    least, most, step = ends.pop()
    steps = round((most - least) / step) + 1
    if steps <= 11:
        edges = least + step * (np.arange(steps + 1) - 0.5)
        labels = [f"{least + step * k:g}" for k in range(steps)]
    else:
        edges = np.linspace(least, most, 6)
        labels = [f"{low:g}–{high:g}" for low, high in zip(edges, edges[1:])]
    rows = {}
    for name in (item["name"] for item in items):
        values = answers.loc[(answers["form"] == form["name"]) & (answers["item"] == name), "value"]
        counts = np.histogram(values.to_numpy(dtype=float), edges)[0]
        rows[name] = [*(counts / max(counts.sum(), 1)), int(counts.sum())]
    return pandas.DataFrame.from_dict(rows, orient="index", columns=[*labels, "n"])
