"""What a texture says of itself."""

from __future__ import annotations

import copy
import json
import pickle

import numpy as np
import pytest

import asperity


def test_arrays_have_the_shapes_and_values_that_inspect_prints(texture, command, tmp_path):
    texture.save(tmp_path / "texture.asp")
    printed = json.loads(command("inspect", tmp_path / "texture.asp", "--json"))
    assert texture.to_dict() == printed
    grid, ar = texture.grid, printed["ar"]
    for name in ("speed_mm_s", "force_n", "kind", "lsf_rad", "sigma_m_s2"):
        expected = np.array([vertex[name] for vertex in ar["vertices"]])
        np.testing.assert_array_equal(getattr(grid, name), expected, strict=True)
    np.testing.assert_array_equal(grid.gain, [v.get("gain", 1) for v in ar["vertices"]])
    np.testing.assert_array_equal(grid.triangles, ar["triangles"])
    assert grid.triangles.dtype == np.int64
    assert (grid.order, grid.numerator) == (ar["order"], ar["numerator"])
    assert grid.sample_rate_hz == ar["sample_rate_hz"]
    assert (grid.max_speed_mm_s, grid.max_force_n) == (ar["max_speed_mm_s"], ar["max_force_n"])
    np.testing.assert_array_equal(texture.taps.traces_m_s2, printed["taps"]["traces_m_s2"])
    np.testing.assert_array_equal(texture.taps.speeds_m_s, printed["taps"]["speeds_m_s"])
    assert texture.taps.sample_rate_hz == printed["taps"]["sample_rate_hz"]
    assert vars(texture.wall) == printed["wall"]
    assert vars(texture.gains) == printed["gains"]
    assert vars(texture.attributes) == printed["attributes"]
    assert vars(texture.sizes) == printed["bytes"]
    assert vars(texture.provenance) == printed["provenance"]
    assert texture.friction.mu == printed["friction"]["mu"]
    assert [vars(anchor) for anchor in texture.friction.anchors] == printed["friction"]["anchors"]
    assert texture.prompt == printed["prompt"]


def test_ma_parts_are_there_where_the_numerator_has_lsfs(texture, hatt):
    assert texture.grid.numerator == "nyquist" and texture.grid.ma_lsf_rad is None
    source = sorted(hatt.glob("*.xml"))[0]
    grid = asperity.import_hatt(source).grid
    assert grid.numerator == "lsf"
    assert grid.ma_lsf_rad.shape[0] == len(grid.force_n)
    assert (np.diff(grid.ma_lsf_rad, axis=1) > 0).all()


def test_arrays_are_read_only_and_made_once(texture):
    assert texture.grid is texture.grid
    with pytest.raises(ValueError, match="read-only"):
        texture.grid.lsf_rad[0, 0] = 0.0
    with pytest.raises(ValueError, match="read-only"):
        texture.taps.traces_m_s2[0, 0] = 0.0


def test_lsfs_ascend_between_zero_and_pi(texture):
    lsf = texture.grid.lsf_rad
    assert lsf.shape == (len(texture.grid.force_n), texture.grid.order)
    assert (np.diff(lsf, axis=1) > 0).all() and lsf.min() > 0 and lsf.max() < np.pi


def test_the_same_arguments_give_the_same_bytes_and_another_seed_does_not(texture):
    prompt = texture.prompt
    assert asperity.compile(prompt) == texture
    assert hash(asperity.compile(prompt)) == hash(texture)
    other = asperity.compile(prompt, seed=3)
    assert other != texture and other.provenance.seed == 3


def test_options_reach_the_compiler(texture):
    plain = asperity.compile("polished marble", fidelity=8, rate=1500, preview=False)
    assert plain.grid.order == 8
    assert plain.grid.sample_rate_hz == 1500
    assert plain.preview_png is None
    assert texture.preview_png.startswith(b"\x89PNG")
    assert texture.sizes.preview == len(texture.preview_png)
    assert asperity.compile("polished marble", fidelity=8, preview=64).preview_png[16:24] == bytes([0, 0, 0, 64] * 2)
    author = asperity.Author()
    assert author.compile("polished marble", fidelity=8, rate=1500, preview=False) == plain


def test_the_report_is_that_of_the_command(texture, command, tmp_path):
    path = tmp_path / "texture.asp"
    printed = json.loads(command("compile", texture.prompt, "-o", path, "--json"))
    report = dict(texture.report)
    # Only the command writes.
    assert printed.pop("stages_ms").keys() == {*report.pop("stages_ms"), "write"}
    assert report == printed
    assert path.read_bytes() == texture.to_bytes()
    assert asperity.load(path).report is None


def test_a_prompt_far_from_everything_warns():
    with pytest.warns(asperity.AsperityWarning, match="far from everything"):
        asperity.compile("the square root of minus one")


def test_notebooks_show_the_sheet_that_plot_draws(texture, command, tmp_path):
    texture.save(tmp_path / "texture.asp")
    command("plot", tmp_path / "texture.asp", "-o", tmp_path / "sheet.png")
    drawn = (tmp_path / "sheet.png").read_bytes()
    assert texture._repr_png_() == texture.plot() == asperity.plot(texture) == drawn
    assert asperity.plot(texture, tmp_path / "again.png") is None
    assert (tmp_path / "again.png").read_bytes() == drawn


def test_the_repr_names_what_matters(texture):
    text = repr(texture)
    name = repr(texture.name).replace("'", '"')
    order, mu = f"order {texture.grid.order}", f"mu {texture.attributes.mu:.3f}"
    for part in (name, order, "1000 Hz", "dB", mu):
        assert part in text
    assert f"float64 {texture.grid.lsf_rad.shape}" in repr(texture.grid)


def test_copies_and_pickles_are_equal(texture):
    assert pickle.loads(pickle.dumps(texture)) == texture
    assert copy.deepcopy(texture) == texture
    assert asperity.Texture(bytes(texture)) == texture


def test_a_model_of_ones_own_is_imported(command, tmp_path):
    command("builtin", "-o", tmp_path / "grit.asp", "--emit-model", tmp_path / "grit.json")
    command("import", "model", tmp_path / "grit.json", "-o", tmp_path / "again.asp")
    texture = asperity.import_model(tmp_path / "grit.json")
    assert texture.to_bytes() == (tmp_path / "again.asp").read_bytes()
    assert texture.report["name"] == texture.name


def test_hatt_materials_are_those_of_the_command(hatt, command, tmp_path):
    source = sorted(hatt.glob("*.xml"))[0]
    command("import", "hatt", source, "-o", tmp_path / "one.asp")
    texture = asperity.import_hatt(source)
    assert texture.to_bytes() == (tmp_path / "one.asp").read_bytes()
    command("import", "hatt", source, "-o", tmp_path / "taps.asp", "--complete-taps")
    completed = asperity.import_hatt(str(source), complete_taps=True)
    assert completed.to_bytes() == (tmp_path / "taps.asp").read_bytes()


def test_a_folder_of_hatt_gives_a_list(hatt, tmp_path):
    for source in sorted(hatt.glob("*.xml"))[:2]:
        (tmp_path / source.name).write_bytes(source.read_bytes())
    both = asperity.import_hatt(tmp_path, fidelity="auto")
    assert [type(texture) for texture in both] == [asperity.Texture] * 2
    (tmp_path / "bad.xml").write_text("<nothing/>")
    (tmp_path / "worse.xml").write_text("nothing")
    with pytest.raises(asperity.AsperityError) as refused:
        asperity.import_hatt(tmp_path)
    assert "bad.xml" in str(refused.value) and "worse.xml" in str(refused.value)
