"""Files, and the mesh objects of other libraries (those that are installed; look-alikes for all)."""

from __future__ import annotations

from types import SimpleNamespace

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
    for name, content, code in (("a.obj", "v 0 0\n", "file_malformed"), ("b.xyz", "???", "unknown_format")):
        (tmp_path / name).write_text(content)
        with pytest.raises(bf.BrushfireError) as error:
            bf.read(tmp_path / name)
        assert error.value.code == code
        assert name in str(error.value)
    with pytest.raises(bf.BrushfireError) as error:
        bf.read(tmp_path / "absent.obj")
    assert error.value.code == "file_not_readable"


def test_from_any_knows_objects_by_their_attributes(tmp_path):
    vtk = np.column_stack([np.full(len(F), 3), F]).ravel()
    gifti = SimpleNamespace(agg_data=lambda intent: {"pointset": V, "triangle": F}[intent])
    for source in (
        (V, F),
        bf.Mesh(V, F),
        write_obj(tmp_path / "m.obj"),
        SimpleNamespace(vertices=V, faces=F),
        SimpleNamespace(vertices=V, triangles=F),
        SimpleNamespace(coordinates=V, faces=F),
        SimpleNamespace(points=V, faces=vtk),
        SimpleNamespace(points=V, cells_dict={"triangle": F, "vertex": np.zeros((1, 1), int)}),
        gifti,
    ):
        assert same(bf.from_any(source))


def test_from_any_refuses_what_holds_no_triangles():
    for source in (None, 3, object(), (V, F, F), SimpleNamespace(points=V)):
        with pytest.raises(TypeError):
            bf.from_any(source)
    for source in (
        SimpleNamespace(points=V, faces=np.array([4, 0, 1, 2, 3])),
        SimpleNamespace(points=V, cells_dict={"quad": np.zeros((1, 4), int)}),
    ):
        with pytest.raises(bf.BrushfireError, match="triang"):
            bf.from_any(source)


def test_from_trimesh():
    trimesh = pytest.importorskip("trimesh")
    assert same(bf.from_any(trimesh.Trimesh(V, F, process=False)))


def test_from_meshio():
    meshio = pytest.importorskip("meshio")
    assert same(bf.from_any(meshio.Mesh(V, [("triangle", F)])))


def test_from_pyvista():
    pyvista = pytest.importorskip("pyvista")
    assert same(bf.from_any(pyvista.PolyData(V, np.column_stack([np.full(len(F), 3), F]).ravel())))


def test_from_nibabel():
    nibabel = pytest.importorskip("nibabel")
    arrays = [
        nibabel.gifti.GiftiDataArray(V.astype(np.float32), intent="NIFTI_INTENT_POINTSET"),
        nibabel.gifti.GiftiDataArray(F.astype(np.int32), intent="NIFTI_INTENT_TRIANGLE"),
    ]
    mesh = bf.from_any(nibabel.gifti.GiftiImage(darrays=arrays))
    assert np.array_equal(mesh.vertices, V.astype(np.float32))
    assert np.array_equal(mesh.faces, F)
