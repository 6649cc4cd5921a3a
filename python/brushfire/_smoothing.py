"""Smoothing along the surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, Labels, number
from brushfire._errors import BrushfireError
from brushfire._options import Options, Tolerance, options, thread_count
from brushfire._progress import Progress, shown

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

    from brushfire._mesh import Mesh


_FWHM_PER_SIGMA = 2.3548200450309493


def smoothing_kernel(
    mesh: Mesh,
    *,
    sigma: float | None = None,
    fwhm: float | None = None,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> csr_matrix:
    """A Gaussian of the distance along the surface, by area, every row summing to 1: a scipy.sparse matrix.

    :param sigma: its standard deviation; or
    :param fwhm: its full width at half maximum. It ends at 4 sigma.

    ``kernel @ values`` smooths any number of columns; :meth:`smooth` does so for one and minds NaN.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.smoothing_kernel(fwhm=2).sum().round(9).item()
    4.0
    """
    from scipy.sparse import csr_matrix

    chosen = options(method, tolerance, np.inf, bound, precision)
    value, column, starts = _kernel(mesh, sigma, fwhm, chosen, threads, progress)
    return csr_matrix((value, column, starts), shape=(len(starts) - 1, mesh._mesh.vertex_count))


def smooth(
    mesh: Mesh,
    values: npt.ArrayLike,
    *,
    sigma: float | None = None,
    fwhm: float | None = None,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Floats:
    """Values smoothed along the surface, within walls: (vertex_count,) or (vertex_count, k), as given.

    :param values: NaN does not count, and stays; so does what is in no open face.
    :param sigma, fwhm, method, tolerance, bound, precision, threads, progress: as for :meth:`smoothing_kernel`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.smooth([1, 1, 1, 5], sigma=0.5).round(3).tolist()
    [1.0, 1.0, 1.0, 5.0]
    """
    array = _arrays.floats(values, "values")
    if array.ndim not in (1, 2) or array.shape[0] != mesh._mesh.vertex_count:
        raise BrushfireError(f"values: one row per vertex is needed, {mesh._mesh.vertex_count}, not {array.shape}")
    chosen = options(method, tolerance, np.inf, bound, precision)
    value, column, starts = _kernel(mesh, sigma, fwhm, chosen, threads, progress)
    columns = array.reshape(len(array), -1)
    there = ~np.isnan(columns)
    rows = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    result = columns.copy()
    for k in range(columns.shape[1]):
        known = there[:, k]
        weight = np.bincount(rows, value * known[column], minlength=len(columns))
        total = np.bincount(rows, value * np.where(known, columns[:, k], 0)[column], minlength=len(columns))
        smooth = known & (weight > 0)
        result[smooth, k] = total[smooth] / weight[smooth]
    return result.reshape(array.shape)


def _kernel(
    mesh: Mesh, sigma: Any, fwhm: Any, chosen: Options, threads: Any, progress: Progress
) -> tuple[Floats, Labels, npt.NDArray[np.int64]]:
    if (sigma is None) == (fwhm is None):
        raise BrushfireError("how wide? one of sigma and fwhm is needed")
    width = number(sigma, "sigma") if sigma is not None else number(fwhm, "fwhm") / _FWHM_PER_SIGMA
    with shown(progress, "smooth") as report:
        return _core.smoothing_kernel(mesh._space, width, chosen, thread_count(threads), report)
