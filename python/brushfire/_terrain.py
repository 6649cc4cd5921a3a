"""Terrain: meshes from grids of heights."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import floats, number
from brushfire._errors import BrushfireError
from brushfire._mesh import Mesh
from brushfire._places import Points
from brushfire._rasters import Raster, placement_of, read_raster, write_raster


def _placement(transform: Any) -> npt.NDArray[np.float64]:
    """Origin, right, down; of the middles of cells."""
    if transform is None:
        return np.array([0.0, 0.0, 1.0, 0.0, 0.0, -1.0])
    if hasattr(transform, "to_gdal"):  # rasterio's Affine
        transform = transform.to_gdal()
    return placement_of([number(v, "transform") for v in transform])


class Terrain:
    """A mesh from a grid of heights; made by :func:`terrain`.

    ``mesh``: a :class:`Mesh`, whose vertices are those of the array, row by row: ``mesh.distance(...).reshape(shape)`` is a
    raster again, and ``write()`` writes it as one. ``shape``: of the array.

    >>> import brushfire as bf
    >>> ground = bf.terrain([[0, 1, 2], [0, 1, 2]])
    >>> ground.mesh.distance(0).reshape(ground.shape).shape
    (2, 3)
    """

    def __init__(self, grid: Raster, no_data: float) -> None:
        self.shape: tuple[int, int] = (grid.values.shape[0], grid.values.shape[1])
        self._placement, self._reference = grid.placement, grid.reference
        self._core = _core.Terrain(grid.values.ravel(), self.shape[1], self.shape[0], grid.placement, no_data)
        self.mesh = Mesh._of(self._core.mesh)

    def __repr__(self) -> str:
        return f"Terrain({self.shape[0]} x {self.shape[1]} heights, {self.mesh!r})"

    def write(self, file: str | os.PathLike[str], values: npt.ArrayLike) -> None:
        """Values of the vertices as a grid that lies where the heights do: ``.asc``, ``.npy``, or ``.tif`` where rasterio or
        GDAL's package is installed. +inf and NaN are no data.

        :param values: (rows, columns) or (vertex_count,).

        >>> import brushfire as bf
        >>> import tempfile, pathlib
        >>> ground = bf.terrain([[0, 1, 2], [0, 1, 2]])
        >>> file = pathlib.Path(tempfile.mkdtemp()) / "distance.asc"
        >>> ground.write(file, ground.mesh.distance(0))
        >>> bf.terrain(file).shape
        (2, 3)
        """
        array = floats(values, "values")
        if array.size != self.shape[0] * self.shape[1]:
            raise BrushfireError(f"values: {self.shape[0]} x {self.shape[1]} are needed, not {array.shape}")
        write_raster(file, Raster(array.reshape(self.shape), self._placement, self._reference))

    def below(self, xy: npt.ArrayLike) -> Points:
        """Places on the ground by their map coordinates, dropped vertically: what GPS gives.

        :param xy: (2,) or (k, 2).
        :raises BrushfireError: for a place beside the grid, or in a hole.

        >>> import brushfire as bf
        >>> ground = bf.terrain([[0, 1], [0, 1]])
        >>> ground.mesh.position(ground.below([0.25, -0.5])).tolist()
        [[0.25, -0.5, 0.25]]
        """
        places = np.atleast_2d(floats(xy, "xy"))
        if places.ndim != 2 or places.shape[1] != 2:
            raise BrushfireError(f"xy: shape (n, 2) is needed, not {places.shape}")
        face, weights = self._core.below(np.ascontiguousarray(places.ravel()))
        if (face < 0).any():
            k = int(np.argmax(face < 0))
            raise BrushfireError(f"place {k}, {places[k].tolist()}, has no ground below it: beside the grid, or in a hole")
        return Points(face, weights)


def terrain(
    heights: npt.ArrayLike | os.PathLike[str], transform: Any = None, *, no_data: float = np.inf
) -> Terrain:
    """A mesh of a grid of heights: two triangles for every cell, over the diagonal along which the heights differ less.

    :param heights: (rows, columns), or a file: an ESRI ASCII grid, ``.npy``, or, where rasterio or GDAL's package is
        installed, a GeoTIFF or whatever else that reads (its first band; in metres, not in degrees). NaN, inf and
        ``no_data`` are no heights: cells without are holes.
    :param transform: where an array lies: the six numbers of GDAL's geotransform, (x, dx, rx, y, ry, dy) with x and y of the
        corner of the first cell, or rasterio's ``dataset.transform``. Without one the first height is at (0, 0), and
        rows run down in steps of 1.
    :return: :class:`Terrain`.

    >>> import brushfire as bf
    >>> ground = bf.terrain([[0, 1, 2], [0, 1, 2]], (100, 10, 0, 500, 0, -10))
    >>> ground.mesh.vertices[0].tolist(), ground.mesh.face_count
    ([105.0, 495.0, 0.0], 4)
    >>> seconds = ground.mesh.weighted(slope="tobler").distance(0)
    >>> bool(seconds[2] > ground.mesh.weighted(slope="tobler").distance(0, towards=True)[2])
    True
    """
    none = number(no_data, "no_data")
    if isinstance(heights, (str, os.PathLike)):
        grid = read_raster(heights)
        if transform is not None:
            grid = replace(grid, placement=_placement(transform))
        return Terrain(replace(grid, values=np.ascontiguousarray(grid.values)), none)
    array = floats(heights, "heights")
    if array.ndim != 2:
        raise BrushfireError(f"heights: shape (rows, columns) is needed, not {array.shape}")
    return Terrain(Raster(array, _placement(transform)), none)
