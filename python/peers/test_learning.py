"""What learning on surfaces makes of potpourri3d: diffusion-net's operators and geomfum's metrics themselves, run on the
adapter. Both need torch, and are tried where they are installed (diffusion-net is a folder to put on PYTHONPATH)."""

from __future__ import annotations

import sys

import numpy as np
import pytest

pytest.importorskip("scipy")

from brushfire.compat import potpourri3d
from peer_meshes import hedgehog, original

V, F = hedgehog()
NAMES = ("frames", "mass", "L", "eigenvalues", "eigenvectors", "gradX", "gradY")


@pytest.fixture
def in_place(monkeypatch):
    there = original("potpourri3d")
    monkeypatch.setitem(sys.modules, "potpourri3d", potpourri3d)
    return there


def operators(geometry, torch, module):
    geometry.pp3d = module
    # Doubles: in floats the eigenvectors that the iteration ends at depend on the last bits.
    found = geometry.compute_operators(torch.tensor(V), torch.tensor(F.astype(np.int64)), k_eig=8)
    return [x.to_dense().numpy() if x.is_sparse else x.numpy() for x in found]


def test_the_operators_of_diffusion_net_are_those_of_the_original(in_place):
    torch = pytest.importorskip("torch")
    geometry = pytest.importorskip("diffusion_net.geometry")
    ours = operators(geometry, torch, potpourri3d)
    assert all(np.isfinite(x).all() for x in ours)
    if in_place is None:
        return
    for name, a, b in zip(NAMES, ours, operators(geometry, torch, in_place), strict=True):
        if name == "eigenvectors":  # up to their sign
            b = b * np.sign((a * b).sum(axis=0))
        assert np.allclose(a, b, rtol=1e-6, atol=1e-6 * np.abs(b).max()), name


def test_the_metrics_of_geomfum_are_distances(in_place):
    wrap = pytest.importorskip("geomfum.wrap.pp3d")
    shape = pytest.importorskip("geomfum.shape")
    mesh = shape.TriangleMesh(V, F)
    wrap.pp3d = potpourri3d
    metric = wrap.Pp3dMeshHeatDistanceMetric(mesh)
    row, _ = metric.dist_from_source(np.array(5))
    assert row[5] == 0
    assert metric.dist(np.array(5), np.array(90)) == row[90]
    matrix = np.asarray(metric.dist_matrix())
    assert np.allclose(matrix, matrix.T)
    mesh.equip_with_metric(wrap.Pp3dMeshHeatDistanceMetric)
    cloud = wrap.Pp3dPointSetHeatDistanceMetric(shape.PointCloud(V))
    assert np.isfinite(cloud.dist_from_source(np.array(5))[0]).all()
