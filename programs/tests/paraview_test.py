"""The filters in ParaView itself: pvpython programs/tests/paraview_test.py. Ends with a line that counts what held."""

import inspect
from pathlib import Path

import numpy.testing
from octahedron import FACES, OPPOSITE, SIDE, VERTICES  # beside this file: pvpython has no pytest
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

# Debian 12 has ParaView 5.11.0, whose loader of Python plug-ins asks for a function that Python 3.11 no longer has.
inspect.getargspec = getattr(inspect, "getargspec", inspect.getfullargspec)
simple.LoadPlugin(str(Path(__file__).parents[1] / "paraview/brushfire_filters.py"), remote=False, ns=vars(simple))


def close(found, right):
    numpy.testing.assert_allclose(found, right, rtol=1e-9, atol=1e-12)


def octahedron():
    return simple.ProgrammableSource(
        OutputDataSetType="vtkPolyData",
        Script=f"""
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray
points, faces = vtkPoints(), vtkCellArray()
points.SetDataTypeToDouble()
for p in {VERTICES}: points.InsertNextPoint(*p)
for f in {FACES}: faces.InsertNextCell(3, f)
self.GetPolyDataOutput().SetPoints(points)
self.GetPolyDataOutput().SetPolys(faces)
""",
    )


def result(filter_):
    filter_.UpdatePipeline()
    return servermanager.Fetch(filter_)


def distance_of(data):
    return vtk_to_numpy(data.GetPointData().GetArray("distance"))


def distances_from_a_place_and_from_vertices(surface):
    from_place = simple.GeodesicDistance(Input=surface, Source=[1.5, 0, 0], Method="exact")
    close(distance_of(result(from_place)), [0, OPPOSITE, SIDE, SIDE, SIDE, SIDE])
    from_vertices = simple.GeodesicDistance(Input=surface, SourceVertices="0, 1", Method="exact")
    close(distance_of(result(from_vertices)), [0, 0, SIDE, SIDE, SIDE, SIDE])


def a_property_that_changes_computes_anew(surface):
    filter_ = simple.GeodesicDistance(Input=surface, Source=[1, 0, 0], Method="exact")
    result(filter_)
    filter_.Source = [-1, 0, 0]
    close(distance_of(result(filter_))[:2], [OPPOSITE, 0])


def a_path_is_a_line(surface):
    data = result(simple.GeodesicPath(Input=surface, Start=[1, 0, 0], End=[-1, 0, 0]))
    assert data.GetNumberOfLines() == 1
    close(distance_of(data)[-1:], [OPPOSITE])


def isolines_are_lines_with_their_level(surface):
    data = result(simple.GeodesicIsolines(Input=surface, Source=[1, 0, 0], Count=3))
    assert data.GetNumberOfLines() == 3
    close(sorted(set(distance_of(data).tolist())), [OPPOSITE / 4, OPPOSITE / 2, 3 * OPPOSITE / 4])


if __name__ == "__main__":
    checks = [distances_from_a_place_and_from_vertices, a_property_that_changes_computes_anew, a_path_is_a_line,
              isolines_are_lines_with_their_level]  # fmt: skip
    for check in checks:
        check(octahedron())
        print("ok", check.__name__)
    print(f"{len(checks)} of {len(checks)} held in ParaView {simple.GetParaViewVersion()}")
