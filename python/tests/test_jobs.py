"""Matrices on disk: killed and gone on with, and opened by the libraries that people use."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

WRITE = """
import sys, brushfire as bf
bf.read(sys.argv[1]).write_distance_matrix(
    sys.argv[2], method="exact", threads=1, chunk_rows=int(sys.argv[3]), progress=lambda share: print(share, flush=True)
)
"""


@pytest.mark.parametrize("name", ["d.npy", "d.zarr"])
def test_a_job_that_is_killed_again_and_again_ends_in_the_same_bytes(tmp_path, name):
    mesh = bf.Mesh(*grid(24, 0.5))
    mesh.save(tmp_path / "m.ply")
    chunk = 0 if name == "d.npy" else 30
    whole, killed = tmp_path / f"whole.{name}", tmp_path / name
    mesh.write_distance_matrix(whole, method="exact", chunk_rows=chunk)
    randomly = random.Random(7)
    command = [sys.executable, "-c", WRITE, str(tmp_path / "m.ply"), str(killed), str(chunk)]
    shares = []
    for _ in range(3):
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            shares.append(process.stdout.readline())  # it is at work
            time.sleep(randomly.uniform(0, 0.02))
            process.send_signal(signal.SIGKILL)
    assert float(shares[0]) < 1
    assert mesh.write_distance_matrix(killed, method="exact", chunk_rows=chunk) == str(killed)
    files = [p.relative_to(whole) for p in whole.rglob("c/*/*")] or [""]
    for file in files:
        assert (whole / file).read_bytes() == (killed / file).read_bytes()
    assert not (tmp_path / (name + ".part.rows")).exists()


@pytest.mark.parametrize("zarr_format", [2, 3])
def test_zarr_and_xarray_open_a_store(bumpy, tmp_path, zarr_format):
    zarr, xarray = pytest.importorskip("zarr"), pytest.importorskip("xarray")
    rows = [5, 3, 99]
    path = bumpy.write_distance_matrix(
        tmp_path / "d.zarr", rows, method="dijkstra", chunk_rows=2, zarr_format=zarr_format
    )
    expected = bumpy.distance_matrix(rows, method="dijkstra")
    array = zarr.open(path, mode="r")["distance"]
    assert array.shape == expected.shape and array.chunks == (2, bumpy.vertex_count)
    assert np.array_equal(array[:], expected)
    data = xarray.open_zarr(path)
    assert data.distance.dims == ("row", "column") and data.row.values.tolist() == rows
    assert np.array_equal(data.distance.sel(row=99).values, expected[2])
    assert float(data.distance.sel(row=3, column=50)) == expected[1, 50]


def test_numpy_and_scipy_open_files(bumpy, tmp_path):
    sparse = pytest.importorskip("scipy.sparse")
    path = bumpy.write_distance_matrix(tmp_path / "d.npy", method="dijkstra", symmetric="min")
    memory = np.load(path, mmap_mode="r")
    assert isinstance(memory, np.memmap) and np.array_equal(memory, bumpy.distance_matrix(method="dijkstra", symmetric="min"))
    near = bumpy.distances_within(0.4, method="dijkstra")
    bf.write(tmp_path / "near.npz", near)
    assert (sparse.load_npz(tmp_path / "near.npz") != near).nnz == 0


def test_sorted_rows_and_indices_are_those_that_brainsmash_makes(bumpy, tmp_path):
    n = bumpy.vertex_count
    path = bumpy.write_distance_matrix(tmp_path / "d.npy", method="exact", nearest=n)
    dense = bumpy.distance_matrix(method="exact")
    order = np.argsort(dense, axis=1, kind="stable")
    distance, index = np.load(path, mmap_mode="r"), np.load(tmp_path / "d.index.npy", mmap_mode="r")
    assert distance.dtype == np.float32 and index.dtype == np.int32
    assert np.array_equal(index, order)
    assert np.array_equal(distance, np.take_along_axis(dense, order, axis=1))
    sampled = pytest.importorskip("brainsmash.mapgen", reason="brainsmash is not installed").Sampled
    values = np.random.default_rng(1).normal(size=n)
    surrogate = sampled(values, distance, index, ns=n // 2, knn=n // 2, seed=1)
    assert surrogate.D.shape[0] == n


def test_the_nearest_few_of_chosen_columns(bumpy, tmp_path):
    columns = np.arange(0, bumpy.vertex_count, 9)
    bumpy.write_distance_matrix(tmp_path / "d.npy", [4, 8], columns, method="exact", nearest=3)
    dense = bumpy.distance_matrix([4, 8], columns, method="exact")
    order = np.argsort(dense, axis=1, kind="stable")[:, :3]
    assert np.array_equal(np.load(tmp_path / "d.index.npy"), order)
    with pytest.raises(bf.BrushfireError, match="ask for fewer"):
        bumpy.write_distance_matrix(tmp_path / "e.npy", [4], columns, nearest=len(columns) + 1)
