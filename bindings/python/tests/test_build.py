"""Libraries and scenes are built, merged and taken apart as the command does it."""

from __future__ import annotations

import _thread
import json
import threading
import time

import pytest

import asperity

MANIFEST = """
[[texture]]
name = "cork"
prompt = "cork"
[[texture]]
name = "grit"
asset = "grit.asp"
[[texture]]
name = "between"
blend = { a = "cork", b = "ice", t = 0.25 }
[[texture]]
name = "ice"
prompt = "wet ice"
"""
SURFACE = """
[[surface]]
texture = "cork"
sphere = { center_m = [0, 0, 0], radius_m = 0.05 }
"""


@pytest.fixture
def manifest(grit, tmp_path):
    grit.save(tmp_path / "grit.asp")
    (tmp_path / "hall.toml").write_text(MANIFEST)
    return tmp_path / "hall.toml"


def same_report(ours: dict, printed: str) -> None:
    theirs = json.loads(printed)
    for report in (ours, theirs):
        report.pop("stages_ms", None)
        report.pop("library", None)
        for texture in report["textures"]:
            # Which program made it, and whether its cache had it.
            texture.pop("key", None)
            texture.pop("cached", None)
        report.pop("made", None)
        report.pop("cached", None)
    assert ours == theirs


def test_a_library_is_that_of_the_command(manifest, command, tmp_path):
    printed = command("build", manifest, "-o", tmp_path / "theirs.aspl", "--json", "--no-cache")
    theirs = (tmp_path / "theirs.aspl").read_bytes()
    (tmp_path / "hall.toml.lock").rename(tmp_path / "theirs.lock")
    shown = []
    library = asperity.build(
        manifest, tmp_path / "ours.aspl", cache=tmp_path / "kept", progress=lambda *at: shown.append(at)
    )
    assert (tmp_path / "ours.aspl").read_bytes() == theirs
    assert (tmp_path / "hall.toml.lock").read_text() == (tmp_path / "theirs.lock").read_text()
    assert library.names == ["between", "cork", "grit", "ice"]
    assert shown[-1] == (4, 4) and shown == sorted(shown)
    assert (library.report["made"], library.report["cached"]) == (4, 0)
    same_report(library.report, printed)
    again = asperity.build(manifest, cache=tmp_path / "kept", locked=True)
    assert again.to_bytes() == theirs
    assert (again.report["made"], again.report["cached"]) == (0, 4)


def test_shards_merge_to_the_whole_and_options_reach_the_build(manifest, command, tmp_path):
    command("build", manifest, "-o", tmp_path / "one.aspl", "--shard", "1/2", "--preview-size", 64)
    options = {"cache": tmp_path / "kept", "preview": 64, "confined": True, "min_certainty": "close"}
    shards = [asperity.build(manifest, shard=f"{n}/2", **options) for n in (1, 2)]
    assert shards[0].to_bytes() == (tmp_path / "one.aspl").read_bytes()
    merged = asperity.merge(shards, tmp_path / "both.aspl")
    assert merged.to_bytes() == asperity.build(manifest, **options).to_bytes()
    assert (tmp_path / "both.aspl").read_bytes() == merged.to_bytes()
    assert shards[1].report["shard"] == "2/2" and merged.report is None


def test_a_scene_is_built_within_its_budget_as_the_command_does(manifest, command, tmp_path):
    manifest.write_text(MANIFEST + SURFACE)
    for options, arguments in [
        ({}, []),
        ({"target": "cortex-m4f@48MHz", "share": 5}, ["--target", "cortex-m4f@48MHz", "--share", 5]),
        ({"budget_bytes": 4000}, ["--budget-bytes", 4000]),
    ]:
        out = tmp_path / "desk.aspl"
        printed = command("build", manifest, "-o", out, "--json", *arguments)
        with pytest.warns(asperity.AsperityWarning, match="no surface wears"):
            scene = asperity.build(manifest, cache=tmp_path / "kept", **options)
        assert isinstance(scene, asperity.Scene)
        assert scene.to_bytes() == out.read_bytes()
        same_report(scene.report, printed)


def test_what_the_command_does_with_a_library_python_does(grit, texture, command, tmp_path):
    library = asperity.pack([grit, texture, texture.rename("paper")], tmp_path / "hall.aspl")
    renamed = library.rename("paper", "sheet")
    command("rename", tmp_path / "hall.aspl", "paper", "sheet", "-o", tmp_path / "renamed.aspl")
    assert renamed.to_bytes() == (tmp_path / "renamed.aspl").read_bytes()
    command("extract", tmp_path / "hall.aspl", "paper", "-o", tmp_path / "paper.asp")
    assert library.extract("paper").to_bytes() == (tmp_path / "paper.asp").read_bytes()
    command("split", tmp_path / "hall.aspl", "--into", 2, "-o", tmp_path / "parts")
    parts = [part.to_bytes() for part in library.split(2)]
    assert parts == [file.read_bytes() for file in sorted((tmp_path / "parts").iterdir())]
    (tmp_path / "same.aspl").write_bytes(library.to_bytes())
    printed = command("diff", tmp_path / "hall.aspl", tmp_path / "same.aspl", "--json")
    assert asperity.diff(library, library) == json.loads(printed)
    difference = asperity.diff(library, renamed)
    assert (difference["added"], difference["removed"]) == (["sheet"], ["paper"])
    assert list(asperity.diff(texture, texture.edit(rougher=5))["changed"]) == [texture.name]


def test_a_build_that_is_interrupted_ends_and_writes_nothing(manifest, tmp_path):
    names = "".join(f'[[texture]]\nname = "{n}"\nprompt = "cork {n}"\n' for n in range(2000))
    manifest.write_text(names)
    timer = threading.Timer(1.0, _thread.interrupt_main)
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        asperity.build(manifest, tmp_path / "out.aspl", cache=tmp_path / "kept")
    # The whole of it takes minutes.
    assert time.monotonic() - begin < 20
    assert sorted(file.name for file in tmp_path.iterdir() if file.is_file()) == ["grit.asp", "hall.toml"]

    def stop(done: int, total: int) -> None:
        assert total == 2000
        raise RuntimeError(f"enough after {done}")

    with pytest.raises(RuntimeError, match="enough"):
        asperity.build(manifest, tmp_path / "out.aspl", cache=tmp_path / "kept", progress=stop)


def test_what_cannot_be_built_says_why(manifest, grit, texture, tmp_path):
    (tmp_path / "wrong.toml").write_text('[[texture]]\nname = "a"\nprompt = 1\n[[texture]]\nname = "b"\n')
    (tmp_path / "scene.toml").write_text(MANIFEST + SURFACE)
    build, library = asperity.build, asperity.pack([grit, texture])
    for expected, part, wrong in [
        (asperity.UsageError, "share = 0", lambda: build(manifest, share=0)),
        (asperity.UsageError, "shard = ", lambda: build(manifest, shard="3/2")),
        (asperity.UsageError, "target = ", lambda: build(manifest, target="z80@4MHz")),
        (asperity.UsageError, "min_certainty = ", lambda: build(manifest, min_certainty="sure")),
        (asperity.UsageError, "target: it applies only to scenes", lambda: build(manifest, target="2500")),
        (asperity.UsageError, "shard: it applies only to lib", lambda: build(tmp_path / "scene.toml", shard="1/2")),
        (asperity.AsperityError, "gone.toml", lambda: build(tmp_path / "gone.toml")),
        (asperity.AsperityError, "wrong.toml.*wrong.toml", lambda: build(tmp_path / "wrong.toml")),
        (asperity.AsperityError, "no lock file", lambda: build(manifest, locked=True)),
        (asperity.AsperityError, "an input", lambda: build(manifest, manifest)),
        (asperity.AsperityError, "already a texture", lambda: library.rename(0, texture.name)),
        (asperity.NoSuchTextureError, "no texture", lambda: library.rename("none", "cork")),
        (asperity.UsageError, "into = 0", lambda: library.split(0)),
        (asperity.AsperityError, "different contents", lambda: asperity.merge([grit, texture.rename(grit.name)])),
    ]:
        with pytest.raises(expected, match=f"(?s){part}.*help: ."):
            wrong()
