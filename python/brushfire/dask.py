"""Distance matrices on a dask.distributed cluster: blocks of rows as tasks, one store that all workers write into.

>>> import brushfire.dask, dask.distributed  # doctest: +SKIP
>>> client = dask.distributed.Client("tcp://scheduler:8786")  # doctest: +SKIP
>>> brushfire.dask.distance_matrix(mesh, store="/shared/d.zarr", client=client)  # doctest: +SKIP
'/shared/d.zarr'

The mesh goes once to every worker. A block that is lost with its worker is computed by another one; rows that were there
already are kept, also those of an earlier run or of ``brushfire matrix`` with the same mesh and options. The bytes are
those of one machine alone (:doc:`/cluster`).
"""

from __future__ import annotations

import os
import threading
import time
from typing import Any

import numpy as np
import numpy.typing as npt
from distributed import Client, as_completed, get_client, get_worker

from brushfire import _core
from brushfire._arrays import path_text, whole
from brushfire._errors import BrushfireError
from brushfire._matrices import _MOST_ROWS, Symmetric, _check_symmetric, _optional, _pair, _symmetry
from brushfire._matrix_arrays import float_type
from brushfire._mesh import Mesh
from brushfire._options import Tolerance, options
from brushfire._places import Places
from brushfire._progress import Progress, shown

__all__ = ["distance_matrix"]

# Blocks for every thread of the cluster: so many that a lost one is little, and the last ones end together.
_BLOCKS_PER_THREAD = 16
# Of one block, and of its scattered mesh when all workers that had it are gone.
_TRIES = 5
_PAUSE = 1.0  # seconds between two of them


def distance_matrix(
    mesh: Mesh,
    rows: Places | None = None,
    columns: Places | None = None,
    *,
    store: str | os.PathLike[str],
    client: Client | None = None,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    radius: float = np.inf,
    precision: str | None = None,
    dtype: npt.DTypeLike = np.float32,
    symmetric: Symmetric | None = None,
    chunk_rows: int = 0,
    zarr_format: int = 3,
    blocks: int = 0,
    progress: Progress = None,
) -> str:
    """``Mesh.write_distance_matrix()`` by all workers of a cluster.

    :param store: a .zarr store or .npy file, under a path that is the same on every worker: on a disk that they share.
    :param client: of the cluster; the current one if none is given.
    :param blocks: tasks to cut the rows into; 0 means 16 for each thread of the cluster.
    :param progress: a function of the share of the blocks that are done, or True for a bar.
    :return: ``store``. The other arguments are those of ``Mesh.write_distance_matrix()``.
    :raises BrushfireError: as ``Mesh.write_distance_matrix()`` does, on the worker that was first.
    """
    where = client if client is not None else get_client()
    row, column = _optional(mesh, rows, "rows"), _optional(mesh, columns, "columns")
    if symmetric is not None:
        _check_symmetric(symmetric, row, column)
    arguments = (
        path_text(store), bool(float_type(dtype) == np.float32), *_pair(row), *_pair(column),
        options(method, tolerance, radius, bound, precision), _symmetry(symmetric),
        whole(chunk_rows, "chunk_rows", _MOST_ROWS), whole(zarr_format, "zarr_format", 3)
    )  # fmt: skip
    threads = sum(where.nthreads().values())
    if threads == 0:
        raise BrushfireError("the cluster has no workers")
    count = whole(blocks, "blocks", _MOST_ROWS) or _BLOCKS_PER_THREAD * threads
    with shown(progress, "matrix") as report:
        left = set(range(count))
        for attempt in range(_TRIES):
            part = _scattered(where, _Part(mesh, arguments))  # again where every worker that had it is gone
            tasks = {where.submit(_run_block, part, k, count, pure=False, retries=_TRIES): k for k in sorted(left)}
            _collect(tasks, left, count, report, last=attempt + 1 == _TRIES)
            if not left:
                where.submit(_finish, part, pure=False, retries=_TRIES).result()
                return path_text(store)
    raise AssertionError("the last try raises")


def _scattered(client: Client, part: _Part) -> Any:
    """On all workers; those that die meanwhile are waited for."""
    for _ in range(_TRIES - 1):
        try:
            return client.scatter(part, broadcast=True, hash=False)
        except (OSError, TimeoutError, KeyError):  # KeyError: of a worker that the scheduler no longer knows
            time.sleep(_PAUSE)
    return client.scatter(part, broadcast=True, hash=False)


def _collect(tasks: dict[Any, int], left: set[int], count: int, report: Any, *, last: bool) -> None:
    """Takes the blocks that are done out of `left`. What the job itself refuses is raised; what was lost, in the end."""
    for task in as_completed(tasks):
        if task.status == "finished":
            left.discard(tasks[task])
            if report is not None:
                report(1 - len(left) / count)
            continue
        failure = task.exception() if task.status == "error" else None
        if isinstance(failure, BrushfireError) or (last and failure is not None):
            for other in tasks:
                other.cancel()
            raise failure
        if last:
            raise BrushfireError("workers were lost again and again: see their logs; what is there is kept")


class _Part:
    """A worker's part in the job: the mesh, and the job once it has been joined. What is pickled is not joined yet."""

    def __init__(self, mesh: Mesh, arguments: tuple[Any, ...]) -> None:
        self._mesh, self._arguments = mesh, arguments
        self._job: _core.MatrixJob | None = None
        self._one_at_a_time = threading.Lock()

    def __reduce__(self) -> tuple[Any, ...]:
        return _Part, (self._mesh, self._arguments)

    def run_block(self, block: int, blocks: int, threads: int) -> int:
        with self._one_at_a_time:
            return self._joined(threads).run_block(block, blocks)

    def finish(self, threads: int) -> None:
        with self._one_at_a_time:
            self._joined(threads).run()

    def _joined(self, threads: int) -> _core.MatrixJob:
        if self._job is None:
            path, single, a, b, c, d, chosen, symmetric, chunk, layout = self._arguments
            self._job = _core.MatrixJob(
                self._mesh._space, path, single, a, b, c, d, chosen, threads, symmetric, chunk, layout
            )
        return self._job


def _run_block(part: _Part, block: int, blocks: int) -> int:
    return part.run_block(block, blocks, get_worker().state.nthreads)


def _finish(part: _Part) -> None:
    part.finish(get_worker().state.nthreads)
