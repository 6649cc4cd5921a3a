"""From what the caller has to the arrays that the compiled core takes: the rules of conversion, in one place."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire._errors import BrushfireError, BrushfireIndexError, BrushfireTypeError
from brushfire._foreign import to_numpy

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Labels = npt.NDArray[np.int32]


def path_text(path: Any, what: str = "path") -> str:
    """The name of a file."""
    try:
        text = os.fsdecode(path)
    except TypeError:
        raise BrushfireTypeError(f"{what}: the name of a file is needed, not {path!r}") from None
    if not text:
        raise BrushfireError(f"{what}: the name of a file is needed, not {path!r}")
    return text


def floating_type(dtype: Any) -> np.dtype[Any]:
    """float32 or float64."""
    try:
        wanted: np.dtype[Any] = np.dtype(dtype)
    except TypeError:
        raise BrushfireTypeError(f"dtype: float32 or float64 are possible, not {dtype!r}") from None
    if wanted not in (np.dtype(np.float32), np.dtype(np.float64)):
        raise BrushfireError(f"dtype: float32 or float64 are possible, not {wanted}")
    return wanted


def any_array(values: npt.ArrayLike, what: str) -> npt.NDArray[Any]:
    """As numpy understands it; arrays of other libraries too."""
    try:
        return to_numpy(values)
    except ValueError:  # rows of different lengths
        raise BrushfireTypeError(f"{what}: the rows do not form an array") from None


def floats(values: npt.ArrayLike, what: str) -> Floats:
    """C-contiguous float64: the array itself where it is one already, else a converted copy of any real numbers."""
    array = any_array(values, what)
    if array.size == 0:
        return np.zeros(array.shape)
    if array.dtype.kind not in "fiu":
        raise BrushfireTypeError(f"{what}: numbers are needed, not {array.dtype}")
    return np.asarray(array, dtype=np.float64, order="C")


def integers(values: npt.ArrayLike, what: str) -> Ints:
    """C-contiguous int64 of any integers. Floats are refused, whole numbers too: they are usually positions."""
    array = any_array(values, what)
    if array.size == 0:
        return np.zeros(array.shape, dtype=np.int64)
    if array.dtype.kind not in "iu":
        raise BrushfireTypeError(f"{what}: integers are needed, not {array.dtype}")
    if array.dtype == np.uint64 and array.max() > np.iinfo(np.int64).max:
        raise BrushfireIndexError(f"{what}: {array.max()} does not exist")
    return np.asarray(array, dtype=np.int64, order="C")


def whole_numbers(array: npt.NDArray[Any]) -> bool:
    """Whether all of these floats are integers that 64 bits hold."""
    return bool((np.abs(array) < 2.0**63).all() and (array == np.floor(array)).all())


def columns(array: npt.NDArray[Any], count: int, what: str) -> None:
    if array.ndim != 2 or array.shape[1] != count:
        raise BrushfireError(f"{what}: shape (n, {count}) is needed, not {array.shape}")


def triples(values: npt.ArrayLike, what: str) -> Floats:
    """(n, 3) float64."""
    array = floats(values, what)
    if array.size == 0:
        return np.zeros((0, 3))
    columns(array, 3, what)
    return array


def vertices(values: npt.ArrayLike) -> Floats:
    """(n, 3) float64; a flat mesh may come as (n, 2)."""
    array = floats(values, "vertices")
    if array.ndim == 2 and array.shape[1] == 2:
        array = np.column_stack([array, np.zeros(len(array))])
    return triples(array, "vertices")


def faces(values: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    """(m, 3) uint32: int32 and uint32 in C order are used as they are, other integers converted.

    Numbers of 32 bits are not looked at here: the mesh does that, and negative ones then read as too high to exist.
    """
    array = any_array(values, "faces")
    if array.size == 0:
        return np.zeros((0, 3), dtype=np.uint32)
    if array.dtype.kind not in "iu":
        raise BrushfireTypeError(f"faces: integers are needed, not {array.dtype}")
    columns(array, 3, "faces")
    if array.dtype not in (np.int32, np.uint32):
        check_faces(array)
        return np.ascontiguousarray(array).astype(np.uint32)
    return np.ascontiguousarray(array).view(np.uint32)


def check_faces(array: npt.NDArray[Any]) -> None:
    """Throws for a number that no vertex can have, with the number."""
    most = np.iinfo(np.int32).max
    if array.size and (array.min() < 0 or array.max() > most):
        bad = int(np.argmax((array < 0) | (array > most)))
        raise BrushfireError(f"face {bad // 3} names vertex {array.flat[bad]}, which cannot exist", "invalid_mesh")


def numbers(chosen: Any, count: int, what: str) -> Ints:
    """Of a mask or of numbers, flat."""
    array = any_array(chosen, what)
    if array.dtype == np.bool_:
        if array.shape != (count,):
            raise BrushfireError(f"{what}: a mask needs shape ({count},), not {array.shape}")
        return np.flatnonzero(array).astype(np.int64)
    numbers = integers(array, what)
    if numbers.ndim > 1 and numbers.size:
        raise BrushfireError(f"{what}: shape (k,) is needed, not {numbers.shape}")
    return numbers.reshape(-1)


def offsets(values: npt.ArrayLike, count: int) -> Floats:
    """(count,) float64; one number means the same for all."""
    array = floats(values, "offset")
    if array.ndim == 0:
        return np.full(count, array)
    if array.shape != (count,):
        raise BrushfireError(f"offset: one per source is needed, shape ({count},), not {array.shape}")
    return array


def number(value: Any, what: str) -> float:
    """A float of any real number; texts that look like one are not."""
    if isinstance(value, (bool, str, bytes, bytearray)):
        raise BrushfireTypeError(f"{what}: a number is needed, not {value!r}")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise BrushfireTypeError(f"{what}: a number is needed, not {value!r}") from None
    except OverflowError:
        raise BrushfireError(f"{what}: {value} is beyond the largest number") from None


def radius_of(value: Any, what: str = "radius") -> float:
    """A number >= 0, or +inf."""
    radius = number(value, what)
    if not radius >= 0:
        raise BrushfireError(f"{what}: a number >= 0 is needed, not {value!r}")
    return radius


def integer(value: Any, what: str) -> int:
    """Of Python or numpy; whole floats, truth values and texts are not."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise BrushfireTypeError(f"{what}: an integer is needed, not {value!r}")
    return int(value)


def whole(value: Any, what: str, most: int) -> int:
    """An integer from 0 to ``most``."""
    value = integer(value, what)
    if not 0 <= value <= most:
        raise BrushfireError(f"{what}: a number from 0 to {most} is needed, not {value}")
    return int(value)
