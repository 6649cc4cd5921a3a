"""The script in QGIS itself, by its own Python: python3 programs/tests/qgis_test.py. The last line counts what held."""

import math
import sys
import tempfile
from pathlib import Path

import numpy as np
from osgeo import gdal
from qgis.core import (
    QgsApplication,
    QgsFeature,
    QgsGeometry,
    QgsPointXY,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsRasterLayer,
    QgsVectorLayer,
)

sys.path.insert(0, str(Path(__file__).parents[1] / "qgis"))
application = QgsApplication([], False)
application.initQgis()
from brushfire_walk import NOT_REACHED, WalkOnTerrain

FOLDER = Path(tempfile.mkdtemp())
CELL = 10.0


def raster(name, heights, crs="EPSG:32632"):
    path = str(FOLDER / name)
    heights = np.asarray(heights, dtype=np.float32)
    file = gdal.GetDriverByName("GTiff").Create(path, heights.shape[1], heights.shape[0], 1, gdal.GDT_Float32)
    file.SetGeoTransform((1000.0, CELL, 0, 5000.0, 0, -CELL))
    file.GetRasterBand(1).SetNoDataValue(-9999)
    file.GetRasterBand(1).WriteArray(heights)
    file = None
    layer = QgsRasterLayer(path, name)
    from qgis.core import QgsCoordinateReferenceSystem

    layer.setCrs(QgsCoordinateReferenceSystem(crs))
    return layer


def points(*places):
    layer = QgsVectorLayer("Point?crs=EPSG:32632", "start", "memory")
    for x, y in places:
        feature = QgsFeature()
        feature.setGeometry(QgsGeometry.fromPointXY(QgsPointXY(x, y)))
        layer.dataProvider().addFeature(feature)
    return layer


def walk(heights, start, **more):
    algorithm = WalkOnTerrain()
    algorithm.initAlgorithm()
    context, output = QgsProcessingContext(), str(FOLDER / "walk.tif")
    result, _ = algorithm.run(
        {"HEIGHTS": heights, "SOURCES": start, "OUTPUT": output, **more},
        context,
        QgsProcessingFeedback(),
        catchExceptions=False,
    )
    return gdal.Open(result["OUTPUT"]).ReadAsArray()


def on_flat_ground_distances_are_those_of_the_map():
    rows, columns = np.mgrid[0:20, 0:30]
    values = walk(raster("flat.tif", np.zeros((20, 30))), points((1005.0, 4995.0)))
    assert np.abs(values - CELL * np.hypot(rows, columns)).max() < 1e-3


def up_a_slope_the_way_is_longer():
    values = walk(raster("slope.tif", np.tile(CELL * np.arange(5), (4, 1))), points((1005.0, 4995.0)))
    assert math.isclose(values[0, 4], 4 * CELL * math.sqrt(2), rel_tol=1e-6)


def walking_time_is_tobler_s():
    values = walk(raster("flat.tif", np.zeros((3, 11))), points((1005.0, 4995.0)), MEASURE=1)
    assert math.isclose(values[0, 10], 100 / (6 / 3.6 * math.exp(-3.5 * 0.05)), rel_tol=1e-3)


def cells_without_height_are_not_reached():
    heights = np.zeros((5, 9))
    heights[:, 4] = -9999
    values = walk(raster("gap.tif", heights), points((1005.0, 4995.0)))
    assert (values[:, 5:] == NOT_REACHED).all() and (values[:, :4] >= 0).all()


def degrees_and_places_beside_the_map_are_refused():
    for heights, start, said in [
        (raster("degrees.tif", np.zeros((3, 3)), "EPSG:4326"), points((1005.0, 4995.0)), "degrees"),
        (raster("flat.tif", np.zeros((3, 3))), points((0.0, 0.0)), "no ground below it"),
    ]:
        try:
            walk(heights, start)
        except QgsProcessingException as error:
            assert said in str(error), error
        else:
            raise AssertionError(said)


if __name__ == "__main__":
    checks = [on_flat_ground_distances_are_those_of_the_map, up_a_slope_the_way_is_longer, walking_time_is_tobler_s,
              cells_without_height_are_not_reached, degrees_and_places_beside_the_map_are_refused]  # fmt: skip
    for check in checks:
        check()
        print("ok", check.__name__)
    from qgis.core import Qgis

    print(f"{len(checks)} of {len(checks)} held in QGIS {Qgis.QGIS_VERSION}")
