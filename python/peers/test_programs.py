"""What nine programs compute with these packages, by the calls that they make, against the originals where those are
installed: surfdist, torch_geometric, napari-stress, The Virtual Brain, fugw, slam, hippomaps, geomfum, compas_slicer; then
what others do that these do not."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy")

from peer_meshes import flat, hedgehog, original

import brushfire as bf
from brushfire.compat import gdist, igl, potpourri3d
from brushfire.compat.pygeodesic import geodesic

V, F = hedgehog()
N = len(V)
EVERY = np.arange(N)


def theirs(name, inner=None):
    """The original, or a reason to skip."""
    found = original(inner or name)
    if found is None:
        pytest.skip(f"{name} is not installed")
    return found


def test_surfdist_masks_the_cortex_and_takes_the_nearest_of_its_sources():
    """It numbers the vertices of the mask anew, computes, and puts the distances back; what is outside stays 0."""
    inside = np.flatnonzero(V[:, 2] > -0.5)
    number = np.full(N, -1)
    number[inside] = np.arange(len(inside))
    faces = number[F[(number[F] >= 0).all(axis=1)]].astype(np.int32)
    sources = np.array([0, 5, 9], dtype=np.int32)
    values = [m.compute_gdist(V[inside], faces, source_indices=sources) for m in (gdist, theirs("gdist"))]
    assert np.allclose(*values, rtol=1e-9)


@pytest.mark.parametrize("norm", [False, True])
@pytest.mark.parametrize("limit", [None, 0.9])
def test_torch_geometric_divides_by_the_square_root_of_the_area(norm, limit):
    """All pairs by one matrix, chosen ones by a call each. No limit is infinity there, which the release fails on."""
    unit = 1.0
    if norm:
        unit = np.sqrt(np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1).sum() / 2)
    pairs = np.array([(0, 7), (120, 4), (299, 299)], dtype=np.int32)
    found = []
    for module, unlimited in ((gdist, np.inf), (theirs("gdist"), 1e100)):
        reach = unlimited if limit is None else limit * unit
        matrix = module.local_gdist_matrix(V, F, reach).toarray() / unit
        chosen = [module.compute_gdist(V, F, p[:1], p[1:], reach)[0] / unit for p in pairs]
        found.append((matrix, chosen))
    assert np.allclose(found[0][0], found[1][0], rtol=1e-9)
    assert np.allclose(found[0][1], found[1][1], rtol=1e-9)


def test_tvb_makes_the_matrix_of_local_connections():
    ours, original_matrix = (
        m.local_gdist_matrix(V.astype(np.float64), F.astype(np.int32), max_distance=0.8)
        for m in (gdist, theirs("gdist"))
    )
    assert ours.nnz == original_matrix.nnz
    assert np.allclose(ours.toarray(), original_matrix.toarray(), rtol=1e-9)


def test_fugw_takes_rows_of_single_vertices():
    for i in (0, 17, 200):
        source = np.asarray([i], dtype=np.int32)
        values = [m.compute_gdist(V, F, source_indices=source) for m in (gdist, theirs("gdist"))]
        assert np.allclose(*values, rtol=1e-9)


def test_napari_stress_fills_a_triangle_row_by_row():
    """The last row asks for no target at all."""
    few = 12
    matrices = []
    for module in (geodesic, theirs("pygeodesic", "pygeodesic.geodesic")):
        algorithm, matrix = module.PyGeodesicAlgorithmExact(V, F), np.zeros((few, few))
        for i in range(few):
            if i + 1 < few:
                matrix[i, i + 1 :] = algorithm.geodesicDistances([i], np.arange(i + 1, few))[0]
        matrices.append(matrix)
    assert np.allclose(*matrices, rtol=1e-9)
    assert geodesic.PyGeodesicAlgorithmExact(V, F).geodesicDistances([few], np.arange(0))[0].shape == (0,)


def test_slam_asks_for_every_vertex_by_number_for_one_alone_and_for_discs():
    every = np.linspace(0, N - 1, N).astype(np.int32)
    source, one = np.array([31], dtype=np.int32), np.array([200], dtype=np.int32)
    ours, their = (
        (m.compute_gdist(V, F, source, every), m.compute_gdist(V, F, source, one), m.local_gdist_matrix(V, F, 0.6))
        for m in (gdist, theirs("gdist"))
    )
    assert np.allclose(ours[0], their[0], rtol=1e-9)
    assert np.allclose(ours[1], their[1], rtol=1e-9) and ours[1].shape == (1,)
    assert np.allclose(ours[2].toarray(), their[2].toarray(), rtol=1e-9)


def test_hippomaps_averages_profiles_over_the_disc_around_every_vertex():
    profiles = np.random.default_rng(3).normal(size=(N, 5))
    means = []
    for module in (geodesic, theirs("pygeodesic", "pygeodesic.geodesic")):
        algorithm = module.PyGeodesicAlgorithmExact(V, F)
        near = [algorithm.geodesicDistances(np.array([v]), None)[0] < 0.7 for v in range(0, N, 9)]
        means.append([profiles[n].mean(axis=0) for n in near])
    assert np.allclose(*means, rtol=1e-12)


def test_geomfum_stacks_rows_of_the_heat_method():
    """The adapter's rows are exact distances; told method="heat" they are the original's, which has a term against zeros
    on the diagonal in it that moves the fifth digit."""
    exact, heat = (potpourri3d.MeshHeatMethodDistanceSolver(V, F, method=m) for m in ("exact", "heat"))
    their = theirs("potpourri3d").MeshHeatMethodDistanceSolver(V, F)
    vertices = (0, 5, 250)
    rows, expected = (np.stack([s.compute_distance(v) for v in vertices]) for s in (heat, their))
    assert np.abs(rows - expected).max() < 2e-5 * expected.max()
    for v in vertices:
        assert np.allclose(exact.compute_distance(v), bf.Mesh(V, F).distance(v, method="exact"), rtol=1e-12)


def test_compas_slicer_gives_four_arrays_in_the_order_of_before():
    v, f = np.array(V.tolist()), np.array(F.tolist())
    ours = igl.exact_geodesic(v, f, np.array([0, 9]), EVERY)
    assert np.allclose(ours, igl.exact_geodesic(v, f, VS=[0, 9], VT=EVERY))
    named = theirs("igl").exact_geodesic(v, f, VS=np.array([0, 9]), VT=EVERY)
    assert np.allclose(ours, named, rtol=1e-7)


def test_cortical_packages_ask_one_source_for_all_vertices_and_for_a_path():
    ours = geodesic.PyGeodesicAlgorithmExact(V, F)
    their = theirs("pygeodesic", "pygeodesic.geodesic").PyGeodesicAlgorithmExact(V, F)
    for i in (3, 250):
        assert np.allclose(
            ours.geodesicDistances(np.array([i]), None)[0], their.geodesicDistances(np.array([i]), None)[0]
        )
    length, path = ours.geodesicDistance(3, 250)
    their_length, their_path = their.geodesicDistance(3, 250)
    assert length == pytest.approx(their_length, rel=1e-9)
    assert np.allclose(path[[0, -1]], their_path[[0, -1]])


def test_blender_nodes_write_the_names_small():
    v, f = flat()
    ours = igl.exact_geodesic(v, f.astype("i"), vs=np.array([60], dtype="i"), vt=np.arange(len(v), dtype="i"))
    assert np.allclose(ours, np.linalg.norm(v - v[60], axis=1))
