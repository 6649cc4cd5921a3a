"""Patches over a base mesh: paths that do not cross, and a morph through them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from conftest import grid
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


OCTAHEDRON = np.array([[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]])
AXES = np.concatenate([np.eye(3), -np.eye(3)])
BALL = ball(3)
ENDS = [int(np.argmax(BALL.vertices @ e)) for e in AXES]


def torus(n, k):
    """n x k vertices around and across, and its faces."""
    u, v = np.meshgrid(np.arange(n), np.arange(k), indexing="ij")
    a, b = 2 * np.pi * u / n, 2 * np.pi * v / k
    x = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], axis=-1)
    here, ahead, both, beside = (((u + i) % n * k + (v + j) % k).ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return x.reshape(-1, 3), np.concatenate([np.stack([here, ahead, both], 1), np.stack([here, both, beside], 1)])


@pytest.mark.parametrize(
    ("landmarks", "base", "why"),
    [
        ([], [], "at least one face"),
        (ENDS, [0, 1, 2], "shape"),
        (ENDS, [[0, 1, 6]], "landmark 6 of 6"),
        (ENDS, [[0, 1, -1]], "landmark -1 of 6"),
        (ENDS, [[0, 1, 1]], "landmark 1 twice"),
        (ENDS, [[0.0, 1.0, 2.0]], "integers"),
        (ENDS, [*OCTAHEDRON, [0, 1, 2]], "faces 0 and 8 both run from landmark 0 to 1"),
        (ENDS, [*OCTAHEDRON, [1, 0, 4]], "at most two faces"),
        (ENDS, OCTAHEDRON[:2], "number 4 is in no face"),
        (ENDS[:5], [[0, 1, 2], [0, 3, 4]], "not one fan"),
        ([0, 0, 1], [[0, 1, 2]], "vertex 0 repeats, as numbers 0 and 1"),
        ([0, 1, 10**6], [[0, 1, 2]], "does not exist"),
        ([[0, 1, 2]], [[0, 1, 2]], "shape"),
        (ENDS, OCTAHEDRON[:, ::-1], r"reverse them \(connectivity\[:, ::-1\]\)"),
        ([ENDS[k] for k in (0, 1, 3, 2, 5, 4)], OCTAHEDRON, "another order"),
        (np.arange(9), torus(3, 3)[1], "0 handles and the base mesh 1"),
    ],
)
def test_what_is_no_base_mesh_of_the_surface_is_told(landmarks, base, why):
    with pytest.raises(bf.BrushfireError, match=why):
        bf.patches(BALL, landmarks, base)


def without(faces, vertex):
    """One face at the vertex left out."""
    return np.delete(faces, np.flatnonzero((faces == vertex).any(axis=1))[0], axis=0)


@pytest.mark.parametrize(
    ("faces", "why"),
    [
        (np.concatenate([BALL.faces[:7], BALL.faces[7:8, ::-1], BALL.faces[8:]]), "oriented against each other"),
        (np.concatenate([BALL.faces, BALL.faces[:1]]), "three faces or more"),
        (BALL.faces[:, ::-1], "reverse them"),
        (without(BALL.faces, ENDS[4]), "landmark 4 lies on the surface's boundary"),
        (BALL.faces[(BALL.faces != ENDS[5]).all(axis=1)], "in no face"),
    ],
)
def test_what_is_no_surface_for_patches_is_told(faces, why):
    with pytest.raises(bf.BrushfireError, match=why):
        bf.patches(bf.Mesh(BALL.vertices, faces), ENDS, OCTAHEDRON)


def test_landmarks_of_one_part_lie_on_one_component():
    count = BALL.vertex_count
    two = bf.Mesh(
        np.concatenate([BALL.vertices, BALL.vertices + [3, 0, 0]]), np.concatenate([BALL.faces, BALL.faces + count])
    )
    with pytest.raises(bf.BrushfireError, match="different components"):
        bf.patches(two, [*ENDS[:5], ENDS[5] + count], OCTAHEDRON)
    both = bf.patches(two, ENDS + [v + count for v in ENDS], np.concatenate([OCTAHEDRON, OCTAHEDRON + 6]))
    assert_no_path_crosses(both)


def test_paths_stay_off_their_own_landmarks_other_sides():
    """In an order that makes paths wind around landmarks, they come back to where they began, on another side."""
    dice = np.random.default_rng(1)
    places = dice.choice(BALL.vertex_count, 8, replace=False)
    base = hull_of(BALL.vertices[places])
    assert_no_path_crosses(bf.patches(BALL, dice.permutation(places), base))


def test_paths_that_wind_around_each_other_without_end_are_refused():
    mesh = ball(1)
    dice = np.random.default_rng(3)
    places = dice.choice(mesh.vertex_count, 8, replace=False)
    base = hull_of(mesh.vertices[places])
    assert_no_path_crosses(bf.patches(mesh, places, base))
    with pytest.raises(bf.BrushfireError, match="wind around each other"):
        bf.patches(mesh, dice.permutation(places), base)


def test_a_torus_is_cut_by_a_torus():
    vertices, faces = torus(24, 18)
    corners, base = torus(3, 3)
    places = [int(np.argmin(np.linalg.norm(vertices - x, axis=1))) for x in corners]
    assert_no_path_crosses(bf.patches(bf.Mesh(vertices, faces), places, base))


def test_a_plane_is_cut_from_its_corners():
    vertices, faces = grid(8)
    flat = bf.Mesh(vertices, faces)
    middle = int(np.argmin(np.linalg.norm(vertices - vertices.mean(axis=0), axis=1)))
    corners = [int(np.argmax(vertices[:, :2] @ d)) for d in ([-1, -1], [1, -1], [1, 1], [-1, 1])]
    fan = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    assert_no_path_crosses(bf.patches(flat, [*corners, middle], fan))
    with pytest.raises(bf.BrushfireError, match="no way from landmark"):
        bf.patches(flat, corners[:3], [[0, 2, 1]])


def test_bow_ties_and_faces_without_three_corners_are_no_matter():
    found = bf.patches(bf.Mesh(BALL.vertices, np.concatenate([BALL.faces, [[0, 0, 1], [3, 3, 3]]])), ENDS, OCTAHEDRON)
    assert_no_path_crosses(found)
    # A second ball hangs at a vertex that is no landmark.
    own = next(v for v in range(BALL.vertex_count) if v not in ENDS)
    number = np.arange(BALL.vertex_count) + BALL.vertex_count
    number[own] = own
    more = np.concatenate([BALL.vertices, 2 * BALL.vertices[own] + BALL.vertices])
    pair = bf.Mesh(more, np.concatenate([BALL.faces, number[BALL.faces]]))
    assert pair.report.nonmanifold_vertices == 1
    assert set(bf.patches(pair, ENDS, OCTAHEDRON).patch) == {-1, *range(8)}
    with pytest.raises(bf.BrushfireError, match="several fans"):
        bf.patches(pair, [own, *ENDS[1:]], OCTAHEDRON)
