"""Points of a mesh as potpourri3d names them: (element, coordinates), with its numbers of edges."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from brushfire._mesh import Mesh
from brushfire._places import Point, Points
from brushfire.compat._exact import indices

Element: TypeAlias = "tuple[int, Sequence[float]]"


class Elements:
    """A vertex and [], an edge and [t], a face and [b0, b1(, b2)].

    Edges are numbered in the order in which the faces name them first; t runs along that direction.
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._faces = mesh.faces
        self._first: npt.NDArray[np.intp] | None = None  # of each edge, the halfedge that names it first
        self._edge: npt.NDArray[np.intp]  # of each halfedge

    def _number_edges(self) -> npt.NDArray[np.intp]:
        if self._first is None:
            ends = np.stack([self._faces, np.roll(self._faces, -1, axis=1)], axis=2).reshape(-1, 2)
            _, first, inverse = np.unique(np.sort(ends, axis=1), axis=0, return_index=True, return_inverse=True)
            order = np.argsort(first)
            rank = np.empty(len(order), dtype=np.intp)
            rank[order] = np.arange(len(order))
            self._first, self._edge = first[order], rank[inverse.reshape(-1)]
        return self._first

    def ends(self, halfedge: int) -> tuple[int, int]:
        face = self._faces[halfedge // 3]
        return int(face[halfedge % 3]), int(face[(halfedge + 1) % 3])

    def point(self, element: int, coordinates: Sequence[float]) -> int | Point:
        if len(coordinates) == 0:
            return int(element)
        if len(coordinates) == 1:
            return self._on_edge(int(element), float(coordinates[0]))
        b0, b1 = float(coordinates[0]), float(coordinates[1])
        return Point(int(element), (b0, b1, float(coordinates[2]) if len(coordinates) > 2 else 1 - b0 - b1))

    def points(self, curve: Sequence[Element]) -> list[int | Point]:
        return [self.point(element, coordinates) for element, coordinates in curve]

    def _on_edge(self, edge: int, t: float) -> Point:
        """The halfedge that names the edge first lies in face ``halfedge // 3``."""
        first = self._number_edges()
        halfedge = int(first[indices([edge], len(first), "edge")[0]])
        weights = [0.0, 0.0, 0.0]
        weights[halfedge % 3] = 1 - t
        weights[(halfedge + 1) % 3] = t
        return Point(halfedge // 3, (weights[0], weights[1], weights[2]))

    def names(self, points: Points) -> list[tuple[int, list[float]]]:
        """The way back: a vertex where one weight is not 0, an edge where two are, else a face."""
        first = self._number_edges()
        return [self._name(first, int(face), weights) for face, weights in zip(points.face, points.weights, strict=True)]

    def _name(self, first: npt.NDArray[np.intp], face: int, weights: npt.NDArray[Any]) -> tuple[int, list[float]]:
        inside = np.flatnonzero(weights > 0)
        if len(inside) == 1:
            return int(self._faces[face, inside[0]]), []
        if len(inside) == 3:
            return face, [float(w) for w in weights]
        corner = 2 if inside[0] == 0 and inside[1] == 2 else int(inside[0])
        edge = int(self._edge[3 * face + corner])
        along = self.ends(3 * face + corner) == self.ends(int(first[edge]))
        return edge, [float(weights[(corner + 1) % 3] if along else weights[corner])]
