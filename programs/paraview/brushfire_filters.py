"""Brushfire's filters for ParaView: Tools, Manage Plugins, Load New, this file. They need ``pip install brushfire`` for
ParaView's own Python (``pvpython -m pip install brushfire``), or ``PYTHONPATH`` to where it is installed.

Geodesic Distance, Geodesic Path and Geodesic Isolines take a surface of triangles (Triangulate makes one; Extract
Surface before it, of a volume) and places that are dragged in the view: the nearest point of the surface counts.
"""

from __future__ import annotations

import numpy as np
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smproperty, smproxy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import brushfire as bf

METHODS = ["windows", "exact", "novotni-klein"]

# A place in the view that is dragged by its handle.
PLACE = """
<DoubleVectorProperty name="{name}" label="{label}" command="Set{name}" number_of_elements="3" default_values="0 0 0"
                      panel_visibility="default">
  <DoubleRangeDomain name="range"/>
  <Documentation>{what} The nearest point of the surface is taken.</Documentation>
</DoubleVectorProperty>
<PropertyGroup label="{label}" panel_widget="InteractiveHandle">
  <Property function="WorldPosition" name="{name}"/>
</PropertyGroup>"""


class _OnSurface(VTKPythonAlgorithmBase):
    """One surface in, one set of points and cells out."""

    def __init__(self) -> None:
        super().__init__(nInputPorts=1, nOutputPorts=1, inputType="vtkPolyData", outputType="vtkPolyData")

    def RequestData(self, request, inputs, outputs):  # VTK's name
        surface = vtkPolyData.GetData(inputs[0], 0)
        result = vtkPolyData.GetData(outputs, 0)
        try:
            self.compute(surface, bf.from_any(surface), result)
        except bf.BrushfireError as error:  # into ParaView's messages, not a Python traceback
            raise RuntimeError(f"Brushfire: {error}") from None
        return 1

    def change(self, name: str, value) -> None:
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()


@smproxy.filter(label="Geodesic Distance")
@smproperty.input(name="Input", port_index=0)
@smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)
class GeodesicDistance(_OnSurface):
    """The surface with the point data `distance`: from a place, or from vertices, along the surface; inf: no way."""

    place = (0.0, 0.0, 0.0)
    vertices = ""
    method = METHODS[0]

    @smproperty.xml(PLACE.format(name="Source", label="Source", what="Where distances start."))
    def SetSource(self, x, y, z):
        self.change("place", (x, y, z))

    @smproperty.stringvector(name="SourceVertices", default_values="")
    def SetSourceVertices(self, numbers):
        """Numbers of points, separated by blanks or commas; where there are some, the place does not count."""
        self.change("vertices", numbers or "")

    @smproperty.stringvector(name="MethodInfo", information_only="1")
    def GetMethods(self):
        return METHODS

    @smproperty.stringvector(name="Method", default_values=METHODS[0])
    @smdomain.xml(
        """<StringListDomain name="list"><RequiredProperties><Property name="MethodInfo" function="StringInfo"/>
        </RequiredProperties></StringListDomain>"""
    )
    def SetMethod(self, method):
        self.change("method", method)

    def compute(self, surface, mesh, result):
        sources = [int(n) for n in self.vertices.replace(",", " ").split()] or bf.at(self.place)
        distance = numpy_to_vtk(np.asarray(mesh.distance(sources, method=self.method), dtype=np.float64), deep=True)
        distance.SetName("distance")
        result.ShallowCopy(surface)
        result.GetPointData().AddArray(distance)
        result.GetPointData().SetActiveScalars("distance")


@smproxy.filter(label="Geodesic Path")
@smproperty.input(name="Input", port_index=0)
@smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)
class GeodesicPath(_OnSurface):
    """The shortest path between two places as a line; `distance` is the way from its start."""

    start, end = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)

    @smproperty.xml(PLACE.format(name="Start", label="Start", what="Where the path starts."))
    def SetStart(self, x, y, z):
        self.change("start", (x, y, z))

    @smproperty.xml(PLACE.format(name="End", label="End", what="Where the path ends."))
    def SetEnd(self, x, y, z):
        self.change("end", (x, y, z))

    def compute(self, surface, mesh, result):
        path = mesh.path(bf.at(self.start), bf.at(self.end))
        steps = np.linalg.norm(np.diff(path.positions, axis=0), axis=1)
        along = np.concatenate([np.zeros(min(1, len(path.positions))), np.cumsum(steps)])
        _draw(result, [(path, along)])


@smproxy.filter(label="Geodesic Isolines")
@smproperty.input(name="Input", port_index=0)
@smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)
class GeodesicIsolines(_OnSurface):
    """Curves at equal distance from a place, arcs drawn as arcs."""

    place = (0.0, 0.0, 0.0)
    count = 10

    @smproperty.xml(PLACE.format(name="Source", label="Source", what="Where distances start."))
    def SetSource(self, x, y, z):
        self.change("place", (x, y, z))

    @smproperty.intvector(name="Count", default_values=10)
    @smdomain.intrange(min=1, max=200)
    def SetCount(self, count):
        self.change("count", count)

    def compute(self, surface, mesh, result):
        found = mesh.curved_isolines(bf.at(self.place), count=self.count)
        _draw(result, [(line.line, np.full(len(line.line.positions), line.level)) for line in found])


def _draw(result, paths) -> None:
    """Polylines with their point data `distance`."""
    points, cells, distances = vtkPoints(), vtkCellArray(), []
    points.SetDataTypeToDouble()
    for path, distance in paths:
        first, count = points.GetNumberOfPoints(), len(path.positions)
        for position in path.positions:
            points.InsertNextPoint(*position)
        numbers = [*range(first, first + count), *([first] if path.closed else [])]
        if count:
            cells.InsertNextCell(len(numbers), numbers)
        distances.append(distance)
    array = numpy_to_vtk(np.concatenate([np.zeros(0), *distances]), deep=True)
    array.SetName("distance")
    result.SetPoints(points)
    result.SetLines(cells)
    result.GetPointData().SetScalars(array)
