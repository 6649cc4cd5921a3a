"""Brushfire on PyVista's surfaces: after ``import brushfire.pyvista`` every ``pyvista.PolyData`` has a ``brushfire``.

>>> import pyvista, brushfire.pyvista  # doctest: +SKIP
>>> surface = pyvista.Sphere()  # doctest: +SKIP
>>> surface.brushfire.distance(0).plot(scalars="distance")  # doctest: +SKIP
>>> surface.brushfire.path(0, 400)["distance"].max()  # doctest: +SKIP
0.97

As PyVista's own filters do, each returns a new data set and leaves the surface as it is. What is not here is on
``surface.brushfire.mesh``, a :class:`brushfire.Mesh` whose vertices are the surface's points.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt
import pyvista

from brushfire._any import from_any
from brushfire._arrays import Floats
from brushfire._curves import Path
from brushfire._mesh import Mesh
from brushfire._places import Places
from brushfire._sources import Sources

__all__ = ["Accessor", "lines"]


class Accessor:
    """``surface.brushfire``: distances, paths, isolines and cells of one surface of triangles."""

    def __init__(self, surface: pyvista.PolyData) -> None:
        self._surface = surface
        self._made: tuple[int, Mesh] | None = None

    @property
    def mesh(self) -> Mesh:
        """The surface as a :class:`brushfire.Mesh`; made once, and anew after points or faces were changed.

        :raises BrushfireError: for a surface with other polygons than triangles: ``surface.triangulate()`` has none.
        """
        points, polygons = self._surface.GetPoints(), self._surface.GetPolys()
        changed = max(thing.GetMTime() for thing in (self._surface, points, polygons) if thing is not None)
        if self._made is None or self._made[0] != changed:
            self._made = changed, from_any(self._surface)
        return self._made[1]

    def distance(self, sources: Sources, *, name: str = "distance", **options: Any) -> pyvista.PolyData:
        """The surface with its distance from the sources, as point data; +inf where nothing leads.

        :param sources, options: as for :meth:`brushfire.Mesh.distance`.
        :param name: of the point data.
        """
        return self._with(**{name: self.mesh.distance(sources, **options)})

    def path(self, start: Places, end: Places) -> pyvista.PolyData:
        """The shortest path as a line, with the way from its start as point data ``distance``.

        :param start, end: as for :meth:`brushfire.Mesh.path`. Where there is no path the line is empty.
        """
        path = self.mesh.path(start, end)
        line = lines([path])
        line["distance"] = _lengths_along(path.positions)
        return line

    def isolines(self, sources: Sources, *, name: str = "distance", **options: Any) -> pyvista.PolyData:
        """Curves at equal distance from the sources, arcs drawn as arcs, with their distance as point and cell data.

        :param sources, options: as for :meth:`brushfire.Mesh.curved_isolines`: ``levels``, ``every=`` or ``count=``.
        """
        found = self.mesh.curved_isolines(sources, **options)
        drawn = lines([isoline.line for isoline in found])
        levels = np.array([isoline.level for isoline in found])
        drawn.cell_data[name] = levels
        drawn.point_data[name] = np.repeat(levels, [len(isoline.line.positions) for isoline in found])
        return drawn

    def voronoi(self, sources: Sources, **options: Any) -> tuple[pyvista.PolyData, pyvista.PolyData]:
        """The surface with ``source``, which of them is nearest (-1: none), and ``distance``; and the borders as lines.

        :param sources, options: as for :meth:`brushfire.Mesh.voronoi`.
        """
        cells = self.mesh.voronoi(sources, **options)
        borders = lines([border.line for border in cells.borders])
        borders.cell_data["sources"] = np.array([border.sources for border in cells.borders]).reshape(-1, 2)
        return self._with(distance=cells.distance, source=cells.source), borders

    def _with(self, **fields: npt.NDArray[Any]) -> pyvista.PolyData:
        result = self._surface.copy()
        for name, values in fields.items():
            result.point_data[name] = values
        return result


def lines(paths: Iterable[Path]) -> pyvista.PolyData:
    """Paths of Brushfire as one PolyData: a polyline each, closed ones ending where they began.

    >>> import brushfire.pyvista  # doctest: +SKIP
    >>> brushfire.pyvista.lines([mesh.path(0, 600)]).plot()  # doctest: +SKIP
    """
    points: list[Floats] = []
    cells: list[int] = []
    first = 0
    for path in paths:
        count = len(path.positions)
        if count == 0:
            continue
        points.append(path.positions)
        cells += [count + path.closed, *range(first, first + count), *([first] if path.closed else [])]
        first += count
    if not points:
        return pyvista.PolyData()
    return pyvista.PolyData(np.concatenate(points), lines=np.array(cells))


def _lengths_along(positions: Floats) -> Floats:
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    return np.concatenate([np.zeros(min(1, len(positions))), np.cumsum(steps)])


def _register() -> None:
    if hasattr(pyvista, "register_dataset_accessor"):  # since 0.48
        pyvista.register_dataset_accessor("brushfire", pyvista.PolyData)(Accessor)
    else:
        pyvista.PolyData.brushfire = property(Accessor)


_register()
