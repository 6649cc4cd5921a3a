"""Solvers: what a mesh gives, again and again, with what has to be built for it built once; progress."""

from __future__ import annotations

import io
import pickle
import sys
import time

import numpy as np
import pytest

import brushfire as bf
from conftest import grid
from test_from_any import lib


def test_a_solver_gives_what_the_mesh_gives_in_any_order(bumpy):
    solver = bumpy.solver()
    rng = np.random.default_rng(2)
    d = bumpy.distance(0, method="exact")

    def same_path(a, b):
        return a == b and np.array_equal(a.positions, b.positions)

    checks = [
        lambda s, t: np.array_equal(solver.distance(s), bumpy.distance(s)),
        lambda s, t: np.array_equal(solver.distance(s, method="dijkstra"), bumpy.distance(s, method="dijkstra")),
        lambda s, t: same_path(solver.path(s, t), bumpy.path(s, t)),
        lambda s, t: same_path(solver.path(s, t, 7, closed=True), bumpy.path(s, t, 7, closed=True)),
        lambda s, t: all(map(same_path, solver.paths([s, 9], [t, 3])[0], bumpy.paths([s, 9], [t, 3])[0])),
        lambda s, t: same_path(solver.edge_path(s, t), bumpy.edge_path(s, t)),
        lambda s, t: np.array_equal(solver.log_map(s).angle, bumpy.log_map(s).angle, equal_nan=True),
        lambda s, t: np.array_equal(solver.log_map(s, 3.0).radius, bumpy.log_map(s, 3.0).radius),
        lambda s, t: (
            [i.line for i in solver.curved_isolines(s, [2.0])] == [i.line for i in bumpy.curved_isolines(s, [2.0])]
        ),
        lambda s, t: [i.line for i in solver.isolines(d, [2.0])] == [i.line for i in bumpy.isolines(d, [2.0])],
        lambda s, t: solver.trace(s, 0.3, 2.0)[0] == bumpy.trace(s, 0.3, 2.0)[0],
    ]
    inner = np.flatnonzero((bumpy.vertices[:, :2] % 11 != 0).all(axis=1))
    for _ in range(60):
        check = checks[rng.integers(len(checks))]
        s, t = (int(v) for v in rng.choice(inner, 2, replace=False))
        assert check(s, t), (check, s, t)


def test_rows_of_a_solver_are_rows_of_the_matrix(bumpy):
    lib("scipy.sparse")
    solver = bumpy.solver()
    places = [5, 100, 5]
    ours = solver.distances_within(3.0, places, method="exact", dtype=float)
    theirs = bumpy.distances_within(3.0, places, method="exact", dtype=float)
    assert ours.has_sorted_indices
    for attribute in ("indptr", "indices", "data"):
        assert np.array_equal(getattr(ours, attribute), getattr(theirs, attribute))
    one = solver.distances_within(2.0, bf.Point(7, (0.2, 0.3, 0.5)))
    assert one.shape == (1, bumpy.vertex_count)
    assert one.dtype == np.float32
    assert 0 < one.nnz < bumpy.vertex_count
    for radius in (-1, np.inf, np.nan):
        with pytest.raises(bf.BrushfireError, match="radius"):
            solver.distances_within(radius, 0)
    with pytest.raises(IndexError):
        solver.distances_within(1.0, [bumpy.vertex_count])


def test_a_vertex_in_no_face_is_an_empty_row():
    lib("scipy.sparse")
    mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [9, 9]], [[0, 1, 2]])
    rows = mesh.solver().distances_within(10.0, [3, 0], method="exact")
    assert rows.nnz == 3
    assert np.array_equal(rows.toarray(), mesh.distances_within(10.0, [3, 0], method="exact").toarray())


def test_a_sparse_log_map_holds_what_the_full_one_has(bumpy):
    full = bumpy.log_map(77, 4.0)
    sparse = bumpy.solver().log_map(77, 4.0, sparse=True)
    assert np.array_equal(sparse.vertices, np.flatnonzero(np.isfinite(full.radius)))
    assert np.array_equal(sparse.radius, full.radius[sparse.vertices])
    assert np.array_equal(sparse.angle, full.angle[sparse.vertices])
    assert sparse.total_angle == full.total_angle
    assert full.vertices is None


def test_what_a_solver_is_made_with_counts_where_a_call_says_nothing(bumpy):
    solver = bumpy.solver("dijkstra")
    assert np.array_equal(solver.distance(3), bumpy.distance(3, method="dijkstra"))
    assert np.array_equal(solver.distance(3, method="exact"), bumpy.distance(3, method="exact"))
    tolerant = bumpy.solver(tolerance=0.05, bound="upper")
    for call in (tolerant, pickle.loads(pickle.dumps(tolerant))):
        assert np.array_equal(call.distance(3), bumpy.distance(3, tolerance=0.05, bound="upper"))
        assert np.array_equal(call.distance(3, tolerance=0), bumpy.distance(3, tolerance=0))
    marching = bumpy.solver("novotni-klein", precision="float64")
    assert np.array_equal(marching.distance(3), bumpy.distance(3, method="novotni-klein", precision="float64"))
    for arguments in ({"method": "none"}, {"method": "exact", "tolerance": 0.1}, {"precision": "float"}):
        with pytest.raises((bf.BrushfireError, TypeError)):
            bumpy.solver(**arguments).distance(0)


def test_what_is_limited_costs_little_after_the_first_call():
    """The least of several, and a factor that no busy machine makes up for: set-up is many times a small run."""
    mesh = bf.Mesh(*grid(250, 0.5))
    solver = mesh.solver("exact")
    lib("scipy.sparse")
    calls = {
        "path": (lambda: mesh.path(30000, 30010), lambda: solver.path(30000, 30010)),
        "log map": (lambda: mesh.log_map(30000, 4.0), lambda: solver.log_map(30000, 4.0, sparse=True)),
        "row": (
            lambda: mesh.distances_within(4.0, 30000, method="exact", threads=1),
            lambda: solver.distances_within(4.0, 30000),
        ),
    }
    for name, (fresh, kept) in calls.items():
        kept()
        assert 2 * least_time(kept, 9) < least_time(fresh, 3), name


def least_time(call, times):
    least = np.inf
    for _ in range(times):
        start = time.perf_counter()
        call()
        least = min(least, time.perf_counter() - start)
    return least


# ---- progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


def long_calls(mesh):
    yield lambda **p: mesh.distance(0, method="dijkstra", **p)
    yield lambda **p: mesh.distance_matrix(range(50), method="dijkstra", **p)
    yield lambda **p: mesh.distance_matrix(range(50), method="dijkstra", dtype=np.float16, **p)
    yield lambda **p: mesh.voronoi([0, 5], **p)
    yield lambda **p: mesh.farthest_points(5, **p)
    yield lambda **p: mesh.curved_isolines(0, [1.0], **p)


def test_progress_true_shows_a_bar_that_ends(bumpy, monkeypatch):
    tqdm = lib("tqdm.auto")
    bars = []

    class Bar(tqdm.tqdm):
        def __init__(self, *args, **kwargs):
            super().__init__(*args, **kwargs, file=io.StringIO())
            bars.append(self)

    monkeypatch.setattr(tqdm, "tqdm", Bar)
    for call in long_calls(bumpy):
        call(progress=True)
        assert bars[-1].n == 1
        assert bars[-1].disable  # closed
    with pytest.raises(IndexError):
        bumpy.distance(10**6, progress=True)
    assert bars[-1].disable


def test_progress_true_without_tqdm_is_a_line_on_a_terminal(bumpy, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    monkeypatch.setitem(sys.modules, "tqdm", None)
    terminal, pipe = Terminal(), io.StringIO()
    for stream in (terminal, pipe):
        monkeypatch.setattr(sys, "stderr", stream)
        bumpy.distance(0, method="dijkstra", progress=True)
    assert "distance 100 %" in terminal.getvalue()
    assert terminal.getvalue().endswith("\r\033[K")
    assert pipe.getvalue() == ""


def test_progress_may_be_nothing_and_shares_ascend_to_the_end(bumpy):
    for call in long_calls(bumpy):
        shares: list[float] = []
        call(progress=shares.append)
        assert shares == sorted(shares)
        assert shares[-1] == 1
        call(progress=None)
        call(progress=False)
        for bad in (7, "yes"):
            with pytest.raises(TypeError, match="progress"):
                call(progress=bad)
