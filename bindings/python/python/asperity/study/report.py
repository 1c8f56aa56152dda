"""One page of HTML with all results, which needs no network."""

from __future__ import annotations

import os
from html import escape
from pathlib import Path
from typing import Any, Callable, Dict, Optional, Sequence, Union

import numpy as np

from . import agreement, exploration, figures, forms, midpoints
from ._extra import Frame, pandas
from .load import Study, StudyError
from .statistics import Options

_STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
td,th{padding:.15rem .8rem .15rem 0;text-align:left}thead{border-bottom:1px solid}
img{max-width:100%}figure{margin:1rem 0;overflow-x:auto}.note{color:#555;margin:.3rem 0}
.banner{background:#F0E442;color:#000;padding:.6rem 1rem;font-weight:bold}"""


def _number(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if not isinstance(value, (float, np.floating)):
        return str(value)
    digits = 2 if abs(float(value)) < 100 else 0
    return f"{value:.{digits}f}" if np.isfinite(value) else "–"


def _table(frame: Frame) -> str:
    """A frame as a table, an estimate and its interval in one cell."""
    shown = frame.astype(object).map(_number)
    if "p" in frame:
        exact = [f"{p:.3f}" if p >= 0.001 else "< 0.001" for p in frame["p"].fillna(0)]
        shown["p"] = shown["p"].where(frame["p"].isna(), exact)
    for name, low, high in (("value", "low", "high"), ("alpha", "alpha_low", "alpha_high")):
        if name in frame:
            cells = shown.pop(name) + " [" + shown.pop(low) + ", " + shown.pop(high) + "]"
            at = list(frame.columns).index(name)
            cells = cells.str.replace(" [–, –]", "", regex=False)
            shown.insert(min(at, shown.shape[1]), f"{name} [95 % interval]", cells)
    rows = [[str(name).replace("_", " ") for name in shown.columns], *shown.to_numpy().tolist()]
    lines = ["".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows]
    head, body = lines[0].replace("td>", "th>"), "</tr><tr>".join(lines[1:])
    return f"<figure><table><thead><tr>{head}</tr></thead><tr>{body}</tr></table></figure>"


def _section(
    *said: str, missing: str, tables: Sequence[Frame], drawn: Optional[Callable[[], Any]] = None
) -> str:
    """Title, introduction and notes of what was left out, with figure and tables; or missing."""
    title, about, *notes = map(escape, said)
    if len(tables[0]) == 0:
        return f"<h2>{title}</h2><p class=note>{escape(missing)}</p>"
    parts = [f"<h2>{title}</h2><p>{about}</p>"]
    if drawn:
        parts.append(f'<figure><img src="{figures.data_uri(drawn())}" alt="{title}"></figure>')
    parts += [_table(table) for table in tables if len(table)]
    return "\n".join(parts + [f"<p class=note>{note}</p>" for note in notes])


def _midpoints(study: Study, options: Options) -> str:
    ratings, missing = study.ratings, "No midpoints (t = 0.5) were rated in the main phase."
    found = midpoints.places(ratings, options)
    grid, weights = midpoints.medians(found, options), midpoints.dominance(ratings, options)
    guard, all_ = f"differ by less than {options.guard:g} points", f"of {len(found)} places"
    is_close = found["status"] == midpoints.NO_DIFFERENCE
    is_alone = found["status"] == midpoints.NO_ANCHORS
    is_other = (ratings["phase"] == "main") & (ratings["anchor_a"] != "") & (ratings["t"] != 0.5)
    has_places = bool(found["t_a"].notna().any())
    return _section(
        "Place of midpoints between their anchors",
        "t_a = (r_mid − r_A) / (r_B − r_A) of each participant, pair and attribute. The value is "
        "the share inside the axis, 0 ≤ t_a ≤ 1.",
        f"Left out, as the participant's ratings of the anchors {guard}: {is_close.sum()} {all_}.",
        f"Left out, as the participant did not rate both anchors: {is_alone.sum()} {all_}.",
        f"Left out, as they lie between anchors at another t than 0.5: {is_other.sum()} ratings.",
        missing=missing, tables=[midpoints.inside_rates(found, options)],
        drawn=(lambda: figures.violins(found)) if has_places else None,
    ) + _section(
        "Median place by pair",
        "Medians of t_a over participants: 0 at the first anchor, 1 at the second.",
        f"left out: participants whose ratings of the anchors {guard}, or lack one.",
        missing=missing, tables=[grid],
        drawn=(lambda: figures.medians(grid)) if has_places else None,
    ) + _section(
        "Dominance of the higher-rated anchor",
        "w is its weight in a midpoint's rating: 0.5 is the middle, 1 the higher anchor alone. An "
        "effect is found where the t interval over participants excludes 0.5.",
        f"left out: pairs whose anchors' mean ratings {guard}.",
        missing=missing, tables=[weights],
        drawn=lambda: figures.dots(weights, "w", 0.5),
    )


def _agreement(study: Study, options: Options) -> str:
    ratings, missing = study.ratings, "No ratings of the main phase."
    predicted = agreement.prediction(ratings, study.textures, options)
    agreed = agreement.agreement(ratings)
    return _section(
        "Prediction by Asperity",
        "Spearman's correlation, over textures, of mean ratings with the places that Asperity "
        "itself gives. This tests the software, not the participants.",
        missing=missing, tables=[predicted],
        drawn=lambda: figures.dots(predicted, "Spearman's correlation", 0),
    ) + _section(
        "Agreement of participants",
        "Kendall's W over participants × textures; p by χ², the interval by jackknife.",
        "left out: participants who did not rate every texture.",
        missing=missing, tables=[agreed],
        drawn=lambda: figures.dots(agreed, "Kendall's W", 0),
    ) + _section(
        "Consistency of participants",
        "Catch trials against the main ratings that they repeat.",
        missing="No catch trials.", tables=[agreement.consistency(ratings, options)],
    )


def _form(study: Study, form: Dict[str, Any]) -> str:
    scores, shares = forms.scores(form, study.answers), forms.shares(form, study.answers)
    item = (forms.scales(form) or [{}])[0]
    ends = item.get("low", ""), item.get("high", "")
    return _section(
        f"Form {form['name']}",
        "Scores with t intervals over participants, alpha by Cronbach, and shares of answers.",
        "left out: participants who answered the form but missed an item of the score.",
        missing="No answers on a scale.",
        tables=[scores[scores["n"] > 0], shares.rename_axis("share of answers").reset_index()],
        drawn=(lambda: figures.bars(shares, *ends)) if len(shares) else None,
    )


def _exploration(study: Study, options: Options) -> str:
    seconds, n = exploration.seconds_by_bin(study)
    has_contact = bool(np.nansum(seconds) > 0)  # simulated participants touch nothing
    by_bin = pandas.DataFrame(seconds, columns=[f"{force} N" for force in exploration.FORCES])
    by_bin.insert(0, f"s, mean of n = {n}", [f"{speed} mm/s" for speed in exploration.SPEEDS])
    return _section(
        "Exploration",
        "Contact in main ratings over speed and force; medians over participants of each one's "
        f"median. A bin counts as covered from {exploration.VISITED_S} s.",
        missing="Nobody explored a texture.",
        tables=[exploration.effort(study, options), by_bin if has_contact else by_bin[:0]],
        drawn=(lambda: figures.exploration(seconds, n)) if has_contact else None,
    ) + _section(
        "Prompts",
        f"{len(study.tries)} tries; refined is a share of prompts, a certainty one of tries.",
        missing="No prompts were tried.", tables=[exploration.prompts(study, options)],
    )


def report(study: Study, options: Options = Options()) -> str:
    """The results of a study as a page of HTML; what the study lacks is said in its place."""
    people = study.trials.groupby("subject").agg(
        trials=("trial_index", "size"), minutes=("time_elapsed", lambda it: it.max() / 60000)
    )
    people["ratings"] = study.ratings.groupby("subject")["trial_index"].nunique()
    title, banner = escape(study.title), ""
    if study.simulated:
        told = escape(str(study.simulated).strip("{}").replace("'", ""))
        banner = f"<p class=banner>Simulated: no person was asked ({told}).</p>"
    versions = ", ".join(study.versions) or "–"
    none = "<h2>Forms</h2><p class=note>The study has no forms.</p>"
    parts = [
        '<!doctype html><html lang="en"><meta charset="utf-8">',
        f"<title>{title}</title><style>{_STYLE}</style><h1>{title}</h1>{banner}",
        f"<p>Participants: {len(study.subjects)}. Recorded by asperity {escape(versions)}. "
        "n counts participants. Intervals are of 95 %; without width, participants do not differ. "
        f"Bootstraps draw them {options.resamples} times, from seed {options.seed}.</p>",
        _midpoints(study, options),
        _agreement(study, options),
        "".join(_form(study, form) for form in study.forms) or none,
        _exploration(study, options),
        _section("Participants", "", missing="No participants.", tables=[people.reset_index()]),
    ]
    return "\n".join(parts) + "\n</html>\n"


def write_report(study: Study, path: Union[str, Path], options: Options = Options()) -> None:
    """Writes the report to a file, all of it or nothing; to a pipe or a device as it comes."""
    path, page = Path(path), report(study, options).encode()
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        if path.exists() and not path.is_file():
            path.write_bytes(page)
            return
        try:
            part.write_bytes(page)
            os.replace(part, path)
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        remedy = "give a file in a folder that exists and can be written"
        raise StudyError(f"{path}: cannot be written: {error.strerror}", remedy) from None
