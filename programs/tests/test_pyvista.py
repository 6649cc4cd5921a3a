import math

import numpy as np
import pytest

pyvista = pytest.importorskip("pyvista")

import brushfire.pyvista  # noqa: F401  (what gives surfaces their `brushfire`)
from octahedron import OPPOSITE, SIDE


@pytest.fixture
def surface(octahedron):
    return pyvista.PolyData.from_regular_faces(np.array(octahedron[0], dtype=float), np.array(octahedron[1]))


def length(lines):
    return lines.compute_cell_sizes(length=True)["Length"].sum()


def test_distance_is_point_data_of_a_new_surface(surface):
    result = surface.brushfire.distance(0, method="exact")
    assert result["distance"] == pytest.approx([0, OPPOSITE, SIDE, SIDE, SIDE, SIDE])
    assert "distance" not in surface.point_data


def test_a_path_is_a_line_that_knows_the_way_from_its_start(surface):
    line = surface.brushfire.path(0, 1)
    assert length(line) == pytest.approx(OPPOSITE)
    assert line["distance"][-1] == pytest.approx(OPPOSITE)


def test_isolines_are_closed_curves_with_their_level(surface):
    lines = surface.brushfire.isolines(0, levels=[0.5], chord_error=1e-5)
    assert lines.n_cells == 1
    assert set(lines["distance"]) == {0.5}
    assert length(lines) == pytest.approx(0.5 * 4 * math.pi / 3, rel=1e-3)  # four corners of 60 degrees


def test_cells_and_their_borders(surface):
    cells, borders = surface.brushfire.voronoi([0, 1], method="exact")
    assert cells["source"][:2].tolist() == [0, 1]
    assert borders.cell_data["sources"].tolist() == [[0, 1]] * borders.n_cells
    assert np.abs(borders.points[:, 0]).max() < 1e-12


def test_a_surface_that_was_changed_is_measured_anew(surface):
    assert surface.brushfire.distance(0)["distance"][2] == pytest.approx(SIDE)
    surface.points = 2 * surface.points
    assert surface.brushfire.distance(0)["distance"][2] == pytest.approx(2 * SIDE)


def test_no_path_is_an_empty_line():
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 0, 0], [8, 0, 0], [9, 1, 0]])
    apart = pyvista.PolyData.from_regular_faces(corners, np.array([[0, 1, 2], [3, 4, 5]]))
    assert apart.brushfire.path(0, 3).n_points == 0
