"""Exports, recordings and effects are those of the command."""

from __future__ import annotations

import json

import numpy as np
import pytest

import asperity

FORMATS = ["c-array", "rust", "hjif", "hmpg", "ahap", "haptic", "gltf", "wav", "csv"]
FILES = {"c-array": "c", "rust": "rs"}
STROKES = [(speed, load) for load in (0.5, 1.0, 1.6) for speed in (30, 60, 100)]


def without_path(text: str) -> dict:
    report = json.loads(text)
    del report["output"]
    return report


@pytest.mark.parametrize("to", FORMATS)
def test_every_format_has_the_bytes_and_the_loss_of_the_command(to, grit, command, tmp_path):
    grit.save(tmp_path / "grit.asp")
    (tmp_path / "theirs").mkdir()
    theirs = tmp_path / f"theirs/grit.{FILES.get(to, to)}"
    printed = command("export", tmp_path / "grit.asp", "--to", to, "-o", theirs, "--json")
    ours = tmp_path / theirs.name
    exported = asperity.export(grit, to, ours)
    assert exported.report == without_path(printed)
    assert exported.data == ours.read_bytes() == theirs.read_bytes()
    if to == "c-array":
        assert exported.header == ours.with_suffix(".h").read_bytes()
        assert exported.header == theirs.with_suffix(".h").read_bytes()
        assert asperity.export(grit, to).header is None


def test_options_of_an_export_are_those_of_the_command(grit, command, tmp_path):
    grit.save(tmp_path / "grit.asp")
    for to, options, arguments in [
        ("rust", {"symbol": "rough", "keep_preview": True}, ["--symbol", "rough", "--keep-preview"]),
        ("wav", {"taps": True}, ["--taps"]),
        ("hjif", {"speed_mm_s": 200, "force_n": 1.5, "time_s": 0.5}, ["--speed", 200, "--force", 1.5, "--time", 0.5]),
        ("ahap", {"full_scale_m_s2": 10, "tap_full_scale_m_s2": 50}, ["--full-scale", 10, "--tap-full-scale", 50]),
        ("csv", {"seed": 5, "rate": 2000, "time_s": 0.3}, ["--seed", 5, "--rate", 2000, "--time", 0.3]),
        ("gltf", {"size": 64}, ["--size", 64]),
    ]:
        printed = command("export", tmp_path / "grit.asp", "--to", to, "-o", tmp_path / "out", "--json", *arguments)
        exported = asperity.export(grit, to, **options)
        assert exported.data == (tmp_path / "out").read_bytes(), to
        assert exported.report == without_path(printed)


def test_a_library_goes_into_source_text_as_a_whole(grit, texture, command, tmp_path):
    asperity.pack([grit, texture], tmp_path / "hall.aspl")
    printed = command("export", tmp_path / "hall.aspl", "--to", "rust", "-o", tmp_path / "hall.rs", "--json")
    exported = asperity.export(asperity.load(tmp_path / "hall.aspl"), "rust")
    assert exported.data == (tmp_path / "hall.rs").read_bytes()
    assert exported.report == without_path(printed)


@pytest.mark.parametrize("kind", ["ahap", "haptic", "hjif"])
def test_effects_are_those_of_the_command(kind, grit, command, tmp_path):
    # The content tells the format, whatever the file is called.
    effect = tmp_path / "effect.bin"
    asperity.export(grit, kind, effect)
    command("import", kind, effect, "-o", tmp_path / "usual.asp", "--name", "usual")
    usual = asperity.import_effect(effect, name="usual")
    assert usual.to_bytes() == (tmp_path / "usual.asp").read_bytes()
    arguments = ["--speed", 150, "--force", 0.8, "--full-scale", 8, "--tap-full-scale", 40]
    more = ["--tap-speed", 0.2, "--mu", 0.7, "--fidelity", "full", "--rate", 2000, "--no-preview"]
    printed = json.loads(
        command("import", kind, effect, "-o", tmp_path / "own.asp", "--json", *arguments, *more)
    )
    own = asperity.import_effect(
        effect,
        speed_mm_s=150,
        force_n=0.8,
        full_scale_m_s2=8,
        tap_full_scale_m_s2=40,
        tap_speed_m_s=0.2,
        mu=0.7,
        fidelity="full",
        rate=2000,
        preview=False,
    )
    assert own.to_bytes() == (tmp_path / "own.asp").read_bytes()
    assert {**own.report, "stages_ms": None} == {**printed, "stages_ms": None}


@pytest.fixture(scope="session")
def recording(tmp_path_factory):
    """Simulated sensors: a second in the air, then nine strokes. The table of columns at 1 kHz."""
    rng = np.random.default_rng(3)
    ticks = 1200
    velocity, load = [np.zeros(1000)], [np.zeros(1000)]
    for stroke, (speed, force) in enumerate(STROKES):
        shape = np.tanh(12 * np.sin(np.pi * np.arange(ticks) / ticks))
        velocity.append((-1) ** stroke * speed * shape)
        load.append(np.full(ticks, force))
    v, load = np.concatenate(velocity), np.concatenate(load)
    rows = len(v)
    noise = rng.uniform(-0.5, 0.5, (5, rows))
    vibration = np.zeros(rows)
    for n in range(1, rows):
        vibration[n] = 0.6 * vibration[n - 1] + 0.02 * abs(v[n]) * noise[0, n]
    friction = -0.3 * load * np.tanh(v / 5)
    columns = {
        "t": (np.arange(rows) / 1000, None),
        "ax": (vibration + 0.02 * noise[1], ("acceleration", "x", "m/s^2")),
        "az": (9.81 + 0.02 * noise[2], ("acceleration", "z", "m/s^2")),
        "fx": (friction + 0.002 * noise[3], ("force", "x", "N")),
        "fz": (load + 0.002 * noise[4], ("force", "z", "N")),
        "x": (np.cumsum(v) / 1000, ("position", "x", "mm")),
    }
    folder = tmp_path_factory.mktemp("recording") / "oak"
    folder.mkdir()
    table = np.stack([column for column, _ in columns.values()], axis=1)
    np.savetxt(folder / "all.csv", table, "%.5f", ",", header=",".join(columns), comments="")
    description = 'name = "Oak"\n[[file]]\npath = "all.csv"\nclock = "t"\n'
    for name, (_, channel) in columns.items():
        if channel:
            keys = dict(zip(("quantity", "axis", "unit"), channel), column=name)
            lines = "\n".join(f'{key} = "{value}"' for key, value in keys.items())
            description += f"[[file.channel]]\n{lines}\n"
    (folder / "recording.toml").write_text(description)
    return folder


@pytest.mark.filterwarnings("ignore::asperity.AsperityWarning")
def test_a_recording_is_that_of_the_command_with_its_report_and_sheet(recording, command, tmp_path):
    command(
        *("import", "recording", recording, "-o", tmp_path / "oak.asp"),
        *("--report", tmp_path / "oak.json", "--plot", tmp_path / "theirs.png"),
    )
    oak = asperity.import_recording(recording, plot=tmp_path / "ours.png")
    assert oak.to_bytes() == (tmp_path / "oak.asp").read_bytes()
    assert (tmp_path / "ours.png").read_bytes() == (tmp_path / "theirs.png").read_bytes()
    printed = json.loads((tmp_path / "oak.json").read_text("utf-8"))
    report = dict(oak.report)
    for timed in (report, printed):
        del timed["stages_ms"]
        timed["steps"] = [step["step"] for step in timed["steps"]]
    assert report == printed
    assert oak.name == "Oak" and oak.friction.mu == pytest.approx(0.3, abs=0.03)


@pytest.mark.filterwarnings("ignore::asperity.AsperityWarning")
def test_a_surface_is_that_of_the_command(command, tmp_path):
    x = np.arange(2000) * 0.01
    z = 20 * np.sin(2 * np.pi * x) + np.random.default_rng(3).normal(0, 1, 2000)
    np.savetxt(tmp_path / "comb.csv", np.c_[x, z], "%.4f", ",", header="x_mm,z_um", comments="")
    command(
        *("import", "surface", tmp_path / "comb.csv", "-o", tmp_path / "comb.asp"),
        *("--like", "hard plastic", "--tip", "needle", "--plot", tmp_path / "theirs.png"),
    )
    ours = tmp_path / "ours.png"
    comb = asperity.import_surface(tmp_path / "comb.csv", like="hard plastic", tip="needle", plot=ours)
    assert comb.to_bytes() == (tmp_path / "comb.asp").read_bytes()
    assert ours.read_bytes() == (tmp_path / "theirs.png").read_bytes()
    assert comb.report["surface"]["like"] == "hard plastic" and comb.name == "comb"
    for expected, part, keys in [
        (asperity.UsageError, 'tip = "pen"', {"tip": "pen"}),
        (asperity.UsageError, 'normal = "up"', {"normal": "up"}),
        (asperity.UsageError, "width_mm: 0 mm", {"width_mm": 0}),
        (asperity.AsperityError, "comb.csv: width_mm: 5 mm", {"width_mm": 5}),
    ]:
        with pytest.raises(expected, match=f"(?s){part}.*help: ."):
            asperity.import_surface(tmp_path / "comb.csv", **keys)


def test_what_cannot_be_exchanged_says_why(grit, texture, tmp_path):
    (tmp_path / "text.ahap").write_text("no effect")
    (tmp_path / "what.bin").write_text("no effect")
    for expected, part, wrong in [
        (asperity.UsageError, "to = ", lambda: asperity.export(grit, "mp3")),
        (asperity.UsageError, "speed_mm_s = 0", lambda: asperity.export(grit, "wav", speed_mm_s=0)),
        (asperity.UsageError, "size = 8", lambda: asperity.export(grit, "gltf", size=8)),
        (asperity.UsageError, "one texture", lambda: asperity.export(asperity.pack([grit]), "wav")),
        (asperity.UsageError, "mu = 3", lambda: asperity.import_effect("x.ahap", mu=3)),
        (asperity.AsperityError, "gone.ahap", lambda: asperity.import_effect(tmp_path / "gone.ahap")),
        (asperity.AsperityError, "text.ahap", lambda: asperity.import_effect(tmp_path / "text.ahap")),
        (asperity.AsperityError, "what.bin: neither", lambda: asperity.import_effect(tmp_path / "what.bin")),
        (asperity.AsperityError, "oak", lambda: asperity.import_recording(tmp_path / "oak")),
    ]:
        with pytest.raises(expected, match=f"(?s){part}.*help: ."):
            wrong()
