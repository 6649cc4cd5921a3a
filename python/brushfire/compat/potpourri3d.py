"""The distance classes and functions of potpourri3d, computed exactly.

Different from the original: the heat method smooths, is several per cent wrong on coarse meshes and shifts multi-source
fields; here every one of these calls gives the exact polyhedral distance. ``t_coef`` and ``use_robust`` are taken and
have nothing to control. Fast marching from a point inside a face starts with wrong distances to the corners in the
original (version 1.4.0), unless the triangle has a right angle; here with the straight ones. Other components read +inf. ``sign=True`` is not offered.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire._io import read
from brushfire._mesh import Mesh, Solver
from brushfire._places import Point
from brushfire.compat._exact import METHOD, indices

__all__ = [
    "MeshFastMarchingDistanceSolver",
    "MeshHeatMethodDistanceSolver",
    "compute_distance",
    "compute_distance_multisource",
    "read_mesh",
]


class MeshHeatMethodDistanceSolver:
    """Distances from vertices, again and again on one mesh.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> solver = pp3d.MeshHeatMethodDistanceSolver([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> solver.compute_distance(1).tolist()
    [3.0, 0.0, 4.0, 5.0]
    >>> solver.compute_distance_multisource([1, 2]).tolist()
    [3.0, 0.0, 0.0, 3.0]
    """

    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0, use_robust: bool = True) -> None:
        self._solver = Solver(Mesh(V, F))

    def compute_distance(self, v_ind: int) -> Floats:
        return self._solver.distance(int(v_ind), method=METHOD)

    def compute_distance_multisource(self, v_inds: npt.ArrayLike) -> Floats:
        sources = indices(v_inds, self._solver.mesh.vertex_count, "v_inds")
        return self._solver.distance(sources, method=METHOD)


def compute_distance(V: npt.ArrayLike, F: npt.ArrayLike, v_ind: int) -> Floats:
    """Distances from one vertex."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance(v_ind)


def compute_distance_multisource(V: npt.ArrayLike, F: npt.ArrayLike, v_inds: npt.ArrayLike) -> Floats:
    """Distances from the nearest of several vertices."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance_multisource(v_inds)


class MeshFastMarchingDistanceSolver:
    """Distances from points given as (element, coordinates): a vertex and [], an edge and [t], a face and [b0, b1(, b2)].

    Edges are numbered as in the original, in the order in which the faces name them first; t runs along that direction.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> solver = pp3d.MeshFastMarchingDistanceSolver([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> solver.compute_distance([[(1, [0.5])]]).round(3).tolist()
    [3.606, 2.0, 2.0, 3.606]
    """

    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike) -> None:
        self._solver = Solver(Mesh(V, F))
        self._edges: npt.NDArray[np.intp] | None = None  # of each edge, the halfedge that names it first

    def compute_distance(
        self,
        curves: Sequence[Sequence[tuple[int, Sequence[float]]]],
        distances: Sequence[Sequence[float]] = (),
        sign: bool = False,
    ) -> Floats:
        """Distances from all points of all curves; ``distances`` are the values that the points start with."""
        if sign:
            raise BrushfireError("sign=True: signed distances are not offered")
        points = [self._point(element, coordinates) for curve in curves for element, coordinates in curve]
        offsets = np.array([value for curve in distances for value in curve], dtype=np.float64)
        return self._solver.distance(points, offset=offsets if len(offsets) else 0.0, method=METHOD)

    def _point(self, element: int, coordinates: Sequence[float]) -> int | Point:
        if len(coordinates) == 0:
            return int(element)
        if len(coordinates) == 1:
            return self._on_edge(int(element), float(coordinates[0]))
        b0, b1 = float(coordinates[0]), float(coordinates[1])
        return Point(int(element), (b0, b1, float(coordinates[2]) if len(coordinates) > 2 else 1 - b0 - b1))

    def _on_edge(self, edge: int, t: float) -> Point:
        """The halfedge that names the edge first lies in face ``halfedge // 3``."""
        faces = self._solver.mesh.faces
        if self._edges is None:
            ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
            _, first = np.unique(np.sort(ends, axis=1), axis=0, return_index=True)
            self._edges = np.sort(first)
        halfedge = int(self._edges[indices([edge], len(self._edges), "edge")[0]])
        weights = [0.0, 0.0, 0.0]
        weights[halfedge % 3] = 1 - t
        weights[(halfedge + 1) % 3] = t
        return Point(halfedge // 3, (weights[0], weights[1], weights[2]))


def read_mesh(filename: str | os.PathLike[str]) -> tuple[Floats, npt.NDArray[np.int64]]:
    """Vertices and faces of a file, in arrays that may be written to: float64 and int64."""
    mesh = read(filename)
    return mesh.vertices.copy(), mesh.faces.astype(np.int64)
