"""The adapters against the originals, where those are installed: same calls, same shapes, same numbers."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

pytest.importorskip("scipy")

from brushfire.compat import gdist as our_gdist
from brushfire.compat import igl as our_igl
from brushfire.compat import potpourri3d as our_pp3d
from brushfire.compat.pygeodesic import geodesic as our_pygeodesic

V, F = grid(14, 0.4)
F32 = F.astype(np.int32)
N = len(V)


def int32(*values: int) -> np.ndarray:
    return np.array(values, dtype=np.int32)


class TestGdist:
    @pytest.fixture(autouse=True)
    def original(self):
        self.gdist = pytest.importorskip("gdist", reason="the original gdist is not installed")

    @pytest.mark.parametrize("sources", [int32(0), int32(5, 100, 100), int32(N - 1)])
    def test_compute(self, sources):
        expected = self.gdist.compute_gdist(V, F32, source_indices=sources)
        assert np.allclose(our_gdist.compute_gdist(V, F32, source_indices=sources), expected, rtol=1e-10)

    def test_compute_to_targets_ignores_the_radius_as_the_original_does(self):
        arguments = {"source_indices": int32(3), "target_indices": int32(150, 4, 190), "max_distance": 2.0}
        expected = self.gdist.compute_gdist(V, F32, **arguments)
        assert np.allclose(our_gdist.compute_gdist(V, F32, **arguments), expected, rtol=1e-10)

    def test_compute_defaults(self):
        expected = self.gdist.compute_gdist(V, F32 + 1, is_one_indexed=True)
        assert np.allclose(our_gdist.compute_gdist(V, F32 + 1, is_one_indexed=True), expected, rtol=1e-10)

    def test_compute_up_to_a_radius(self):
        theirs = self.gdist.compute_gdist(V, F32, source_indices=int32(3), max_distance=4.0)
        ours = our_gdist.compute_gdist(V, F32, source_indices=int32(3), max_distance=4.0)
        assert np.allclose(ours[theirs <= 4], theirs[theirs <= 4], rtol=1e-10)
        assert np.isinf(ours[theirs > 4]).all()  # 1e100, or somewhat beyond the radius, in the original

    @pytest.mark.parametrize("radius", [2.5, 5.0, 1e100])
    def test_local_matrix(self, radius):
        theirs = self.gdist.local_gdist_matrix(V, F32, max_distance=radius)
        ours = our_gdist.local_gdist_matrix(V, F32, max_distance=radius)
        assert ours.format == theirs.format == "csc"
        assert ours.shape == theirs.shape
        assert ours.dtype == theirs.dtype
        assert ours.nnz == theirs.nnz
        assert np.array_equal(ours.indices, theirs.indices)
        assert np.array_equal(ours.indptr, theirs.indptr)
        assert np.allclose(ours.data, theirs.data, rtol=1e-10)

    @pytest.mark.parametrize("radius", [3.0, 1e100])
    def test_selected_points(self, radius):
        points = int32(2, 5, 10, 90, 91, 150)
        theirs = self.gdist.distance_matrix_of_selected_points(V, F32, points, max_distance=radius)
        ours = our_gdist.distance_matrix_of_selected_points(V, F32, points, max_distance=radius)
        assert ours.format == theirs.format == "csc"
        assert ours.shape == theirs.shape
        theirs = theirs.toarray()
        assert np.allclose(ours.toarray(), np.where(theirs > radius, 0, theirs), rtol=1e-10)


class TestIgl:
    def test_vertices_and_faces(self):
        igl = pytest.importorskip("igl", reason="the original igl is not installed")
        for sources, source_faces, targets, target_faces in (
            ([0], [], list(range(N)), []),
            ([7, 120], [], [3, 50], [0, 77]),
            ([], [33, 34], list(range(0, N, 5)), []),
            ([9], [200], [1], [2]),
            ([0], [], [], []),
        ):
            arrays = [np.array(a, dtype=np.int64) for a in (sources, source_faces, targets, target_faces)]
            expected = igl.exact_geodesic(V, F.astype(np.int64), *arrays)
            ours = our_igl.exact_geodesic(V, F, *arrays)
            assert ours.shape == expected.shape
            assert np.allclose(ours, expected, rtol=1e-7)


class TestPotpourri3d:
    @pytest.fixture(autouse=True)
    def original(self):
        self.pp3d = pytest.importorskip("potpourri3d", reason="the original potpourri3d is not installed")

    def test_heat_is_near_and_has_the_same_shape(self):
        theirs = self.pp3d.compute_distance(V, F, 20)
        ours = our_pp3d.compute_distance(V, F, 20)
        assert ours.shape == theirs.shape
        assert ours.dtype == theirs.dtype
        assert np.abs(ours - theirs).mean() < 0.1 * ours.mean()
        theirs = self.pp3d.MeshHeatMethodDistanceSolver(V, F, t_coef=1.0).compute_distance_multisource([3, 180])
        ours = our_pp3d.MeshHeatMethodDistanceSolver(V, F, t_coef=1.0).compute_distance_multisource([3, 180])
        assert ours[3] == ours[180] == 0
        assert np.abs(ours - theirs).mean() < 0.2 * ours.mean()

    @pytest.mark.parametrize(
        "curves", [[[(5, [])]], [[(40, [0.25])]], [[(333, [0.75])]], [[(3, []), (100, [0.5])]]], ids=str
    )
    def test_fast_marching_from_vertices_and_edges(self, curves):
        theirs = self.pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance(curves)
        ours = our_pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance(curves)
        assert ours[ours.argmin()] == pytest.approx(theirs[ours.argmin()], rel=1e-12)
        # First-order fast marching is several per cent too long on such a mesh.
        assert np.abs(ours - theirs).max() < 0.15 * ours.max()

    def test_fast_marching_from_a_face_begins_with_straight_distances_unlike_the_original(self):
        curves = [[(77, [0.2, 0.3, 0.5])]]
        straight = np.linalg.norm(V[F[77]] - [0.2, 0.3, 0.5] @ V[F[77]], axis=1)
        theirs = self.pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance(curves)
        ours = our_pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance(curves)
        assert np.allclose(ours[F[77]], straight, rtol=1e-12)
        assert np.abs(theirs[F[77]] - straight).max() > 0.1  # should this fail, the original has been mended
        assert np.abs(ours - theirs).max() < 0.15 * ours.max()

    def test_fast_marching_with_initial_distances(self):
        curves, distances = [[(0, [])], [(N - 1, [])]], [[1.0], [0.0]]
        theirs = self.pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance(curves, distances)
        ours = our_pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance(curves, distances)
        assert ours[0] == theirs[0] == 1.0
        assert np.abs(ours - theirs).max() < 0.15 * ours.max()


def test_where_the_originals_crash_there_is_an_index_error():
    for call in (
        lambda: our_gdist.compute_gdist(V, F32, source_indices=int32(N)),
        lambda: our_gdist.distance_matrix_of_selected_points(V, F32, int32(0, -1)),
        lambda: our_igl.exact_geodesic(V, F, VS=[0], FT=[len(F)]),
        lambda: our_pp3d.compute_distance(V, F, N),
        lambda: our_pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance([[(10**6, [0.5])]]),
    ):
        with pytest.raises(IndexError):
            call()


def test_unreachable_targets_read_infinity():
    v, f = np.vstack([V, V + 100]), np.vstack([F, F + N])
    assert our_igl.exact_geodesic(v, f, VS=[0], VT=[N]).tolist() == [np.inf]
    assert np.isinf(our_gdist.compute_gdist(v, f, source_indices=[0])[N:]).all()


class TestPygeodesic:
    @pytest.fixture(autouse=True)
    def original(self):
        module = pytest.importorskip("pygeodesic.geodesic", reason="the original pygeodesic is not installed")
        self.theirs = module.PyGeodesicAlgorithmExact(V, F)
        self.ours = our_pygeodesic.PyGeodesicAlgorithmExact(V, F)

    @pytest.mark.parametrize(("source", "target"), [(0, N - 1), (7, 8), (100, 20), (3, 3)])
    def test_distance_and_path(self, source, target):
        d, path = self.theirs.geodesicDistance(source, target)
        ours, our_path = self.ours.geodesicDistance(source, target)
        assert ours == pytest.approx(d, rel=1e-10, abs=1e-12)
        assert our_path.shape[1] == 3
        assert np.allclose(our_path[0], path[0])
        assert np.allclose(our_path[-1], path[-1])
        assert np.linalg.norm(np.diff(our_path, axis=0), axis=1).sum() == pytest.approx(ours, rel=1e-10, abs=1e-12)

    @pytest.mark.parametrize("targets", [None, [1, 2, 150], np.array([5])])
    def test_distances_and_best_sources(self, targets):
        expected, best = self.theirs.geodesicDistances(np.array([0, 77, N - 1]), targets)
        ours, our_best = self.ours.geodesicDistances(np.array([0, 77, N - 1]), targets)
        assert ours.dtype == expected.dtype
        assert our_best.dtype == best.dtype
        assert np.allclose(ours, expected, rtol=1e-10)
        assert (our_best == best).mean() > 0.98  # equally near sources: ours names the first


# Two pieces and a vertex in no face.
APART_V = np.vstack([V, V + 100, [[500, 500, 500]]])
APART_F = np.vstack([F32, F32 + N]).astype(np.int32)
ALONE = 2 * N


class TestWhatIsApart:
    @pytest.mark.parametrize(
        ("sources", "targets"),
        [
            (int32(ALONE), None),
            (int32(ALONE, 0), None),
            (int32(), None),
            (int32(), int32(1, 2)),
            (int32(0), int32(3, N, ALONE)),
            (int32(0), int32()),
            (None, int32(ALONE)),
        ],
        ids=str,
    )
    def test_gdist_reads_infinity_where_the_original_does(self, sources, targets):
        ours = our_gdist.compute_gdist(APART_V, APART_F, sources, targets)
        gdist = pytest.importorskip("gdist", reason="the original gdist is not installed")
        theirs = gdist.compute_gdist(APART_V, APART_F, sources, targets)
        assert ours.shape == theirs.shape
        assert np.allclose(ours, theirs, rtol=1e-10)

    @pytest.mark.parametrize("limit", [{}, {"max_distance": np.inf}, {"max_distance": 1e100}], ids=str)
    def test_gdist_without_a_limit_stores_infinity_for_what_no_way_joins(self, limit):
        matrix = our_gdist.local_gdist_matrix(APART_V, APART_F, **limit)
        full = bf.Mesh(APART_V, APART_F).distance_matrix(method="exact", dtype=float)
        np.fill_diagonal(full, 0)
        assert np.array_equal(matrix.toarray(), full.T)
        assert matrix.nnz == len(full) * (len(full) - 1)
        assert matrix.has_sorted_indices

    def test_gdist_with_a_limit_stores_what_is_within(self):
        matrix = our_gdist.local_gdist_matrix(APART_V, APART_F, max_distance=3.0)
        assert np.isfinite(matrix.data).all()
        assert 0 < matrix.data.max() <= 3

    @pytest.mark.parametrize("limit", [{}, {"max_distance": 4.0}], ids=str)
    def test_gdist_among_points(self, limit):
        points = int32(0, 3, 3, 100, N, ALONE)
        ours = our_gdist.distance_matrix_of_selected_points(APART_V, APART_F, points, **limit).toarray()
        gdist = pytest.importorskip("gdist", reason="the original gdist is not installed")
        theirs = gdist.distance_matrix_of_selected_points(APART_V, APART_F, int32(0, 3, 100, N, ALONE)).toarray()
        theirs[np.isfinite(theirs) & (theirs > limit.get("max_distance", np.inf))] = 0
        assert np.allclose(ours, theirs, rtol=1e-10)

    def test_pygeodesic_has_no_path_there(self):
        algorithm = our_pygeodesic.PyGeodesicAlgorithmExact(APART_V, APART_F)
        for target in (N, ALONE):
            distance, path = algorithm.geodesicDistance(0, target)
            assert distance == np.inf
            assert path.shape == (0, 3)
        distances, best = algorithm.geodesicDistances([ALONE, N, 0], [0, ALONE, N + 1, 0])
        assert distances.tolist()[:2] == [0, np.inf]
        assert best.tolist() == [2, -1, 1, 2]
        assert algorithm.geodesicDistances([ALONE])[1].tolist() == [-1] * (2 * N + 1)


class TestPygeodesicArguments:
    def test_what_is_left_out_is_vertex_0_and_no_limit(self):
        algorithm = our_pygeodesic.PyGeodesicAlgorithmExact(V, F.astype(float))
        d, best = algorithm.geodesicDistances()
        assert np.array_equal(d, algorithm.geodesicDistances([0])[0])
        assert not best.any()
        near, best = algorithm.geodesicDistances(np.array([0.0]), max_distance=4.0)
        assert np.array_equal(np.isfinite(near), d <= 4)
        assert np.array_equal(best, np.where(d <= 4, 0, -1))
        assert np.array_equal(algorithm.geodesicDistances([0], [5, 190], 4.0)[0], near[[5, 190]])

    def test_paths_lie_in_one_piece_of_memory(self):
        path = our_pygeodesic.PyGeodesicAlgorithmExact(V, F).geodesicDistance(0, N - 1)[1]
        assert path.flags.c_contiguous
        assert path.flags.writeable

    def test_the_package_has_a_version(self):
        from brushfire.compat import pygeodesic

        assert pygeodesic.__version__ == bf.__version__

    def test_faces_that_are_not_whole_are_refused(self):
        with pytest.raises((TypeError, bf.BrushfireError)):
            our_pygeodesic.PyGeodesicAlgorithmExact(V, F + 0.5)


@pytest.mark.skipif("heat" not in bf.methods(), reason="this build has no Eigen")
class TestIglHeat:
    @staticmethod
    def distance(module, sources, delaunay, *arguments, **named):
        data = module.HeatGeodesicsData()
        data.use_intrinsic_delaunay = delaunay
        module.heat_geodesics_precompute(V, F.astype(np.int64), *arguments, data=data, **named)
        return np.ravel(module.heat_geodesics_solve(data, np.array(sources, dtype=np.int64)))

    @pytest.mark.parametrize("delaunay", [False, True])
    def test_it_is_the_original_s_to_a_per_cent(self, delaunay):
        igl = pytest.importorskip("igl", reason="the original igl is not installed")
        for time in ({}, {"t": 2.0}):
            theirs, ours = (self.distance(m, [7], delaunay, **time) for m in (igl, our_igl))
            assert np.abs(ours - (theirs - theirs[7])).max() < 0.01 * ours.max()

    def test_every_source_reads_zero_and_arguments_come_by_place_and_name(self):
        ours = self.distance(our_igl, [3, 90, 150], True, t=2.0)
        assert ours[[3, 90, 150]].tolist() == [0, 0, 0]
        data = our_igl.HeatGeodesicsData()
        data.use_intrinsic_delaunay = True
        our_igl.heat_geodesics_precompute(V, F, 2.0, data)
        assert np.array_equal(our_igl.heat_geodesics_solve(data, [3, 90, 150]), ours)
        for wrong in ([], [1.0], [1.0, 2.0, data], [data, data]):
            with pytest.raises(TypeError, match="V, F"):
                our_igl.heat_geodesics_precompute(V, F, *wrong)
        with pytest.raises(bf.BrushfireError, match="precompute"):
            our_igl.heat_geodesics_solve(our_igl.HeatGeodesicsData(), [0])


class TestIglBefore26:
    expected = staticmethod(lambda **places: our_igl.exact_geodesic(V, F, **places))

    def test_the_order_of_before_is_recognised(self):
        vs, vt, fs, ft = [7], [3, 50], [9], [0, 77]
        both = self.expected(VS=vs, VT=vt)
        for call in (
            lambda: our_igl.exact_geodesic(V, F, vs, vt),
            lambda: our_igl.exact_geodesic(V, F, vs=vs, vt=vt),
            lambda: our_igl.exact_geodesic(V, F, vs, vt=vt),
        ):
            assert np.array_equal(call(), both)
        everything = self.expected(VS=vs, FS=fs, VT=vt, FT=ft)
        for call in (
            lambda: our_igl.exact_geodesic(V, F, vs, vt, fs=fs, ft=ft),
            lambda: our_igl.exact_geodesic(V, F, vs, vt, fs, ft=ft),
            lambda: our_igl.exact_geodesic(V, F, vs, fs, vt, ft),
            lambda: our_igl.exact_geodesic(V, F, vs, fs, VT=vt, FT=ft),
        ):
            assert np.array_equal(call(), everything)

    def test_what_cannot_be_meant_is_refused_by_name(self):
        for call in (
            lambda: our_igl.exact_geodesic(V, F, vs=[0], VT=[1]),
            lambda: our_igl.exact_geodesic(V, F, [0], VS=[1]),
            lambda: our_igl.exact_geodesic(V, F, [0], [1], [2], [3], [4]),
            lambda: our_igl.exact_geodesic(V, F, sources=[0]),
        ):
            with pytest.raises(TypeError, match="exact_geodesic"):
                call()


def test_potpourri3d_reads_arrays_that_may_be_written_to(tmp_path):
    bf.Mesh(V, F).save(tmp_path / "mesh.obj")
    vertices, faces = our_pp3d.read_mesh(tmp_path / "mesh.obj")
    assert vertices.flags.writeable
    assert faces.flags.writeable
    assert faces.dtype == np.int64
    vertices += 1
    faces += 0


def test_the_help_of_every_adapter_says_what_differs():
    for module in (our_gdist, our_igl, our_pp3d, our_pygeodesic):
        assert "ifferent" in module.__doc__, module.__name__
