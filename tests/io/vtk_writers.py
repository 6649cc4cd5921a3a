#!/usr/bin/env python3
"""Every file that VTK's own writers make is read, with its points and faces.

    vtk_writers.py FILE_PROBE VENV_FOLDER

XML PolyData (with strips, lines, vertices, bits, strings and information keys) and UnstructuredGrid: data mode x
encoding x compressor x header type x byte order x number of triangles, so that arrays have all lengths mod 3; legacy
files of versions 4.2 and 5.1, as text and binary. VTK is installed from PyPI into VENV_FOLDER where Python lacks it;
where it cannot be had the script says so and exits with 77, which ctest counts as skipped.
"""
import itertools
import os
import subprocess
import sys
import tempfile

from environment import enter_environment

PACKAGES = ["numpy", "vtk"]
TEXT = 1e-9  # text that VTK writes does not have all digits
SIZES = [0, 1, 2, 3, 4, 5, 6, 7, 40, 3000]

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk
except ImportError:
    enter_environment(sys.argv[2], PACKAGES, "BRUSHFIRE_VTK_WRITERS", "VTK")

probe = os.path.abspath(sys.argv[1])
folder = tempfile.TemporaryDirectory()
failures = []
left_out = set()
checks = 0


def fan(n):
    """The points and faces of n triangles around point 0."""
    angle = 0.1 * np.arange(n + 1)
    points = np.vstack([np.zeros((1, 3)), np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)])
    return points, [(0, k + 1, k + 2) for k in range(n)]


def cells(lists):
    array = vtk.vtkCellArray()
    for corners in lists:
        array.InsertNextCell(len(corners), corners)
    return array


def points_of(points):
    out = vtk.vtkPoints()
    out.SetDataTypeToDouble()
    out.SetData(numpy_to_vtk(points, deep=1))
    return out


def poly_data(n, with_more):
    """A fan, with_more: and two triangles of a strip, a line and a vertex."""
    points, faces = fan(n)
    data = vtk.vtkPolyData()
    data.SetPoints(points_of(points))
    data.SetPolys(cells(faces))
    if with_more and n >= 2:
        data.SetStrips(cells([(0, 1, 2, 3)]))
        data.SetLines(cells([(0, 1)]))
        data.SetVerts(cells([(0,)]))
        faces = faces + [(0, 1, 2), (2, 1, 3)]
    vectors = numpy_to_vtk(np.arange(3.0 * (n + 2)).reshape(-1, 3), deep=1)
    vectors.SetName("three of them")
    vectors.SetComponentName(0, "x")
    strings, bits = vtk.vtkStringArray(), vtk.vtkBitArray()
    for array, name in ((strings, "strings"), (bits, "bits")):
        array.SetName(name)
        for k in range(n + 2):
            array.InsertNextValue(f"word {k}" if array is strings else k % 2)
        data.GetPointData().AddArray(array)
    data.GetPointData().AddArray(vectors)
    return data, points, faces


def grid(n):
    """The same fan with a quadrangle, a pixel, a line and a tetrahedron."""
    points, faces = fan(n)
    data = vtk.vtkUnstructuredGrid()
    data.SetPoints(points_of(points))
    data.Allocate(n)
    for f in faces:
        data.InsertNextCell(vtk.VTK_TRIANGLE, 3, f)
    if n >= 4:
        for kind in (vtk.VTK_QUAD, vtk.VTK_TETRA, vtk.VTK_PIXEL):
            data.InsertNextCell(kind, 4, (0, 1, 2, 3))
        data.InsertNextCell(vtk.VTK_LINE, 2, (0, 1))
        faces = faces + [None] * 4  # two quadrangles; how they are cut is not VTK's to say
    return data, points, faces


def compare(name, points, faces, tolerance=0.0):
    global checks
    checks += 1
    out = os.path.join(folder.name, "out")
    path = os.path.join(folder.name, name)
    done = subprocess.run([probe, "mesh", path, out], capture_output=True, text=True)
    if "built without it" in done.stderr:  # LZ4 and LZMA are optional
        left_out.add(done.stderr.split("compressed with ")[1].split(",")[0])
        checks -= 1
        return
    if done.returncode:
        failures.append(f"{name}: {done.stderr.strip()}")
        return
    read_points, read_faces = np.load(out + ".positions.npy"), np.load(out + ".faces.npy")
    known = [f for f in faces if f is not None]
    read_points = read_points.reshape(-1, 3)
    if read_points.shape != points.shape or np.abs(read_points - points).max(initial=0) > tolerance:
        failures.append(f"{name}: other points")
    if len(read_faces) != len(faces) or [tuple(f) for f in read_faces[:len(known)]] != known:
        failures.append(f"{name}: other faces")


def write(writer, name, data):
    writer.SetInputData(data)
    writer.SetFileName(os.path.join(folder.name, name))
    writer.Write()


def made(kind, n):
    return grid(n) if kind == "grid" else poly_data(n, kind == "strips")


def xml_files():
    modes = {"ascii": (vtk.vtkXMLWriter.Ascii, 0), "inline": (vtk.vtkXMLWriter.Binary, 0),
             "raw": (vtk.vtkXMLWriter.Appended, 0), "base64": (vtk.vtkXMLWriter.Appended, 1)}
    compressors = {"none": "None", "zlib": "ZLib", "lz4": "LZ4", "lzma": "LZMA"}
    for mode, compressor, header, n, kind in itertools.product(modes, compressors, (32, 64), SIZES,
                                                               ("poly", "strips", "grid")):
        data, points, faces = made(kind, n)
        writer = vtk.vtkXMLUnstructuredGridWriter() if kind == "grid" else vtk.vtkXMLPolyDataWriter()
        writer.SetDataMode(modes[mode][0])
        writer.SetEncodeAppendedData(modes[mode][1])
        getattr(writer, f"SetCompressorTypeTo{compressors[compressor]}")()
        getattr(writer, f"SetHeaderTypeToUInt{header}")()
        if n % 2:
            writer.SetByteOrderToBigEndian()
        name = f"{mode}-{compressor}-{header}-{kind}-{n}.{'vtu' if kind == 'grid' else 'vtp'}"
        write(writer, name, data)
        compare(name, points, faces, tolerance=TEXT if mode == "ascii" else 0)


def legacy_files():
    for version, binary, n, kind in itertools.product((42, 51), (0, 1), SIZES, ("poly", "strips", "grid")):
        data, points, faces = made(kind, n)
        writer = vtk.vtkUnstructuredGridWriter() if kind == "grid" else vtk.vtkPolyDataWriter()
        writer.SetFileVersion(version)
        writer.SetFileType(vtk.VTK_BINARY if binary else vtk.VTK_ASCII)
        name = f"legacy-{version}-{binary}-{kind}-{n}.vtk"
        write(writer, name, data)
        compare(name, points, faces, tolerance=0 if binary else TEXT)


xml_files()
legacy_files()
print(f"{checks - len(set(f.split(':')[0] for f in failures))} of {checks} files are read as VTK "
      f"{vtk.vtkVersion().GetVTKVersion()} wrote them")
if left_out:
    print(f"left out, because the library was built without: {', '.join(sorted(left_out))}")
print("\n".join(failures[:40]))
sys.exit(1 if failures else 0)
