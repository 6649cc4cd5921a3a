"""Meshes and methods that the tests share."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf


def grid(n: int, height: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """An n x n grid of unit squares, each split in two, with bumps of the given height (seeded)."""
    y, x = np.mgrid[0:n, 0:n]
    z = np.random.default_rng(1).uniform(0, height, (n, n)) if height else np.zeros((n, n))
    v = (np.arange((n - 1) * n).reshape(n - 1, n)[:, :-1]).ravel()
    lower = np.column_stack([v, v + 1, v + n])
    upper = np.column_stack([v + 1, v + n + 1, v + n])
    return np.column_stack([x.ravel(), y.ravel(), z.ravel()]).astype(float), np.concatenate([lower, upper])


def assert_same(limited: np.ndarray, full: np.ndarray, method: str) -> None:
    """A run with a radius gives what one without gives: to the bit, but exact ones round otherwise on short ways.

    On small meshes `windows` runs exactly, too.
    """
    if method in ("exact", "windows"):
        np.testing.assert_allclose(limited, full, rtol=1e-14, atol=0)
    else:
        np.testing.assert_array_equal(limited, full)


@pytest.fixture(scope="session")
def square() -> bf.Mesh:
    return bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])


@pytest.fixture(scope="session")
def bumpy() -> bf.Mesh:
    return bf.Mesh(*grid(12, 0.5))


@pytest.fixture(params=bf.methods())
def method(request: pytest.FixtureRequest) -> str:
    return str(request.param)
