"""What the peers' tests run on: a flat grid, a hedgehog; and the originals, where they are installed."""

from __future__ import annotations

import importlib
from types import ModuleType

import numpy as np


def flat(spacing: float = 0.2, n: int = 11) -> tuple[np.ndarray, np.ndarray]:
    """A flat grid of n x n vertices, row by row, each square cut from its lower right to its upper left corner."""
    y, x = np.mgrid[0:n, 0:n] * spacing
    v = (np.arange((n - 1) * n).reshape(n - 1, n)[:, :-1]).ravel()
    faces = np.concatenate([np.column_stack([v, v + 1, v + n]), np.column_stack([v + 1, v + n + 1, v + n])])
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(n * n)]), faces.astype(np.int32)


def hedgehog(seed: int = 7) -> tuple[np.ndarray, np.ndarray]:
    """A closed sphere-like mesh of a few hundred vertices, a third of them drawn out to spikes."""
    from scipy.spatial import ConvexHull

    random = np.random.default_rng(seed)
    directions = random.normal(size=(300, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    faces = ConvexHull(directions).simplices
    outward = np.einsum(
        "ij,ij->i",
        np.cross(*(directions[faces[:, k]] - directions[faces[:, 0]] for k in (1, 2))),
        directions[faces[:, 0]],
    )
    faces[outward < 0] = faces[outward < 0][:, [0, 2, 1]]
    return directions * np.where(random.uniform(size=300) < 1 / 3, 1.6, 1.0)[:, None], faces.astype(np.int32)


def original(name: str) -> ModuleType | None:
    """The package that the adapter stands for; None where it is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def straight(vertices: np.ndarray, source: int) -> np.ndarray:
    """What the distances on a flat mesh without holes and bays are."""
    return np.linalg.norm(vertices - vertices[source], axis=1)
