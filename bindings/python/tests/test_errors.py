"""Errors say what is wrong and what to do about it."""

from __future__ import annotations

import numpy as np
import pytest

import asperity


def raised(expected, *parts):
    """A context that checks class, message and remedy."""
    return pytest.raises(expected, match=".*".join(("(?s)", *parts, "help: .")))


def test_what_makes_no_sense_is_a_usage_error_that_names_the_argument(texture):
    render = asperity.Renderer(texture).render
    for part, wrong in [
        ("prompt: it is empty", lambda: asperity.compile(" \n")),
        ("seed = -1", lambda: asperity.compile("cork", seed=-1)),
        ("rate = 3 Hz", lambda: asperity.compile("cork", rate=3)),
        ('fidelity = "most"', lambda: asperity.compile("cork", fidelity="most")),
        ('fidelity = "25"', lambda: asperity.compile("cork", fidelity=25)),
        ("text_encoder = ", lambda: asperity.Author(text_encoder="bert")),
        ("text_encoder: ", lambda: asperity.Author(text_encoder="clip:.")),
        ("backend = ", lambda: asperity.Author(backend="gpu")),
        (r"positions_m: float64 of shape \[3\]", lambda: render([0.0, 0.0, 0.0])),
        (r"positions_m: float64 of shape \[2, 2\]", lambda: render(np.zeros((2, 2)))),
        ("positions_m: <U1", lambda: render([["a", "b", "c"]])),
        ("positions_m: complex128", lambda: render(np.zeros((1, 3), complex))),
        (r"elapsed_ticks\[1\] = -1", lambda: render(np.zeros((2, 3)), [1, -1])),
        (r"elapsed_ticks: int64 of shape \[3\]", lambda: render(np.zeros((2, 3)), np.ones(3, "i8"))),
        ("elapsed_ticks: float64", lambda: render(np.zeros((1, 3)), [1.0])),
        ("1500 Hz", lambda: asperity.Renderer(texture, rate=1500)),
        ("rate = 10", lambda: asperity.Renderer(texture, rate=10)),
        ("peak_n = -1", lambda: asperity.Renderer(texture, peak_n=-1)),
        ("slew_n_s = NaN", lambda: asperity.Renderer(texture, slew_n_s=float("nan"))),
        ("solid = ", lambda: asperity.Renderer(texture, solid="ball")),
        ("solid.center_m = ", lambda: asperity.Renderer(texture, solid=asperity.Sphere(0, 1))),
        ("solid.radius_m = -1", lambda: asperity.Renderer(texture, solid=asperity.Sphere((0, 0, 0), -1))),
        ("symbol = .a-b", lambda: asperity.export(texture, "rust", symbol="a-b")),
        ("symbol: a wav file", lambda: asperity.export(texture, "wav", symbol="a")),
        ("keep_preview: a wav file", lambda: asperity.export(texture, "wav", keep_preview=True)),
        ("preview = 7", lambda: asperity.compile("cork", preview=7)),
        ("vibration_axis = ", lambda: asperity.Renderer(texture, vibration_axis="up")),
    ]:
        with raised(asperity.UsageError, part):
            wrong()
    assert issubclass(asperity.UsageError, ValueError)
    assert issubclass(asperity.UsageError, asperity.AsperityError)


def test_a_file_at_fault_is_named_with_the_remedy(texture, tmp_path):
    (tmp_path / "text.asp").write_text("no asset")
    (tmp_path / "short.asp").write_bytes(texture.to_bytes()[:-1])
    (tmp_path / "model.json").write_text("{")
    (tmp_path / "model.xml").write_text("<nothing/>")
    for part, wrong in [
        ("missing.asp: cannot read it", lambda: asperity.load(tmp_path / "missing.asp")),
        ("text.asp: neither", lambda: asperity.load(tmp_path / "text.asp")),
        ("short.asp: asset: .* truncated", lambda: asperity.load(tmp_path / "short.asp")),
        ("model.json: ", lambda: asperity.import_model(tmp_path / "model.json")),
        ("model.xml", lambda: asperity.import_hatt(tmp_path / "model.xml")),
        ("nowhere", lambda: asperity.Author(tmp_path / "nowhere")),
        ("cannot reach its folder", lambda: texture.save(tmp_path / "no" / "folder.asp")),
        ("cannot write a file there", lambda: texture.plot(tmp_path)),
        ("written: ", lambda: asperity.pack([texture, texture])),
    ]:
        with raised(asperity.AsperityError, part):
            wrong()
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        "model.json",
        "model.xml",
        "short.asp",
        "text.asp",
    ]


def test_parts_of_an_error_can_be_asked_for():
    with pytest.raises(asperity.AsperityError) as caught:
        asperity.load(b"no asset")
    error = caught.value
    assert str(error) == f"{error.message}\n  help: {error.remedy}"
    assert error.message.startswith("data: ")


def test_another_type_is_a_type_error(texture):
    for wrong in (
        lambda: asperity.load(3),
        lambda: asperity.Renderer("cork"),
        lambda: asperity.pack(["cork"]),
        lambda: asperity.compile(3),
    ):
        with pytest.raises(TypeError):
            wrong()
