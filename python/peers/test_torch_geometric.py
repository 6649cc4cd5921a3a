"""torch_geometric's test of geodesic_distance(): with the calls of gdist that it makes, and, where torch is, itself."""

from __future__ import annotations

import sys
from multiprocessing.pool import ThreadPool

import numpy as np
import pytest

pytest.importorskip("scipy")

from brushfire.compat import gdist

POS = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [2, 2, 0]], dtype=float)
FACE = np.array([[0, 1, 3], [0, 2, 3]], dtype=np.int32)
DIAGONAL = np.sqrt(2)
EXPECTED = np.array([[0, 1, 1, DIAGONAL], [1, 0, DIAGONAL, 1], [1, DIAGONAL, 0, 1], [DIAGONAL, 1, 1, 0]])


def geodesic_distance(src=None, dst=None, norm=True, max_distance=None, workers=0):
    """Its calls: the matrix where nothing is chosen, else pair by pair; lengths in units of the square root of the area."""
    limit = float("inf") if max_distance is None else max_distance
    scale = 2.0 if norm else 1.0
    if src is None and dst is None:
        return gdist.local_gdist_matrix(POS, FACE, limit * scale).toarray() / scale
    src = np.arange(len(POS), dtype=np.int32) if src is None else src

    def one(i):
        goal = None if dst is None else dst[i : i + 1]
        return gdist.compute_gdist(POS, FACE, src[i : i + 1], goal, limit * scale) / scale

    if workers:
        with ThreadPool(workers) as pool:
            found = pool.map(one, range(len(src)))
    else:
        found = [one(i) for i in range(len(src))]
    return np.concatenate(found) if dst is not None else np.stack(found)


def test_all_pairs_with_the_default_of_no_limit():
    assert np.allclose(geodesic_distance(), EXPECTED)
    assert np.allclose(geodesic_distance(norm=False), 2 * EXPECTED)


def test_chosen_pairs():
    src, dst = np.zeros(4, dtype=np.int32), np.arange(4, dtype=np.int32)
    for workers in (0, 2):
        assert np.allclose(geodesic_distance(src, dst, workers=workers), EXPECTED[0])
        assert np.allclose(geodesic_distance(dst=dst, workers=workers), 0)
        assert np.allclose(geodesic_distance(src=dst, workers=workers), EXPECTED)


def test_the_function_itself_runs_on_the_adapter(monkeypatch):
    torch = pytest.importorskip("torch")
    utils = pytest.importorskip("torch_geometric.utils")
    monkeypatch.setitem(sys.modules, "gdist", gdist)
    pos, face = torch.tensor(POS), torch.tensor(FACE.T.astype(np.int64))
    assert np.allclose(utils.geodesic_distance(pos, face).numpy(), EXPECTED)
    dst = torch.arange(4)
    assert np.allclose(
        utils.geodesic_distance(pos, face, src=torch.zeros(4, dtype=torch.long), dst=dst).numpy(), EXPECTED[0]
    )
