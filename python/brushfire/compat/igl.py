"""igl.exact_geodesic, with sources and targets at vertices and at the centres of faces.

Different from the original, on purpose: targets that cannot be reached read +inf (the original gives 0 or ends the
process), an index that does not exist is an IndexError, and the order of the arguments before libigl 2.6 is understood.
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


def exact_geodesic(V: npt.ArrayLike, F: npt.ArrayLike, *places: npt.ArrayLike, **named: npt.ArrayLike) -> Floats:
    """Distances from the nearest source to the target vertices, then to the target faces' centres.

    ``exact_geodesic(V, F, VS, FS, VT, FT)``, any of the last four by name or left out:

    :param VS: source vertices. :param FS: source faces. :param VT: target vertices. :param FT: target faces.
    :return: (len(VT) + len(FT),).

    Before libigl 2.6 the order was ``exact_geodesic(v, f, vs, vt, fs, ft)``. It is meant where a name is written small, and
    where the call has four arrays in order and no more: in the order of today that would be a call without targets. Five
    or six arrays in order are in that of today.

    >>> from brushfire.compat import igl
    >>> V, F = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> igl.exact_geodesic(V, F, VS=[1], VT=[3, 2]).tolist()
    [5.0, 4.0]
    >>> igl.exact_geodesic(V, F, [1], [3, 2]).tolist()
    [5.0, 4.0]
    """
    given = _by_name(places, named)
    mesh = Mesh(V, F)
    targets = _places(mesh, given["VT"], given["FT"], "T")
    return mesh.distance(_places(mesh, given["VS"], given["FS"], "S"), targets=targets, method=METHOD)


_TODAY = ("VS", "FS", "VT", "FT")
_BEFORE = ("vs", "vt", "fs", "ft")


def _by_name(places: tuple[npt.ArrayLike, ...], named: dict[str, npt.ArrayLike]) -> dict[str, npt.ArrayLike]:
    unknown = sorted(set(named) - set(_TODAY) - set(_BEFORE))
    if unknown:
        raise TypeError(f"exact_geodesic: there is no argument {unknown[0]!r}: it takes V, F, VS, FS, VT, FT")
    was = any(name in _BEFORE for name in named) or len(places) == 2 and not named
    if was and any(name in _TODAY for name in named):
        raise TypeError("exact_geodesic: names of today (VS, VT, ...) and of before (vs, vt, ...) in one call")
    order = _BEFORE if was else _TODAY
    if len(places) > len(order):
        raise TypeError(f"exact_geodesic: {2 + len(places)} arrays were given, it takes V, F, VS, FS, VT, FT")
    given: dict[str, npt.ArrayLike] = dict.fromkeys(_TODAY, ())
    for name, place in [*zip(order, places, strict=False), *named.items()]:
        if name in order[: len(places)] and name in named:
            raise TypeError(f"exact_geodesic: {name} was given twice")
        given[name.upper()] = () if place is None else place
    return given
