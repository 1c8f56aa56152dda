"""From a dataset's folder to frames."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from .._errors import AsperityError
from . import table
from ._extra import Frame, pandas

COLUMNS = (
    *("trial_type", "trial_index", "time_elapsed", "rt", "stimulus", "response", "phase", "repeat"),
    *("anchor_a", "anchor_b", "t", "form", "strokes", "taps", "contact_s", "exploration"),
    *("asset_sha256", "log", "started_at", "device", "version"),
)
"""The columns of a participant's file, in their order."""
BINS = 36
"""Bins of an exploration: six of speed times six of force, row by row of speed."""
_WORDS = ("trial_type", "stimulus", "phase")
_NUMBERS = ("time_elapsed", "rt", "strokes", "taps", "contact_s")
_PLACE = ("stimulus", "phase", "repeat", "anchor_a", "anchor_b", "t")
_FRAMES = {
    "trials": (*_WORDS, *_NUMBERS),
    "ratings": (*_PLACE, "attribute", "rating"),
    "answers": ("form", "item", "value"),
    "tries": ("order", "prompt", "certainty"),
}
_Kept = Dict[str, List[Tuple[Any, ...]]]


class StudyError(AsperityError, ValueError):
    """A dataset that cannot be read; names the file, the row and the column."""

    def __init__(self, message: str, remedy: str = "restore the file as it was recorded") -> None:
        super().__init__(message, remedy)


@dataclass(frozen=True)
class Study:
    """A study with all that its participants answered.

    Attributes
    ----------
    title : str
        The study's title.
    attributes, forms, textures : list of dict
        What was rated and asked, as ``materials/study.json`` and ``textures.json`` have it.
    simulated : False or dict
        What the participants were simulated with, where no person was asked.
    subjects, versions : list of str
        Participants, by the names of their files; versions of Asperity that recorded them.
    seconds : ndarray, shape (trials, 36)
        s in contact in each bin of speed and force; NaN where a trial has none.
    trials, ratings, answers, tries : DataFrame
        Each with subject and trial_index. A row a trial (times in ms, contact in s); a rated
        attribute (0 to 100); an item on a scale, in its points; a prompt tried, order from 1.
    """

    title: str
    attributes: List[Dict[str, Any]]
    forms: List[Dict[str, Any]]
    textures: List[Dict[str, Any]]
    simulated: Union[bool, Dict[str, float]]
    subjects: List[str]
    versions: List[str]
    seconds: NDArray[np.float64]
    trials: Frame
    ratings: Frame
    answers: Frame
    tries: Frame


@dataclass(frozen=True)
class _Row:
    """A row of a file, whose cells are read one by one."""

    file: Path
    number: int
    cells: Dict[str, str]

    def error(self, column: str, cause: str) -> StudyError:
        return StudyError(f"{self.file}: row {self.number}, column {column}: {cause}")

    def real(self, column: str) -> float:
        try:
            return float(self.cells[column] or "nan")
        except ValueError:
            raise self.error(column, f"{self.cells[column]!r} is no number") from None

    def document(self, column: str, kind: type) -> Any:
        try:
            value = json.loads(self.cells[column])
        except ValueError:
            value = None
        if not isinstance(value, kind):
            what = "object" if kind is dict else "list"
            raise self.error(column, f"{self.cells[column][:40]!r} is no JSON {what}")
        return value

    def scale(self, column: str, name: str, value: Any, least: float, most: float) -> float:
        if type(value) not in (int, float) or not least <= value <= most:
            cause = f"{name} is {value!r}, not a number from {least:g} to {most:g}"
            raise self.error(column, cause)
        return float(value)


def load(folder: Union[str, Path]) -> Study:
    """Reads the dataset of a folder.

    Raises `StudyError` for a file that is missing or cannot be read: which one, where, and what to
    do. A dataset without participants gives empty frames.
    """
    folder = Path(folder)
    design = _document(folder / "materials" / "study.json", dict)
    textures = _document(folder / "materials" / "textures.json", list)
    kept: _Kept = {name: [] for name in _FRAMES}
    seconds, subjects, versions = [], [], set()
    for file in sorted((folder / "data").rglob("*_data.csv")):
        subject = re.search(r"(?:^|_)subject-([a-zA-Z0-9]+)_", file.name)
        if subject is None or subject[1] in subjects:
            cause = f"{file}: no subject of its own in the name"
            raise StudyError(cause, "name it like study-NAME_subject-P01_data.csv")
        subjects.append(subject[1])
        for row in _rows(file):
            seconds.append(_trial(row, subject[1], design, kept))
            versions.add(row.cells["version"])
    own = ["subject", "trial_index"]
    return Study(
        title=str(design.get("title") or design.get("name") or folder.name),
        attributes=design.get("attributes") or [],
        forms=design.get("forms") or [],
        textures=textures,
        simulated=design.get("simulated") or False,
        subjects=subjects,
        versions=sorted(versions - {""}),
        seconds=np.array(seconds, dtype=float).reshape(-1, BINS),
        **{it: pandas.DataFrame(kept[it], columns=[*own, *_FRAMES[it]]) for it in _FRAMES},
    )


def _text(file: Path) -> str:
    try:
        return file.read_bytes().decode("utf-8")
    except OSError as error:
        remedy = "give the folder of a dataset that `asperity study` wrote"
        raise StudyError(f"{file}: {error.strerror or error}", remedy) from None
    except UnicodeDecodeError as error:
        raise StudyError(f"{file}: not UTF-8: {error}") from None


def _document(file: Path, kind: type) -> Any:
    try:
        value = json.loads(_text(file))
    except json.JSONDecodeError as error:
        raise StudyError(f"{file}: row {error.lineno}: {error.msg}") from None
    if not isinstance(value, kind):
        raise StudyError(f"{file}: not what `asperity study` writes there")
    return value


def _rows(file: Path) -> List[_Row]:
    try:
        header, *rows = table.rows(_text(file)) or [[]]
    except table.TableError as error:
        raise StudyError(f"{file}: {error}") from None
    missing = ", ".join(name for name in COLUMNS if name not in header)
    if missing:
        raise StudyError(f"{file}: row 1: no column {missing}")
    for number, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise StudyError(f"{file}: row {number}: {len(row)} cells under {len(header)} columns")
    return [_Row(file, number, dict(zip(header, row))) for number, row in enumerate(rows, 2)]


def _trial(row: _Row, subject: str, design: Dict[str, Any], kept: _Kept) -> List[float]:
    """Puts a trial's answers where they belong; gives its seconds by bin."""
    cells, own = row.cells, (subject, row.real("trial_index"))
    words = (cells[name] for name in _WORDS)
    kept["trials"].append((*own, *words, *(row.real(name) for name in _NUMBERS)))
    if cells["trial_type"] == "texture-rating":
        response = row.document("response", dict)
        place = [row.real(it) if it in ("repeat", "t") else cells[it] for it in _PLACE]
        for name in (attribute["name"] for attribute in design.get("attributes") or []):
            value = row.scale("response", name, response.get(name), 0, 100)
            kept["ratings"].append((*own, *place, name, value))
    elif cells["trial_type"] == "form":
        form = [it for it in design.get("forms") or [] if it["name"] == cells["form"]]
        if not form:
            raise row.error("form", f"materials/study.json has no form {cells['form']!r}")
        items = {item["name"]: item for item in form[0]["items"] if not item.get("text")}
        for item, value in row.document("response", dict).items():
            if isinstance(value, str):
                continue  # answers in words are for people to read
            if item not in items:
                raise row.error("response", f"the form {cells['form']} has no item {item!r}")
            value = row.scale("response", item, value, items[item]["least"], items[item]["most"])
            kept["answers"].append((*own, cells["form"], item, value))
    elif cells["trial_type"] == "prompt":
        tries = row.document("response", dict).get("tries") or []
        if not all(isinstance(tried, dict) for tried in tries):
            raise row.error("response", "its tries are no JSON objects")
        for order, tried in enumerate(tries, 1):
            certainty = str(tried.get("certainty") or "not said")
            kept["tries"].append((*own, order, str(tried.get("prompt", "")), certainty))
    if not cells["exploration"]:
        return [np.nan] * BINS
    bins = row.document("exploration", list)
    if len(bins) != BINS:
        raise row.error("exploration", f"{len(bins)} numbers instead of {BINS}")
    return [row.scale("exploration", "a bin", value, 0, np.inf) for value in bins]
