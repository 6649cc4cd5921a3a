"""Isochrones: what can be reached within a cost, as polygons on the map."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import floats

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


def isochrones(mesh: Mesh, values: npt.ArrayLike, levels: npt.ArrayLike) -> dict[str, Any]:
    """Where the values are below each level, as polygons on the map: a GeoJSON FeatureCollection of MultiPolygons.

    :param values: one per vertex, +inf where there is none, (vertex_count,): what it takes to get there.
    :param levels: (k,); each one's polygons have it as their property ``level``.
    :return: what ``json.dump`` writes; in the mesh's x and y, up to its walls. For terrain: no two faces over one another.

    >>> import brushfire as bf
    >>> ground = bf.terrain([[0, 0], [0, 0]])
    >>> region = ground.mesh.isochrones([0, 1, 0, 1], [0.5])["features"][0]
    >>> region["properties"], region["geometry"]["type"]
    ({'level': 0.5}, 'MultiPolygon')
    """
    field = floats(values, "values").ravel()
    found: dict[str, Any] = json.loads(_core.isochrones(mesh._space, field, np.atleast_1d(floats(levels, "levels"))))
    return found
