"""Grids of values in files: ESRI ASCII and .npy by the library; GeoTIFF and others by rasterio, or GDAL's own package."""

from __future__ import annotations

import importlib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats
from brushfire._errors import BrushfireError

_OWN = (".asc", ".npy")


@dataclass(frozen=True)
class Raster:
    """``values`` (rows, columns), NaN where there is none; ``placement``: x and y of the middle of the first cell, of a step to
    the right and of one down; ``reference``: of the map, as WKT."""

    values: Floats
    placement: npt.NDArray[np.float64]
    reference: str = ""


def placement_of(transform: Any) -> npt.NDArray[np.float64]:
    """Of GDAL's six numbers, which speak of corners."""
    x, right_x, down_x, y, right_y, down_y = (float(v) for v in transform)
    return np.array([x + 0.5 * (right_x + down_x), y + 0.5 * (right_y + down_y), right_x, right_y, down_x, down_y])


def _transform(placement: npt.NDArray[np.float64]) -> tuple[float, ...]:
    x, y, right_x, right_y, down_x, down_y = placement.tolist()
    return (x - 0.5 * (right_x + down_x), right_x, down_x, y - 0.5 * (right_y + down_y), right_y, down_y)


def _installed(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def _refuse(file: str) -> BrushfireError:
    return BrushfireError(f"{file}: .asc and .npy are read and written as they are, others where rasterio is installed")


def _refuse_degrees(file: str, is_geographic: bool) -> None:
    if is_geographic:
        raise BrushfireError(
            f"{file}: its map is in degrees, and its heights are not: rasterio.warp.reproject, or gdalwarp -t_srs, to your "
            "own zone makes metres of both"
        )


def read_raster(file: str | os.PathLike[str]) -> Raster:
    """The first band of a file."""
    name = os.fspath(file)
    if Path(name.removesuffix(".gz")).suffix.lower() in _OWN:
        values, columns, rows, placement, reference = _core.read_grid(name)
        return Raster(np.where(np.isfinite(values), values, np.nan).reshape(rows, columns), placement, reference)
    if rasterio := _installed("rasterio"):
        with rasterio.open(name) as data:
            _refuse_degrees(name, data.crs is not None and data.crs.is_geographic)
            band = data.read(1, masked=True).astype(np.float64) * data.scales[0] + data.offsets[0]
            reference = data.crs.to_wkt() if data.crs else ""
            return Raster(band.filled(np.nan), placement_of(data.transform.to_gdal()), reference)
    if gdal := _installed("osgeo.gdal"):
        gdal.UseExceptions()
        data = gdal.Open(name)
        system = data.GetSpatialRef()
        _refuse_degrees(name, system is not None and bool(system.IsGeographic()))
        band = data.GetRasterBand(1)
        values = band.ReadAsArray().astype(np.float64) * (band.GetScale() or 1.0) + (band.GetOffset() or 0.0)
        values[band.GetMaskBand().ReadAsArray() == 0] = np.nan
        return Raster(values, placement_of(data.GetGeoTransform()), data.GetProjection())
    raise _refuse(name)


def write_raster(file: str | os.PathLike[str], raster: Raster) -> None:
    """By extension; what is not finite is no data. Appears complete or not at all."""
    name = os.fspath(file)
    values = np.where(np.isfinite(raster.values), raster.values, np.nan)
    rows, columns = values.shape
    suffix = Path(name).suffix.lower()
    if suffix in _OWN:
        kept = np.ascontiguousarray((raster.values if suffix == ".npy" else values).ravel())
        return _core.write_grid(name, kept, columns, rows, raster.placement, raster.reference)
    if suffix not in (".tif", ".tiff"):
        raise BrushfireError(f"{name}: grids are written as .asc, .npy and .tif")
    part = f"{name}.part-{os.getpid()}.tif"
    try:
        _write_geotiff(name, part, values, _transform(raster.placement), raster.reference)
        os.replace(part, name)
    finally:
        Path(part).unlink(missing_ok=True)


def _write_geotiff(name: str, part: str, values: Floats, transform: tuple[float, ...], reference: str) -> None:
    rows, columns = values.shape
    if rasterio := _installed("rasterio"):
        with rasterio.open(
            part,
            "w",
            driver="GTiff",
            width=columns,
            height=rows,
            count=1,
            dtype="float64",
            nodata=np.nan,
            compress="deflate",
            crs=reference or None,
            transform=rasterio.Affine.from_gdal(*transform),
        ) as data:
            data.write(values, 1)
    elif gdal := _installed("osgeo.gdal"):
        gdal.UseExceptions()
        data = gdal.GetDriverByName("GTiff").Create(part, columns, rows, 1, gdal.GDT_Float64, ["COMPRESS=DEFLATE"])
        data.SetGeoTransform(transform)
        data.SetProjection(reference)
        data.GetRasterBand(1).SetNoDataValue(np.nan)
        data.GetRasterBand(1).WriteArray(values)
        data.FlushCache()
    else:
        raise _refuse(name)
