"""Whether a dataset follows Psych-DS (https://psych-ds.github.io), and what a study adds to it."""

from __future__ import annotations

import json
import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Iterator, List, Set, Union

from . import table
from .load import COLUMNS

_IGNORED = {
    *(".git", ".DS_Store", "sourcedata", "code", "stimuli", "materials", "results", "products"),
    *("analysis", "documentation", "log"),
}
_NAME = re.compile(r"([a-z]+-[a-zA-Z0-9]+)(_[a-z]+-[a-zA-Z0-9]+)*_data\.csv")
_KEYWORDS = "study site subject session task condition trial stimulus description".split()
_CONTEXT = re.compile(r"https?://(www\.)?schema\.org/?")
_RESTORE = "restore the file as it was recorded"
_REMEDIES = {
    "MISSING_DATASET_DESCRIPTION": "add it, or give the folder that holds it",
    "MISSING_DATA_DIRECTORY": "put the participants' files into a folder `data`",
    "MISSING_DATAFILE": "add study-NAME_subject-P01_data.csv of a participant",
    "JSON_ENCODING_ERROR": "save it as UTF-8",
    "JSON_INVALID": "correct it; a byte order mark is not JSON",
    "JSON_KEY_REQUIRED": 'give it; "@context" is "https://schema.org/"',
    "INCORRECT_DATASET_TYPE": 'set "@type" to "Dataset"',
    "MISSING_DATASET_TYPE": 'set "@type" to "Dataset"',
    "FILENAME_KEYWORD_FORMATTING_ERROR": "name it like study-NAME_subject-P01_data.csv",
    "FILENAME_UNOFFICIAL_KEYWORD_WARNING": f"use one of {', '.join(_KEYWORDS)}",
    "CSV_COLUMN_MISSING_FROM_METADATA": "describe it in dataset_description.json",
    "VARIABLE_MISSING_FROM_CSV_COLUMNS": "take it out of variableMeasured",
    "CSV_FORMATTING_ERROR": "quote cells as RFC 4180 says, in UTF-8",
    "CSV_HEADER_MISSING": "start it with the names of the columns",
    "CSV_HEADER_REPEATED": "name each column once",
    "CSV_HEADER_LENGTH_MISMATCH": "give a row a cell for each column, and leave no blank line",
    "ROWID_VALUES_NOT_UNIQUE": "give each row an id of its own",
    "BYTE_ORDER_MARK": "save it as UTF-8 without one",
    "COLUMN_UNKNOWN": _RESTORE,
    "COLUMN_MISSING": _RESTORE,
    "TRIAL_INDEX_NOT_RISING": _RESTORE,
    "SUBJECT_NOT_UNIQUE": "give each participant one file, with the subject in its name",
}


@dataclass(frozen=True)
class Finding:
    """What is wrong: a code of Psych-DS or our own, the file within the dataset, and the cause."""

    code: str
    file: str
    cause: str

    @property
    def is_error(self) -> bool:
        """Whether it breaks a rule, not just a custom."""
        return not self.code.endswith("WARNING")

    def __str__(self) -> str:
        kind = "error" if self.is_error else "warning"
        return f"{kind}[{self.code}]: {self.file}: {self.cause}\n  help: {_REMEDIES[self.code]}"


def check(folder: Union[str, Path]) -> List[Finding]:
    """All that is wrong with the dataset of a folder; nothing where it follows the rules."""
    folder = Path(folder)
    return list(_dataset(folder, folder / "dataset_description.json", folder / "data"))


def _dataset(folder: Path, description: Path, data: Path) -> Iterator[Finding]:
    variables: Set[str] = set()
    columns: Set[str] = set()
    subjects: Dict[str, str] = {}
    if description.is_file():
        yield from _description(description, variables)
    else:
        yield Finding("MISSING_DATASET_DESCRIPTION", description.name, "no such file")
    if not data.is_dir():
        yield Finding("MISSING_DATA_DIRECTORY", "data", "no such folder")
    every = sorted(data.rglob("*.csv"))
    files = [path for path in every if not _IGNORED.intersection(path.relative_to(folder).parts)]
    for path in files:
        file = path.relative_to(folder).as_posix()
        yield from _file_name(path, file, subjects)
        yield from _file(path, file, variables, columns)
    if data.is_dir() and not any(_NAME.fullmatch(path.name) for path in files):
        yield Finding("MISSING_DATAFILE", "data", "no file of a participant")
    for it in sorted(variables - columns):
        cause = f"{it!r} is no column of a CSV file"
        yield Finding("VARIABLE_MISSING_FROM_CSV_COLUMNS", description.name, cause)


def _description(path: Path, variables: Set[str]) -> Iterator[Finding]:
    file = path.name
    try:
        value: Any = json.loads(path.read_bytes().decode("utf-8"))
    except ValueError as error:
        is_text = not isinstance(error, UnicodeDecodeError)
        yield Finding("JSON_INVALID" if is_text else "JSON_ENCODING_ERROR", file, str(error))
        return
    value = value if isinstance(value, dict) else {}
    for key in ("name", "description", "variableMeasured"):
        if not value.get(key):
            yield Finding("JSON_KEY_REQUIRED", file, f"no {key}")
    context, kind = value.get("@context"), value.get("@type")
    if not isinstance(context, str) or not _CONTEXT.fullmatch(context):
        yield Finding("JSON_KEY_REQUIRED", file, f"@context is {context!r}")
    if kind != "Dataset":
        code = "INCORRECT_DATASET_TYPE" if kind else "MISSING_DATASET_TYPE"
        yield Finding(code, file, f"@type is {kind!r}")
    measured = value.get("variableMeasured")
    for it in measured if isinstance(measured, list) else [measured]:
        name = it.get("name") if isinstance(it, dict) else it
        variables.update([name] if isinstance(name, str) else [])


def _file_name(path: Path, file: str, subjects: Dict[str, str]) -> Iterator[Finding]:
    if not _NAME.fullmatch(path.name):
        yield Finding("FILENAME_KEYWORD_FORMATTING_ERROR", file, "not keyword-value_…_data.csv")
        return
    pairs = dict(part.split("-") for part in path.stem.split("_")[:-1])
    for keyword in sorted(pairs.keys() - _KEYWORDS):
        yield Finding("FILENAME_UNOFFICIAL_KEYWORD_WARNING", file, f"{keyword} is not official")
    other = subjects.setdefault(pairs.get("subject", ""), file)
    if "subject" not in pairs or other != file:
        yield Finding("SUBJECT_NOT_UNIQUE", file, f"{other} has the same subject, or it has none")


def _file(path: Path, file: str, variables: Set[str], columns: Set[str]) -> Iterator[Finding]:
    data = path.read_bytes()
    if data.startswith(b"\xef\xbb\xbf"):
        cause = "a byte order mark, which becomes part of the first column's name"
        yield Finding("BYTE_ORDER_MARK", file, cause)
    try:
        header, *rows = table.rows(data.decode("utf-8-sig")) or [[""]]
    except ValueError as error:
        yield Finding("CSV_FORMATTING_ERROR", file, str(error))
        return
    if header == [""]:
        yield Finding("CSV_HEADER_MISSING", file, "row 1: no header")
        return
    columns.update(header)
    for column, count in Counter(header).items():
        if count > 1:
            yield Finding("CSV_HEADER_REPEATED", file, f"row 1: {count} columns {column!r}")
        if column not in variables:
            cause = f"column {column!r} is not in variableMeasured"
            yield Finding("CSV_COLUMN_MISSING_FROM_METADATA", file, cause)
        if column not in COLUMNS:
            yield Finding("COLUMN_UNKNOWN", file, f"column {column!r} is not of a study")
    for column in (it for it in COLUMNS if it not in header):
        yield Finding("COLUMN_MISSING", file, f"no column {column!r}")
    last, ids = -1, set()
    for number, row in enumerate(rows, 2):
        cells = dict(zip(header, row))
        index, id_ = cells.get("trial_index", str(last + 1)), cells.get("row_id", number)
        if len(row) != len(header):
            cause = f"row {number}: {len(row)} cells under {len(header)} columns"
            yield Finding("CSV_HEADER_LENGTH_MISMATCH", file, cause)
        elif id_ in ids:
            yield Finding("ROWID_VALUES_NOT_UNIQUE", file, f"row {number}: row_id {id_!r} again")
        elif not re.fullmatch("[0-9]+", index) or int(index) <= last:
            cause = f"row {number}, column trial_index: {index!r} after {last}"
            yield Finding("TRIAL_INDEX_NOT_RISING", file, cause)
        else:
            last = int(index)
        ids.add(id_)
