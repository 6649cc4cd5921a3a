"""Curves read back, drawings in real size, welding, log maps with a direction, gradients on vertices."""

import re

import numpy as np
import pytest

import brushfire as bf

V, F = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]]
TORN = [[0, 0], [1, 0], [1, 1], [1, 0], [2, 0], [1, 1]], [[0, 1, 2], [3, 4, 5]]


@pytest.mark.parametrize("extension", ["csv", "json", "obj", "ply", "vtp"])
def test_curves_come_back_from_every_format_that_is_read(bumpy, tmp_path, extension):
    paths, _ = bumpy.paths([0, 1], [130, 42])
    file = tmp_path / f"paths.{extension}"
    bf.write(file, paths)
    again = bf.read_lines(file, bumpy)
    assert len(again) == 2
    for path, read in zip(paths, again, strict=True):
        assert np.allclose(read.positions, path.positions, atol=1e-9)
        assert read.length == pytest.approx(path.length, rel=1e-9)
        assert len(read.points) == len(path.points)
    assert np.isfinite(bumpy.distance(again[0].points)).all()
    bf.write(tmp_path / "again.csv", again)  # they know their mesh
    assert len(bf.read_lines(file)) == 2  # and without one


def test_a_curve_read_without_its_mesh_says_so_where_its_points_are_needed(bumpy, tmp_path):
    file = tmp_path / "path.obj"
    bf.write(file, bumpy.path(0, 130))
    (alone,) = bf.read_lines(file)
    for use in (bumpy.distance, bumpy.shorten, bumpy.length_of):
        with pytest.raises(bf.BrushfireError, match="read_lines\\(\\) with its mesh"):
            use(alone)


def test_isolines_come_back_with_their_levels_and_closed(bumpy, tmp_path):
    lines = bumpy.isolines(bumpy.distance(77), [1.0, 2.0])
    bf.write(tmp_path / "l.json", lines)
    again = bf.read_lines((tmp_path / "l.json").read_bytes(), bumpy, format="json")
    assert [(a.level, a.level_index, a.line.closed) for a in again] == [
        (b.level, b.level_index, b.line.closed) for b in lines
    ]


def test_what_is_no_curve_is_refused(tmp_path):
    with pytest.raises(bf.BrushfireError):
        bf.read_lines(b"nothing", format="csv")
    with pytest.raises(bf.BrushfireError, match="no such file"):
        bf.read_lines(tmp_path / "missing.csv")


def test_drawings_have_the_size_that_the_unit_says(tmp_path):
    mesh = bf.Mesh(V, F)
    for unit, width in {"mm": 3, "cm": 30, "in": 76.2}.items():
        bf.write(tmp_path / "a.svg", mesh.path(1, 3), unit=unit, view="top", outline=True)
        text = (tmp_path / "a.svg").read_text()
        found = float(re.search(r'width="([0-9.]+)mm"', text)[1])
        assert found == pytest.approx(width, rel=0.2)
    plain, outlined = tmp_path / "b.dxf", tmp_path / "c.dxf"
    bf.write(plain, mesh.path(1, 3))
    bf.write(outlined, mesh.path(1, 3), outline=True)
    assert outlined.stat().st_size > plain.stat().st_size
    for bad in ({"unit": "ell"}, {"view": "below"}, {"view": 3}):
        with pytest.raises((bf.BrushfireError, TypeError)):
            bf.write(tmp_path / "a.svg", mesh.path(1, 3), **bad)


def test_welding_joins_and_tells_how(tmp_path):
    torn = bf.Mesh(*TORN)
    assert np.isinf(torn.distance(0)[4])
    mesh, vertex_map = torn.weld(0)
    assert (mesh.vertex_count, vertex_map.tolist()) == (4, [0, 1, 2, 1, 3, 2])
    assert mesh.distance(0)[vertex_map][4] == 2
    torn.save(tmp_path / "torn.ply")
    read, info = bf.read(tmp_path / "torn.ply", weld=0, return_info=True)
    assert (read.vertex_count, info.vertex_map.tolist()) == (4, [0, 1, 2, 1, 3, 2])
    assert bf.read(tmp_path / "torn.ply").vertex_count == 6
    for bad in (-1, float("nan"), "near"):
        with pytest.raises((bf.BrushfireError, TypeError)):
            torn.weld(bad)


def test_a_log_map_turns_to_its_direction_and_is_written(tmp_path):
    x, y = np.meshgrid(np.arange(5.0), np.arange(5.0))
    vertices = np.column_stack([x.ravel(), y.ravel()])
    corner = np.array([5 * r + c for r in range(4) for c in range(4)])
    faces = np.vstack([np.column_stack([corner, corner + 1, corner + 6]), np.column_stack([corner, corner + 6, corner + 5])])
    mesh = bf.Mesh(vertices, faces)
    polar = mesh.log_map(12, direction=[0, 2, 0])
    assert np.allclose(polar.uv, np.column_stack([vertices[:, 1] - 2, 2 - vertices[:, 0]]), atol=1e-12)
    sparse = mesh.log_map(12, 1.1, direction=[0, 2, 0], sparse=True)
    assert sparse.vertices.tolist() == [7, 11, 12, 13, 17]
    assert np.allclose(sparse.uv, polar.uv[sparse.vertices])
    assert np.isnan(mesh.log_map(12, 1.1).uv[0]).all()
    for extension in ("csv", "json", "npy", "ply", "vtk", "obj"):
        bf.write(tmp_path / f"a.{extension}", sparse)
        bf.write(tmp_path / f"b.{extension}", mesh.log_map(12, 1.1, direction=[0, 2, 0]))
        assert (tmp_path / f"a.{extension}").read_bytes() == (tmp_path / f"b.{extension}").read_bytes()
    assert bf.read(tmp_path / "a.ply").vertex_count == 5
    with pytest.raises(bf.BrushfireError, match="right angles"):
        mesh.log_map(12, direction=[0, 0, 1])


def test_gradients_on_vertices_are_those_of_a_linear_field(bumpy):
    flat = bf.Mesh(V, F)
    values = [3 * x - 2 * y for x, y, _ in V]
    assert np.allclose(flat.gradient(values, on="vertices"), [3, -2, 0])
    assert bumpy.gradient(bumpy.distance(0), on="vertices").shape == (bumpy.vertex_count, 3)
    with pytest.raises(bf.BrushfireError, match="on:"):
        flat.gradient(values, on="edges")


def test_paths_end_at_the_radius():
    mesh = bf.Mesh(V, F)
    assert mesh.path(1, 3, radius=5.1).length == 5
    assert mesh.path(1, 3, radius=4.9).length == np.inf
    paths, source = mesh.paths(0, [1, 2], radius=4)
    assert [p.length for p in paths] == [3, np.inf]
    assert source.tolist() == [0, -1]
