"""gdist's nine tests: compute_gdist (4), local_gdist_matrix (3), distance_matrix_of_selected_points, and with the original."""

from __future__ import annotations

import numpy as np
import pytest

scipy_sparse = pytest.importorskip("scipy.sparse")

from peer_meshes import flat, hedgehog, original, straight

from brushfire.compat import gdist


def int32(*values: int) -> np.ndarray:
    return np.array(values, dtype=np.int32)


def edge_length(v: np.ndarray, a: int, b: int) -> float:
    return float(np.linalg.norm(v[a] - v[b]))


def assert_symmetric(matrix, limit: float = np.inf) -> None:
    assert (abs(matrix - matrix.T) > 1e-6).nnz == 0
    assert np.max(matrix) <= limit


class TestComputeGdist:
    def test_flat(self):
        v, f = flat()
        d = gdist.compute_gdist(v, f, source_indices=int32(1), target_indices=int32(2))
        np.testing.assert_array_almost_equal(d, [0.2])

    def test_flat_counted_from_one(self):
        v, f = flat()
        d = gdist.compute_gdist(v, f + 1, int32(1), int32(2), is_one_indexed=True)
        np.testing.assert_array_almost_equal(d, [0.2])

    def test_flat_without_sources_and_targets(self):
        v, f = flat()
        np.testing.assert_array_almost_equal(gdist.compute_gdist(v, f, None, None), straight(v, 0))

    def test_hedgehog(self):
        v, f = hedgehog()
        a, b = f[0, 0], f[0, 1]
        d = gdist.compute_gdist(v, f, source_indices=int32(a), target_indices=int32(b))
        assert 0 < d[0] <= edge_length(v, a, b)
        if theirs := original("gdist"):
            assert np.allclose(d, theirs.compute_gdist(v, f, int32(a), int32(b)), rtol=1e-10)


class TestLocalGdistMatrix:
    @pytest.mark.parametrize("first", [0, 1])
    def test_flat(self, first):
        v, f = flat()
        matrix = gdist.local_gdist_matrix(v, f + first, is_one_indexed=bool(first))
        assert_symmetric(matrix)
        np.testing.assert_array_almost_equal(matrix.toarray()[1][0], 0.2)
        assert_symmetric(gdist.local_gdist_matrix(v, f + first, 0.3, bool(first)), 0.3)

    def test_hedgehog(self):
        v, f = hedgehog()
        a, b = f[0, 0], f[0, 1]
        matrix = gdist.local_gdist_matrix(v, f)
        assert_symmetric(matrix)
        assert 0 < matrix.toarray()[a][b] <= edge_length(v, a, b)
        near = gdist.local_gdist_matrix(v, f, 0.7)
        assert_symmetric(near, 0.7)
        whole = matrix.toarray()
        assert np.allclose(near.toarray(), np.where(whole <= 0.7, whole, 0), atol=1e-9)
        if theirs := original("gdist"):
            assert np.allclose(matrix.toarray(), theirs.local_gdist_matrix(v, f).toarray(), rtol=1e-9)


class TestDistanceMatrixOfSelectedPoints:
    def test_flat(self):
        v, f = flat()
        points = int32(2, 5, 10, 12, 14, 16)
        matrix = gdist.distance_matrix_of_selected_points(v, f, points)
        expected = np.zeros((len(v), len(v)))
        expected[np.ix_(points, points)] = [straight(v, p)[points] for p in points]
        np.testing.assert_array_almost_equal(matrix.toarray(), expected)
        assert_symmetric(matrix)
        assert matrix.nnz == len(points) * (len(points) - 1)
        assert type(matrix) is scipy_sparse.csc_matrix


def test_numbers_are_those_of_the_release():
    """Up to the limit: the release keeps some vertices a little beyond, and says 1e100 for the others."""
    theirs = pytest.importorskip("gdist")
    v, f = hedgehog()
    sources, targets = int32(0, 12, 150), np.arange(0, len(v), 7, dtype=np.int32)
    for given in ({}, {"max_distance": 0.9}, {"target_indices": targets}):
        ours = gdist.compute_gdist(v, f, source_indices=sources, **given)
        expected = theirs.compute_gdist(v, f, source_indices=sources, **given)
        assert ours.shape == expected.shape
        within = np.where(expected <= given.get("max_distance", 1e99), expected, np.inf)
        assert np.allclose(ours, within, rtol=1e-9)
    picked = [m.distance_matrix_of_selected_points(v, f, targets).toarray() for m in (gdist, theirs)]
    assert np.allclose(*picked, rtol=1e-9)
