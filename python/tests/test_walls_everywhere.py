"""Every method of a mesh keeps to its walls, or has nothing to do with them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brushfire as bf

V = np.array([[x, y, 0.1 * x * y] for y in range(3) for x in range(5)], dtype=float)
F = np.array(
    [t for y in range(2) for x in range(4) for v in [y * 5 + x] for t in ((v, v + 1, v + 6), (v, v + 6, v + 5))]
)
X = V[:, 0]
EXACT: dict[str, Any] = {"method": "exact"}

# What a mesh is made of, where positions are, and pictures and files of it: all of it, whatever is blocked.
WHOLE = {
    "from_lengths", "weld", "cut", "walled", "masked", "position", "nearest", "boundaries", "region", "curve_along",
    "length_of", "panel", "render", "ambient_occlusion", "save", "show", "solver",
}  # fmt: skip

# Each of the others, as it is called on a mesh whose column x = 3 is closed, and on one without walls.
CALLS: dict[str, Callable[[bf.Mesh], Any]] = {
    "distance": lambda m: m.distance(0, **EXACT),
    "signed_distance": lambda m: m.signed_distance(bf.Curve([5, 6, 7])),
    "distance_vjp": lambda m: m.distance_vjp(0).distance,
    "pair_distances": lambda m: m.pair_distances([[0, 4]], **EXACT),
    "distance_matrix": lambda m: m.distance_matrix([0], **EXACT),
    "distances_within": lambda m: m.distances_within(9, rows=[0], **EXACT).toarray(),
    "write_distance_matrix": lambda m: written(m),
    "certify": lambda m: m.certify(bf.Mesh(V, F).distance(0, **EXACT), 0).proven_wrong,
    "weighted": lambda m: m.weighted(np.ones(len(F))).distance(0),
    "isochrones": lambda m: str(m.isochrones(X, [3.5])),
    "path": lambda m: m.path(0, 4).length,
    "paths": lambda m: m.paths([0], [4])[0][0].length,
    "edge_path": lambda m: m.edge_path(0, 4).length,
    "shorten": lambda m: m.shorten([2, 7, 8], closed=False).length,
    "trace": lambda m: m.trace(0, [1, 0.1, 0], 9.0)[0].length,
    "angle_of": lambda m: m.angle_of(7, [1, 0.2, 0]),
    "log_map": lambda m: m.log_map(0).radius,
    "project_curve": lambda m: m.project_curve([[1.5, 1.0, 0], [3.9, 1.0, 0]])[0].length,
    "isolines": lambda m: sum(line.line.length for line in m.isolines(X, [1.5, 3.5])),
    "curved_isolines": lambda m: sum(line.line.length for line in m.curved_isolines(0, [1.5, 3.5])),
    "gradient": lambda m: m.gradient(X),
    "steepest_descent": lambda m: str(m.steepest_descent(-X, 2)),
    "vertex_areas": lambda m: m.vertex_areas(),
    "smoothing_kernel": lambda m: m.smoothing_kernel(sigma=2).toarray(),
    "smooth": lambda m: m.smooth(X, sigma=2),
    "voronoi": lambda m: m.voronoi([0, 1], **EXACT).distance,
    "farthest_points": lambda m: m.farthest_points(2, **EXACT).vertices,
    "nearest_sources": lambda m: m.nearest_sources([0, 1], 1, **EXACT)[0],
    "centroidal_voronoi": lambda m: m.centroidal_voronoi([0, 2], rounds=1).distance,
    "parcels": lambda m: m.parcels(X.astype(int), "min", **EXACT).distance,
    "extent": lambda m: m.extent().diameter_lower,
    "eccentricity": lambda m: m.eccentricity([0], **EXACT),
    "average_distance": lambda m: m.average_distance([0], **EXACT),
    "discs": lambda m: m.discs(0.5, [0], **EXACT).radius,
    "karcher_mean": lambda m: m.karcher_mean([0, 2, 14]).deviation,
    "page": lambda m: m.page(X, sources=0),
}


def written(mesh: bf.Mesh) -> Any:
    raise NotImplementedError


@pytest.fixture(autouse=True)
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    empty = tmp_path / "empty.html"
    empty.write_text("<html>\n<!-- brushfire view: the mesh -->\n</html>\n")
    monkeypatch.setenv("BRUSHFIRE_VIEWER", str(empty))

    def write(mesh: bf.Mesh) -> Any:
        mesh.write_distance_matrix(tmp_path / "d.npy", **EXACT)
        found = np.load(tmp_path / "d.npy")
        (tmp_path / "d.npy").unlink()
        return found

    monkeypatch.setitem(globals(), "written", write)


def methods() -> list[str]:
    return [n for n in dir(bf.Mesh) if not n.startswith("_") and callable(getattr(bf.Mesh, n))]


def test_every_method_is_known_to_mind_walls_or_to_have_nothing_to_do_with_them() -> None:
    assert sorted(WHOLE | set(CALLS)) == methods()


def outcome(call: Callable[[bf.Mesh], Any], mesh: bf.Mesh) -> Any:
    try:
        return call(mesh)
    except bf.BrushfireError as error:
        return str(error)


@pytest.mark.parametrize("name", CALLS)
def test_it_minds_walls_however_they_are_given(name: str) -> None:
    mesh, call = bf.Mesh(V, F), CALLS[name]
    closed = [3, 8, 13]
    walls = [
        mesh.walled(vertices=closed),
        mesh.walled(mask=~np.isin(np.arange(15), closed)),
        mesh.walled(faces=np.isin(F, closed).any(axis=1)),
    ]
    first = outcome(call, walls[0])
    for other in walls[1:]:
        assert np.array_equal(outcome(call, other), first, equal_nan=not isinstance(first, str))
    open_result = outcome(call, mesh)
    assert type(open_result) is not str or name in ("isochrones", "page", "steepest_descent"), open_result
    assert not np.array_equal(open_result, first, equal_nan=not isinstance(first, str))


def test_signed_distances_are_those_of_the_cut_mesh() -> None:
    mesh = bf.Mesh(V, F)
    blocked = [(2, 7)]
    cut = mesh.cut(edges=blocked)
    curve = bf.Curve([10, 11, 6])
    there = cut.mesh.signed_distance(curve)
    here = mesh.walled(edges=blocked).signed_distance(curve)
    assert here == pytest.approx(there[:15]) and (here < 0).any() and (here > 0).any()
    assert mesh.walled(edges=blocked).cut().mesh.vertex_count == cut.mesh.vertex_count == 16


def test_discs_in_walls_have_the_closed_forms() -> None:
    side = 41
    grid = np.array([[x, y] for y in range(side) for x in range(side)]) / 20.0 - 1
    squares = [y * side + x for y in range(side - 1) for x in range(side - 1)]
    faces = np.array([t for v in squares for t in ((v, v + 1, v + side + 1), (v, v + side + 1, v + side))])
    mesh = bf.Mesh(grid, faces)
    middle = side * side // 2
    quarter = mesh.walled(faces=(grid[faces].mean(axis=1) < 0).any(axis=1))
    discs = quarter.discs(0.2, [middle], method="exact")
    assert discs.area == pytest.approx([0.2])
    assert discs.radius == pytest.approx([np.sqrt(0.8 / np.pi)], rel=1e-2)
    assert discs.perimeter == pytest.approx(0.5 * np.pi * discs.radius, rel=1e-2)
