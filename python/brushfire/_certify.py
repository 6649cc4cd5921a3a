"""What can be proven about a distance field, whoever made it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, number, radius_of
from brushfire._errors import BrushfireError
from brushfire._options import Tolerance, thread_count, tolerance_of
from brushfire._progress import Progress, shown
from brushfire._sources import Sources, sources_of

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


@dataclass(frozen=True)
class Certificate:
    """What :meth:`Mesh.certify` has proven.

    ``proven_wrong``: how many values cannot be right; each of them is counted in one of ``too_short``, ``too_long``,
    ``not_reachable`` (a number where no source leads), ``not_reached`` (+inf where one does) and ``not_a_number``.
    ``possible``: the others. ``least_within``: the least ``within`` with which nothing would be proven wrong, +inf where
    none is large enough; ``worst_vertex``: the one that asks for it, -1 for none. ``max_gap``: how far apart the bounds
    are at most, as a share of the distance.

    Per vertex, (vertex_count,): ``lower`` and ``upper`` hold the distance between them, proven, +inf where no source
    leads. ``proven_error``: how far the value is from the distance at least, negative where it is too short, -inf and
    +inf where it is finite and should not be, or should be, NaN where it is; 0 where nothing is proven. ``finding``: the
    place of what is wrong in ``findings``, int8, 0 for possible.
    """

    proven_wrong: int
    possible: int
    too_short: int
    too_long: int
    not_reachable: int
    not_reached: int
    not_a_number: int
    least_within: float
    worst_vertex: int
    max_gap: float
    lower: Floats = field(repr=False)
    upper: Floats = field(repr=False)
    proven_error: Floats = field(repr=False)
    finding: npt.NDArray[np.int8] = field(repr=False)

    findings = _core.finding_names()

    @property
    def wrong_vertices(self) -> npt.NDArray[np.int64]:
        """The vertices whose values are proven wrong, ascending."""
        return np.flatnonzero(self.finding).astype(np.int64)

    def __str__(self) -> str:
        if self.proven_wrong == 0:
            return f"nothing is proven wrong: {self.possible} vertices may be right"
        return f"proven wrong: {self.proven_wrong} of {self.proven_wrong + self.possible} vertices cannot be right"


def certify(
    mesh: Mesh,
    values: npt.ArrayLike,
    sources: Sources,
    *,
    within: float = 0.0,
    tolerance: Tolerance = 0.0,
    offset: npt.ArrayLike = 0.0,
    radius: float = np.inf,
    threads: int = 1,
    progress: Progress = None,
) -> Certificate:
    """Judges values as the distances from the sources: proven bounds of each, and those that cannot be right.

    :param values: one per vertex, from any program, (vertex_count,); NaN is allowed, and wrong.
    :param sources, offset, threads, progress: as for :meth:`distance`.
    :param within: what is claimed of the values: they may be off by this share of the distance.
    :param tolerance: how tight the bounds are: within rounding of each other with 0, up to twice the tolerance apart
        otherwise, which is quicker on large meshes; in [0, 0.1].
    :param radius: what is farther than this may read +inf.
    :raises BrushfireError: for values of another number than the vertices, options out of range, and as
        :meth:`distance` does.

    A value is called wrong only where it is proven: a field that passes may be off by ``within`` and the gap of the
    bounds. Costs one run of :meth:`distance`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> print(mesh.certify([0, 3, 5, 4], 0))
    nothing is proven wrong: 4 vertices may be right
    >>> found = mesh.certify([0, 3, 5.01, 4], 0)
    >>> found.wrong_vertices.tolist(), found.findings[found.finding[2]], round(float(found.proven_error[2]), 9)
    ([2], 'too long', 0.01)
    >>> mesh.certify([0, 3, 5.01, 4], 0, within=0.01).proven_wrong
    0
    """
    array = _arrays.floats(values, "values")
    if array.ndim != 1:
        raise BrushfireError(f"values: shape (k,) is needed, not {array.shape}")
    start = sources_of(mesh, sources, offset)
    with shown(progress, "certify") as report:
        found = _core.certify(
            mesh._space,
            array,
            start,
            tolerance_of(tolerance),
            number(within, "within"),
            radius_of(radius),
            thread_count(threads),
            report,
        )
    return Certificate(**found)
