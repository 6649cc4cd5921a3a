"""How to compute: the arguments that every distance call takes."""

from __future__ import annotations

from typing import Any

from brushfire._arrays import number, whole
from brushfire._errors import BrushfireError, BrushfireTypeError

Options = dict[str, "str | float"]

TOLERANT = "windows"


_MOST_THREADS = 4096


def thread_count(threads: Any) -> int:
    """A number of threads, checked."""
    return whole(threads, "threads", _MOST_THREADS)


def options(
    method: Any, tolerance: Any, radius: Any, bound: Any = None, precision: Any = None, threads: int = 1
) -> Options:
    """Those that were given, checked; a tolerance without a method means the one that keeps it."""
    chosen: Options = {"max_distance": number(radius, "radius"), "threads": thread_count(threads)}
    if tolerance is not None or bound is not None:
        if method not in (None, TOLERANT):
            raise BrushfireError(f"tolerance and bound are for method {TOLERANT!r}: {method!r} has none")
        method = TOLERANT
    if tolerance is not None:
        chosen["tolerance"] = number(tolerance, "tolerance")
    for name, value in (("method", method), ("bound", bound), ("precision", precision)):
        if value is None:
            continue
        if not isinstance(value, str):
            raise BrushfireTypeError(f"{name}: a string is needed, not {value!r}")
        chosen[name] = value
    return chosen
