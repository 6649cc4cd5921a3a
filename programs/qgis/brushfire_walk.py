"""Brushfire in QGIS: Processing, Scripts, Add Script to Toolbox, this file. QGIS's Python needs `pip install brushfire`.

Walk on terrain: how far, or how long, to every cell of a raster of heights from the points of a layer: over the surface,
not over the map; across cells in any direction, not in eight.
"""

import numpy as np
from osgeo import gdal
from qgis.core import (
    QgsCoordinateTransform,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingException,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterNumber,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer,
)

import brushfire as bf

NOT_REACHED = -1.0
MEASURES = ["distance over the surface", "walking time (Tobler)"]


class WalkOnTerrain(QgsProcessingAlgorithm):
    HEIGHTS, SOURCES, MEASURE, RADIUS, OUTPUT = "HEIGHTS", "SOURCES", "MEASURE", "RADIUS", "OUTPUT"

    def name(self):
        return "walk_on_terrain"

    def displayName(self):
        return "Walk on terrain (Brushfire)"

    def shortHelpString(self):
        return (
            "Distance over the surface, exact, or walking time by Tobler's function, from the nearest of the points to"
            " every cell. Heights and map have to have the same unit: metres, not degrees. Cells without height are"
            f" holes: one goes around them. Cells that are not reached read {NOT_REACHED:g}, which is the no-data value."
        )

    def createInstance(self):
        return WalkOnTerrain()

    def initAlgorithm(self, config=None):
        self.addParameter(QgsProcessingParameterRasterLayer(self.HEIGHTS, "Heights"))
        self.addParameter(QgsProcessingParameterFeatureSource(self.SOURCES, "Start", [QgsProcessing.TypeVectorPoint]))
        self.addParameter(QgsProcessingParameterEnum(self.MEASURE, "Measure", MEASURES, defaultValue=0))
        self.addParameter(
            QgsProcessingParameterNumber(
                self.RADIUS, "No farther than", QgsProcessingParameterNumber.Double, optional=True, minValue=0
            )
        )
        self.addParameter(QgsProcessingParameterRasterDestination(self.OUTPUT, "Walk"))

    def processAlgorithm(self, parameters, context, feedback):
        layer = self.parameterAsRasterLayer(parameters, self.HEIGHTS, context)
        start = self.parameterAsSource(parameters, self.SOURCES, context)
        if layer.crs().isGeographic():
            raise QgsProcessingException("the heights' map is in degrees: reproject it into metres first")
        raster = gdal.Open(layer.source())
        if raster is None:
            raise QgsProcessingException(f"GDAL cannot open {layer.source()}")
        band = raster.GetRasterBand(1)
        no_data = band.GetNoDataValue()
        try:
            ground = bf.terrain(
                band.ReadAsArray(), raster.GetGeoTransform(), no_data=np.inf if no_data is None else no_data
            )
            values = self._walk(parameters, context, feedback, ground, self._places(start, layer.crs(), context))
        except bf.BrushfireError as error:
            raise QgsProcessingException(str(error)) from None
        output = self.parameterAsOutputLayer(parameters, self.OUTPUT, context)
        _write(output, values.reshape(ground.shape), raster)
        return {self.OUTPUT: output}

    def _places(self, start, crs, context):
        to_raster = QgsCoordinateTransform(start.sourceCrs(), crs, context.transformContext())
        places = []
        for feature in start.getFeatures():
            geometry = feature.geometry()
            geometry.transform(to_raster)
            places += [(vertex.x(), vertex.y()) for vertex in geometry.vertices()]
        if not places:
            raise QgsProcessingException("there are no points to start from")
        return places

    def _walk(self, parameters, context, feedback, ground, places):
        radius = np.inf
        if parameters.get(self.RADIUS) is not None:
            radius = self.parameterAsDouble(parameters, self.RADIUS, context)

        def report(share):
            feedback.setProgress(100 * share)
            if feedback.isCanceled():
                raise QgsProcessingException("cancelled")

        sources = ground.below(places)
        if self.parameterAsEnum(parameters, self.MEASURE, context) == 0:
            return ground.mesh.distance(sources, method="exact", radius=radius, progress=report)
        return ground.mesh.weighted(slope="tobler").distance(sources, radius=radius, progress=report)


def _write(path, values, like):
    """A GeoTIFF where `like` lies."""
    rows, columns = values.shape
    file = gdal.GetDriverByName("GTiff").Create(path, columns, rows, 1, gdal.GDT_Float32, ["COMPRESS=DEFLATE"])
    if file is None:
        raise QgsProcessingException(f"{path} cannot be written")
    file.SetGeoTransform(like.GetGeoTransform())
    file.SetProjection(like.GetProjection())
    band = file.GetRasterBand(1)
    band.SetNoDataValue(NOT_REACHED)
    band.WriteArray(np.where(np.isfinite(values), values, NOT_REACHED).astype(np.float32))
    file.FlushCache()
