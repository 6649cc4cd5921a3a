"""Costs that follow changes are those of a fresh run."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf

N = 16


@pytest.fixture
def ground() -> bf.Mesh:
    return bf.terrain(np.random.default_rng(3).uniform(0, 0.7, (N, N))).mesh


def is_fresh(planner: bf.Replanner, weighted: bf.Weighted, goal: int) -> None:
    assert planner.distance.tolist() == weighted.distance(goal, towards=True).tolist()
    assert planner.path(N * N - 1).cost == pytest.approx(weighted.path(goal, N * N - 1, towards=True).cost, rel=1e-9)


def test_costs_follow_weights_walls_fences_and_goals_to_the_bit(ground: bf.Mesh) -> None:
    weights = np.random.default_rng(4).uniform(1, 5, ground.face_count)
    planner = ground.weighted(weights, slope="tobler").replanner(0, towards=True)
    assert planner.renewed == 1
    is_fresh(planner, ground.weighted(weights, slope="tobler"), 0)
    weights[150:170] *= 3
    planner.change(weights)
    assert planner.renewed < 0.9
    weights[30:40] = np.inf
    planner.change(weights)
    is_fresh(planner, ground.weighted(weights, slope="tobler"), 0)
    fence = [[N * 7 + x, N * 7 + x + 1, np.inf, 4] for x in range(N - 3)]
    planner.change(edge_weights=fence)
    is_fresh(planner, ground.weighted(weights, fence, slope="tobler"), 0)
    planner.move(N - 1)
    is_fresh(planner, ground.weighted(weights, fence, slope="tobler"), N - 1)
    planner.change(edge_weights=[])
    is_fresh(planner, ground.weighted(weights, slope="tobler"), N - 1)
    assert planner.source.max() == 0


def test_what_is_refused_leaves_all_as_it_was(ground: bf.Mesh) -> None:
    planner = ground.weighted(np.full(ground.face_count, 2.0)).replanner([0, 5], offset=[0, 1])
    before = planner.distance
    with pytest.raises(bf.BrushfireError, match="weight"):
        planner.change(np.zeros(ground.face_count))
    with pytest.raises(bf.BrushfireError):
        planner.move(N * N)
    with pytest.raises(bf.BrushfireError, match="paths"):
        planner.path([1, 2])
    assert (planner.distance == before).all()
    planner.change(edge_weights=[[0, 1, 1]])
    assert planner.distance[1] == pytest.approx(before[1] / 2) and planner.renewed < 1


def test_an_array_that_changes_afterwards_changes_nothing(ground: bf.Mesh) -> None:
    weights = np.full(ground.face_count, 2.0)
    planner = ground.weighted(weights).replanner(0)
    planner.change(weights)
    before = planner.distance
    weights[:] = 7
    planner.change(edge_weights=[])
    assert (planner.distance == before).all()
