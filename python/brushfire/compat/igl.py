"""igl.exact_geodesic, with sources and targets at vertices and at the centres of faces.

Different from the original: targets that cannot be reached read +inf (the original gives 0 or ends the process), and an
index that does not exist is an IndexError.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._mesh import Mesh
from brushfire._places import PlaceArrays
from brushfire.compat._exact import METHOD, indices

__all__ = ["exact_geodesic"]


def _places(mesh: Mesh, vertices: npt.ArrayLike, faces: npt.ArrayLike, what: str) -> PlaceArrays:
    """Vertices, then the centres of faces."""
    v = indices(vertices, mesh.vertex_count, f"V{what}")
    f = indices(faces, mesh.face_count, f"F{what}")
    weights = np.concatenate([np.zeros((len(v), 3)), np.full((len(f), 3), 1 / 3)])
    return PlaceArrays(np.concatenate([v, f]), weights)


def exact_geodesic(
    V: npt.ArrayLike,
    F: npt.ArrayLike,
    VS: npt.ArrayLike = (),
    FS: npt.ArrayLike = (),
    VT: npt.ArrayLike = (),
    FT: npt.ArrayLike = (),
) -> Floats:
    """Distances from the nearest source to the target vertices, then to the target faces' centres.

    :param VS: source vertices. :param FS: source faces. :param VT: target vertices. :param FT: target faces.
    :return: (len(VT) + len(FT),).

    >>> from brushfire.compat import igl
    >>> V = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]]
    >>> igl.exact_geodesic(V, [[0, 1, 2], [0, 2, 3]], VS=[1], VT=[3, 2]).tolist()
    [5.0, 4.0]
    """
    mesh = Mesh(V, F)
    return mesh.distance(_places(mesh, VS, FS, "S"), targets=_places(mesh, VT, FT, "T"), method=METHOD)
