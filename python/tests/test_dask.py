"""brushfire.dask: a cluster on loopback writes the bytes of one process, also when a worker is killed."""

from __future__ import annotations

import os
import signal
import threading
from pathlib import Path

import numpy as np
import pytest

import brushfire as bf

distributed = pytest.importorskip("distributed", reason="dask is not installed: pip install 'dask[distributed]'")


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(
            n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def sphere(turns: int, rings: int) -> bf.Mesh:
    """A closed one, of latitudes and longitudes."""
    up, around = np.meshgrid(np.pi * np.arange(1, rings) / rings, 2 * np.pi * np.arange(turns) / turns, indexing="ij")
    ring = np.stack([np.sin(up) * np.cos(around), np.sin(up) * np.sin(around), np.cos(up)], axis=-1).reshape(-1, 3)
    a = np.arange(turns * (rings - 2)).reshape(rings - 2, turns)
    b = np.roll(a, -1, axis=1)
    low = np.stack([a, b, a + turns], axis=-1).reshape(-1, 3)
    high = np.stack([b, b + turns, a + turns], axis=-1).reshape(-1, 3)
    south, north = len(ring), len(ring) + 1
    edge, last = np.arange(turns), turns * (rings - 2)
    caps = [[south, (k + 1) % turns, k] for k in edge] + [[north, last + k, last + (k + 1) % turns] for k in edge]
    return bf.Mesh(np.vstack([ring, [[0, 0, 1], [0, 0, -1]]]), np.vstack([low, high, caps]))


def files_of(store: Path) -> dict[str, bytes]:
    return {str(p.relative_to(store)): p.read_bytes() for p in sorted(store.rglob("*")) if p.is_file()}


def test_a_store_by_three_workers_of_which_one_is_killed_has_the_bytes_of_one_process(client, tmp_path):
    import brushfire.dask

    mesh = sphere(40, 24)
    alone, together = tmp_path / "alone.zarr", tmp_path / "together.zarr"
    mesh.write_distance_matrix(alone, method="exact", chunk_rows=50)
    victim = next(iter(client.run(os.getpid).values()))
    shares: list[float] = []
    killed = threading.Event()

    def kill_after_the_first_block(share: float) -> None:
        shares.append(share)
        if not killed.is_set():
            killed.set()
            os.kill(victim, signal.SIGKILL)

    found = brushfire.dask.distance_matrix(
        mesh, store=together, client=client, method="exact", chunk_rows=50, blocks=40, progress=kill_after_the_first_block
    )
    assert found == str(together)
    assert killed.is_set() and shares[0] < 0.5 and shares[-1] == 1.0  # it died in the midst
    assert files_of(together) == files_of(alone)


def test_a_worker_that_dies_while_the_mesh_is_sent_costs_a_second_try(client, tmp_path, monkeypatch):
    import brushfire.dask

    scatter, gone = client.scatter, [KeyError("tcp://127.0.0.1:1")]  # as the scheduler reports it

    def scatter_once_in_vain(*arguments, **options):
        if gone:
            raise gone.pop()
        return scatter(*arguments, **options)

    monkeypatch.setattr(client, "scatter", scatter_once_in_vain)
    mesh = sphere(12, 8)
    brushfire.dask.distance_matrix(mesh, store=tmp_path / "d.npy", client=client, blocks=4)
    assert not gone and np.array_equal(np.load(tmp_path / "d.npy"), mesh.distance_matrix())


def test_what_another_process_has_begun_is_gone_on_with_and_another_matrix_refused(client, tmp_path):
    import brushfire.dask

    mesh = sphere(12, 8)
    assert brushfire.dask.distance_matrix(mesh, store=tmp_path / "d.npy", client=client, symmetric="mean", blocks=4)
    matrix = np.load(tmp_path / "d.npy")
    assert np.array_equal(matrix, matrix.T) and np.allclose(matrix, mesh.distance_matrix(symmetric="mean"))
    with pytest.raises(bf.BrushfireError, match="no folder|No such file"):
        brushfire.dask.distance_matrix(mesh, store=tmp_path / "absent" / "d.npy", client=client, blocks=4)
    with pytest.raises(bf.BrushfireError, match="same places"):
        brushfire.dask.distance_matrix(mesh, [0, 1], [1, 2], store=tmp_path / "e.npy", client=client, symmetric="min")
