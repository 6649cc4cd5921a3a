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
    assert strip.weighted(W).distance(5) == pytest.approx(costs.upper)
    assert strip.weighted(W).distance(5, targets=[9, 0]) == pytest.approx(costs.upper[[9, 0]])
    assert strip.weighted(W).costs(5, tolerance=0.1, refine=True).max_error_bound <= 0.1


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
