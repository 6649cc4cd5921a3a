"""pygeodesic's three tests: there is a version; a path and its length; distances from a source."""

from __future__ import annotations

import numpy as np
import pytest
from peer_meshes import flat, straight

from brushfire.compat import pygeodesic
from brushfire.compat.pygeodesic import geodesic


@pytest.fixture
def file(tmp_path):
    """In the format of its examples: the counts, the points, the faces."""
    v, f = flat()
    rows = [
        f"{len(v)} {len(f)}",
        *(" ".join(map(repr, p)) for p in v.tolist()),
        *("\t".join(map(str, t)) for t in f.tolist()),
    ]
    path = tmp_path / "flat.txt"
    path.write_text("\n".join(rows))
    return path


def test_version():
    assert isinstance(pygeodesic.__version__, str)


def test_distance(file):
    points, faces = geodesic.read_mesh_from_file(file)
    algorithm = geodesic.PyGeodesicAlgorithmExact(points, faces)
    source, target = 25, 97  # six squares to the right and six up
    distance, path = algorithm.geodesicDistance(source, target)
    assert np.isclose(distance, 1.2 * np.sqrt(2))
    # From the target back; every square is crossed through the middle of its diagonal.
    expected = points[target] - np.arange(13)[:, None] * [0.1, 0.1, 0]
    assert np.allclose(path, expected)


def test_distances(file):
    points, faces = geodesic.read_mesh_from_file(file)
    algorithm = geodesic.PyGeodesicAlgorithmExact(points, faces)
    distances, best = algorithm.geodesicDistances(np.array([25]))
    assert np.allclose(distances, straight(points, 25))
    assert (best == 0).all()
