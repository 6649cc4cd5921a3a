"""Nearest points, paths, straightest geodesics, logarithmic map, masks."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import grid


def test_positions_on_the_surface_are_their_own_nearest_points(bumpy):
    rng = np.random.default_rng(5)
    weights = rng.dirichlet([1, 1, 1], 200)
    face = rng.integers(0, bumpy.face_count, 200)
    xyz = bumpy.position(bf.Points(face, weights))
    points, distance = bumpy.nearest(xyz)
    assert (distance < 1e-12).all()
    assert np.allclose(bumpy.position(points), xyz, atol=1e-12)
    assert bumpy.nearest(xyz[0])[1].shape == (1,)


def test_at_snaps_sources_targets_rows_and_columns(bumpy):
    xyz = bumpy.vertices[[5, 70]] + [0, 0, 1e-9]
    full = bumpy.distance_matrix([5, 70], method="exact", dtype=float)
    assert np.allclose(bumpy.distance_matrix(bf.at(xyz), method="exact", dtype=float), full, atol=1e-7)
    assert np.allclose(bumpy.distance(bf.at(xyz[0]), targets=bf.at(xyz), method="exact"), full[0, [5, 70]], atol=1e-7)
    for bad in (np.zeros((2, 2)), np.zeros((2, 2, 3)), [np.nan] * 3, "x"):
        with pytest.raises((bf.BrushfireError, TypeError)):
            bumpy.distance(bf.at(bad), method="exact")
    with pytest.raises(bf.BrushfireError):
        bf.Mesh.from_lengths([[0, 1, 2]], [[1, 1, 1]]).nearest([0, 0, 0])


def test_a_path_is_as_long_as_the_distance(bumpy):
    d = bumpy.distance(0, method="exact")
    for target in (143, 17, 1):
        path = bumpy.path(0, target)
        assert path.length == pytest.approx(d[target], rel=1e-12)
        steps = np.linalg.norm(np.diff(path.positions, axis=0), axis=1)
        assert steps.sum() == pytest.approx(path.length, rel=1e-12)
        assert (steps > 0).all()
        assert np.allclose(path.positions[[0, -1]], bumpy.vertices[[0, target]])


def test_paths_through_waypoints_and_back(bumpy):
    legs = [bumpy.path(a, b).length for a, b in ((3, 90), (90, 140), (140, 3))]
    assert bumpy.path(3, 90, 140).length == pytest.approx(sum(legs[:2]), rel=1e-12)
    assert bumpy.path([3, 90, 140], closed=True).length == pytest.approx(sum(legs), rel=1e-12)
    assert bumpy.path(bf.Point(4, (0.2, 0.2, 0.6)), 90).length > 0


def test_where_there_is_no_path_there_are_no_points():
    v, f = grid(3)
    path = bf.Mesh(np.vstack([v, v + 9]), np.vstack([f, f + 9])).path(0, 10)
    assert path.length == np.inf
    assert path.positions.shape == (0, 3)
    with pytest.raises(bf.BrushfireError):
        bf.Mesh(v, f).path()


def test_the_log_map_is_undone_by_straightest_geodesics(bumpy):
    polar = bumpy.log_map(bf.Point(100, (0.3, 0.3, 0.4)), radius=2.0)
    reached = np.flatnonzero(np.isfinite(polar.radius))
    assert len(reached) > 5
    hits = 0
    for v in reached:
        path, _ = bumpy.trace(bf.Point(100, (0.3, 0.3, 0.4)), polar.angle[v], polar.radius[v])
        hits += bool(np.allclose(path.positions[-1], bumpy.vertices[v], atol=1e-9))
    assert hits > 0.7 * len(reached)  # behind saddles the direction is that towards the vertex where the path bends


def test_a_mask_closes_faces_and_keeps_numbers(bumpy):
    wall = bumpy.vertices[:, 0] != 5
    left = bumpy.masked(wall).distance(0, method="exact")
    assert np.isfinite(left[bumpy.vertices[:, 0] < 5]).all()
    assert np.isinf(left[bumpy.vertices[:, 0] >= 5]).all()
    for bad in (np.ones(3, dtype=bool), np.ones(bumpy.vertex_count), None):
        with pytest.raises(bf.BrushfireError):
            bumpy.masked(bad)
