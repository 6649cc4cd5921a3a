"""Arithmetic of faces: their edges, what hangs together, and faces with points on their sides cut into triangles."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Ints

Edge = tuple[int, int]


def ends_of(faces: npt.NDArray[Any]) -> Ints:
    """(3 k, 2): from where to where the sides of (k, 3) faces run: of all faces the first, the second, the third."""
    sides: Ints = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    return sides


def edges_of(faces: npt.NDArray[Any]) -> tuple[Ints, Ints]:
    """(n, 2): the edges, lower end first; and (n,): how many faces have each."""
    edges, times = np.unique(np.sort(ends_of(faces), axis=1), axis=0, return_counts=True)
    return edges, times


def _neighbours(faces: npt.NDArray[Any]) -> tuple[Ints, Ints]:
    """Sides, as ends_of() counts them, that two faces share."""
    ends = np.sort(ends_of(faces), axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    same = np.flatnonzero((ends[order][1:] == ends[order][:-1]).all(axis=1))
    return order[same], order[same + 1]


def components(faces: npt.NDArray[Any]) -> Ints:
    """(k,): of faces that share an edge, the lowest."""
    from brushfire._reeb import _connected

    here, there = _neighbours(faces)
    return _connected(len(faces), np.column_stack([here, there]) % max(len(faces), 1))


def parted_fans(faces: npt.NDArray[Any], vertex_count: int) -> tuple[Ints, Ints]:
    """The faces with a vertex for every fan where fans meet at one; and which vertices the further ones are copies of."""
    from brushfire._reeb import _connected

    ends, n = ends_of(faces), len(faces)

    def corner(side: Ints, end: str) -> Ints:
        at: Ints = ends[side].argmin(axis=1) if end == "lower" else ends[side].argmax(axis=1)
        return side % n * 3 + (side // n + at) % 3

    pairs = [np.column_stack([corner(side, end) for side in _neighbours(faces)]) for end in ("lower", "upper")]
    _, first, fan = np.unique(_connected(3 * n, np.concatenate(pairs)), return_index=True, return_inverse=True)
    number = faces.ravel()[first].astype(np.int64)
    further = np.ones(len(number), dtype=bool)
    further[np.unique(number, return_index=True)[1]] = False
    copied = number[further]
    number[further] = vertex_count + np.arange(len(copied))
    return number[fan].reshape(-1, 3), copied


def filled_euler_characteristic(faces: npt.NDArray[Any]) -> int:
    """Of the faces with a lid on every hole: 2 less 2 for each handle, if they hang together."""
    from brushfire._reeb import _connected

    edges, times = edges_of(faces)
    used, border = np.unique(edges[times == 1], return_inverse=True)
    holes = len(np.unique(_connected(len(used), border.reshape(-1, 2))))
    return len(np.unique(faces)) - len(edges) + len(faces) + holes


def split_faces(
    faces: npt.NDArray[Any], split: dict[Edge, int], way: list[int]
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[Any]]:
    """Faces with new vertices on their edges, cut so that the path runs along edges."""
    steps = {frozenset(pair) for pair in pairwise(way)}
    ends = np.array(list(split))
    touched = np.isin(faces, ends[:, 0]).any(axis=1) & np.isin(faces, ends[:, 1]).any(axis=1)
    keep = np.ones(len(faces), dtype=bool)
    new: list[list[int]] = []
    for f in np.flatnonzero(touched):
        polygon: list[int] = []
        corners = faces[f].tolist()
        for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
            polygon.append(a)
            middle = split.get((min(a, b), max(a, b)))
            if middle is not None:
                polygon.append(middle)
        if len(polygon) > 3:
            keep[f] = False
            new += _triangles(polygon, steps, set(split.values()))
    return keep, np.array(new, dtype=faces.dtype).reshape(-1, 3)


def _triangles(polygon: list[int], steps: set[frozenset[int]], added: set[int]) -> list[list[int]]:
    """Of a triangle with points on its sides: cut along the path first, then what is between two points off."""
    n = len(polygon)
    if n == 3:
        return [polygon]
    for i in range(n):
        for j in range(i + 2, n):
            if (i, j) != (0, n - 1) and frozenset((polygon[i], polygon[j])) in steps:
                rest = steps - {frozenset((polygon[i], polygon[j]))}
                return _triangles(polygon[i : j + 1], rest, added) + _triangles(
                    polygon[j:] + polygon[: i + 1], rest, added
                )
    for i in range(n):
        before, after = polygon[i - 1], polygon[(i + 1) % n]
        if polygon[i] not in added and before in added and after in added:
            return [[before, polygon[i], after], *_triangles(polygon[:i] + polygon[i + 1 :], steps, added)]
    # A fan from a point of a side: it sees all corners.
    first = next(i for i in range(n) if polygon[i] in added)
    turned = polygon[first:] + polygon[:first]
    return [[turned[0], turned[i], turned[i + 1]] for i in range(1, n - 1)]
