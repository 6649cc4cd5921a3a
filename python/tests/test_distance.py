"""distance(): every spelling of sources and targets, and what is returned."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import assert_same, grid


def test_every_spelling_of_a_source_means_the_same(bumpy, method):
    expected = bumpy.distance(17, method=method)
    mask = np.zeros(bumpy.vertex_count, dtype=bool)
    mask[17] = True
    face = int(np.flatnonzero((bumpy.faces == 17).any(axis=1))[0])
    weights = (bumpy.faces[face] == 17).astype(float)
    spellings = [
        np.int8(17), np.uint64(17), [17], (17,), np.array(17), np.array([17], dtype=np.int16), mask, range(17, 18),
        np.array([17], dtype=object), bf.Point(face, tuple(weights)), [bf.Point(face, tuple(weights))],
        bf.Points([face], [weights]),
    ]  # fmt: skip
    for spelling in spellings:
        assert np.array_equal(bumpy.distance(spelling, method=method), expected), spelling


def test_several_sources_give_the_nearest_and_say_which(bumpy, method):
    sources = [5, 140, bf.Point(7, (0.2, 0.3, 0.5))]
    d, label = bumpy.distance(sources, method=method, return_source=True)
    assert label.dtype == np.int32
    single = np.array([bumpy.distance(s, method=method) for s in sources])
    assert set(label) == {0, 1, 2}
    # The fronts of approximate methods disturb each other where they meet.
    # That of heat is rounded everywhere, by some of these long edges.
    rounded = 1.5 * bumpy.report.mean_edge_length if method == "heat" else 0
    assert np.allclose(d, single.min(axis=0), rtol=0.03, atol=rounded)
    assert d[5] == d[140] == 0


def test_offsets_shift_the_field(bumpy, method):
    d = bumpy.distance(3, method=method)
    assert np.allclose(bumpy.distance(3, offset=2.5, method=method), d + 2.5, rtol=1e-12)
    assert np.allclose(bumpy.distance([3], offset=[-1.0], method=method), d - 1, atol=1e-12)


def test_beyond_the_radius_reads_infinity_and_no_source(bumpy, method):
    full = bumpy.distance(0, method=method)
    d, label = bumpy.distance(0, radius=4.0, method=method, return_source=True)
    near = full <= 4
    assert_same(d[near], full[near], method)
    assert np.isinf(d[~near]).all()
    assert (label[~near] == -1).all()


def test_targets_read_what_the_field_reads(bumpy, method):
    full = bumpy.distance(0, method=method)
    d, label = bumpy.distance(0, targets=[100, 7, 7], method=method, return_source=True)
    assert np.array_equal(d, full[[100, 7, 7]])
    assert label.tolist() == [0, 0, 0]
    inside = bumpy.distance(0, targets=bf.Point(30, (0.4, 0.3, 0.3)), method=method)
    corners = full[bumpy.faces[30]]
    assert corners.min() - 1.5 < inside[0] < corners.max() + 1.5


def test_other_components_and_unused_vertices_read_infinity(method):
    v, f = grid(4)
    mesh = bf.Mesh(np.vstack([v, v + 100, [[0, 0, 9]]]), np.vstack([f, f + 16]))
    d, label = mesh.distance(0, method=method, return_source=True)
    assert np.isfinite(d[:16]).all()
    assert np.isinf(d[16:]).all()
    assert (label[16:] == -1).all()


def test_a_solver_gives_what_the_mesh_gives(bumpy, method):
    solver = bumpy.solver()
    for source in (0, 77, 0):
        for limit in (np.inf, 3.0):
            expected = bumpy.distance(source, radius=limit, method=method)
            assert np.array_equal(solver.distance(source, radius=limit, method=method), expected)


def test_the_bound_is_returned_where_there_is_one(bumpy, method):
    try:
        d, bound = bumpy.distance(0, method=method, return_bound=True)
    except bf.BrushfireError as error:
        assert "bound" in str(error)
    else:
        assert bound.shape == d.shape
        assert (bound >= 0).all()


def test_any_number_of_threads_gives_the_same_bits(method):
    large = bf.Mesh(*grid(200, 0.3))
    expected = large.distance(0, method=method)
    for threads in (0, 2, 5):
        assert np.array_equal(large.distance(0, method=method, threads=threads), expected)
    with pytest.raises(bf.BrushfireError, match="threads"):
        large.distance(0, method=method, threads=-1)
    with pytest.raises(bf.BrushfireError, match="4096"):
        large.distance(0, method=method, threads=5000)


def test_progress_ends_at_one_and_its_exception_comes_through(bumpy):
    shares: list[float] = []
    bumpy.distance_matrix(method="dijkstra", progress=shares.append)
    assert shares[-1] == 1.0
    assert shares == sorted(shares)

    def fail(share: float) -> None:
        raise LookupError("from the callback")

    with pytest.raises(LookupError, match="from the callback"):
        bumpy.distance_matrix(method="dijkstra", progress=fail)


def test_positions_of_points(square):
    assert square.position(2).tolist() == [3, 4, 0]
    assert square.position([bf.Point(0, (0, 0.5, 0.5)), 0]).tolist() == [[3, 2, 0], [0, 0, 0]]
