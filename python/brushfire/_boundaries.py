"""Curves along edges, around holes and regions, and out of space onto the surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Labels
from brushfire._curves import Path, path_of
from brushfire._errors import BrushfireError, BrushfireIndexError
from brushfire._places import Points
from brushfire._sources import Curve

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


@dataclass(frozen=True)
class Boundary:
    """A curve along edges of one face: ``vertices`` (k,) in order, ``length``, and whether it is ``closed`` (the last
    vertex is joined to the first, which is not repeated)."""

    vertices: Labels
    length: float
    closed: bool

    def __repr__(self) -> str:
        return f"Boundary({len(self.vertices)} vertices, length {self.length:.6g}{', closed' if self.closed else ''})"


def boundaries(mesh: Mesh) -> list[Boundary]:
    """The boundary of the mesh as curves, longest first.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.boundaries()
    [Boundary(4 vertices, length 14, closed)]
    """
    return [Boundary(*curve) for curve in _core.boundaries(mesh._mesh)]


def curve_along(mesh: Mesh, vertices: npt.ArrayLike, *, closed: bool = False) -> Path:
    """The curve along edges through these vertices, each joined to the next by an edge.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.curve_along([0, 1, 2], closed=True).length
    12.0
    """
    chain = _arrays.integers(vertices, "vertices").reshape(-1)
    return path_of(mesh, _core.curve_along(mesh._mesh, chain, bool(closed)))


def project_curve(mesh: Mesh, xyz: npt.ArrayLike, *, closed: bool = False) -> tuple[Path, float]:
    """A polyline in space put onto the surface: nearest points, and shortest paths between them.

    :param xyz: (k, 3).
    :return: the curve, and how far the polyline is from the surface at most.
    :raises BrushfireError: for places between which no way leads.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> curve, gap = mesh.project_curve([[0, 0, 1], [3, 0, 2]])
    >>> round(curve.length, 9), gap
    (3.0, 2.0)
    """
    path, gap, _ = _core.project_curve(mesh._space, _arrays.triples(xyz, "xyz"), bool(closed))
    return path_of(mesh, path), gap


def region(mesh: Mesh, *, vertices: npt.ArrayLike | None = None, faces: npt.ArrayLike | None = None) -> Curve:
    """A region as a source: distances are 0 everywhere in it, and outside from its border on.

    :param vertices: numbers, or a mask with one bool per vertex (``labels == 3``): these, and the edges and faces
        between them; or
    :param faces: numbers, or a mask with one bool per face.
    :raises BrushfireError: for an empty region.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.distance(mesh.region(vertices=[0, 1])).round(9).tolist()
    [0.0, 0.0, 4.0, 4.0]
    >>> mesh.distance(mesh.region(faces=[0])).round(9).tolist()
    [0.0, 0.0, 0.0, 2.4]
    """
    if (vertices is None) == (faces is None):
        raise BrushfireError("region: one of vertices and faces is needed")
    if faces is not None:
        face, weights, starts, within = _core.region_of_faces(
            mesh._mesh, _arrays.numbers(faces, mesh._mesh.face_count, "faces")
        )
    else:
        inside = np.zeros(mesh._mesh.vertex_count, dtype=np.uint8)
        chosen = _arrays.numbers(vertices, mesh._mesh.vertex_count, "vertices")
        if chosen.size and (chosen.min() < 0 or chosen.max() >= len(inside)):
            bad = chosen[(chosen < 0) | (chosen >= len(inside))][0]
            raise BrushfireIndexError(f"vertices: there is no vertex {bad}, the mesh has {len(inside)}")
        inside[chosen] = 1
        face, weights, starts, within = _core.region_of_vertices(mesh._mesh, inside)
    return Curve(Points(face, weights), starts=starts, inside=within)
