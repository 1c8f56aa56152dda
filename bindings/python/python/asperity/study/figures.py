"""Figures of the report, in colours that the colour-blind can tell apart (Okabe & Ito 2008)."""

from __future__ import annotations

import base64
import io
from typing import Any, List, Sequence, Tuple

import numpy as np

from ._extra import Frame, figure, matplotlib
from .exploration import FORCES, SPEEDS

_BLUE, _GREEN, _ORANGE = "#0072B2", "#009E73", "#D55E00"
_SHOWN = (-1.0, 2.0)  # of t_a


def data_uri(drawn: Any) -> str:
    """An SVG of a Matplotlib figure as a data URI, the same bytes for the same figure."""
    data = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": "asperity"}):
        drawn.savefig(data, format="svg", metadata={"Date": None})
    return "data:image/svg+xml;base64," + base64.b64encode(data.getvalue()).decode()


def _axes(width: float, height: float) -> Tuple[Any, Any]:
    drawn = figure.Figure(figsize=(width, height), layout="constrained")
    axes = drawn.add_subplot()
    axes.spines[["top", "right"]].set_visible(False)
    return drawn, axes


def violins(found: Frame) -> Any:
    """t_a by attribute (as `midpoints.places` gives it), with the band inside the axis."""
    names = list(found["attribute"].unique())
    drawn, axes = _axes(1.5 + 1.7 * len(names), 3.6)
    axes.axhspan(0, 1, color=_GREEN, alpha=0.18, lw=0)
    axes.axhline(0.5, color=_GREEN, lw=0.8, ls="--")
    labels, jitter = [], np.random.default_rng(1)
    for at, name in enumerate(names):
        values = found.loc[found["attribute"] == name, "t_a"].dropna().to_numpy(dtype=float)
        shown = values[(values >= _SHOWN[0]) & (values <= _SHOWN[1])]
        if len(shown) > 4 and np.ptp(shown) > 0:
            for body in axes.violinplot([shown], [at], widths=0.8, showextrema=False)["bodies"]:
                body.set(facecolor=_BLUE, edgecolor=_BLUE, alpha=0.35)
        x = at + jitter.uniform(-0.08, 0.08, len(shown))
        axes.plot(x, shown, ".", color="k", ms=3, alpha=0.35)
        if len(values):
            axes.plot([at - 0.2, at + 0.2], [np.median(values)] * 2, color=_ORANGE, lw=2.5)
        labels.append(f"{name}\n{len(values)} places, {len(values) - len(shown)} beyond")
    axes.set(xticks=range(len(names)), ylim=_SHOWN, ylabel="t_a: 0 at anchor A, 1 at anchor B")
    axes.set_xticklabels(labels)
    return drawn


def _cells(values: Any, rows: Sequence[str], columns: Sequence[str], unit: str, **look: Any) -> Any:
    """A grid of numbers on their colours."""
    values = np.asarray(values, dtype=float)
    longest, digits = max(map(len, rows)), 2 if np.nanmax(values) < 10 else 1
    drawn, axes = _axes(2.2 + 0.075 * longest + 0.85 * len(columns), 1.3 + 0.33 * len(rows))
    image = axes.imshow(values, aspect="auto", **look)
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            red, green, blue, _ = image.cmap(image.norm(value))
            colour = "k" if 0.3 * red + 0.6 * green + 0.1 * blue > 0.45 else "w"
            text = f"{value:.{digits}f}"
            axes.text(column, row, text, ha="center", va="center", color=colour, size=8)
    axes.set_xticks(range(len(columns)), columns)
    axes.set_yticks(range(len(rows)), rows)
    drawn.colorbar(image, ax=axes, label=unit)
    return drawn


def medians(table: Frame) -> Any:
    """Median t_a by pair and attribute, as `midpoints.medians` gives it."""
    grid = table.pivot(index="pair", columns="attribute", values="value")
    grid = grid[list(table["attribute"].unique())]
    colours = {"cmap": "PuOr", "vmin": -0.5, "vmax": 1.5}
    return _cells(grid, list(grid.index), list(grid.columns), "median t_a", **colours)


def dots(table: Frame, label: str, reference: float) -> Any:
    """Estimates with their intervals by attribute, and a line where there is no effect."""
    drawn, axes = _axes(5.5, 0.9 + 0.4 * len(table))
    at = np.arange(len(table))
    axes.axvline(reference, color="0.5", lw=0.8, ls="--")
    axes.hlines(at, table["low"], table["high"], color=_BLUE, lw=2)
    axes.plot(table["value"], at, "o", color=_BLUE)
    labels = [f"{name}, n = {n}" for name, n in zip(table["attribute"], table["n"])]
    axes.set(yticks=at, yticklabels=labels, xlabel=label, ylim=(len(table) - 0.5, -0.5))
    return drawn


def bars(shares: Frame, low: str, high: str) -> Any:
    """Stacked shares of answers, as `forms.shares` gives them, from the low end to the high one."""
    steps: List[str] = list(shares.columns[:-1])
    drawn, axes = _axes(7.5, 1.3 + 0.34 * len(shares))
    left = np.zeros(len(shares))
    names = [f"{name}, n = {n}" for name, n in shares["n"].items()]
    colours = matplotlib.colormaps["PuOr_r"](np.linspace(0.1, 0.9, len(steps)))
    for step, colour in zip(steps, colours):
        width, look = 100 * shares[step].to_numpy(dtype=float), {"edgecolor": "0.6", "lw": 0.5}
        axes.barh(names, width, left=left, color=colour, label=step, **look)
        left += width
    axes.set(xlim=(0, 100), ylim=(len(shares) - 0.5, -0.5))
    axes.set_xlabel(f"answers, %: {low} … {high}", parse_math=False)
    drawn.legend(loc="outside upper center", ncols=len(steps), frameon=False, handlelength=1)
    return drawn


def exploration(seconds: Any, n: int) -> Any:
    """Seconds over speed × force, as `exploration.seconds_by_bin` gives them."""
    label = f"s, mean of n = {n}"
    drawn = _cells(np.transpose(seconds)[::-1], FORCES[::-1], SPEEDS, label, cmap="cividis")
    drawn.axes[0].set(xlabel="speed, mm/s", ylabel="normal force, N")
    return drawn
