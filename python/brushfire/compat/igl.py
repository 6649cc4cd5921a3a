"""igl.exact_geodesic, with sources and targets at vertices and at the centres of faces; and igl's heat geodesics.

Different from the original, on purpose: every source of the heat method reads 0, other components +inf, and any mesh is
taken; masses are thirds of the areas around a vertex, the original's Voronoi areas (some tenths of a per cent in the field). Of exact geodesics, targets that cannot be reached read +inf (the original gives 0 or ends the
process), an index that does not exist is an IndexError, and the order of the arguments before libigl 2.6 is understood.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire._heat import HeatSolver
from brushfire._mesh import Mesh
from brushfire._places import PlaceArrays
from brushfire.compat._exact import METHOD, indices

__all__ = ["HeatGeodesicsData", "exact_geodesic", "heat_geodesics_precompute", "heat_geodesics_solve"]


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


class HeatGeodesicsData:
    """What :func:`heat_geodesics_precompute` fills."""

    def __init__(self) -> None:
        self.use_intrinsic_delaunay = False
        self._solver: HeatSolver | None = None


def heat_geodesics_precompute(
    V: npt.ArrayLike,
    F: npt.ArrayLike,
    *rest: float | HeatGeodesicsData,
    t: float | None = None,
    data: HeatGeodesicsData | None = None,
) -> None:
    """Factors the heat method's two systems: ``heat_geodesics_precompute(V, F, t, data)``, or without t; both by name, too.

    :param t: for how long heat spreads; the mean edge length squared where nothing is said.
    :param data: is filled. Its ``use_intrinsic_delaunay`` counts as in the original, where it is False.

    Borders: the mean of free and cold ones, as in the original.

    >>> from brushfire.compat import igl
    >>> V, F = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> data = igl.HeatGeodesicsData()
    >>> igl.heat_geodesics_precompute(V, F, data)
    >>> igl.heat_geodesics_solve(data, [1]).shape
    (4,)
    """
    times = [value for value in rest if not isinstance(value, HeatGeodesicsData)] + ([] if t is None else [t])
    filled = [value for value in rest if isinstance(value, HeatGeodesicsData)] + ([] if data is None else [data])
    if len(times) > 1 or len(filled) != 1:
        raise TypeError("heat_geodesics_precompute: it takes V, F, t and data, or V, F and data")
    time, delaunay = (float(times[0]) if times else None), bool(filled[0].use_intrinsic_delaunay)
    filled[0]._solver = HeatSolver(Mesh(V, F), time=time, boundary="averaged", delaunay=delaunay)


def heat_geodesics_solve(data: HeatGeodesicsData, gamma: npt.ArrayLike) -> Floats:
    """Distances from the nearest of the vertices ``gamma``, (vertices,)."""
    if data._solver is None:
        raise BrushfireError("heat_geodesics_solve: data comes out of heat_geodesics_precompute")
    return data._solver.distance(indices(gamma, data._solver.mesh.vertex_count, "gamma"))
