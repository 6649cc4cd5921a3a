"""What the adapters share."""

from __future__ import annotations

from typing import Any

import numpy as np

from brushfire import _arrays
from brushfire._errors import BrushfireIndexError

METHOD = "exact"


def indices(values: Any, count: int, what: str) -> _arrays.Ints:
    """Flat int64, all below ``count``."""
    array = _arrays.integers(np.atleast_1d(values).ravel(), what)
    for bad in array[(array < 0) | (array >= count)]:
        raise BrushfireIndexError(f"{what}: {bad} does not exist, there are {count}")
    return array
