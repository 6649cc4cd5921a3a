"""Triangles of VTK's data sets, whichever package wraps them. What is used of VTK the object has brought along."""

from __future__ import annotations

import importlib
import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire._errors import BrushfireError, BrushfireTypeError

Ints = npt.NDArray[np.int64]

# Cell types of VTK (vtkCellType.h).
_NO_SURFACE = {0, 1, 2, 3, 4}  # empty, vertices, lines
_TRIANGLE, _STRIP = 5, 6
_POLYGONS = {7: "polygons", 8: "pixels", 9: "quadrangles"}


def is_vtk(source: Any) -> bool:
    return _data_set(source) is not None


def _data_set(source: Any) -> Any:
    """The data set that is here or within a wrapper: vedo's ``dataset``, brainspace's ``VTKObject``."""
    for candidate in (source, getattr(source, "dataset", None), getattr(source, "VTKObject", None)):
        if callable(getattr(candidate, "IsA", None)) and callable(getattr(candidate, "GetClassName", None)):
            return candidate
    return None


def arrays_of_vtk(source: Any) -> tuple[Any, Ints]:
    """Points (n, 3), triangles (m, 3)."""
    data = _data_set(source)
    if data.IsA("vtkCompositeDataSet"):
        data = _only_surface(data)
    if data.IsA("vtkPolyData"):
        return _points(data), _triangles_of_polydata(data)
    if data.IsA("vtkUnstructuredGrid"):
        return _points(data), _triangles_of_grid(data)
    if data.IsA("vtkDataSet"):
        raise BrushfireError(f"a {data.GetClassName()} is no surface: its .extract_surface().triangulate() is one")
    held = (
        ".GetOutput()"
        if hasattr(data, "GetOutput")
        else ".GetMapper().GetInput()"
        if hasattr(data, "GetMapper")
        else ""
    )
    raise BrushfireTypeError(
        f"a {data.GetClassName()} is no data set" + (f": its {held} is what it shows" if held else "")
    )


def _to_numpy(array: Any) -> npt.NDArray[Any]:
    return np.asarray(importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy(array))


def _points(data: Any) -> npt.NDArray[Any]:
    points = data.GetPoints()
    return np.zeros((0, 3)) if points is None else _to_numpy(points.GetData())


def _cells(cells: Any) -> tuple[Ints, Ints]:
    """Offsets [cells + 1] and the numbers of the points."""
    if cells is None or cells.GetNumberOfCells() == 0:
        return np.zeros(1, dtype=np.int64), np.zeros(0, dtype=np.int64)
    offsets, numbers = _to_numpy(cells.GetOffsetsArray()), _to_numpy(cells.GetConnectivityArray())
    return offsets.astype(np.int64), numbers.astype(np.int64)


def _triangles_of_polydata(data: Any) -> Ints:
    offsets, numbers = _cells(data.GetPolys())
    if (np.diff(offsets) != 3).any():
        raise BrushfireError("polygons that are not triangles: triangulate() them first")
    strips = list(_strips(*_cells(data.GetStrips())))
    triangles = np.concatenate([numbers.reshape(-1, 3), *strips])
    if len(triangles) == 0:
        held = f"{data.GetNumberOfPoints()} points and {data.GetNumberOfLines()} lines"
        raise BrushfireError(f"a {data.GetClassName()} with {held} and no triangles: a surface is needed")
    return triangles


def _strips(offsets: Ints, numbers: Ints) -> Iterator[Ints]:
    """Every second triangle of a strip runs the other way round; those that repeat a point only steer it."""
    for begin, end in itertools.pairwise(offsets):
        strip = numbers[begin:end]
        rows = np.column_stack([strip[:-2], strip[1:-1], strip[2:]])
        rows[1::2] = rows[1::2, [1, 0, 2]]
        a, b, c = rows.T
        yield rows[(a != b) & (b != c) & (c != a)]


def _triangles_of_grid(data: Any) -> Ints:
    # The types of a grid of one kind of cells are not stored one by one in later versions.
    types = np.array([data.GetCellType(i) for i in range(data.GetNumberOfCells())], dtype=np.int64)
    others = sorted({int(t) for t in types} - _NO_SURFACE - {_TRIANGLE, _STRIP})
    if others and set(others) <= set(_POLYGONS):
        names = ", ".join(_POLYGONS[t] for t in others)
        raise BrushfireError(f"{names}: triangles are needed (.extract_surface().triangulate() makes them)")
    if others:
        raise BrushfireError("cells that are no triangles: the border, .extract_surface().triangulate(), is a surface")
    offsets, numbers = _cells(data.GetCells())
    starts = offsets[:-1][types == _TRIANGLE]
    single = numbers[starts[:, None] + np.arange(3)]
    strips = [s for i in np.flatnonzero(types == _STRIP) for s in _strips(offsets[i : i + 2], numbers)]
    triangles = np.concatenate([single, *strips])
    if len(triangles) == 0:
        raise BrushfireError(f"a {data.GetClassName()} with {len(types)} cells and no triangles: a surface is needed")
    return triangles


def _only_surface(composite: Any) -> Any:
    """The one block that has cells of a surface."""
    found = [leaf for leaf in _leaves(composite) if _is_surface(leaf)]
    if len(found) != 1:
        raise BrushfireError(
            f"a {composite.GetClassName()} with {len(found)} surfaces: one is needed, give that block alone"
        )
    return found[0]


def _leaves(composite: Any) -> Iterator[Any]:
    iterator = composite.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator.GetCurrentDataObject()
        iterator.GoToNextItem()


def _is_surface(leaf: Any) -> bool:
    if leaf is None or leaf.GetNumberOfCells() == 0:
        return False
    if leaf.IsA("vtkPolyData"):
        return bool(leaf.GetNumberOfPolys() + leaf.GetNumberOfStrips())
    return any(leaf.GetCellType(i) not in _NO_SURFACE for i in range(leaf.GetNumberOfCells()))
