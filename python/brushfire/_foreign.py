"""Arrays of other libraries, sets, generators: whatever holds numbers becomes a numpy array. Nothing is imported for it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from collections.abc import Set as AbstractSet
from typing import Any

import numpy as np
import numpy.typing as npt


def on_this_side(values: Any) -> Any:
    """What numpy can look at: a tensor without its gradient and off its device, a column of pandas without its NA."""
    if hasattr(values, "detach") and hasattr(values, "cpu"):  # torch, and what is made like it
        return values.detach().cpu()
    if hasattr(values, "__cuda_array_interface__") and hasattr(values, "get"):  # cupy
        return values.get()
    nullable = getattr(getattr(values, "dtype", None), "numpy_dtype", None)  # pandas' own types: Int64, boolean
    if nullable is not None and hasattr(values, "to_numpy"):
        return values.to_numpy(dtype=nullable)
    return values


def is_loose(values: Any) -> bool:
    """Whether these are items that numpy does not look into: a set, a generator, the keys of a dict."""
    return (
        isinstance(values, Iterable)
        and not isinstance(values, (str, bytes, bytearray, memoryview, list, tuple, range, np.ndarray, Mapping))
        and not any(hasattr(values, name) for name in ("__array__", "__array_interface__", "__len__", "dtype"))
        or isinstance(values, AbstractSet)
    )


def listed(values: Iterable[Any]) -> list[Any]:
    """The items in their order; those of a set ascend where they can be compared."""
    if not isinstance(values, AbstractSet):
        return list(values)
    try:
        return sorted(values)
    except TypeError:
        return list(values)


def to_numpy(values: Any) -> npt.NDArray[Any]:
    """Raises what numpy, or the library that the values come from, raises."""
    return np.asarray(listed(values) if is_loose(values) else on_this_side(values))
