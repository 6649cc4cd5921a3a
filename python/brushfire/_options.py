"""How to compute: the arguments that every distance call takes."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from brushfire._arrays import number, radius_of, whole
from brushfire._errors import BrushfireError, BrushfireTypeError

Options = dict[str, Any]

Tolerance: TypeAlias = "float | Literal['draft', 'standard', 'fine', 'exact']"
"""The relative error that ``windows`` keeps at every vertex, 0 to 0.1, or a word for it."""

TOLERANT = "windows"
_IN_WORDS = {"draft": 1e-2, "standard": 1e-3, "fine": 1e-5, "exact": 0.0}

_MOST_THREADS = 4096


def thread_count(threads: Any) -> int:
    """A number of threads, checked."""
    return whole(threads, "threads", _MOST_THREADS)


def tolerance_of(value: Any) -> float:
    """A tolerance as a number."""
    if not isinstance(value, str):
        return number(value, "tolerance")
    if value not in _IN_WORDS:
        raise BrushfireTypeError(
            f"tolerance: a number from 0 to 0.1, or one of {', '.join(_IN_WORDS)} is needed, not {value!r}"
        )
    return _IN_WORDS[value]


def options(
    method: Any, tolerance: Any, radius: Any, bound: Any = None, precision: Any = None, threads: int = 1
) -> Options:
    """Those that were given, checked; a tolerance without a method means the one that keeps it."""
    chosen: Options = {"max_distance": radius_of(radius), "threads": thread_count(threads)}
    if tolerance is not None or bound is not None:
        if method not in (None, TOLERANT):
            raise BrushfireError(f"tolerance and bound are for method {TOLERANT!r}: {method!r} has none")
        method = TOLERANT
    if tolerance is not None:
        chosen["tolerance"] = tolerance_of(tolerance)
    for name, value in (("method", method), ("bound", bound), ("precision", precision)):
        if value is None:
            continue
        if not isinstance(value, str):
            raise BrushfireTypeError(f"{name}: a string is needed, not {value!r}")
        chosen[name] = value
    return chosen
