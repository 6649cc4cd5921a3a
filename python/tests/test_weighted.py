"""Weighted surfaces."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf

V = np.array([[x, y, 0] for y in range(3) for x in range(5)], dtype=float)
F = np.array(
    [t for y in range(2) for x in range(4) for v in [y * 5 + x] for t in ((v, v + 1, v + 6), (v, v + 6, v + 5))]
)
# Right of x = 2 every step costs three times as much.
W = np.where(V[F].mean(axis=1)[:, 0] > 2, 3.0, 1.0)


@pytest.fixture
def strip() -> bf.Mesh:
    return bf.Mesh(V, F)


def test_costs_lie_between_their_bounds(strip: bf.Mesh) -> None:
    costs = strip.weighted(W).costs(5)
    assert costs.lower is not None
    assert costs.lower[9] <= 8 <= costs.upper[9]
    assert (costs.lower <= costs.upper).all()
    excess = (costs.upper - costs.lower)[costs.upper > 0] / costs.lower[costs.upper > 0]
    assert excess.max() == pytest.approx(costs.max_error_bound)
    assert excess.mean() == pytest.approx(costs.mean_error_bound)
    assert costs.engine in ("windows", "points")
    distance = strip.weighted(W).distance(5)
    assert (distance >= costs.lower).all() and distance == pytest.approx(costs.upper, rel=0.01)
    assert strip.weighted(W).distance(5, targets=[9, 0]) == pytest.approx(costs.upper[[9, 0]], rel=0.01)
    assert strip.weighted(W).costs(5, tolerance=0.1, refine=True).max_error_bound <= 0.1


def test_a_wish_that_is_not_met_says_what_it_would_take(strip: bf.Mesh) -> None:
    weighted = strip.weighted(W, [[2, 7, np.inf, 5]])
    once = weighted.costs(5, tolerance=0.08)
    assert once.max_error_bound > 0.08 and once.needed is not None and once.needed.refinements
    assert once.needed.points > 0 and once.needed.time >= 4
    too_few = weighted.costs(5, tolerance=0.08, refine=once.needed.refinements - 1)
    assert too_few.needed == once.needed
    met = weighted.costs(5, tolerance=0.08, refine=True)
    assert met.max_error_bound <= 0.08 and met.needed is None
    with pytest.raises(bf.BrushfireError, match="refine"):
        weighted.costs(5, refine=-1)


def test_rows_of_costs_are_the_same_on_any_number_of_threads(strip: bf.Mesh) -> None:
    for bound in ("upper", "lower"):
        one, three = (strip.distance_matrix(weights=W, bound=bound, threads=n, dtype=np.float64) for n in (1, 3))
        assert (one == three).all()


def test_paths_are_those_of_the_weights_leg_by_leg(strip: bf.Mesh) -> None:
    weighted = strip.weighted(W, [[2, 7, np.inf, 5], [7, 12, np.inf, 5]])
    path = weighted.path(5, 9)
    assert path.cost == pytest.approx(13) and path.length == pytest.approx(4) and path.lower <= path.cost
    assert (path.leg_length * path.weight + path.toll).sum() == pytest.approx(path.cost)
    assert len(path.face) == len(path.positions) - 1 and path.toll.sum() == pytest.approx(5)
    road = strip.weighted(edge_weights=[[5, 6, 0.5], [6, 7, 0.5]]).path(5, 7)
    assert road.cost == pytest.approx(1) and sorted(road.edge.ravel().tolist()) == [5, 6, 6, 7]
    found, source = weighted.paths([5, 9], [6, 8])
    assert [p.cost for p in found] == pytest.approx([1, 3]) and source.tolist() == [0, 1]


def test_walls_of_both_kinds_go_together(strip: bf.Mesh) -> None:
    walls = np.where(V[F].mean(axis=1)[:, 0].astype(int) == 2, np.inf, 1.0)
    assert np.isinf(strip.weighted(walls).distance(5)[9])
    assert np.isinf(strip.weighted(walls).path(5, 9).cost)
    walled = strip.walled(edges=[(2, 7)])
    assert walled.weighted(np.full(len(F), 2.0)).distance(1)[3] == pytest.approx(4 * np.sqrt(2), rel=1e-2)
    assert walled.weighted(W).path(1, 3).cost > 2 + 3


def test_one_weight_everywhere_is_that_times_the_distance(strip: bf.Mesh) -> None:
    plain = strip.distance(5, tolerance=0.01, bound="upper")
    assert (strip.weighted(np.full(len(F), 1.7)).distance(5) == 1.7 * plain).all()


def test_what_are_no_weights_is_refused(strip: bf.Mesh) -> None:
    with pytest.raises(bf.BrushfireError, match="one per face"):
        strip.weighted([1.0, 2.0])
    with pytest.raises(bf.BrushfireError, match="not > 0"):
        strip.weighted(-W)
    with pytest.raises(bf.BrushfireError, match="rows of two vertices"):
        strip.weighted(edge_weights=[[0, 1]])
    with pytest.raises(bf.BrushfireIndexError, match="does not exist"):
        strip.weighted(edge_weights=[[0, 99, 1]])
    with pytest.raises(bf.BrushfireError, match="tolerance"):
        strip.weighted(W).costs(0, tolerance=0)


def test_weights_count_in_whatever_reads_a_field(strip: bf.Mesh) -> None:
    weighted = strip.weighted(W)
    truth = weighted.distance(5)
    assert (strip.distance(5, weights=W) == truth).all()
    assert (strip.solver().distance(5, weights=weighted) == truth).all()
    assert (strip.distance_matrix([5], weights=W, dtype=np.float64)[0] == truth).all()
    assert strip.pair_distances([[5, 9], [5, 7]], weights=W) == pytest.approx([8, 2])
    assert strip.nearest_sources([5, 9], 2, weights=W)[0][7] == pytest.approx([2, 6])
    assert strip.parcels([0, 0, -1, -1, 1] * 3, weights=W).distance[0, 1] == pytest.approx(7)
    assert strip.farthest_points(2, 5, weights=W).separation[1] == truth.max()
    cells = strip.voronoi([5, 9], weights=weighted)
    assert cells.area.sum() == pytest.approx(8) and cells.area[0] > 4.5
    low, bound = strip.distance(5, weights=W, bound="lower", return_bound=True)
    assert (low + bound == pytest.approx(truth, rel=0.01)) and (low <= truth).all()
    with pytest.raises(bf.BrushfireError, match="points on edges"):
        strip.distance(5, weights=W, method="exact")


def test_infinite_weights_are_walls_in_cells(strip: bf.Mesh) -> None:
    wall = np.where(V[F].mean(axis=1)[:, 0] > 2, np.inf, 1.0)
    cells = strip.voronoi([5], weights=wall)
    assert cells.area[0] == pytest.approx(4)
    assert np.isinf(cells.distance[9])


def test_curves_are_sources_of_costs(strip: bf.Mesh) -> None:
    costs = strip.weighted(W).costs(bf.Curve([0, 5, 10]))
    assert costs.lower is None
    assert costs.upper[9] == pytest.approx(8)
    assert strip.weighted(W).path(bf.Curve([0, 5, 10]), 9).cost == pytest.approx(8)


def test_a_direction_is_that_of_the_weights_where_a_call_does_not_say() -> None:
    ground = bf.terrain([[0, 5, 10], [0, 5, 10]], (0, 10, 0, 0, 0, -10))
    down = ground.mesh.weighted(slope="tobler", towards=True)
    up = ground.mesh.weighted(slope="tobler")
    assert (down.distance(0) == up.distance(0, towards=True)).all()
    assert (ground.mesh.distance(0, weights=down) == down.distance(0)).all()
    assert ground.mesh.distance(0, weights=up)[2] > ground.mesh.distance(0, weights=down)[2]


def test_marching_is_near_and_fast_and_promises_nothing(strip: bf.Mesh) -> None:
    weighted = strip.weighted(W)
    near = weighted.distance(5, method="kimmel-sethian")
    assert near == pytest.approx(weighted.distance(5), rel=0.25) and near[9] == pytest.approx(8, rel=0.06)
    assert len(strip.farthest_points(3, weights=weighted, method="kimmel-sethian").vertices) == 3
    with pytest.raises(bf.BrushfireError, match="kimmel-sethian"):
        weighted.distance(5, method="carried-source")
    with pytest.raises(bf.BrushfireError, match="roads"):
        strip.weighted(W, [[2, 7, np.inf, 5]]).distance(5, method="kimmel-sethian")


def test_going_across_a_grain_costs_more(strip: bf.Mesh) -> None:
    grain = np.tile([1.0, 0.0, 0.0, 3.0], (len(F), 1))
    weighted = strip.weighted(grain=grain)
    truth = np.hypot(V[:, 0], 3 * V[:, 1])
    found = weighted.distance(0, tolerance=0.001)
    assert (found >= truth * (1 - 1e-12)).all() and found == pytest.approx(truth, rel=2e-3)
    assert weighted.costs(0).lower is None
    planner = weighted.replanner(0)
    planner.change(np.full(len(F), 2.0))
    assert planner.distance == pytest.approx(2 * weighted.distance(0), rel=1e-12)
    planner.change(grain=np.tile([0.0, 1.0, 0.0, 3.0], (len(F), 1)))
    assert planner.distance[5] == pytest.approx(2) and planner.distance[1] == pytest.approx(6)
    with pytest.raises(bf.BrushfireError, match="grain"):
        strip.weighted(grain=[[1, 0, 0, 3]])
    with pytest.raises(bf.BrushfireError, match="together"):
        strip.weighted(grain=grain, slope="tobler")
