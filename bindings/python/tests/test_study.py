"""The analysis of studies gives what is worked out by hand, and its intervals cover."""

from __future__ import annotations

import csv
import json
from itertools import combinations

import numpy as np
import pytest

for package in ("pandas", "scipy", "matplotlib"):
    pytest.importorskip(package, reason=f"the analysis of studies needs {package}")
import pandas  # noqa: E402

from asperity import study  # noqa: E402
from asperity.study import agreement, exploration, forms, midpoints  # noqa: E402
from asperity.study.__main__ import main  # noqa: E402
from asperity.study.load import COLUMNS  # noqa: E402
from asperity.study.statistics import cronbach_alpha, kendall_w, mean_interval  # noqa: E402

FAST = study.Options(resamples=200)
LIKERT = {"least": 1, "most": 7, "step": 1}
TLX = ("mental", "physical", "temporal", "performance", "effort", "frustration")


def rated(rows):
    """Ratings of (subject, stimulus, anchor_a, anchor_b, rating, phase) of one attribute."""
    columns = ["subject", "stimulus", "anchor_a", "anchor_b", "rating", "phase"]
    frame = pandas.DataFrame(rows, columns=columns)
    frame["t"] = np.where(frame["anchor_a"] == "", np.nan, 0.5)
    return frame.assign(trial_index=range(len(frame)), attribute="rough")


def of(subject, a, b, mid, again=None):
    rows = [("a", "", "", a), ("b", "", "", b), ("ab", "a", "b", mid), ("a", "", "", again)]
    return [(subject, *row, "main") for row in rows if row[3] is not None]


def test_places_are_those_worked_out_by_hand():
    rows = [*of("P1", 20, 60, 50, 30), *of("P2", 80, 40, 30), *of("P3", 50, 59, 55)]
    rows += [("P1", "a", "", "", 99, "practice"), ("P1", "a", "", "", 99, "catch")]
    ratings = rated(rows + of("P4", None, 50, 40))
    found = midpoints.places(ratings)
    assert list(found["t_a"]) == pytest.approx([25 / 35, 1.25, np.nan, np.nan], nan_ok=True)
    assert list(found["status"]) == ["kept", "kept", "no difference", "no anchors"]
    rates = midpoints.inside_rates(found, FAST).iloc[0]
    assert (rates["value"], rates["n"], rates["low"], rates["high"]) == (0.5, 2, 0, 1)
    assert (rates["kept"], rates["no difference"], rates["no anchors"]) == (2, 1, 1)
    median = midpoints.medians(found, FAST).iloc[0]
    assert median["value"] == pytest.approx((25 / 35 + 1.25) / 2) and median["left_out"] == 2
    assert midpoints.places(ratings, study.Options(guard=5))["t_a"][2] == pytest.approx(5 / 9)


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 0, 2)])
def test_dominance_is_that_worked_out_by_hand(order):
    people = {"P1": (20, 60, 50), "P2": (30, 70, 54)}
    ratings = rated([row for who, it in people.items() for row in of(who, *(it[k] for k in order))])
    found = midpoints.dominance(ratings).iloc[0]
    assert found["value"] == pytest.approx(0.5 + (10 + 4) / 2 / 40)
    assert found["high"] - found["value"] == pytest.approx(12.706 * 3 / 40, rel=1e-4)
    assert (found["n"], found["pairs"], found["found"]) == (2, 1, False)
    assert midpoints.dominance(ratings, study.Options(guard=41)).iloc[0]["left_out"] == 1


def simulated(w, seed):
    """20 participants rate 5 anchors at 20 to 80 and their midpoints in a random direction."""
    random, rows = np.random.default_rng(seed), []
    true = dict(zip("abcde", random.permutation(np.linspace(20, 80, 5))))
    felt = [(name, "", "", value) for name, value in true.items()]
    for a, b in (random.permutation(pair) for pair in combinations(true, 2)):
        low, high = sorted((true[a], true[b]))
        felt.append((a + b, a, b, w * high + (1 - w) * low))
    for person, bias in enumerate(random.normal(0, 4, 20)):
        for *texture, value in felt:
            rating = np.clip(round(value + bias + random.normal(0, 6)), 0, 100)
            rows.append((person, *texture, rating, "main"))
    return rated(rows)


def test_the_interval_of_dominance_covers_what_was_planted():
    planted = [midpoints.dominance(simulated(0.6, seed)).iloc[0] for seed in range(100)]
    assert 90 <= sum(it["low"] <= 0.6 <= it["high"] for it in planted) <= 98
    none = [midpoints.dominance(simulated(0.5, seed)).iloc[0] for seed in range(100)]
    assert sum(it["found"] for it in none) <= 8


def test_concordance_is_that_of_the_textbook_with_and_without_ties():
    w, p = kendall_w([[1, 2, 3, 4], [1, 2, 3, 4], [1, 2, 3, 4]])
    assert w == 1 and p == pytest.approx(0.0293, abs=1e-4)
    # Rank sums 3.5, 3, 5.5: S = 3.5; one tie of two: T = 6; W = 12 S / (4 · 24 − 2 · 6).
    assert kendall_w([[1, 2, 3], [5, 4, 5]])[0] == pytest.approx(12 * 3.5 / (96 - 12))
    assert kendall_w([[1, 1, 9], [3, 2, 9]])[0] == pytest.approx(12 * 6.5 / (96 - 12))
    assert np.isnan(kendall_w([[1, 2, 3]])[0]) and np.isnan(kendall_w([[1, 1], [2, 2]])[0])
    rows = [row for k in range(5) for row in of(f"P{k}", 20, 80, 50)]
    ratings = rated(rows + of("P9", 20, None, 50))
    found = agreement.agreement(ratings).iloc[0]
    assert list(found[["value", "low", "high", "n", "textures", "left_out"]]) == [1, 1, 1, 5, 3, 1]


def textures(**places):
    return [{"name": name, "attributes": {"rough": place}} for name, place in places.items()]


def test_prediction_and_consistency():
    rows = [row for k in range(4) for row in of(f"P{k}", 20, 80, 50 + k)]
    ratings = rated(rows + [(f"P{k}", "a", "", "", 23 + k, "catch") for k in range(4)])
    found = agreement.prediction(ratings, textures(a=1, b=2, ab=3), FAST).iloc[0]
    assert found["value"] == pytest.approx(0.5) and found["low"] == pytest.approx(0.5)
    found = agreement.consistency(ratings, FAST).set_index("measure")
    assert found.loc["mean absolute difference", "value"] == pytest.approx(4.5)
    between, within = 2 * 1.25 / 3, (9 + 16 + 25 + 36) / 8  # mean squares
    expected = (between - within) / (between + within)
    assert found.loc["ICC(1,1)", "value"] == pytest.approx(expected)


def form_of(answers, **form):
    rows = [(f"P{k}", form["name"], *it) for k, of in enumerate(answers) for it in of.items()]
    frame = pandas.DataFrame(rows, columns=["subject", "form", "item", "value"])
    return forms.scores(form, frame).set_index("score"), forms.shares(form, frame)


def test_scores_of_forms_are_those_worked_out_by_hand():
    items = [{"name": name, "least": 0, "most": 100, "step": 5} for name in TLX]
    answers = [dict(zip(TLX, (10, 20, 30, 40, 50, 60))), dict(zip(TLX, (55,) * 6)), {"mental": 100}]
    found, shares = form_of(answers, name="tlx", kind="tlx", items=items)
    assert found.loc["raw TLX", "value"] == 45 and found.loc["raw TLX", "left_out"] == 1
    assert found.loc["item mental", "value"] == 55 and found.loc["item mental", "n"] == 3
    assert list(shares.loc["mental"]) == pytest.approx([1 / 3, 0, 1 / 3, 0, 1 / 3, 3])
    items = [{"name": f + k, "factor": f, "reversed": k == "2"} for f in "AIRHD" for k in "12"]
    items = [{**item, **LIKERT} for item in items]
    answers = [{it["name"]: 2 if it["reversed"] else 6 - k for it in items} for k in (0, 2)]
    found, shares = form_of(answers, name="hxi", items=items)
    assert list(found["value"][["A", "D", "total"]]) == [5.5, 5.5, 4 * 5.5 + 8 - 5.5]
    assert shares.loc["A1", "4"] == 0.5 and shares.loc["A2", "2"] == 1
    words = [{"name": "why", "text": True}]
    assert all(len(it) == 0 for it in form_of([], name="words", items=words))
    assert cronbach_alpha([[1, 2], [2, 3], [3, 4]]).value == pytest.approx(1)
    assert cronbach_alpha([[1, 2], [2, 2], [3, 5]]).value == pytest.approx(2 * (1 - 4 / 7))
    assert mean_interval([1, 2, 3, np.nan])[:3] == pytest.approx((2, -0.4841, 4.4841), abs=1e-4)


def write(folder, people=3, has_midpoints=True, has_forms=True, simulated=False):
    """A dataset whose participants rate a, b and perhaps ab, fill a form and try a prompt."""
    [(folder / name).mkdir(parents=True) for name in ("data", "materials")]
    form = {"name": "ease", "items": [{"name": name, **LIKERT} for name in ("x", "y")]}
    design = {"title": "A <b>", "attributes": [{"name": "rough"}], "simulated": simulated}
    design["forms"] = [form] * has_forms
    (folder / "materials/study.json").write_text(json.dumps(design))
    (folder / "materials/textures.json").write_text(json.dumps(textures(a=9, b=80, ab=50)))
    about = {"@context": "https://schema.org/", "@type": "Dataset", "name": "s", "description": "s"}
    about["variableMeasured"] = [{"@type": "PropertyValue", "name": name} for name in COLUMNS]
    (folder / "dataset_description.json").write_text(json.dumps(about))
    bins = [0.5, 0.05] + [0.0] * 34
    felt = {"strokes": 4, "taps": 2, "contact_s": 3.5, "exploration": bins}
    rating = {"trial_type": "texture-rating", "phase": "main", "repeat": 1, **felt}
    between = {"stimulus": "ab", "anchor_a": "a", "anchor_b": "b", "t": 0.5}
    for k in range(people):
        ends = {"a": 20 + k, "b": 70}
        rows = [{**rating, "stimulus": it, "response": {"rough": ends[it]}} for it in ends]
        rows += [{**rating, **between, "response": {"rough": 50 - k}}] * has_midpoints
        rows += [{"trial_type": "form", "form": "ease", "response": {"x": 3, "y": 3}}] * has_forms
        tries = [{"prompt": 'a "wet",\nbark', "certainty": "known"}] * (1 + k % 2)
        rows += [{"trial_type": "prompt", "response": {"tries": tries}, "exploration": bins}]
        with open(folder / f"data/study-s_subject-P{k:02}_data.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
            writer.writeheader()
            for index, row in enumerate(rows):
                json_cells = {"response", "exploration"} & row.keys()
                row |= {name: json.dumps(row[name]) for name in json_cells}
                writer.writerow({**row, "trial_index": index, "time_elapsed": 60000 * index})
    return folder


def test_exploration_and_prompts(tmp_path):
    recorded = study.load(write(tmp_path))
    seconds, n = exploration.seconds_by_bin(recorded)
    assert (seconds[0, 0], seconds[0, 1], n) == (1.5, pytest.approx(0.15), 3)
    effort = exploration.effort(recorded, FAST).set_index(["trials", "measure"])["value"]
    assert effort["main ratings", "strokes"] == 4 and effort["main ratings", "contact, s"] == 3.5
    assert effort["main ratings", "coverage of a trial"] == pytest.approx(1 / 36)
    assert effort["main ratings", "coverage of all"] == pytest.approx(2 / 36)
    found = exploration.prompts(recorded, FAST).set_index("measure")
    assert found.loc["refined", "value"] == pytest.approx(1 / 3)
    assert found.loc["certainty: known", ["count", "of"]].tolist() == [4, 4]


@pytest.mark.parametrize(
    "options, said",
    [
        ({"simulated": {"noise": 6.0}}, ["no person was asked (noise: 6.0)", "A &lt;b&gt;"]),
        ({"people": 1}, ["Participants: 1."]),
        ({"people": 0}, ["No participants.", "No ratings of the main phase."]),
        ({"has_midpoints": False}, ["No midpoints"]),
        ({"has_forms": False}, ["The study has no forms."]),
    ],
)
def test_a_report_is_written_whatever_a_study_lacks(options, said, tmp_path):
    folder, page = write(tmp_path / "d", **options), tmp_path / "report.html"
    assert main(["report", str(folder), "-o", str(page)]) == 0
    text = page.read_text("utf-8")
    assert all(it in text for it in said) and "src=\"http" not in text
    assert ("Simulated" in text) == ("simulated" in options)
    assert sorted(it.name for it in tmp_path.iterdir()) == ["d", "report.html"]


NAME, ABOUT = "study-s_subject-P00_data.csv", "dataset_description.json"


@pytest.mark.parametrize(
    "code, file, edit",
    [
        ("MISSING_DATASET_DESCRIPTION", ABOUT, None),
        ("JSON_INVALID", ABOUT, lambda it: it[:-1]),
        ("INCORRECT_DATASET_TYPE", ABOUT, lambda it: it.replace('"Dataset"', '"Set"')),
        ("JSON_KEY_REQUIRED", ABOUT, lambda it: it.replace("schema.org", "x.org")),
        ("CSV_COLUMN_MISSING_FROM_METADATA", ABOUT, lambda it: it.replace('"rt"', '"r"')),
        ("VARIABLE_MISSING_FROM_CSV_COLUMNS", ABOUT, lambda it: it.replace('"rt"', '"r"')),
        ("CSV_HEADER_MISSING", NAME, lambda it: ""),
        ("CSV_HEADER_REPEATED", NAME, lambda it: it.replace("anchor_b", "anchor_a", 1)),
        ("CSV_HEADER_LENGTH_MISMATCH", NAME, lambda it: it + "\n"),
        ("CSV_FORMATTING_ERROR", NAME, lambda it: it + 'a"b\n'),
        ("ROWID_VALUES_NOT_UNIQUE", NAME, lambda it: it.replace("version", "row_id", 1)),
        ("BYTE_ORDER_MARK", NAME, lambda it: "\ufeff" + it),
        ("COLUMN_UNKNOWN", NAME, lambda it: it.replace("device", "gadget", 1)),
        ("TRIAL_INDEX_NOT_RISING", NAME, lambda it: it.replace("rating,1,", "rating,0,")),
        ("SUBJECT_NOT_UNIQUE", "session-2_subject-P01_data.csv", str),
        ("FILENAME_KEYWORD_FORMATTING_ERROR", "Subject-P09_data.csv", str),
        ("FILENAME_UNOFFICIAL_KEYWORD_WARNING", "run-1_subject-P09_data.csv", str),
    ],
)
def test_a_broken_dataset_gets_its_code(code, file, edit, tmp_path, capsys):
    write(tmp_path)
    assert main(["check", str(tmp_path)]) == 0
    path = tmp_path / ("" if file == ABOUT else "data") / file
    text = (path if path.exists() else tmp_path / "data" / NAME).read_text("utf-8")
    path.unlink() if edit is None else path.write_bytes(edit(text).encode())
    assert main(["check", str(tmp_path)]) == int("WARNING" not in code)
    assert f"[{code}]" in capsys.readouterr().out


def test_what_cannot_be_read_names_file_row_and_column(tmp_path, capsys):
    path = write(tmp_path) / "data" / NAME
    text = path.read_text("utf-8")
    for edit in [("rating,1,", "rating,x,"), ('rough"": 20', 'rough"": 120'), ("ease", "easy")]:
        path.write_text(text.replace(*edit, 1))
        with pytest.raises(study.StudyError, match=rf"(?s){NAME}: row \d, column \w+: .*help: ."):
            study.load(tmp_path)
    assert main(["report", str(tmp_path / "none")]) == 1
    assert "study.json: No such file" in capsys.readouterr().err
