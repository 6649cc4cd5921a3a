"""Voronoi cells, farthest points, barriers; paths by their options."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import grid


def test_voronoi_labels_are_those_of_the_distance_and_cells_fill_the_mesh(bumpy):
    sources = [3, 77, 140]
    cells = bumpy.voronoi(sources, method="exact")
    d, label = bumpy.distance(sources, method="exact", return_source=True)
    assert np.array_equal(cells.source, label)
    assert np.allclose(cells.distance, d, rtol=1e-12)
    assert cells.area.sum() == pytest.approx(bumpy.report.area, rel=1e-9)
    assert {b.sources for b in cells.borders} <= {(0, 1), (0, 2), (1, 2)}
    assert all(b.line.length > 0 for b in cells.borders)


def test_farthest_points_are_farthest(bumpy):
    samples = bumpy.farthest_points(9, first=[5, 60], method="exact")
    assert samples.vertices[:2].tolist() == [5, 60]
    taken = bumpy.distance(samples.vertices[:5], method="exact")
    assert samples.vertices[5] == taken.argmax()
    assert samples.separation[5] == pytest.approx(taken.max(), rel=1e-12)
    assert (np.diff(samples.separation[2:]) <= 0).all()
    final, nearest = bumpy.distance(samples.vertices, method="exact", return_source=True)
    assert np.allclose(samples.distance, final, rtol=1e-12)
    assert np.array_equal(samples.nearest, nearest)
    assert samples.covering_radius == pytest.approx(final.max(), rel=1e-12)
    assert bumpy.farthest_points(4).vertices[0] == 0


def test_a_cut_is_tight_and_knows_the_way_back(bumpy):
    wall = np.flatnonzero(bumpy.vertices[:, 0] == 5)
    edges = np.column_stack([wall[:-1], wall[1:]])
    slit = bumpy.cut(edges=edges)
    d = slit.mesh.distance(0, method="exact")
    assert np.isinf(slit.to_original(d)[bumpy.vertices[:, 0] > 5]).all()
    assert np.isfinite(slit.to_original(d)[bumpy.vertices[:, 0] <= 5]).all()
    assert slit.original_vertex[: bumpy.vertex_count].tolist() == list(range(bumpy.vertex_count))
    assert slit.mesh.vertex_count == bumpy.vertex_count + len(wall)
    sides, origin = slit.points_from_original([int(wall[3]), 0])
    assert origin.tolist() == [0, 0, 1]
    assert np.allclose(slit.mesh.position(sides), bumpy.vertices[[wall[3], wall[3], 0]])
    back = slit.points_to_original(sides)
    assert np.allclose(bumpy.position(back), slit.mesh.position(sides))
    blocked = bumpy.cut(vertices=bumpy.vertices[:, 0] == 5)
    assert np.array_equal(blocked.original_face, np.flatnonzero(blocked.cut_face >= 0))
    masked = bumpy.masked(bumpy.vertices[:, 0] != 5)
    assert np.array_equal(blocked.mesh.distance(0, method="exact"), masked.distance(0, method="exact"))
    assert bumpy.cut(faces=[0, 1]).mesh.face_count == bumpy.face_count - 2
    assert bumpy.cut().mesh.face_count == bumpy.face_count


def test_paths_off_one_field_are_the_shortest_from_the_nearest_source(bumpy):
    sources, targets = [0, 143], [7, bf.Point(100, (0.2, 0.2, 0.6)), 130]
    paths, source = bumpy.paths(sources, targets, offset=[0, 0.5])
    d, label = bumpy.distance(sources, targets=targets, offset=[0, 0.5], method="exact", return_source=True)
    assert np.array_equal(source, label)
    assert np.allclose([p.length for p in paths] + np.array([0, 0.5])[source], d, rtol=1e-12)
    ends = bumpy.position(targets)
    for path, end, s in zip(paths, ends, source, strict=True):
        assert np.allclose(path.positions[0], bumpy.vertices[sources[s]])
        assert np.allclose(path.positions[-1], end)


def test_edge_paths_are_what_dijkstra_measures(bumpy):
    path = bumpy.edge_path([0, 50], 143)
    assert path.length == pytest.approx(bumpy.distance([0, 50], method="dijkstra")[143], rel=1e-12)
    assert (path.points.weights.max(axis=1) == 1).all()


def test_tightened_paths_are_shorter_and_locally_shortest(bumpy):
    loose = bumpy.path(0, 77, 143)
    tight = bumpy.path(0, 77, 143, tighten=True)
    assert bumpy.path(0, 143).length <= tight.length + 1e-12 < loose.length
    again = bumpy.shorten(tight)
    assert again.length == pytest.approx(tight.length, rel=1e-9)
    assert bumpy.length_of(loose) == pytest.approx(loose.length, rel=1e-12)
    edges = bumpy.edge_path(0, 143)
    assert bumpy.shorten(edges).length < edges.length
    ring = bumpy.shorten([0, 1, 12], closed=True)
    assert ring.length == pytest.approx(0, abs=1e-9)  # a disk has no closed geodesic


def test_angles_of_directions_lead_where_the_directions_point():
    flat = bf.Mesh(*grid(9))
    for direction in ([1, 0, 0], [0.3, 0.8, 0], [-0.5, 0.1, 0]):
        angle, turn = flat.angle_of(40, direction)
        assert turn == pytest.approx(2 * np.pi)
        path, _ = flat.trace(40, angle, 2.0)
        unit = np.array(direction) / np.linalg.norm(direction)
        assert np.allclose(path.positions[-1] - path.positions[0], 2 * unit, atol=1e-12)
