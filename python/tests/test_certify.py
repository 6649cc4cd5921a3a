"""Certificates: planted errors are found, right values are left alone, and other tools' fields are judged."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import grid


@pytest.fixture(scope="module")
def hills() -> bf.Mesh:
    v, f = grid(21)
    v = v / 20.0
    return bf.Mesh(np.column_stack([v[:, 0], v[:, 1], 0.3 * np.sin(7 * v[:, 0]) * np.cos(5 * v[:, 1])]), f)


def finding(certificate: bf.Certificate, vertex: int) -> str:
    return certificate.findings[certificate.finding[vertex]]


def test_an_exact_field_is_not_proven_wrong(hills):
    d = hills.distance(3, method="exact")
    for tolerance in (0, 1e-4, 1e-2):
        c = hills.certify(d, 3, tolerance=tolerance)
        assert c.proven_wrong == 0 and c.possible == hills.vertex_count and c.worst_vertex == -1
        assert (c.lower <= d).all() and (d <= c.upper).all()
        assert c.max_gap <= 2 * tolerance + 1e-11
        assert c.wrong_vertices.size == 0 and not c.proven_error.any()
    assert str(c).startswith("nothing is proven wrong")


@pytest.mark.parametrize("by, what", [(1.002, "too long"), (0.998, "too short")])
def test_one_vertex_moved_by_two_per_mille_is_found(hills, by, what):
    d = hills.distance(3, method="exact")
    moved = d.copy()
    moved[200] *= by
    c = hills.certify(moved, 3)
    assert c.wrong_vertices.tolist() == [200]
    assert finding(c, 200) == what
    assert c.proven_error[200] == pytest.approx(moved[200] - d[200], rel=1e-6)
    assert c.least_within == pytest.approx(0.002, rel=1e-5)
    assert hills.certify(moved, 3, within=0.0021).proven_wrong == 0
    assert str(c) == f"proven wrong: 1 of {hills.vertex_count} vertices cannot be right"


def test_zero_where_nothing_leads_is_wrong():
    v, f = grid(6)
    mesh = bf.Mesh(np.vstack([v, v + [100, 0, 0]]), np.vstack([f, f + len(v)]))
    d = mesh.distance(0, method="exact")
    c = mesh.certify(np.where(np.isinf(d), 0, d), 0, within=1.0)
    assert c.not_reachable == len(v) == c.proven_wrong
    assert np.isneginf(c.proven_error[len(v) :]).all()
    assert np.isinf(c.lower[len(v) :]).all() and c.least_within == np.inf


def test_nan_and_missing_values_are_wrong(hills):
    d = hills.distance(3, method="exact")
    d[[5, 6, 7]] = [np.nan, np.inf, -1]
    c = hills.certify(d, 3)
    assert [finding(c, v) for v in (5, 6, 7)] == ["not a number", "not reached", "too short"]
    near = hills.distance(3, method="exact", radius=0.4)
    assert np.isinf(near).any()
    assert hills.certify(near, 3, radius=0.4).proven_wrong == 0
    assert hills.certify(near, 3).not_reached > 0


def test_sources_with_offsets_and_points(hills):
    sources = [bf.Point(5, (0.2, 0.3, 0.5)), bf.Point(300, (0.1, 0.1, 0.8))]
    d = hills.distance(sources, method="exact", offset=[2, 1.9])
    assert hills.certify(d, sources, offset=[2, 1.9]).proven_wrong == 0
    assert hills.certify(d, sources, offset=[2, 1.8]).proven_wrong > 0


def test_our_own_methods_keep_what_they_promise(hills):
    assert hills.certify(hills.distance(3, tolerance=1e-2), 3, within=1e-2).proven_wrong == 0
    edges = hills.certify(hills.distance(3, method="dijkstra"), 3)
    assert edges.too_long > 0 and edges.too_short == 0


def test_the_heat_method_is_found(hills):
    solvers = pytest.importorskip("potpourri3d")
    v, f = np.array(hills.vertices), np.array(hills.faces, dtype=np.int64)
    field = solvers.MeshHeatMethodDistanceSolver(v, f).compute_distance(3)
    c = hills.certify(field, 3, within=1e-3)
    assert c.proven_wrong > hills.vertex_count // 2


def test_gdist_is_judged(hills):
    gdist = pytest.importorskip("gdist")
    v, f = np.array(hills.vertices), np.array(hills.faces, dtype=np.int32)
    field = gdist.compute_gdist(v, f, source_indices=np.array([3], dtype=np.int32))
    assert hills.certify(field, 3, within=1e-6).proven_wrong == 0
    both = bf.Mesh(np.vstack([v, v + [100, 0, 0]]), np.vstack([f, f + len(v)]))
    padded = np.concatenate([field, np.zeros(len(v))])  # what it writes where nothing leads
    assert both.certify(padded, 3, within=1e-6).not_reachable == len(v)


def test_bad_arguments_are_refused(hills):
    d = hills.distance(3)
    for bad in ({"within": -1}, {"tolerance": 0.5}, {"radius": -1}, {"threads": -1}):
        with pytest.raises(bf.BrushfireError):
            hills.certify(d, 3, **bad)
    with pytest.raises(bf.BrushfireError, match="the field has 3 values"):
        hills.certify(d[:3], 3)
    with pytest.raises(bf.BrushfireError):
        hills.certify(d.reshape(1, -1), 3)
    with pytest.raises(TypeError):
        hills.certify(["a"], 3)
