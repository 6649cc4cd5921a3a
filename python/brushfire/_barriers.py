"""Walls in a mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Ints
from brushfire._errors import BrushfireError
from brushfire._regions import barriers, with_walls_of

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


def walled(
    mesh: Mesh,
    *,
    mask: npt.ArrayLike | None = None,
    vertices: npt.ArrayLike = (),
    faces: npt.ArrayLike = (),
    edges: npt.ArrayLike = (),
) -> Mesh:
    """The same mesh with walls in it: the same vertices and faces, through which no distance and no path goes.

    :param mask: one bool per vertex: open are the faces whose three vertices are.
    :param vertices: numbers, or a mask with one bool per vertex: nothing passes them, all their faces are blocked.
    :param faces: numbers, or a mask with one bool per face: nothing enters them.
    :param edges: (k, 2) vertex numbers: both sides can be reached, nothing crosses.
    :return: a mesh whose every method keeps to what is open, in the numbers of this one. What lies behind a wall reads
        +inf; a vertex on a wall has the least distance of its sides.
    :raises BrushfireError: for arrays of another shape, and two vertices that no edge joins.
    :raises BrushfireIndexError: for what does not exist.

    Walls add to those that are there. A wall is tight, also where blocked faces touch at a vertex only.
    :meth:`cut` gives the open part as a mesh of its own.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> walled = mesh.walled(edges=[(0, 2)])
    >>> mesh.distance(1, method="exact").tolist(), walled.distance(1, method="exact").tolist()
    ([3.0, 0.0, 4.0, 5.0], [3.0, 0.0, 4.0, inf])
    >>> walled
    Mesh(4 vertices, 2 faces, walls)
    """
    blocked = barriers(mesh, vertices, faces, edges)
    if mask is not None:
        closed = _closed_faces(mesh, mask)
        blocked = blocked[0], np.concatenate([blocked[1], closed]), blocked[2]
    blocked = with_walls_of(mesh, blocked)
    walled = mesh._of(mesh._mesh)
    walled._walls, walled._domain = blocked, _core.make_domain(mesh._mesh, *blocked)
    return walled


def masked(mesh: Mesh, open_vertices: npt.ArrayLike) -> Mesh:
    """:meth:`walled` by a mask: only the faces whose three vertices are all open.

    :param open_vertices: one bool per vertex. Closed vertices, and those left without a face, read +inf.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.masked([True, True, True, False]).distance(0, method="exact").tolist()
    [0.0, 3.0, 5.0, inf]
    """
    return mesh.walled(faces=_closed_faces(mesh, open_vertices))


def _closed_faces(mesh: Mesh, open_vertices: npt.ArrayLike) -> Ints:
    mask = np.asarray(open_vertices)
    if mask.dtype != np.bool_ or mask.shape != (mesh.vertex_count,):
        raise BrushfireError(f"open_vertices: one bool per vertex is needed, not {mask.dtype} of shape {mask.shape}")
    closed = ~mask[mesh.faces].all(axis=1) if mesh.face_count else np.zeros(0, dtype=bool)
    return np.flatnonzero(closed).astype(np.int64)
