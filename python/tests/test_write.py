"""What goes out into files, and comes back the same."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest

import brushfire as bf
from conftest import grid
from test_from_any import lib

V, F = grid(6, 0.3)


@pytest.fixture(scope="module")
def mesh() -> bf.Mesh:
    return bf.Mesh(np.vstack([V, [[9, 9, 9]]]), F)  # the last vertex is in no face


@pytest.fixture(scope="module")
def field(mesh) -> np.ndarray:
    return mesh.distance(0)


@pytest.mark.parametrize("extension", ["ply", "vtk", "vtp", "obj"])
def test_meshes_come_back_to_the_bit(mesh, field, tmp_path, extension):
    path = tmp_path / f"mesh.{extension}"
    for arguments in ({}, {"field": field}, {"field": field, "labels": np.where(np.isfinite(field), 0, -1)}):
        if extension == "obj":
            arguments.pop("labels", None)
        mesh.save(path, **arguments)
        again = bf.read(path)
        assert np.array_equal(again.vertices, mesh.vertices)
        assert np.array_equal(again.faces, mesh.faces)
    bf.write(path, mesh)
    assert np.array_equal(bf.read(path).vertices, mesh.vertices)


@pytest.mark.parametrize("extension", ["off", "msh", "meshb", "mesh", "surf.gii", "glb", "stl"])
def test_bare_meshes_go_into_every_format_of_meshes(tmp_path, extension):
    mesh = bf.Mesh(V, F)
    path = tmp_path / f"mesh.{extension}"
    mesh.save(path)
    again = bf.read(path)
    assert again.face_count == mesh.face_count
    corners = again.vertices[again.faces]
    assert np.allclose(corners, mesh.vertices[mesh.faces], rtol=1e-6, atol=1e-6)


def test_gifti_says_which_part_of_the_brain_it_is(field, tmp_path):
    mesh = bf.Mesh(V, F)
    path = tmp_path / "a.surf.gii"
    for structure in ("cortex_left", "CortexLeft", "CIFTI_STRUCTURE_CORTEX_LEFT"):
        mesh.save(path, structure=structure)
        assert b"CortexLeft" in path.read_bytes()
    mesh.save(tmp_path / "a.func.gii", field[:-1], structure="cortex_left")
    assert b"CortexLeft" in (tmp_path / "a.func.gii").read_bytes()


def test_values_and_labels_come_back(mesh, field, tmp_path):
    labels = np.where(np.isfinite(field), 0, -1)
    mesh.save(tmp_path / "d.npy", field)
    assert np.array_equal(np.load(tmp_path / "d.npy"), field)
    mesh.save(tmp_path / "l.npy", labels=labels)
    assert np.array_equal(np.load(tmp_path / "l.npy"), labels)
    mesh.save(tmp_path / "d.csv", field, labels=labels, name="far", label_name="cell")
    rows = [line.split(",") for line in (tmp_path / "d.csv").read_text().splitlines()]
    assert rows[0] == ["vertex", "far", "cell"]
    assert [float(row[1]) for row in rows[1:]] == field.tolist()
    assert [int(row[2]) for row in rows[1:]] == labels.tolist()
    mesh.save(tmp_path / "d.json", field)
    values = json.loads((tmp_path / "d.json").read_text())["distance"]
    assert [np.inf if v is None else v for v in values] == field.tolist()
    mesh.save(tmp_path / "field", field, format="npy")
    assert np.array_equal(np.load(tmp_path / "field"), field)


def test_fields_alone_go_where_values_go_alone(mesh, field, tmp_path):
    for extension in ("npy", "csv", "json"):
        bf.write(tmp_path / f"a.{extension}", field)
        mesh.save(tmp_path / f"b.{extension}", field)
        assert (tmp_path / f"a.{extension}").read_bytes() == (tmp_path / f"b.{extension}").read_bytes()
    with pytest.raises(bf.BrushfireError, match="give it as mesh="):
        bf.write(tmp_path / "a.ply", field)
    bf.write(tmp_path / "a.ply", field, mesh=mesh, name="far")
    mesh.save(tmp_path / "b.ply", field, name="far")
    assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()


def test_nibabel_reads_what_is_written_for_brains(mesh, field, tmp_path):
    nibabel = lib("nibabel")
    finite = field[:-1].astype(np.float32)
    bf.write(tmp_path / "d.func.gii", field[:-1])
    assert np.array_equal(nibabel.load(tmp_path / "d.func.gii").agg_data(), finite)
    bf.write(tmp_path / "lh.curv", field[:-1], format="curv")
    assert np.array_equal(nibabel.freesurfer.read_morph_data(tmp_path / "lh.curv"), finite)


def test_cifti_holds_the_vertices_that_have_values(mesh, field, tmp_path):
    nibabel = lib("nibabel")
    path = tmp_path / "d.dscalar.nii"
    mesh.save(path, field, labels=np.arange(len(field)), name="far", structure="cortex_left")
    image = nibabel.load(path)
    scalars, brain = (image.header.get_axis(k) for k in (0, 1))
    assert list(scalars.name) == ["far", "source"]
    [(structure, _, part)] = list(brain.iter_structures())
    assert structure == "CIFTI_STRUCTURE_CORTEX_LEFT"
    assert part.nvertices[structure] == mesh.vertex_count
    assert np.array_equal(part.vertex, np.flatnonzero(np.isfinite(field)))
    assert np.array_equal(image.get_fdata()[0], field[part.vertex].astype(np.float32))
    assert np.array_equal(image.get_fdata()[1], part.vertex)
    assert image.nifti_header.get_intent()[0] == "ConnDenseScalar"
    bf.write(path, field, structure="CIFTI_STRUCTURE_CORTEX_RIGHT")
    assert "CORTEX_RIGHT" in next(iter(nibabel.load(path).header.get_axis(1).iter_structures()))[0]
    for arguments in ({}, {"structure": "left knee"}):
        with pytest.raises(bf.BrushfireError, match="structure"):
            mesh.save(path, field, **arguments)
    with pytest.raises(bf.BrushfireError, match="vertices"):
        mesh.save(path, field[:-1], structure="cortex_left")
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


CURVES = {
    "path": lambda mesh, field: mesh.path(0, 35),
    "paths": lambda mesh, field: mesh.paths(0, [35, 3])[0],
    "isolines": lambda mesh, field: mesh.isolines(field, every=1.0),
    "isoline": lambda mesh, field: mesh.isolines(field, [1.0])[0],
    "curved": lambda mesh, field: mesh.curved_isolines(0, every=1.0),
    "borders": lambda mesh, field: mesh.voronoi([0, 5, 35]).borders,
    "none": lambda mesh, field: [],
}


@pytest.mark.parametrize("make", CURVES.values(), ids=CURVES)
@pytest.mark.parametrize("extension", ["json", "obj", "ply", "vtp", "csv", "svg", "dxf"])
def test_curves_are_written_in_every_format(mesh, field, tmp_path, extension, make):
    curves = make(mesh, field)
    bf.write(tmp_path / f"a.{extension}", curves)
    bf.write(tmp_path / f"b.{extension}", curves, mesh=mesh)
    content = (tmp_path / f"a.{extension}").read_bytes()
    assert content or not curves  # no curves are an empty OBJ
    if curves:
        assert content == (tmp_path / f"b.{extension}").read_bytes()


def test_written_curves_hold_the_points_and_their_numbers(mesh, field, tmp_path):
    lines = mesh.isolines(field, every=1.5)
    bf.write(tmp_path / "lines.json", lines)
    written = json.loads((tmp_path / "lines.json").read_text())["lines"]
    assert [w["level"] for w in written] == [line.level for line in lines]
    for w, line in zip(written, lines, strict=True):
        assert [p["face"] for p in w["points"]] == line.line.points.face.tolist()
        assert np.array_equal([p["position"] for p in w["points"]], line.line.positions)
        assert w["closed"] == line.line.closed
    path = mesh.path(0, 35)
    bf.write(tmp_path / "path.csv", path)
    assert (tmp_path / "path.csv").read_text().splitlines()[0].split(",")[1] == "length"
    bf.write(tmp_path / "path.csv", path, name="metres")
    assert (tmp_path / "path.csv").read_text().splitlines()[0].split(",")[1] == "metres"


def test_curves_that_do_not_know_their_mesh_say_so(mesh, tmp_path):
    import pickle

    path = pickle.loads(pickle.dumps(mesh.path(0, 35)))
    assert path == mesh.path(0, 35)
    with pytest.raises(bf.BrushfireError, match="mesh="):
        bf.write(tmp_path / "p.obj", path)
    bf.write(tmp_path / "p.obj", path, mesh=mesh)
    other = bf.Mesh(V, F)
    with pytest.raises(bf.BrushfireError, match="several meshes"):
        bf.write(tmp_path / "p.obj", [mesh.path(0, 35), other.path(0, 35)])


def test_matrices_come_back_to_the_bit(mesh, tmp_path):
    sparse = lib("scipy.sparse")
    dense = mesh.distance_matrix()
    bf.write(tmp_path / "d.npy", dense)
    assert np.array_equal(np.load(tmp_path / "d.npy"), dense)
    assert np.load(tmp_path / "d.npy").dtype == np.float32
    near = mesh.distances_within(2.0, dtype=float)
    for matrix in (near, near.tocoo(), near.tocsc()):
        bf.write(tmp_path / "near.npz", matrix)
        assert (sparse.load_npz(tmp_path / "near.npz") != near).nnz == 0
        assert sparse.load_npz(tmp_path / "near.npz").nnz == near.nnz
        bf.write(tmp_path / "near.mtx", matrix)
        from scipy.io import mmread

        assert np.allclose(mmread(tmp_path / "near.mtx").toarray(), near.toarray(), rtol=1e-15)
    for what, name in ((dense, "d.npz"), (dense, "d.csv"), (near, "near.npy")):
        with pytest.raises(bf.BrushfireError) as error:
            bf.write(tmp_path / name, what)
        assert error.value.code == "unknown_format"


def test_what_cannot_be_written_says_why_and_leaves_nothing(mesh, field, tmp_path):
    near = mesh.distances_within(1.0)
    for call, code in (
        (lambda: mesh.save(tmp_path / "a.xyz", field), "unknown_format"),
        (lambda: mesh.save(tmp_path / "absent" / "a.ply", field), "file_not_writable"),
        (lambda: bf.write(tmp_path / "absent" / "a.npz", near), "file_not_writable"),
        (lambda: mesh.save(tmp_path / "a.ply", field[:-1]), "invalid_argument"),
        (lambda: mesh.save(tmp_path / "a.ply", [field]), "invalid_argument"),
        (lambda: mesh.save(tmp_path / "a.ply", labels=np.full(len(field), -2)), "invalid_argument"),
        (lambda: mesh.save(tmp_path / "a.ply", field, name="a b\\n"), "invalid_argument"),
        (lambda: bf.write(tmp_path / "a.stl", mesh.path(0, 3)), "unknown_format"),
    ):
        with pytest.raises(bf.BrushfireError) as error:
            call()
        assert error.value.code == code
    for what in (None, object(), "text", {"a": 1}, [mesh.path(0, 3), 3]):
        with pytest.raises((TypeError, bf.BrushfireError)):
            bf.write(tmp_path / "a.npy", what)
    assert list(tmp_path.iterdir()) == []


def test_a_file_gets_the_rights_that_the_process_gives(mesh, tmp_path):
    if sys.platform == "win32":
        pytest.skip("no such rights there")
    program = (
        "import os, sys, numpy as np, brushfire as bf; os.umask(0o027)\n"
        "bf.write(sys.argv[1], np.zeros((2, 2)))\nprint(oct(os.stat(sys.argv[1]).st_mode & 0o777))"
    )
    command = [sys.executable, "-c", program, str(tmp_path / "a.npy")]
    assert subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip() == "0o640"


def test_objects_of_other_libraries_are_fields_too(mesh, field, tmp_path):
    pandas = lib("pandas")
    mesh.save(tmp_path / "a.npy", pandas.Series(field))
    assert np.array_equal(np.load(tmp_path / "a.npy"), field)
