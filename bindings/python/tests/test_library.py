"""Assets and libraries in files and in memory."""

from __future__ import annotations

import pytest

import asperity


@pytest.fixture
def both(texture, grit):
    return [texture, grit]


def test_a_texture_is_written_and_read(texture, tmp_path):
    texture.save(tmp_path / "texture.asp")
    texture.save(str(tmp_path / "texture.asp"))  # replaced
    assert [file.name for file in tmp_path.iterdir()] == ["texture.asp"]
    assert asperity.load(tmp_path / "texture.asp") == texture
    assert asperity.load(str(tmp_path / "texture.asp"), 0) == texture
    assert asperity.load(texture.to_bytes(), texture.name) == texture


def test_a_library_gives_textures_by_name_and_index(both, tmp_path, command):
    path = tmp_path / "both.aspl"
    packed = asperity.pack(both, path)
    for library in (packed, asperity.load(path), asperity.load(path.read_bytes())):
        assert isinstance(library, asperity.Library)
        assert library.names == sorted(texture.name for texture in both)
        assert len(library) == 2
        for index, name in enumerate(library.names):
            assert name in library
            assert library[name] == library[index] == library[index - 2]
            assert library[name].name == name
        assert list(library) == [library[0], library[1]]
        assert "none" not in library
        assert not isinstance(library, asperity.Scene)
        assert library.to_bytes() == path.read_bytes()
        assert "Library of 2" in repr(library)
    assert asperity.load(path, both[0].name) == both[0]
    assert asperity.load(path, -1) == packed[1]
    assert "2 textures" in command("inspect", path)


def test_what_is_not_there_is_a_lookup_error(both):
    library = asperity.pack(both)
    for wanted in ("none", 2, -3):
        with pytest.raises(LookupError, match=str(wanted)):
            library[wanted]
    with pytest.raises(asperity.NoSuchTextureError):
        asperity.load(both[0].to_bytes(), "another")


def test_damage_is_found_where_it_is(both, tmp_path):
    path = tmp_path / "both.aspl"
    asperity.pack(both, path)
    damaged = bytearray(path.read_bytes())
    damaged[-100] ^= 1
    path.write_bytes(damaged)
    library = asperity.load(path)
    assert library[0].name == library.names[0]
    with pytest.raises(asperity.AsperityError, match="both.aspl.*checksum"):
        library[1]
