import sys
from pathlib import Path

import numpy as np
import pytest

layers = pytest.importorskip("napari.layers")
from octahedron import OPPOSITE, SIDE

sys.path.insert(0, str(Path(__file__).parents[1] / "napari"))
import napari_brushfire as plugin


@pytest.fixture
def surface(octahedron):
    return layers.Surface((np.array(octahedron[0], dtype=float), np.array(octahedron[1])), name="octahedron")


def test_distance_is_a_coloured_surface(surface):
    data, how, kind = plugin.geodesic_distance(surface, layers.Points([[1.2, 0, 0]]), exact=True)
    assert kind == "surface"
    assert data[2] == pytest.approx([0, OPPOSITE, SIDE, SIDE, SIDE, SIDE])
    layers.Surface(data, **how)


def test_scales_of_layers_count(surface):
    surface.scale = (2, 2, 2)
    data, how, _ = plugin.geodesic_distance(surface, layers.Points([[2, 0, 0]]), exact=True)
    assert data[2][2] == pytest.approx(2 * SIDE)
    assert tuple(layers.Surface(data, **how).scale) == (2, 2, 2)


def test_a_path_goes_through_all_points_in_their_order(surface):
    lines, how, kind = plugin.geodesic_path(surface, layers.Points([[1, 0, 0], [-1, 0, 0], [0, 1, 0]]))
    assert kind == "shapes"
    assert how["features"]["length"] == pytest.approx([OPPOSITE, SIDE])
    assert len(layers.Shapes(lines, **how).data) == 2


def test_isolines_are_closed_lines(surface):
    lines, how, _ = plugin.geodesic_isolines(surface, layers.Points([[1, 0, 0]]), count=3)
    assert len(lines) == len(how["features"]["distance"]) == 3
    assert all((line[0] == line[-1]).all() for line in lines)


def test_too_few_points_are_refused_by_number(surface):
    with pytest.raises(Exception, match="has 1 points: at least 2 are needed"):
        plugin.geodesic_path(surface, layers.Points([[1, 0, 0]]))


def test_the_manifest_names_what_is_there():
    npe2 = pytest.importorskip("npe2")
    manifest = npe2.PluginManifest.from_file(Path(plugin.__file__).with_name("napari.yaml"))
    for command in manifest.contributions.commands:
        module, function = command.python_name.split(":")
        assert module == "napari_brushfire"
        assert callable(getattr(plugin, function))
