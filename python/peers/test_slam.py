"""slam's three tests of geodesics, with the calls that it makes."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy")

from peer_meshes import flat

import brushfire as bf
from brushfire.compat import gdist

M, N = 4, 5


def rectangle() -> tuple[np.ndarray, np.ndarray]:
    """M x N vertices one apart: those of a square, the rest cut off."""
    v, f = flat(1.0, N)
    kept = v[:, 0] < M
    number = np.cumsum(kept) - 1
    return v[kept], number[f[kept[f].all(axis=1)]].astype(np.int32)


def compute(v, f, source):
    every = np.linspace(0, len(v) - 1, len(v)).astype(np.int32)
    return gdist.compute_gdist(v, f, np.array([source], dtype=np.int32), every)


def test_the_diagonal_is_between_the_straight_line_and_the_edges():
    v, f = rectangle()
    far = compute(v, f, 0)[M * N - 1]
    assert np.sqrt((M - 1) ** 2 + (N - 1) ** 2) - 1e-12 <= far <= M - 1 + N - 1


def test_from_one_side_it_is_as_far_to_the_other_as_the_rectangle_is_long():
    v, f = rectangle()
    side = np.arange(M, dtype=np.int32)
    assert np.min([compute(v, f, s) for s in side], axis=0).max() == pytest.approx(N - 1, abs=1e-10)
    assert gdist.compute_gdist(v, f, side).max() == pytest.approx(N - 1, abs=1e-10)


def test_along_edges_too():
    v, f = rectangle()
    assert bf.Mesh(v, f).distance(np.arange(M), method="dijkstra").max() == pytest.approx(N - 1, abs=1e-10)
