"""The distance() of meshes and solvers: one set of arguments, one docstring."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypedDict, overload

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats, Labels
from brushfire._errors import BrushfireError
from brushfire._options import Tolerance, options
from brushfire._places import Places
from brushfire._progress import Progress, shown
from brushfire._sources import Sources, sources_of
from brushfire._surface import Surface
from brushfire._weighted import Weighing, chosen_in

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from brushfire._mesh import Mesh


class _How(TypedDict, total=False):
    """The arguments that say how, which the result's type does not depend on."""

    method: str | None
    tolerance: Tolerance | None
    bound: str | None
    precision: str | None
    threads: int
    offset: npt.ArrayLike
    radius: float
    weights: Weighing | None
    targets: Places | None
    progress: Progress


@overload
def distance(
    mesh: Surface,
    sources: Sources,
    *,
    return_source: Literal[False] = ...,
    return_bound: Literal[False] = ...,
    **how: Unpack[_How],
) -> Floats: ...
@overload
def distance(
    mesh: Surface,
    sources: Sources,
    *,
    return_source: Literal[True],
    return_bound: Literal[False] = ...,
    **how: Unpack[_How],
) -> tuple[Floats, Labels]: ...
@overload
def distance(
    mesh: Surface,
    sources: Sources,
    *,
    return_source: Literal[False] = ...,
    return_bound: Literal[True],
    **how: Unpack[_How],
) -> tuple[Floats, Floats]: ...
@overload
def distance(
    mesh: Surface,
    sources: Sources,
    *,
    return_source: Literal[True],
    return_bound: Literal[True],
    **how: Unpack[_How],
) -> tuple[Floats, Labels, Floats]: ...
def distance(
    mesh: Surface,
    sources: Sources,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    threads: int = 1,
    offset: npt.ArrayLike = 0.0,
    radius: float = np.inf,
    weights: Weighing | None = None,
    targets: Places | None = None,
    return_source: bool = False,
    return_bound: bool = False,
    progress: Progress = None,
) -> Floats | tuple[Any, ...]:
    """Distances from the nearest of the sources to every vertex, or to the targets.

    :param sources: places: a vertex, a :class:`Point`, several of them in whatever holds several (lists, sets,
        generators, arrays of numpy, torch, jax, pandas, ...), a mask with one bool per vertex, :class:`Points`, or
        :func:`at` positions; at least one. Numbers count from 0, and negative ones do not exist. Or whole curves, and
        lists of curves and places: a :class:`Curve`, and what :meth:`path`, :meth:`isolines`, :meth:`boundaries` and
        :meth:`region` give.
    :param method: one of :func:`methods`; the library's default if none is given.
    :param tolerance: for method ``"windows"``, which is meant where a tolerance is given: the relative error at every
        vertex is at most this; in [0, 0.1], 0 is exact, and so are those so small that an exact run is quicker. In
        words: ``"draft"``, ``"standard"``, ``"fine"``, ``"exact"`` are 1e-2, 1e-3, 1e-5 and 0.
    :param bound: for method ``"windows"``: ``"lower"`` gives values never above the distance, ``"upper"`` never below
        it, ``"estimate"`` (the default) values in between.
    :param precision: in which the marching methods compute: ``"float32"``, the default, is faster and good for about 6
        digits, ``"float64"`` for all. Other methods ignore it.
    :param threads: that work on this one field, where the mesh is large enough for several; 0 means one per processor.
        The numbers are the same to the bit for any number of threads.
    :param offset: the value that the front starts with, one number or one per source; finite, may be negative.
    :param radius: what is farther reads +inf; the run costs what it reaches.
    :param weights: what going costs, in place of distances: :meth:`Mesh.weighted`, or one number per face. Upper bounds,
        or with ``bound="lower"`` lower ones, within about ``tolerance`` (0.01) of each other.
    :param targets: where only some distances are needed; the solver may stop as soon as it has them.
    :param return_source: also return which source is nearest: its position in ``sources``, -1 where none is.
    :param return_bound: also return the proven absolute error of each distance, for methods that have one.
    :param progress: called with the share of the work that is done, some times a second, from the calling thread;
        True shows a bar, with tqdm where that is installed.
    :return: float64 of shape (vertex_count,) or (targets,), in the units of the vertices; +inf where nothing is
        reached. With ``return_source`` and ``return_bound`` a tuple: distances, int32 sources, float64 bounds.
    :raises BrushfireIndexError: for a vertex or face that does not exist.
    :raises BrushfireError: for no sources, a source in no face, bad weights, offsets or radius, an unknown
        method or precision, a bad number of threads, or ``return_bound`` with a method that has none.
    :raises TypeError: for what are no vertex numbers or points.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.distance(0, method="dijkstra").tolist()
    [0.0, 3.0, 5.0, 4.0]
    >>> d, source = mesh.distance([1, 3], offset=[0, 1], method="dijkstra", return_source=True)
    >>> d.tolist(), source.tolist()
    ([3.0, 0.0, 4.0, 1.0], [0, 0, 0, 1])
    >>> d, bound = mesh.distance(0, tolerance=1e-3, return_bound=True)
    >>> bool((abs(d - [0, 3, 5, 4]) <= bound + 1e-11).all())
    True
    >>> mesh.distance(0, targets=[2, 1], method="dijkstra").tolist()
    [5.0, 3.0]
    """
    start = sources_of(mesh, sources, offset)
    end = None if targets is None else mesh._arrays(targets, "targets")
    if weights is None:
        run = mesh._run()
        chosen = options(*mesh._or_defaults(method, tolerance, bound, precision, limit=radius), threads)
    else:
        space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision, threads)
        run = _core.Solver(space)
    with shown(progress, "distance") as report:
        distance, source, error = run.solve(
            start,
            end.index if end else None,
            end.weights if end else None,
            chosen,
            report,
        )
    if return_bound and error is None:
        raise BrushfireError("return_bound: the method has no bound, or there are targets")
    if return_source or return_bound:
        return (distance, *([source] if return_source else []), *([error] if return_bound else []))
    return distance


def signed_distance(
    mesh: Mesh, curves: Sources, *, radius: float = np.inf, threads: int = 1, progress: Progress = None
) -> Floats:
    """Exact distance with a sign: negative on the left of the nearest curve, positive on its right.

    Left is seen along the curve, the faces lying counter-clockwise: the inside of a closed curve that runs
    counter-clockwise is negative, and curves that nest with opposite senses bound what lies between them. On which
    side a vertex is, its shortest path says, by where it arrives (:doc:`/curve-sources`); where there is no side, as on
    the curve, the distance is positive. Walls part curves: what runs along one is on both of its sides.

    :param curves: one or several, as :meth:`distance` takes them, without offsets.
    :param radius, threads, progress: as for :meth:`distance`.
    :return: float64 (vertex_count,); +inf where nothing is reached.
    :raises BrushfireError: for points among the curves, offsets, and as :meth:`distance` does.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.signed_distance(bf.Curve([0, 2])).round(9).tolist()
    [0.0, 2.4, 0.0, -2.4]
    """
    chosen = options("exact", None, radius, threads=threads)
    start = sources_of(mesh, curves)
    with shown(progress, "distance") as report:
        return _core.signed_distance(mesh._space, start, chosen, report)
