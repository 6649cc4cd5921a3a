"""The arrays that dense matrices are written to: numpy's, other libraries', half precision."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import floating_type
from brushfire._errors import BrushfireError, BrushfireTypeError


def float_type(dtype: npt.DTypeLike) -> np.dtype[Any]:
    """float32 or float64."""
    return floating_type(dtype)


def new_matrix(shape: tuple[int, int], dtype: npt.DTypeLike) -> npt.NDArray[Any]:
    wanted = np.dtype(np.float16) if _is_half(dtype) else float_type(dtype)
    if wanted == np.float16:
        _require_memory_of_halves(shape)
    else:
        _core.require_dense_memory(*shape, bool(wanted == np.float32), 0)
    return np.empty(shape, dtype=wanted)


def _is_half(dtype: npt.DTypeLike) -> bool:
    try:
        return bool(np.dtype(dtype) == np.float16)
    except TypeError:
        return False


def _require_memory_of_halves(shape: tuple[int, int]) -> None:
    try:
        _core.require_dense_memory(shape[0], (shape[1] + 1) // 2, True, 0)  # as many bytes
    except BrushfireError as error:
        raise BrushfireError(
            f"a {shape[0]} x {shape[1]} float16 matrix does not fit into memory: ask for fewer rows or columns, or for "
            "distances within a radius (sparse)",
            error.code,
        ) from None


def memory_of(out: Any) -> Any:
    """A numpy view of a torch tensor; anything else itself."""
    if hasattr(out, "detach") and hasattr(out, "numpy"):
        try:
            return out.detach().numpy()
        except (TypeError, RuntimeError) as error:  # of a GPU, or of a type that numpy has not
            raise BrushfireTypeError(f"out: {error}") from None
    return out


def fits_core(array: Any) -> bool:
    return isinstance(array, np.ndarray) and array.dtype != np.float16


def check_out(array: Any, shape: tuple[int, int]) -> None:
    if isinstance(array, (list, tuple)) or not all(hasattr(array, a) for a in ("shape", "dtype", "__setitem__")):
        raise BrushfireTypeError(f"out: an array that can be written to is needed, not {type(array).__name__}")
    if np.dtype(array.dtype) != np.float16:
        float_type(array.dtype)
    flags = getattr(array, "flags", None)
    plain = not isinstance(array, np.ndarray) or (array.flags.c_contiguous and array.flags.writeable)
    if tuple(array.shape) != shape or not plain:
        what = "a writable C-contiguous array" if flags is not None else "an array"
        raise BrushfireError(f"out: {what} of shape {shape} is needed, not {tuple(array.shape)}")


def as_type(block: npt.NDArray[Any], wanted: np.dtype[Any]) -> npt.NDArray[Any]:
    """Rounded; what has no place among the numbers of float16 is an error, neither infinity nor 0."""
    if wanted != np.float16:
        return block.astype(wanted, copy=False)
    rounded: npt.NDArray[Any]
    with np.errstate(over="ignore", under="ignore"):
        rounded = block.astype(np.float16)
    lost = (np.isinf(rounded) & np.isfinite(block)) | ((rounded == 0) & (block != 0))
    if lost.any():
        raise BrushfireError(f"float16: a distance of {block[lost][0]:g} is out of its range: ask for float32")
    return rounded
