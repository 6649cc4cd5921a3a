"""Reeb graphs: loops, what they do not depend on, a small search."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf


def voxels(mask, fine=3):
    """The surface of blocks, every block's side cut into fine x fine squares."""
    filled = np.pad(np.kron(mask, np.ones((fine,) * 3, dtype=int)), 1).astype(bool)
    quads = []
    for axis in range(3):
        for side in (0, 1):
            free = filled & ~np.roll(filled, 1 - 2 * side, axis)
            for cell in np.argwhere(free):
                u, v = np.eye(3, dtype=int)[[(axis + 1) % 3, (axis + 2) % 3]]
                corner = cell + side * np.eye(3, dtype=int)[axis]
                quad = [corner, corner + u, corner + u + v, corner + v]
                quads.append(quad if side else quad[::-1])
    points, index = np.unique(np.array(quads).reshape(-1, 3), axis=0, return_inverse=True)
    index = index.reshape(-1, 4)
    return points / fine, np.concatenate([index[:, [0, 1, 2]], index[:, [0, 2, 3]]])


def torus(slices=40, around=20):
    i, j = np.mgrid[0:slices, 0:around]
    a, b = 2 * np.pi * i / slices, 2 * np.pi * j / around
    x = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], axis=-1)
    # A thick and a thin side, as shapes have: around a round one every value is taken on a whole circle.
    x *= (1 + 0.25 * np.cos(a))[..., None]
    at = lambda i, j: i % slices * around + j % around  # noqa: E731
    faces = [[at(i, j), at(i + 1, j), at(i + 1, j + 1)] for i in range(slices) for j in range(around)]
    faces += [[at(i, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(slices) for j in range(around)]
    return x.reshape(-1, 3), np.array(faces)


def figure(arms, fine=2, bend=0.0):
    """A body with arms of given lengths, along x, y and z; bent by turning what lies far out."""
    size = 2 * max(arms) + 1
    mask = np.zeros((size,) * 3, dtype=int)
    middle = max(arms)
    mask[middle, middle, middle] = 1
    for k, length in enumerate(arms):
        axis, sign = k % 3, 1 if k < 3 else -1
        for step in range(1, length + 1):
            place = [middle] * 3
            place[axis] += sign * step
            mask[tuple(place)] = 1
    points, faces = voxels(mask, fine)
    x = points - points.mean(axis=0)
    angle = bend * x[:, 2]
    turned = np.column_stack(
        [np.cos(angle) * x[:, 0] - np.sin(angle) * x[:, 1], np.sin(angle) * x[:, 0] + np.cos(angle) * x[:, 1], x[:, 2]]
    )
    return bf.Mesh(turned, faces)


@pytest.mark.parametrize("levels", [3, 5])
def test_loops_are_the_handles(levels):
    ball = voxels(np.ones((2, 2, 3), dtype=int))
    plate = np.ones((9, 5, 1), dtype=int)
    plate[1:4, 1:4] = plate[6:8, 1:4] = 0
    assert bf.reeb_graph(bf.Mesh(*ball), levels, samples=40).loops == 0
    assert bf.reeb_graph(bf.Mesh(*torus()), levels, samples=60).loops == 1
    assert bf.reeb_graph(bf.Mesh(*voxels(plate, 2)), levels, samples=60).loops == 2


def test_the_average_distance_is_within_its_error():
    mesh = bf.Mesh(*torus(24, 12))
    graph = bf.reeb_graph(mesh, 3, samples=30)
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    area = np.bincount(mesh.faces.ravel(), np.repeat(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6, 3))
    average = mesh.distance_matrix(method="exact", dtype=np.float64) @ area / area.sum()
    truth = (average - average.min()) / average.max()
    assert np.abs(graph.values - truth).max() <= graph.error
    assert graph.error > 2 * bf.reeb_graph(mesh, 3, samples=200).error


def test_a_graph_is_whole_and_its_parents_hold_its_nodes():
    graph = bf.reeb_graph(figure([4, 3, 2, 3]), 4, samples=40)
    assert graph.area.sum() == pytest.approx(1)
    assert (graph.node >= 0).all() and graph.loops == 0
    assert (np.abs(np.diff(graph.interval[graph.edges], axis=1)) == 1).all()
    coarse = graph._levels[-2]
    assert (coarse["interval"][graph.parents[-1]] == graph.interval // 2).all()
    assert np.bincount(graph.parents[-1], graph.area) == pytest.approx(coarse["area"])


def test_rotation_scale_and_resolution_do_not_count():
    mesh = figure([4, 3, 2, 3])
    graph = bf.reeb_graph(mesh, 4, samples=60)
    turn, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
    moved = bf.Mesh(7 * mesh.vertices @ turn.T + 1, mesh.faces)
    assert graph.similarity(bf.reeb_graph(moved, 4, samples=60)) > 0.95
    finer = figure([4, 3, 2, 3], fine=3)
    assert graph.similarity(bf.reeb_graph(finer, 4, samples=60)) > 0.85
    assert graph.similarity(graph) == pytest.approx(1)


def test_a_search_finds_poses_of_one_shape_first():
    kinds = [[5, 2, 2, 2], [3, 3, 3, 3, 3, 3], [6, 1, 1, 5], [4, 4, 1]]
    shapes = [
        (k, bf.reeb_graph(figure(arms, bend=b), 4, samples=40)) for k, arms in enumerate(kinds) for b in (0, 0.1, 0.2)
    ]
    for i, (kind, graph) in enumerate(shapes):
        ranked = sorted((-graph.similarity(other), k) for j, (k, other) in enumerate(shapes) if j != i)
        assert [k for _, k in ranked[:2]] == [kind, kind], (kind, ranked[:4])


def test_surfaces_without_area_and_without_positions_are_told():
    with pytest.raises(bf.BrushfireError, match="without area"):
        bf.reeb_graph(bf.Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]))
    with pytest.raises(bf.BrushfireError, match="positions"):
        bf.reeb_graph(bf.Mesh.from_lengths([[0, 1, 2]], [[1, 1, 1]]))
