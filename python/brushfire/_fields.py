"""What is made of a field of one value per vertex: isolines, gradients, the way down, comparison."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, number, whole
from brushfire._curves import Path, path_of
from brushfire._errors import BrushfireError
from brushfire._options import Tolerance, options, tolerance_of
from brushfire._places import Places
from brushfire._progress import Progress, shown
from brushfire._sources import Sources, sources_of
from brushfire._surface import Surface

_MOST_LEVELS = 1_000_000


@dataclass(frozen=True)
class Isoline:
    """One connected curve of one level. Smaller values lie on its left, seen from where faces run counter-clockwise.

    ``level``: its value. ``level_index``: the level's place in the list of levels. ``line``: the curve, closed or from
    border to border.
    """

    level: float
    level_index: int
    line: Path

    def __repr__(self) -> str:
        return f"Isoline(level {self.level:.6g}, {self.line!r})"


@dataclass(frozen=True)
class Descent:
    """The direction in which a field falls fastest from a point.

    ``face``: into which face it leads. ``weight_rates``: the change of the point's weights in that face per unit of
    length. ``slope``: the change of value per unit of length, < 0. ``vector``: the direction as a unit vector, (3,); None
    for a mesh from lengths.
    """

    face: int
    weight_rates: tuple[float, float, float]
    slope: float
    vector: Floats | None


@dataclass(frozen=True)
class Errors:
    """Over some vertices, of ``|field - reference|``. ``max_vertex``: the lowest where it is greatest, -1 for none."""

    mean: float
    root_mean_square: float
    max: float
    max_vertex: int


@dataclass(frozen=True)
class Comparison:
    """How far a field is from a reference. Every vertex is counted in one of the first five.

    ``compared``: finite in both, reference not 0: the errors are over these. ``zero_reference``: reference 0 (sources).
    ``missing``: finite in the reference only. ``surplus``: finite in the field only. ``unreached_in_both``. The weighted
    measures are None where no weights were given.
    """

    compared: int
    zero_reference: int
    missing: int
    surplus: int
    unreached_in_both: int
    absolute: Errors
    relative: Errors
    mean_signed_relative: float
    max_at_zero_reference: float
    weighted_absolute: Errors | None
    weighted_relative: Errors | None


def compare(field: npt.ArrayLike, reference: npt.ArrayLike, weights: npt.ArrayLike | None = None) -> Comparison:
    """How far a distance field is from a reference, both (vertex_count,), +inf where unreachable.

    :param weights: one number >= 0 per vertex, usually :meth:`Mesh.vertex_areas`, for the weighted measures.
    :raises BrushfireError: for arrays of different sizes, and for NaN and -inf.

    >>> import brushfire as bf
    >>> result = bf.compare([0, 1, 2.02, float("inf")], [0, 1, 2, 3])
    >>> result.compared, result.missing, round(result.relative.max, 6), result.relative.max_vertex
    (2, 1, 0.01, 2)
    """
    given = None if weights is None else values_of(weights, "weights")
    counts = _core.compare_fields(values_of(field, "field"), values_of(reference, "reference"), given)
    made: dict[str, Any] = {k: Errors(**v) if isinstance(v, dict) else v for k, v in counts.items()}
    return Comparison(**made)


def values_of(values: npt.ArrayLike, what: str) -> Floats:
    array = _arrays.floats(values, what)
    if array.ndim != 1:
        raise BrushfireError(f"{what}: shape (k,) is needed, not {array.shape}")
    return array


def _levels(levels: npt.ArrayLike) -> Floats:
    array = _arrays.floats(levels, "levels")
    return values_of(array.reshape(1) if array.ndim == 0 else array, "levels")


def _choose_one(levels: Any, every: Any, count: Any) -> None:
    if sum(choice is not None for choice in (levels, every, count)) != 1:
        raise BrushfireError("isolines: one of levels, every and count is needed")


def isolines(
    mesh: Surface,
    values: npt.ArrayLike,
    levels: npt.ArrayLike | None = None,
    *,
    every: float | None = None,
    count: int | None = None,
) -> list[Isoline]:
    """The curves of equal value of a field that is linear in every face, as ordered and oriented polylines.

    :param values: one per vertex, +inf where there is none, (vertex_count,). Of a mesh with walls it counts on both sides
        of them; :meth:`curved_isolines` knows the distances on either side.
    :param levels: which values, (k,); or
    :param every: all multiples of this number in the range of the values; or
    :param count: this many levels, which divide the range into equal parts.
    :return: the curves in the order of the levels; see :class:`Isoline`.
    :raises BrushfireError: where none or several of ``levels``, ``every``, ``count`` are given, for values that are NaN
        or too few, for levels that are not finite, and (code ``too_large``) for more than a million levels.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 1, 2], [0, 2, 3]])
    >>> [line] = mesh.isolines([0, 2, 2, 0], [0.5])
    >>> line.level, line.line.length, line.line.closed, line.line.positions.tolist()
    (0.5, 2.0, False, [[0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 2.0, 0.0]])
    >>> [line.level for line in mesh.isolines([0, 2, 2, 0], count=3)]
    [0.5, 1.0, 1.5]
    """
    _choose_one(levels, every, count)
    field = values_of(values, "values")
    if levels is not None:
        chosen = _levels(levels)
    elif every is not None:
        chosen = _core.levels_every(field, number(every, "every"))
    else:
        chosen = _core.levels_between(field, whole(count, "count", _MOST_LEVELS))
    return _isolines(mesh, _core.isolines(mesh._space, field, chosen))


def curved_isolines(
    mesh: Surface,
    sources: Sources,
    levels: npt.ArrayLike | None = None,
    *,
    every: float | None = None,
    count: int | None = None,
    chord_error: float | None = None,
    tolerance: Tolerance = 0.0,
    offset: npt.ArrayLike = 0.0,
    radius: float = np.inf,
    progress: Progress = None,
) -> list[Isoline]:
    """The curves at equal distance from the sources: arcs of circles, with corners where two fronts meet.

    :param sources, offset, radius, progress: as for :meth:`distance`, which is computed exactly.
    :param levels, every, count: as for :meth:`isolines`.
    :param chord_error: how far pieces may lie from the arcs, > 0; a hundredth of the mean edge if not given.
    :param tolerance: the relative error of the distances; with 0 every node lies on its level to rounding.
    :raises BrushfireError: as :meth:`isolines` and :meth:`distance` do.

    All windows are kept, some kB per vertex. With ``tolerance`` the curves are those of the merged field.

    >>> import brushfire as bf, numpy as np
    >>> mesh = bf.Mesh([[-9, -9], [9, -9], [9, 9], [-9, 9], [0, 0]], [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> [circle] = mesh.curved_isolines(4, [5.0], chord_error=1e-4)
    >>> circle.line.closed, bool(abs(circle.line.length / (10 * np.pi) - 1) < 1e-4)
    (True, True)
    """
    _choose_one(levels, every, count)
    start = sources_of(mesh, sources, offset)
    if chord_error is None:
        chord_error = 0.01 * float(mesh._mesh.report()["mean_edge_length"])  # type: ignore[arg-type]
    with shown(progress, "isolines") as report:
        found = _core.curved_isolines(
            mesh._run(),
            start,
            options("windows", tolerance_of(tolerance), radius),
            None if levels is None else _levels(levels),
            None if every is None else number(every, "every"),
            0 if count is None else whole(count, "count", _MOST_LEVELS),
            number(chord_error, "chord_error"),
            report,
        )
    return _isolines(mesh, found)


def _isolines(mesh: Surface, lines: list[tuple[float, int, _core.PathArrays]]) -> list[Isoline]:
    return [Isoline(level, index, path_of(mesh, line)) for level, index, line in lines]


def gradient(mesh: Surface, values: npt.ArrayLike, *, on: Literal["faces", "vertices"] = "faces") -> Floats:
    """The gradient of a field that is linear in every face: (face_count, 3), change per unit of length.

    :param values: one per vertex, (vertex_count,).
    :param on: ``"vertices"`` gives one for each vertex instead, (vertex_count, 3): the mean of the faces around,
        weighted by their area.
    :return: in the plane of each face, uphill; about 1 long for a distance field. 0 for faces without area and faces
        with a value of +inf.
    :raises BrushfireError: for a mesh from lengths, and for values that are NaN or too few.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.gradient([0, 2, 2, 0]).tolist()
    [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    """
    if on not in ("faces", "vertices"):
        raise BrushfireError(f"on: 'faces' or 'vertices' is needed, not {on!r}")
    return _core.gradients(mesh._space, values_of(values, "values"), on == "vertices")


def steepest_descent(mesh: Surface, values: npt.ArrayLike, place: Places) -> Descent | None:
    """The direction in which a field falls fastest from a place, of all faces around it; None where it falls nowhere.

    :param values: one per vertex, (vertex_count,).
    :param place: a vertex or a :class:`Point`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 1, 2], [0, 2, 3]])
    >>> down = mesh.steepest_descent([0, 2, 2, 0], 1)
    >>> down.face, down.slope, (down.vector + 0.0).round(6).tolist()
    (0, -1.0, [-1.0, 0.0, 0.0])
    """
    arrays = mesh._arrays(place, "place")
    found = _core.steepest_descent(mesh._space, values_of(values, "values"), arrays.index, arrays.weights)
    return None if found is None else Descent(*found)


def vertex_areas(mesh: Surface) -> Floats:
    """A third of the area of the faces around each vertex, (vertex_count,); they sum to the area of the mesh (of what walls leave open).

    >>> import brushfire as bf
    >>> bf.Mesh([[0, 0], [3, 0], [0, 2]], [[0, 1, 2]]).vertex_areas().tolist()
    [1.0, 1.0, 1.0]
    """
    return _core.vertex_areas(mesh._space)
