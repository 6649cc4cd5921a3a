"""Weighted surfaces: what it costs to go, and the cheapest paths."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats, Labels, floats, number, radius_of, whole
from brushfire._curves import Path, path_of
from brushfire._errors import BrushfireError
from brushfire._options import Options, options, thread_count, tolerance_of
from brushfire._places import Places
from brushfire._progress import Progress, shown
from brushfire._sources import Sources, sources_of
from brushfire._weights import Slope, edges_of, grain_of, pace_of

if TYPE_CHECKING:
    from brushfire._mesh import Mesh
    from brushfire._replanner import Replanner
    from brushfire._surface import Surface

_TOLERANCE = 0.01


@dataclass(frozen=True)
class Needed:
    """What it would take until bounds are within the tolerance everywhere: an estimate, by what the last refinement brought.

    ``refinements``: how many more, for ``refine=``; None where more of them would bring the bounds no nearer. ``points``: on
    edges, in the last of them, 0 where windows answer. ``time``: of the last of them, in times of the run that is done.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> needed = mesh.weighted([1, 2], [[0, 2, float("inf"), 1]]).costs(1, tolerance=1e-4).needed
    >>> needed.refinements > 0, needed.time == 4**needed.refinements
    (True, True)
    """

    refinements: int | None
    points: int
    time: float


@dataclass(frozen=True)
class Costs:
    """What :meth:`Weighted.costs` found, (vertex_count,) or (targets,).

    ``upper``: what a real path costs, +inf where there is none. ``lower``: no path costs less, proven; None where no bounds
    were asked for. ``source``: the position in ``sources`` of where that path begins, -1 where there is none.
    ``max_error_bound``, ``mean_error_bound``: the greatest and mean (upper - lower) / lower. ``engine``: what answered,
    ``"windows"`` that refract, a search over ``"points"`` on edges, or ``"uniform"``: plain distances times the weight.
    ``needed``: where the tolerance is not met everywhere, what that would take (:class:`Needed`); else None.
    """

    upper: Floats
    lower: Floats | None
    source: Labels
    max_error_bound: float
    mean_error_bound: float
    engine: str
    needed: Needed | None = None


@dataclass(frozen=True)
class WeightedPath:
    """A cheapest path: ``path``, a :class:`Path`; its ``cost``, +inf where there is none; ``lower``: no path costs less.

    ``face``, ``leg_length``, ``weight``, ``toll`` (legs,): from each point to the next, in which face, how long, at what
    cost per unit of length, and what fences are paid for where it begins. ``edge`` (legs, 2): the vertices of the edge that
    the leg goes along, -1 where it goes through a face.
    """

    path: Path
    cost: float
    lower: float
    face: Labels
    leg_length: Floats
    weight: Floats
    toll: Floats
    edge: Labels

    @property
    def length(self) -> float:
        return self.path.length

    @property
    def positions(self) -> Floats:
        return self.path.positions

    def __repr__(self) -> str:
        return f"WeightedPath({len(self.path.points)} points, cost {self.cost:.6g}, length {self.length:.6g})"


def _refinements(refine: bool | int) -> int:
    if isinstance(refine, (bool, np.bool_)):
        return 4 if refine else 0
    return whole(refine, "refine", 30)


class Weighted:
    """A mesh and what it costs to cross its faces and edges; made by :meth:`Mesh.weighted`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.weighted([1, 3]).path(1, 3).cost > mesh.path(1, 3).length
    True
    """

    def __init__(
        self,
        mesh: Mesh,
        weights: Any,
        edge_weights: Any = None,
        slope: Slope | None = None,
        steepest: float = np.inf,
        towards: bool = False,
        grain: npt.ArrayLike | None = None,
        tacking: bool = False,
    ) -> None:
        face = None if weights is None else floats(weights, "weights")
        if face is not None and face.ndim != 1:
            raise BrushfireError(f"weights: one per face is needed, not an array of shape {face.shape}")
        self._on = mesh
        self._towards = bool(towards)
        edges = None if edge_weights is None else np.array(edge_weights)
        self._given = (None if face is None else face.copy(), edges, slope, steepest, bool(tacking), grain_of(mesh, grain))
        self._solver = _core.WeightedSolver(
            mesh._space,
            face,
            *edges_of(edge_weights),
            *pace_of(slope),
            number(steepest, "steepest"),
            bool(tacking),
            self._given[-1],
        )

    def distance(
        self,
        sources: Sources,
        *,
        tolerance: float = _TOLERANCE,
        offset: npt.ArrayLike = 0.0,
        radius: float = np.inf,
        targets: Places | None = None,
        towards: bool | None = None,
        method: str | None = None,
        progress: Progress = None,
    ) -> Floats:
        """What the cheapest path from the nearest of the sources costs: upper bounds alone, by points on edges, where
        :meth:`costs` may be quicker by windows. Arguments as there; float64 (vertex_count,) or (targets,), +inf where there is
        no path.

        :param method: ``"kimmel-sethian"``: fast marching, which promises nothing, in a twentieth of the time; weights of
            faces only.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.weighted([2, 2]).distance(1, targets=[0, 2]).round(6).tolist()
        [6.0, 8.0]
        """
        return self._solve(sources, tolerance, 0, False, towards, offset, radius, targets, progress, method).upper

    def costs(
        self,
        sources: Sources,
        *,
        tolerance: float = _TOLERANCE,
        refine: bool | int = False,
        offset: npt.ArrayLike = 0.0,
        radius: float = np.inf,
        targets: Places | None = None,
        towards: bool | None = None,
        progress: Progress = None,
    ) -> Costs:
        """What the cheapest path from the nearest of the sources costs, between proven bounds.

        :param sources, offset, radius, targets, progress: as for :meth:`Mesh.distance`.
        :param tolerance: how far apart the bounds may be, relatively; in [1e-5, 1]. A wish: ``max_error_bound`` says what
            was reached.
        :param towards: with a slope: what it costs to get to the sources, and not from them; as :meth:`Mesh.weighted` was
            told if nothing is said.
        :param refine: where the wish is not met everywhere, run again more finely until it is: so many times at most, True is
            four. Not where that many would not do: ``needed`` of the result says how many would, and what they cost.
        :return: :class:`Costs`.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> costs = mesh.weighted([1, 2]).costs(1)
        >>> bool((costs.lower <= costs.upper).all()), costs.max_error_bound < 0.02
        (True, True)
        """
        return self._solve(sources, tolerance, _refinements(refine), True, towards, offset, radius, targets, progress)

    def _solve(
        self,
        sources: Sources,
        tolerance: float,
        refinements: int,
        lower: bool,
        towards: bool | None,
        offset: npt.ArrayLike,
        radius: float,
        targets: Places | None,
        progress: Progress,
        method: str | None = None,
    ) -> Costs:
        start = sources_of(self._on, sources, offset)
        end = None if targets is None else self._on._arrays(targets, "targets")
        with shown(progress, "distance") as report:
            upper, source, below, most, mean, engine, needed = self._solver.solve(
                start,
                end.index if end else None,
                end.weights if end else None,
                number(tolerance, "tolerance"),
                refinements,
                lower,
                self._direction(towards),
                radius_of(radius),
                method or "",
                report,
            )
        more, points, time = needed
        to_meet = Needed(None if more < 0 else more, points, time) if more else None
        return Costs(upper, below, source, most, mean, engine, to_meet)

    def path(
        self,
        source: Sources,
        target: Places,
        *,
        tolerance: float = _TOLERANCE,
        towards: bool | None = None,
        radius: float = np.inf,
    ) -> WeightedPath:
        """The cheapest path from one place to another: see :meth:`paths`.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> path = mesh.weighted([1, 3]).path(1, 3)
        >>> round(path.cost, 6), path.weight.tolist(), path.face.tolist()
        (9.895461, [1.0, 3.0], [0, 1])
        """
        found, _ = self.paths(source, target, tolerance=tolerance, towards=towards, radius=radius)
        if len(found) != 1:
            raise BrushfireError("target: a single place is needed; paths() takes several")
        return found[0]

    def paths(
        self,
        sources: Sources,
        targets: Places,
        *,
        offset: npt.ArrayLike = 0.0,
        tolerance: float = _TOLERANCE,
        towards: bool | None = None,
        radius: float = np.inf,
    ) -> tuple[list[WeightedPath], Labels]:
        """The cheapest path to every target from the source that is nearest to it. They are locally shortest: where they
        cross edges they obey Snell's law to rounding.

        :return: one :class:`WeightedPath` per target, and the position in ``sources`` of each one's source, -1: none.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> paths, _ = mesh.weighted([1, 3]).paths(1, [2, 3])
        >>> [round(p.cost, 6) for p in paths]
        [4.0, 9.895461]
        """
        start, end = sources_of(self._on, sources, offset), self._on._arrays(targets, "targets")
        source, found = self._solver.paths(
            start,
            end.index,
            end.weights,
            number(tolerance, "tolerance"),
            self._direction(towards),
            radius_of(radius),
        )
        return [weighted_path(self._on, *p) for p in found], source

    def replanner(
        self,
        sources: Sources,
        *,
        offset: npt.ArrayLike = 0.0,
        tolerance: float = _TOLERANCE,
        towards: bool | None = None,
        progress: Progress = None,
    ) -> Replanner:
        """Costs that follow changes of weights, walls, fences, roads and sources: see :class:`Replanner`. Arguments as for
        :meth:`costs`.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> planner = mesh.weighted([1, 3]).replanner(1)
        >>> planner.change([1, 1])
        >>> round(planner.path(3).cost, 6)
        5.0
        """
        from brushfire._replanner import Replanner

        return Replanner(self, sources, offset, number(tolerance, "tolerance"), self._direction(towards), progress)

    def _direction(self, towards: bool | None) -> bool:
        return self._towards if towards is None else bool(towards)


def weighted_path(on: Mesh, path: _core.PathArrays, cost: float, lower: float, *legs: Any) -> WeightedPath:
    face, length, weight, toll, edge = legs
    return WeightedPath(path_of(on, path), cost, lower, face, length, weight, toll, edge.reshape(-1, 2))


Weighing: TypeAlias = "Weighted | npt.ArrayLike"
"""What going costs: :meth:`Mesh.weighted`, or one number > 0 for every face."""


def weighted_of(mesh: Mesh, weights: Weighing | None) -> Weighted | None:
    return weights if weights is None or isinstance(weights, Weighted) else Weighted(mesh, weights)


def chosen_in(
    surface: Surface,
    weights: Weighing | None,
    method: Any,
    tolerance: Any,
    radius: Any,
    bound: Any = None,
    precision: Any = None,
    threads: int = 1,
) -> tuple[_core.Space, Options]:
    """Where to compute and how: as options() says, or by the weights."""
    on: Any = surface  # a solver has a mesh
    weighted = weighted_of(getattr(on, "mesh", on), weights)
    if weighted is None:
        return surface._space, options(method, tolerance, radius, bound, precision, threads)
    if precision is not None:
        raise BrushfireError("precision: with weights it is not to be chosen")
    if method not in (None, "kimmel-sethian"):
        raise BrushfireError("method: with weights points on edges (None), or kimmel-sethian, without bounds")
    within = _TOLERANCE if tolerance is None else tolerance_of(tolerance)
    weighting = weighted._solver.weighting(within, weighted._towards, method or "")
    chosen: Options = {
        "max_distance": radius_of(radius),
        "threads": thread_count(threads),
        "weighting": weighting,
    }
    if bound is not None:
        chosen["bound"] = bound
    return weighting.domain, chosen


def weighted(
    mesh: Mesh,
    weights: npt.ArrayLike | None = None,
    edge_weights: npt.ArrayLike | Iterable[Any] | None = None,
    *,
    grain: npt.ArrayLike | None = None,
    slope: Slope | None = None,
    steepest: float = np.inf,
    towards: bool = False,
    tacking: bool = False,
) -> Weighted:
    """This mesh, with what it costs to cross its faces and edges.

    :param weights: per unit of length in each face, > 0; inf is a wall. None: 1 everywhere.
    :param edge_weights: rows of two vertices, the cost along the edge that joins them (inf: as in its faces) and, if
        wanted, the cost to cross it (inf: a wall).
    :param grain: (faces, 4): x, y, z of a direction in each face, and how many times as much as along it going across it
        costs (at an angle a: sqrt(cos² a + across² sin² a) times): any symmetric metric. Upper bounds only, then.
    :param slope: what slopes cost, up and down (z is up): ``"tobler"`` and ``"naismith"`` in seconds per metre on the
        map, ``"energy"`` in J/kg per metre; two arrays, slopes and the paces there, linear between; or a function of the
        slope, which is called for slopes from -2 to 2 and may be inf beyond what can be walked. Times the weights. Upper
        bounds only, then.
    :param steepest: with a slope: no step is steeper than this; steeper ground can still be traversed.
    :param towards: with a slope: costs are those to get to places, and not from them, where a call does not say.
    :param tacking: with a slope: steep steps cost what going there in tacks does, left and right of the straight way, where
        a gentler slope is cheaper for it. Paths keep their straight legs, which stand for these.
    :return: :class:`Weighted`, what ``weights=`` of other calls takes, and whose ``costs()``, ``distance()``, ``path()`` and
        ``paths()`` are those of the weights.
    :raises BrushfireError: for weights that are not > 0, as many as faces; for edges that do not exist.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.weighted(edge_weights=[[0, 2, 0.5]]).distance(0, targets=2).tolist()
    [2.5]
    >>> road = mesh.weighted(edge_weights=[[0, 2, 0.5]]).path(0, 2)
    >>> road.cost, road.edge.tolist()
    (2.5, [[2, 0]])
    >>> mesh.weighted(slope=lambda s: 2 + abs(s)).distance(0, targets=2).round(6).tolist()
    [10.0]
    """
    return Weighted(mesh, weights, edge_weights, slope, steepest, towards, grain, tacking)
