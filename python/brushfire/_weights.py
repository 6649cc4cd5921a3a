"""What going costs, as it is given, in the core's arrays: edges, grain, slopes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, floats, number
from brushfire._errors import BrushfireError

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

Slope: TypeAlias = "str | tuple[npt.ArrayLike, npt.ArrayLike] | Callable[[float], float]"


def edges_of(edge_weights: Any) -> tuple[npt.NDArray[np.int64], Floats, Floats]:
    """Vertices, cost along, cost to cross: from rows of three or four numbers."""
    table = floats([] if edge_weights is None else edge_weights, "edge_weights")
    if table.size == 0:
        return np.zeros(0, np.int64), np.zeros(0), np.zeros(0)
    if table.ndim != 2 or table.shape[1] not in (3, 4):
        raise BrushfireError(
            "edge_weights: rows of two vertices, the cost along the edge (inf: as in its faces) and, if wanted, the cost "
            f"to cross it are needed, not an array of shape {table.shape}"
        )
    ends = table[:, :2]
    if not (np.isfinite(ends).all() and (ends == np.floor(ends)).all()):
        raise BrushfireError("edge_weights: the first two columns are numbers of vertices")
    crossing = table[:, 3] if table.shape[1] == 4 else np.zeros(len(table))
    vertices = np.ascontiguousarray(ends.astype(np.int64).ravel())
    return vertices, np.ascontiguousarray(table[:, 2]), np.ascontiguousarray(crossing)


def grain_of(mesh: Mesh, grain: npt.ArrayLike | None) -> Floats | None:
    if grain is None:
        return None
    rows = floats(grain, "grain")
    if rows.ndim != 2 or rows.shape[1] != 4 or len(rows) != mesh.face_count:
        raise BrushfireError(
            f"grain: x, y, z of a direction and the cost across it for each of {mesh.face_count} faces are needed, not an "
            f"array of shape {rows.shape}"
        )
    return np.array(rows).ravel()


def _sampled(pace: Callable[[float], float]) -> tuple[Floats, Floats]:
    """Where it is finite between slopes of -2 and 2, in steps of 2.5e-4, which is how the core keeps paces."""
    slopes = np.linspace(-2, 2, 16001)
    paces = np.array([number(pace(float(s)), "slope: the pace") for s in slopes])
    walked = np.flatnonzero(paces < np.inf)
    if len(walked) < 2 or walked[-1] - walked[0] + 1 != len(walked):
        raise BrushfireError("slope: the pace may be inf beyond the steepest slopes, up and down, only")
    return slopes[walked], paces[walked]


def pace_of(slope: Slope | None) -> tuple[str, Floats | None, Floats | None]:
    """A name, or slopes and paces."""
    if slope is None or isinstance(slope, str):
        return slope or "", None, None
    if callable(slope):
        return "", *_sampled(slope)
    if not isinstance(slope, Sequence) or len(slope) != 2:
        raise BrushfireError("slope: a name, a function, or slopes and the paces there, two arrays, are needed")
    return "", floats(slope[0], "slopes").ravel(), floats(slope[1], "paces").ravel()
