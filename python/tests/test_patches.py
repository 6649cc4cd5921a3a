"""Patches over a base mesh: paths that do not cross, and a morph through them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from test_reeb import voxels

import brushfire as bf

ConvexHull = pytest.importorskip("scipy.spatial").ConvexHull


def ball(fine=4, radii=(1.0, 1.0, 1.0)):
    points, faces = voxels(np.ones((2, 2, 2), dtype=int), fine)
    x = points - points.mean(axis=0)
    return bf.Mesh(x / np.linalg.norm(x, axis=1)[:, None] * radii, faces)


def hull_of(points):
    """Its triangles, counter-clockwise from outside."""
    hull = ConvexHull(points)
    faces = hull.simplices.copy()
    a, b, c = (points[faces[:, k]] for k in range(3))
    inward = np.einsum("fx,fx->f", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    faces[inward] = faces[inward][:, ::-1]
    return faces


def edges_of(faces):
    return np.unique(np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0)


def assert_no_path_crosses(found):
    known = set(map(tuple, edges_of(found.mesh.faces).tolist()))
    inner = [v for way in found.paths.values() for v in way[1:-1]]
    assert len(inner) == len(set(inner)) and not set(inner) & set(found.landmarks) and not found.touching
    for (i, j), way in found.paths.items():
        assert [way[0], way[-1]] == [found.landmarks[i], found.landmarks[j]]
        assert all(tuple(sorted(p)) in known for p in pairwise(way))
    # Each patch is there, and a disc: what crosses makes others.
    assert set(found.patch) == set(range(len(found.base)))
    for k in range(len(found.base)):
        faces = found.mesh.faces[found.patch == k]
        assert len(np.unique(faces)) - len(edges_of(faces)) + len(faces) == 1


def test_no_path_crosses_on_fifty_random_sets_of_landmarks():
    mesh = ball(3)
    for seed in range(50):
        dice = np.random.default_rng(seed)
        places = dice.choice(mesh.vertex_count, 8, replace=False)
        base = hull_of(mesh.vertices[places])
        assert_no_path_crosses(bf.patches(mesh, places, base))


def test_one_base_mesh_carries_one_surface_over_to_another():
    round_one, long_one = ball(), ball(radii=(1.0, 1.5, 2.5))
    places = [np.argmax(round_one.vertices @ d) for d in np.concatenate([np.eye(3), -np.eye(3)])]
    base = hull_of(round_one.vertices[places])
    a, faces = bf.patches(round_one, places, base).resample(6)
    b, same = bf.patches(long_one, places, base).resample(6)
    np.testing.assert_array_equal(faces, same)
    for share in (0.0, 0.5, 1.0):
        blend = bf.Mesh((1 - share) * a + share * b, faces)
        assert blend.report.boundary_edges == 0 and blend.report.euler_characteristic == 2
        size = np.ptp(blend.vertices, axis=0)
        np.testing.assert_allclose(size, 2 * (1 + share * (np.array([1.0, 1.5, 2.5]) - 1)), rtol=0.1)
    assert round_one.nearest(a)[1].max() < 1e-9 and long_one.nearest(b)[1].max() < 1e-9


def test_wrong_arguments_are_told():
    with pytest.raises(bf.BrushfireError, match="repeats"):
        bf.patches(ball(1), [0, 0, 1], [[0, 1, 2]])
    with pytest.raises(bf.BrushfireError, match="shape"):
        bf.patches(ball(1), [0, 1, 2], [0, 1, 2])
