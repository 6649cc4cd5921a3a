"""progress=True: a bar where tqdm is installed, else a line on a terminal."""

from __future__ import annotations

import contextlib
import importlib
import sys
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

from brushfire._errors import BrushfireTypeError

Reporter: TypeAlias = Callable[[float], object]
Progress: TypeAlias = Reporter | bool | None
"""A function of the share of the work that is done, True for a bar, None or False for nothing."""


@contextlib.contextmanager
def shown(progress: Progress, what: str) -> Iterator[Reporter | None]:
    """What the compiled core calls with the share that is done; whatever it has opened is closed in the end."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        with _bar(what) as report:
            yield report
    elif callable(progress):
        yield progress
    else:
        raise BrushfireTypeError(f"progress: a function, True or None is needed, not {progress!r}")


@contextlib.contextmanager
def _bar(what: str) -> Iterator[Reporter]:
    try:
        tqdm = importlib.import_module("tqdm.auto").tqdm
    except ImportError:
        with _line(what) as report:
            yield report
        return
    layout = "{l_bar}{bar}| [{elapsed}<{remaining}]"
    with tqdm(total=1.0, desc=what, bar_format=layout) as bar:
        yield lambda share: _move(bar, share)


def _move(bar: Any, share: float) -> None:
    bar.update(max(0.0, share - bar.n))


@contextlib.contextmanager
def _line(what: str) -> Iterator[Reporter]:
    """Rewritten in place; nothing where nobody is watching."""
    stream = sys.stderr
    if not stream.isatty():
        yield lambda share: None
        return
    try:
        yield lambda share: print(f"\r{what} {100 * share:3.0f} %", end="", file=stream, flush=True)
    finally:
        print("\r\033[K", end="", file=stream, flush=True)
