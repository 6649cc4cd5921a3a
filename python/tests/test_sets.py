"""Sets of meshes give what single runs give."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import grid

import brushfire as bf


def meshes():
    return [bf.Mesh(*grid(n, 0.5)) for n in (5, 9, 7)]


@pytest.mark.parametrize("threads", [1, 2, 5])
@pytest.mark.parametrize("method", ["exact", "novotni-klein"])
def test_matrices_of_a_set_are_those_of_single_runs_to_the_bit(threads, method):
    single = [m.distance_matrix(method=method, threads=1) for m in meshes()]
    for a, b in zip(bf.distance_matrices(meshes(), method=method, threads=threads), single, strict=True):
        np.testing.assert_array_equal(a, b)


def test_files_are_read_and_written_by_name(tmp_path):
    for name, mesh in zip("abc", meshes(), strict=True):
        mesh.save(tmp_path / f"{name}.ply")
    paths = bf.distance_matrices(
        [tmp_path / f"{n}.ply" for n in "abc"], out=tmp_path / "out", dtype=np.float64, normalise=True
    )
    assert [p.name for p in paths] == ["a.npy", "b.npy", "c.npy"]
    for path, mesh in zip(paths, meshes(), strict=True):
        expected = mesh.distance_matrix(dtype=np.float64) / np.sqrt(mesh.area)
        np.testing.assert_array_equal(np.load(path), expected)
    assert not list((tmp_path / "out").glob("*.part"))


def test_two_files_of_one_name_are_refused(tmp_path):
    with pytest.raises(bf.BrushfireError, match="two are called 'a'"):
        bf.distance_matrices([tmp_path / "a.ply", tmp_path / "b" / "a.off"])


@pytest.mark.parametrize("threads", [1, 3])
def test_pairs_are_entries_of_the_matrix(threads, bumpy):
    pairs = np.random.default_rng(0).integers(0, bumpy.vertex_count, (200, 2))
    matrix = bumpy.distance_matrix(method="exact", dtype=np.float64)
    found = bumpy.pair_distances(pairs, method="exact", threads=threads)
    np.testing.assert_allclose(found, matrix[pairs[:, 0], pairs[:, 1]], rtol=1e-13)
    unit = bumpy.pair_distances(pairs, method="exact", normalise=True)
    np.testing.assert_allclose(unit * np.sqrt(bumpy.area), found, rtol=1e-13)
    assert bumpy.pair_distances(np.zeros((0, 2), int)).shape == (0,)


def test_pairs_of_another_shape_are_refused(bumpy):
    with pytest.raises(bf.BrushfireError, match="pairs"):
        bumpy.pair_distances([[1, 2, 3]])
    for wrong in (-1, bumpy.vertex_count, 2**40):
        with pytest.raises(bf.BrushfireIndexError):
            bumpy.pair_distances([[0, wrong]])


def test_a_surface_without_area_is_no_unit():
    line = bf.Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    for call in (
        lambda: bf.distance_matrices([line], normalise=True),
        lambda: line.pair_distances([[0, 1]], normalise=True),
    ):
        with pytest.raises(bf.BrushfireError, match="without area"):
            call()
