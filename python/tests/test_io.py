"""Meshes from files, bytes and open files."""

from __future__ import annotations

import gzip
import io

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

V, F = grid(4, 0.3)


def write_obj(path):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in V.tolist()] + [
        f"f {a + 1} {b + 1} {c + 1}" for a, b, c in F.tolist()
    ]
    path.write_text("\n".join(lines))
    return path


def same(mesh):
    return np.array_equal(mesh.vertices, V) and np.array_equal(mesh.faces, F)


def test_reading_keeps_order_and_double_precision(tmp_path):
    path = write_obj(tmp_path / "bumps.obj")
    assert same(bf.read(path))
    assert same(bf.read(str(path)))
    mesh, info = bf.read(path, return_info=True)
    assert same(mesh)
    assert info.format == "OBJ"
    assert info.face_origin is None


def test_files_that_cannot_be_read_say_why(tmp_path):
    for name, content, code in (("a.obj", "v 0\n", "file_malformed"), ("b.xyz", "???", "unknown_format")):
        (tmp_path / name).write_text(content)
        with pytest.raises(bf.BrushfireError) as error:
            bf.read(tmp_path / name)
        assert error.value.code == code
        assert name in str(error.value)
    with pytest.raises(bf.BrushfireError) as error:
        bf.read(tmp_path / "absent.obj")
    assert error.value.code == "file_not_readable"


def test_bytes_and_open_files_are_read_as_what_they_are_said_to_be(tmp_path):
    path = write_obj(tmp_path / "bumps.obj")
    content = path.read_bytes()
    for source in (
        content,
        bytearray(content),
        memoryview(content),
        io.BytesIO(content),
        io.StringIO(content.decode()),
    ):
        assert same(bf.read(source, format="obj"))
    with open(path, "rb") as binary, open(path) as text:
        assert same(bf.read(binary))  # by its name
        assert same(bf.from_any(text, format="obj"))
    with gzip.open(tmp_path / "bumps.obj.gz", "wb") as file:
        file.write(content)
    with gzip.open(tmp_path / "bumps.obj.gz") as file:
        assert same(bf.read(file, format=".obj"))
    renamed = tmp_path / "bumps.dat"
    renamed.write_bytes(content)
    assert same(bf.read(renamed, format="obj"))
    assert bf.read(content, format="obj", return_info=True)[1].format == "OBJ"


def test_grids_are_read_as_other_text_is(tmp_path):
    text = "\ufeffNCOLS 2\r\nNROWS 2\r\ncellsize 10\r\n0 1.0D+00\r\n2 3\r\n"
    with gzip.open(tmp_path / "dem.asc.gz", "wb") as file:
        file.write(text.encode())
    terrain = bf.terrain(tmp_path / "dem.asc.gz")
    assert terrain.mesh.vertices[:, 2].tolist() == [0, 1, 2, 3]


def test_bytes_that_are_no_mesh_say_why():
    for source, arguments in ((b"", {}), (b"nonsense", {}), (b"v 0\n", {"format": "obj"}), (b"v", {"format": "no"})):
        with pytest.raises(bf.BrushfireError):
            bf.read(source, **arguments)
    with pytest.raises(bf.BrushfireError) as error:
        bf.read("absent.dat", format="obj")
    assert error.value.code == "file_not_readable"
    with pytest.raises(TypeError, match="format"):
        bf.from_any((V, F), format="obj")
    for source in (5, 5.5, None, ["a.ply"], (V, F)):
        with pytest.raises(TypeError, match="source"):
            bf.read(source)
