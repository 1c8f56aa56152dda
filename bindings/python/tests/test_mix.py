"""Mixtures and edits have the bytes and the report of the command."""

from __future__ import annotations

import json

import pytest

import asperity


@pytest.fixture(scope="session")
def ice() -> asperity.Texture:
    return asperity.compile("wet ice", preview=False)


@pytest.fixture(scope="session")
def anvil() -> asperity.Texture:
    return asperity.compile("anvil")


@pytest.fixture
def same(command, tmp_path):
    """Checks that a texture is what the command writes of these files, and reports."""

    def check(made: asperity.Texture, verb: str, *arguments: object, **files: asperity.Texture) -> None:
        for name, texture in files.items():
            texture.save(tmp_path / f"{name}.asp")
        paths = [
            tmp_path / f"{argument}.asp" if argument in files else argument for argument in arguments
        ]
        printed = json.loads(command(verb, *paths, "-o", tmp_path / "out.asp", "--json"))
        assert made.to_bytes() == (tmp_path / "out.asp").read_bytes()
        report = dict(made.report)
        del printed["stages_ms"], report["stages_ms"]
        assert report == printed

    return check


@pytest.mark.parametrize("t", [0.0, 0.25, 1.0])
def test_a_blend_is_that_of_the_command(t, texture, ice, same):
    made = asperity.blend(texture, ice, t)
    same(made, "blend", "a", "b", "-t", t, a=texture, b=ice)
    named = asperity.blend(ice, texture, t, name="half", preview=64)
    same(named, *("blend", "a", "b", "-t", t, "--name", "half", "--preview-size", 64), a=ice, b=texture)
    assert named.name == "half" and len(named.preview_png) > 0


def test_a_composition_is_that_of_the_command(texture, ice, anvil, same):
    made = asperity.compose(tap=anvil, slide=texture)
    same(made, *("compose", "--tap", "a", "--slide", "b"), a=anvil, b=texture)
    made = asperity.compose(tap=anvil, slide=texture, friction=ice, preview=False)
    arguments = ("compose", "--tap", "a", "--slide", "b", "--friction", "c", "--no-preview")
    same(made, *arguments, a=anvil, b=texture, c=ice)
    assert made.friction.mu == pytest.approx(ice.friction.mu, rel=0.05)


def test_an_edit_is_that_of_the_command_and_can_be_taken_back(texture, same):
    rougher = texture.edit(rougher=10, slipperier=-5)
    same(rougher, *("edit", "a", "--rougher", 10, "--slipperier", -5), a=texture)
    assert rougher.attributes.rough_db > texture.attributes.rough_db
    assert rougher.report["moved"]["rough"] == pytest.approx(10, abs=3)
    with_words = rougher.edit(prompt="more like leather", name="hide")
    same(with_words, *("edit", "a", "--prompt", "more like leather", "--name", "hide"), a=rougher)
    assert with_words.name == "hide"
    back = with_words.undo(name=texture.name)
    same(back, *("edit", "a", "--undo", "--name", texture.name), a=with_words)
    assert back == rougher and back.undo() == texture


def test_an_edit_that_falls_short_warns_as_the_command_does(ice, same):
    with pytest.warns(asperity.AsperityWarning, match="moved by"):
        far = ice.edit(rougher=100, harder=-100)
    assert any("moved by" in warning for warning in far.report["warnings"])
    same(far, *("edit", "a", "--rougher", 100, "--harder", -100), a=ice)


def test_a_recording_is_encoded_as_the_command_encodes_it(grit, same):
    for part, options in [(None, ()), ("whole", ("--part", "whole"))]:
        encoded = asperity.encode(grit, part)
        same(encoded, "encode", "a", *options, a=grit)
    assert asperity.blend(encoded, encoded).attributes == encoded.attributes


def test_an_author_of_ones_own_mixes(texture, ice):
    author = asperity.Author()
    assert asperity.blend(texture, ice, author=author) == asperity.blend(texture, ice)


def test_what_cannot_be_mixed_says_why(texture, grit):
    for expected, part, wrong in [
        (asperity.UsageError, "t = 2", lambda: asperity.blend(texture, texture, 2)),
        (asperity.UsageError, "t = NaN", lambda: asperity.blend(texture, texture, float("nan"))),
        (asperity.UsageError, "rougher = 101", lambda: texture.edit(rougher=101)),
        (asperity.UsageError, "no edit is given", lambda: texture.edit()),
        (asperity.UsageError, "prompt: ", lambda: texture.edit(rougher=1, prompt="softer")),
        (asperity.UsageError, "names neither", lambda: texture.edit(prompt="qwertz")),
        (asperity.UsageError, "not a valid name", lambda: texture.edit(rougher=1, name="a\n")),
        (asperity.UsageError, "part = ", lambda: asperity.encode(grit, "half")),
        (asperity.AsperityError, "no latent", lambda: asperity.blend(texture, grit)),
        (asperity.AsperityError, "no edit to undo", lambda: texture.undo()),
    ]:
        with pytest.raises(expected, match=f"(?s){part}.*help: .") as raised:
            wrong()
        assert "--" not in str(raised.value)
    with pytest.raises(TypeError):
        asperity.blend(texture, "cork.asp")
