"""libigl's test of exact_geodesic: an icosahedron, from a vertex to another; and its numbers, where it is installed."""

from __future__ import annotations

import numpy as np
from peer_meshes import original

import brushfire as bf
from brushfire.compat import igl


def icosahedron() -> tuple[np.ndarray, np.ndarray]:
    golden = (1 + np.sqrt(5)) / 2
    corners = np.array([[0, s, t * golden] for s in (-1, 1) for t in (-1, 1)])
    v = np.concatenate([np.roll(corners, k, axis=1) for k in range(3)])
    apart = np.linalg.norm(v[:, None] - v, axis=2)
    near = np.isclose(apart, 2)
    faces = [
        (a, b, c) for a in range(12) for b in range(a) for c in range(b) if near[a, b] and near[b, c] and near[a, c]
    ]
    return v, np.array(faces)


def test_the_icosahedron():
    v, f = icosahedron()
    assert len(f) == 20
    vs, vt = np.array([0], dtype=np.int64), np.array([1, 3], dtype=np.int64)
    d = igl.exact_geodesic(v, f, VS=vs, VT=vt)
    assert d.shape == (2,)
    assert np.allclose(d, bf.Mesh(v, f).distance(0, method="exact")[vt])
    opposite = int(np.argmax(np.linalg.norm(v - v[0], axis=1)))
    # Over two edges' worth of flat triangles: from a corner of a strip to the corner diagonally across it.
    assert np.isclose(igl.exact_geodesic(v, f, VS=[0], VT=[opposite])[0], 2 * np.sqrt(7))
    if theirs := original("igl"):
        assert np.allclose(theirs.exact_geodesic(v, f.astype(np.int64), VS=vs, VT=vt), d)
