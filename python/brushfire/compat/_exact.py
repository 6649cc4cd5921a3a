"""What the adapters share."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays
from brushfire._errors import BrushfireIndexError
from brushfire._mesh import Mesh

METHOD = "exact"

# What the originals say where they mean "without a limit".
GEODESIC_INF = 1e100


def indices(values: Any, count: int, what: str) -> _arrays.Ints:
    """Flat int64, all below ``count``; whole numbers may come as floats."""
    array = _arrays.any_array(values, what).ravel()
    if array.dtype.kind == "f" and array.size and _arrays.whole_numbers(array):
        array = array.astype(np.int64)
    numbers = _arrays.integers(array, what)
    for bad in numbers[(numbers < 0) | (numbers >= count)]:
        raise BrushfireIndexError(f"{what}: {bad} does not exist, there are {count}")
    return numbers


def whole_faces(faces: npt.ArrayLike) -> npt.NDArray[Any]:
    """Vertex numbers as they come out of text files: floats that are whole."""
    array = _arrays.any_array(faces, "faces")
    if array.dtype.kind == "f" and _arrays.whole_numbers(array):
        return array.astype(np.int64)
    return array


def in_faces(mesh: Mesh) -> npt.NDArray[np.bool_]:
    """Which vertices are in a face at all, (vertex_count,): from and to the others there is no way."""
    found = np.zeros(mesh.vertex_count, dtype=bool)
    found[mesh.faces] = True
    return found
