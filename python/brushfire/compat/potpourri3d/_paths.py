"""Shortest and straightest curves, and curves of equal value."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, floats
from brushfire._curves import Path
from brushfire._errors import BrushfireError
from brushfire._mesh import Mesh
from brushfire._places import Point, Points
from brushfire.compat._exact import indices
from brushfire.compat.potpourri3d._elements import Elements


class EdgeFlipGeodesicSolver:
    """Paths and loops along edges, pulled straight: (points, 3) positions.

    ``max_iterations`` and ``max_relative_length_decrease`` are taken; shortening goes on to the end. Every call ends.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> solver = pp3d.EdgeFlipGeodesicSolver([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> solver.find_geodesic_path(1, 3).tolist()
    [[3.0, 0.0, 0.0], [1.5, 2.0, 0.0], [0.0, 4.0, 0.0]]
    """

    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0) -> None:
        self._solver = Mesh(V, F).solver()

    def find_geodesic_path(
        self,
        v_start: int,
        v_end: int,
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> Floats:
        """Between two vertices, from the shortest path along edges."""
        return self._shortened([v_start, v_end], closed=False)

    def find_geodesic_path_poly(
        self,
        v_list: Sequence[int],
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> Floats:
        """The same from the first vertex to the last, from the way along edges by way of the others."""
        return self._shortened(v_list, closed=False)

    def find_geodesic_loop(
        self,
        v_list: Sequence[int],
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> Floats:
        """The same for the closed way, whose first point is repeated at the end; a single point where it can be pulled
        together."""
        return self._shortened(v_list, closed=True)

    def _shortened(self, vertices: Any, *, closed: bool) -> Floats:
        mesh = self._solver.mesh
        stops = indices(vertices, mesh.vertex_count, "v_list").tolist()
        if len(stops) < 2:
            raise BrushfireError("two vertices are needed at least")
        legs = [self._leg(a, b) for a, b in zip(stops, [*stops[1:], *([stops[0]] if closed else [])], strict=False)]
        face = np.concatenate([leg.points.face[:-1] for leg in legs] + ([] if closed else [legs[-1].points.face[-1:]]))
        weights = np.concatenate(
            [leg.points.weights[:-1] for leg in legs] + ([] if closed else [legs[-1].points.weights[-1:]])
        )
        positions = mesh.shorten(Points(face, weights), closed=closed).positions
        return np.vstack([positions, positions[:1]]) if closed else positions

    def _leg(self, a: int, b: int) -> Path:
        if a == b:
            raise BrushfireError(f"two consecutive vertices are the same: {a}")
        leg = self._solver.edge_path(a, b)
        if not len(leg.points):
            raise BrushfireError(f"no way leads from vertex {a} to vertex {b}")
        return leg


class GeodesicTracer:
    """Straight on from a vertex or a point of a face, as far as the direction is long: (points, 3) positions.

    Directions are projected onto the tangent plane, of a vertex that of the mean of its faces' normals by their angles.
    ``max_iterations``: so many pieces follow the first one at most.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> tracer = pp3d.GeodesicTracer([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> tracer.trace_geodesic_from_face(0, [0.5, 0.25, 0.25], [-1, 1, 5]).round(6).tolist()
    [[1.5, 1.0, 0.0], [1.071429, 1.428571, 0.0], [0.5, 2.0, 0.0]]
    """

    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0) -> None:
        self._mesh = Mesh(V, F)
        self._vertices, self._faces = self._mesh.vertices, self._mesh.faces

    def trace_geodesic_from_vertex(
        self, start_vert: int, direction_xyz: npt.ArrayLike, max_iterations: int | None = None
    ) -> Floats:
        [vertex] = indices([start_vert], self._mesh.vertex_count, "start_vert").tolist()
        normal = np.zeros(3)
        for face in self._faces[(self._faces == vertex).any(axis=1)]:
            corner = int(np.argmax(face == vertex))
            a, b = (self._vertices[face[(corner + k) % 3]] - self._vertices[vertex] for k in (1, 2))
            cross = np.cross(a, b)
            size = np.linalg.norm(cross)
            if size > 0:
                normal += np.arctan2(size, a @ b) * cross / size
        return self._trace(vertex, normal, direction_xyz, max_iterations)

    def trace_geodesic_from_face(
        self, start_face: int, bary_coords: npt.ArrayLike, direction_xyz: npt.ArrayLike, max_iterations: int | None = None
    ) -> Floats:
        [face] = indices([start_face], self._mesh.face_count, "start_face").tolist()
        a, b, c = floats(bary_coords, "bary_coords").tolist()
        corners = self._vertices[self._faces[face]]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        return self._trace(Point(face, (a, b, c)), normal, direction_xyz, max_iterations)

    def _trace(self, start: Any, normal: Floats, direction: npt.ArrayLike, most: int | None) -> Floats:
        along = floats(direction, "direction_xyz").copy()
        size = normal @ normal
        if size > 0:
            along -= (along @ normal / size) * normal
        length = float(np.linalg.norm(along))
        if length == 0:
            return self._mesh.position([start])
        path, _ = self._mesh.trace(start, along, length)
        return path.positions if most is None else path.positions[: most + 2]


class MeshMarchingTrianglesSolver:
    """Curves of equal value as lists of (element, coordinates): a vertex and [], an edge and [t].

    Smaller values lie on the left; a closed curve repeats its first point.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> V, F = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> pp3d.marching_triangles(V, F, [0, 2, 2, 0], 0.5)
    [[(0, [0.25]), (2, [0.75]), (3, [0.75])]]
    """

    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike) -> None:
        self._mesh = Mesh(V, F)
        self._elements = Elements(self._mesh)

    def marching_triangles(self, u: npt.ArrayLike, isoval: float = 0.0) -> list[list[tuple[int, list[float]]]]:
        curves = []
        for line in self._mesh.isolines(np.asarray(u, dtype=np.float64).reshape(-1), [float(isoval)]):
            names = self._elements.names(line.line.points)
            curves.append([*names, names[0]] if line.line.closed else names)
        return curves


def marching_triangles(
    V: npt.ArrayLike, F: npt.ArrayLike, u: npt.ArrayLike, isoval: float = 0.0
) -> list[list[tuple[int, list[float]]]]:
    """The curves of one mesh and field: see :class:`MeshMarchingTrianglesSolver`."""
    return MeshMarchingTrianglesSolver(V, F).marching_triangles(u, isoval)
