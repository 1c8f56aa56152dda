"""Solids and scenes are rendered as the command renders them."""

from __future__ import annotations

import numpy as np
import pytest

import asperity
from conftest import same_bits, same_table

DESK = """
[[texture]]
name = "grit"
asset = "grit.asp"
[[texture]]
name = "paper"
asset = "paper.asp"
"""
SOLIDS = {
    "plane = { point_m = [0, 0, 0], normal = [0, 0.2, 1] }": asperity.Plane(normal=(0, 0.2, 1)),
    "sphere = { center_m = [0, 0, -0.03], radius_m = 0.032 }": asperity.Sphere((0, 0, -0.03), 0.032),
    "box = { center_m = [0, 0, -0.02], half_extents_m = [0.03, 0.01, 0.02] }": asperity.Box(
        (0, 0, -0.02), (0.03, 0.01, 0.02)
    ),
}


@pytest.fixture
def scene(texture, grit, command, tmp_path):
    """Builds a scene of these solids, whose textures alternate, and returns its file."""

    def build(*solids: str):
        grit.save(tmp_path / "grit.asp")
        texture.save(tmp_path / "paper.asp")
        surfaces = [
            f'[[surface]]\ntexture = "{name}"\n{solid}\n'
            for solid, name in zip(solids, ["grit", "paper"] * 2)
        ]
        (tmp_path / "desk.toml").write_text(DESK + "".join(surfaces))
        command("build", tmp_path / "desk.toml", "-o", tmp_path / "desk.aspl")
        return tmp_path / "desk.aspl"

    return build


@pytest.mark.parametrize("solid", SOLIDS)
def test_a_texture_on_a_solid_is_a_scene_of_that_solid(solid, scene, grit, printed, trajectory_mm):
    table = printed(scene(solid), trajectory_mm, 7)
    rendered = asperity.Renderer(grit, solid=SOLIDS[solid], seed=7).render(trajectory_mm / 1000)
    same_table(rendered, table)
    assert np.abs(rendered.vib_m_s2).max() > 0.1
    assert 0 < rendered.has(asperity.Flags.CONTACT).sum() < len(rendered)


def test_a_scene_gives_the_bits_of_the_command(scene, printed, trajectory_mm):
    path = scene(*SOLIDS)
    table = printed(path, trajectory_mm, 3)
    surfaces = np.array([int(index or -1) for index in table["surface"]], dtype=np.int16)
    assert set(surfaces) == {-1, 0, 1, 2}
    for loaded in (asperity.load(path), asperity.load(path.read_bytes())):
        assert isinstance(loaded, asperity.Scene) and isinstance(loaded, asperity.Library)
        rendered = asperity.Renderer(loaded, seed=3).render(trajectory_mm / 1000)
        same_table(rendered, table)
        same_bits(rendered.surface, surfaces)


@pytest.mark.parametrize("fixed_point", [False, True])
def test_ticks_and_pieces_of_a_scene_give_what_the_whole_gives(scene, trajectory_mm, fixed_point):
    positions_m = trajectory_mm[:1500] / 1000
    desk = asperity.load(scene(*SOLIDS))
    whole = asperity.Renderer(desk, seed=1, fixed_point=fixed_point).render(positions_m)
    renderer = asperity.Renderer(desk, seed=1, fixed_point=fixed_point)
    assert renderer.wall is None
    first = renderer.render(positions_m[:700])
    same_bits(first.force_n, whole.force_n[:700])
    for tick, position_m in enumerate(positions_m[700:], 700):
        output = renderer.tick(position_m)
        assert output.force_n == tuple(map(float, whole.force_n[tick]))
        assert (-1 if output.surface is None else output.surface) == whole.surface[tick]
    assert renderer.counters.ticks == len(positions_m)
    renderer.reset()
    same_bits(renderer.render(positions_m).force_n, whole.force_n)


def test_a_scene_lists_its_surfaces(scene):
    path = scene(*SOLIDS)
    for desk in (asperity.load(path), asperity.load(path.read_bytes())):
        plane, sphere, box = desk.surfaces
        assert plane["texture"] == "grit" and plane["kind"] == "plane"
        assert sphere["texture"] == "paper" and sphere["radius_m"] == pytest.approx(0.032)
        assert box["half_extents_m"] == pytest.approx([0.03, 0.01, 0.02])
        assert desk.names == ["grit", "paper"] and desk["grit"].name == "grit"
        assert desk.to_bytes() == path.read_bytes()
        assert "3 surfaces" in repr(desk)
