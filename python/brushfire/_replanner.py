"""Costs that follow changes, without starting anew."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats, Labels
from brushfire._errors import BrushfireError
from brushfire._places import Places
from brushfire._progress import Progress, shown
from brushfire._sources import Sources, sources_of
from brushfire._weighted import Weighted, WeightedPath, weighted_path


class Replanner:
    """What it costs to get from (or ``towards``) sources, for weights and sources that change; made by
    :meth:`Weighted.replanner`.

    A change costs what it changes: what hangs on a step that has become dearer is forgotten and searched again from
    around, what has become cheaper is offered again. Costs are upper bounds, to the bit those of :meth:`Weighted.distance`
    from nothing. Let the sources be what stays (the goal, with ``towards=True``), and read paths off where one is.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> planner = mesh.weighted([2, 2]).replanner(0)
    >>> planner.change([2, float("inf")])  # a wall
    >>> planner.distance.round(6).tolist()
    [0.0, 6.0, 10.0, inf]
    """

    def __init__(
        self,
        weighted: Weighted,
        sources: Sources,
        offset: npt.ArrayLike,
        tolerance: float,
        towards: bool,
        progress: Progress,
    ) -> None:
        self._weighted = weighted
        self._mesh = weighted._on
        start = sources_of(self._mesh, sources, offset)
        with shown(progress, "distance") as report:
            self._core = _core.Replanner(weighted._solver, start, tolerance, towards, report)

    def __repr__(self) -> str:
        return f"Replanner({self._mesh!r})"

    @property
    def distance(self) -> Floats:
        """What the cheapest path costs: upper bounds, +inf where there is none, float64 (vertex_count,)."""
        return self._core.distance()

    @property
    def source(self) -> Labels:
        """The position in ``sources`` of where that path begins, -1 where there is none, (vertex_count,)."""
        return self._core.source()

    @property
    def renewed(self) -> float:
        """The share of the points on edges that the last change made anew; 1 at first."""
        return self._core.renewed

    def change(
        self, weights: Any = None, edge_weights: Any = None, *, grain: Any = None, progress: Progress = None
    ) -> None:
        """Other weights: None leaves those of faces, of edges, or the grain, as they are; ``edge_weights=[]`` takes the latter away.

        :param weights, edge_weights, grain: as for :meth:`Mesh.weighted`. Slopes cost what they did.
        :raises BrushfireError: as there; all is as it was then.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> planner = mesh.weighted([2, 2]).replanner(0)
        >>> planner.change(edge_weights=[[0, 2, 1]])  # a road
        >>> float(planner.distance[2]), planner.renewed < 1
        (5.0, True)
        """
        faces, edges, slope, steepest, tacking, old_grain = self._weighted._given
        faces = faces if weights is None else weights
        edges = edges if edge_weights is None else edge_weights
        if grain is None and old_grain is not None:
            grain = old_grain.reshape(-1, 4)
        weighted = Weighted(self._mesh, faces, edges, slope, steepest, self._weighted._towards, grain, tacking)
        with shown(progress, "distance") as report:
            self._core.change(weighted._solver, report)
        self._weighted = weighted

    def move(self, sources: Sources, *, offset: npt.ArrayLike = 0.0, progress: Progress = None) -> None:
        """Other sources. What is beside the only one changes everything, and takes a run.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> planner = mesh.weighted([2, 3]).replanner([0, 1])
        >>> planner.move([0, 2])
        >>> planner.source.tolist()
        [0, 0, 1, 1]
        """
        start = sources_of(self._mesh, sources, offset)
        with shown(progress, "distance") as report:
            self._core.move(start, report)

    def path(self, target: Places) -> WeightedPath:
        """The cheapest path to one place (from there, where the sources are what one goes to): see :meth:`paths`.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.weighted([2, 3]).replanner(0).path(1).cost
        6.0
        """
        found, _ = self.paths(target)
        if len(found) != 1:
            raise BrushfireError("target: a single place is needed; paths() takes several")
        return found[0]

    def paths(self, targets: Places) -> tuple[list[WeightedPath], Labels]:
        """The cheapest paths, as of :meth:`Weighted.paths`, without another search; their ``lower`` is 0.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> paths, source = mesh.weighted([2, 3]).replanner(0).paths([1, 2])
        >>> [round(p.cost, 6) for p in paths], source.tolist()
        ([6.0, 10.0], [0, 0])
        """
        end = self._mesh._arrays(targets, "targets")
        source, found = self._core.paths(end.index, end.weights)
        return [weighted_path(self._mesh, *p) for p in found], source
