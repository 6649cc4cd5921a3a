"""From positions in space to points of the surface, and back."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats
from brushfire._errors import BrushfireError, BrushfireWarning
from brushfire._places import At, Places, Points, at, is_one

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


# Beyond this share of the mesh's size a position is far off its surface.
_FAR = 0.1


def position(mesh: Mesh, places: Places) -> Floats:
    """Where places are, in coordinates: (3,) for one, (k, 3) for several.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
    >>> mesh.position([1, bf.Point(0, (0, 0.5, 0.5))]).tolist()
    [[2.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
    """
    arrays = mesh._arrays(places, "places")
    xyz = mesh._mesh.positions(arrays.index, arrays.weights)
    return xyz[0] if is_one(places) else xyz


def nearest(mesh: Mesh, xyz: npt.ArrayLike, *, snap_within: float = np.inf) -> tuple[Points, Floats]:
    """The points of the surface nearest to positions in space, and how far away they are.

    :param xyz: (k, 3), or (3,) for a single one.
    :param snap_within: farther than this from the surface no position may be.
    :return: :class:`Points` and distances, (k,) each.
    :raises BrushfireError: for a mesh from lengths or without faces, for positions that are not finite, and for those
        that are farther away than ``snap_within``.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
    >>> points, distance = mesh.nearest([[0.5, 0.5, 3]])
    >>> points.face.tolist(), points.weights.tolist(), distance.tolist()
    ([0], [[0.5, 0.25, 0.25]], [3.0])
    """
    if mesh._finder is None:
        mesh._finder = _core.NearestPointFinder(mesh._mesh)
    positions = at(xyz, snap_within=snap_within)
    face, weights, distance = mesh._finder.nearest(positions.xyz)
    too_far = distance > positions.snap_within
    if too_far.any():
        bad = int(np.argmax(too_far))
        raise BrushfireError(
            f"position {bad} is {distance[bad]:.6g} from the surface, farther than snap_within={positions.snap_within:.6g}"
        )
    return Points(face, weights), distance


def snapped(mesh: Mesh, positions: At) -> Points:
    """Not without a word where that is far, for the size of the mesh."""
    points, distance = mesh.nearest(positions.xyz, snap_within=positions.snap_within)
    size = mesh._mesh.size
    if np.isinf(positions.snap_within) and distance.size and distance.max() > _FAR * size:
        far = int(np.argmax(distance))
        warnings.warn(
            f"position {far} is {distance[far]:.6g} from the surface (the mesh is {size:.6g} across): its nearest "
            "point was taken; at(..., snap_within=...) says how far is near enough",
            BrushfireWarning,
            stacklevel=4,
        )
    return points
