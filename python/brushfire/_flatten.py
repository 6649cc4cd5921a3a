"""Surfaces laid flat: texture coordinates, seams, decals."""

from __future__ import annotations

import json
import os
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats, Labels, floats, number, path_text, whole
from brushfire._errors import BrushfireError
from brushfire._options import options
from brushfire._places import Places
from brushfire._progress import Progress, shown

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_MOST_LANDMARKS = 10_000


@dataclass(frozen=True)
class Distortion:
    """How far a plane is from a surface; all 1 and ``stress`` 0 where nothing is stretched.

    ``stress``: of the distances from the landmarks, sqrt(sum (flat - geodesic)^2 / sum geodesic^2). ``stretch``: of
    lengths, the root of the mean of the square over the area and all directions; ``min_stretch`` and ``max_stretch``: at
    the worst point in the worst direction. ``angle``: the mean of (s1 / s2 + s2 / s1) / 2 of a face's two stretches.
    ``flipped``: faces that lie the other way round than most of the area.
    """

    stress: float
    stretch: float
    max_stretch: float
    min_stretch: float
    angle: float
    flipped: int


@dataclass(frozen=True, eq=False)
class Flattening:
    """A surface in the plane; what :func:`flatten` returns.

    ``mesh``: the surface, cut open. ``uv`` (vertex_count, 2): of its vertices, in the mesh's units; NaN for those in no
    face. ``vertices``, ``faces``: the numbers that its vertices and faces have in the whole. ``landmarks``: vertices of
    ``mesh``. ``distortion``: :class:`Distortion`.
    """

    mesh: Mesh
    uv: Floats
    vertices: Labels
    faces: Labels
    landmarks: Labels
    distortion: Distortion

    def __repr__(self) -> str:
        return f"Flattening({len(self.uv)} vertices, stress {self.distortion.stress:.3g})"

    @property
    def texture(self) -> Floats:
        """``uv`` moved and scaled so that they just fit into [0, 1]^2, as 3D programs take them; proportions are kept.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
        >>> bool(abs(np.ptp(bf.flatten(mesh, method="exact").texture, axis=0) - [1, 0.5]).max() < 1)
        True
        """
        return _core.in_unit_square(np.ascontiguousarray(self.uv).ravel())

    def save(self, path: str | os.PathLike[str]) -> None:
        """The cut mesh with ``texture``: .obj, .ply, .vtk and .glb; .csv, .json and .npy hold u and v alone.

        >>> import brushfire as bf, tempfile, os
        >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     bf.flatten(mesh).save(os.path.join(folder, "uv.obj"))
        """
        place = path_text(path)
        if place.lower().endswith(".glb"):
            _write_glb(place, self.mesh.vertices, self.mesh.faces, self.texture)
        else:
            _core.write_texture(place, self.mesh._mesh, np.ascontiguousarray(self.texture).ravel())


def flatten(
    mesh: Mesh,
    landmarks: int = 100,
    *,
    seams: Sequence[Sequence[int]] | None = None,
    cut: bool = True,
    method: str | None = None,
    tolerance: float | None = None,
    precision: str | None = None,
    progress: Progress = None,
) -> Flattening:
    """Lays a surface flat so that straight distances are the geodesic ones as nearly as can be.

    :param mesh: in one piece, with positions. Where it has walls, they are the seams.
    :param landmarks: how many vertices, each the farthest from those before, are placed by their distances (landmark
        multidimensional scaling); all others by their distances from these.
    :param seams: lists of vertices to cut along, from each to the next on the shortest way along edges. A cone needs one
        from its apex: without it no distance fits.
    :param cut: where there are no seams, cut what is no disc to one: around handles and between holes; a sphere between
        two far points.
    :param method, tolerance, precision: of the distances, as for :meth:`Mesh.distance`.
    :return: :class:`Flattening`: ``uv``, the cut mesh, and how much is distorted.
    :raises BrushfireError: for a mesh in several pieces, fewer than 3 landmarks, a mesh from lengths.

    What unrolls to a convex piece of the plane is laid flat exactly. Based on Zigelman, Kimmel and Kiryati, 2002.

    >>> import brushfire as bf, numpy as np
    >>> t = np.linspace(0, np.pi, 20)
    >>> v = [[np.cos(a), np.sin(a), z] for z in (0, 1, 2) for a in t]
    >>> f = [t for i in range(39) if i % 20 < 19 for t in ([i, i + 1, i + 21], [i, i + 21, i + 20])]
    >>> flat = bf.flatten(bf.Mesh(v, f), landmarks=10, method="exact")
    >>> flat.distortion.stress < 1e-9
    True
    """
    count = whole(landmarks, "landmarks", _MOST_LANDMARKS)
    if seams is not None:
        mesh = mesh.walled(edges=_edges_along(mesh, seams))
    chosen = options(method, tolerance, np.inf, precision=precision)
    with shown(progress, "landmarks") as report:
        core, vertices, faces, places, uv, distortion = _core.flatten(mesh._space, count, bool(cut), chosen, report)
    return Flattening(type(mesh)._of(core), uv, vertices, faces, places, Distortion(**distortion))  # type: ignore[arg-type]


def _edges_along(mesh: Mesh, seams: Sequence[Sequence[int]]) -> npt.NDArray[np.int64]:
    edges: list[list[int]] = []
    for seam in seams:
        stops = [int(v) for v in seam]
        if len(stops) < 2:
            raise BrushfireError("seams: each needs at least two vertices")
        for a, b in zip(stops, stops[1:], strict=False):
            path = mesh.edge_path(a, b)
            corners = path.points.weights.argmax(axis=1)
            way = mesh.faces[path.points.face, corners]
            edges += np.column_stack([way[:-1], way[1:]]).tolist()
    return np.array(edges, dtype=np.int64).reshape(-1, 2)


def distortion(mesh: Mesh, uv: npt.ArrayLike) -> Distortion:
    """Of any coordinates of the vertices, (vertex_count, 2); the stress is not known and 0.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> bf.distortion(mesh, [[0, 0], [2, 0], [0, 1]]).max_stretch
    2.0
    """
    array = floats(uv, "uv")
    if array.shape != (mesh.vertex_count, 2):
        raise BrushfireError(f"uv: shape ({mesh.vertex_count}, 2) is needed, not {array.shape}")
    return Distortion(**_core.distortion(mesh._mesh, array.ravel()))  # type: ignore[arg-type]


def decal(
    mesh: Mesh, place: Places, direction: npt.ArrayLike, width: float, height: float | None = None
) -> tuple[Labels, Floats]:
    """Where on the surface an image lies that is stuck to it at a place: texture coordinates by the logarithmic map.

    :param place: of the middle of the image.
    :param direction: (3,) where its right-hand side points; its part along the surface counts.
    :param width, height: of the image on the surface, in the units of the mesh; a square where there is no height.
    :return: the faces that the image touches, and (vertex_count, 2) coordinates: [0, 1]^2 is the image, NaN lies beyond.

    Lengths from the middle, and directions there, are those of the image.

    >>> import brushfire as bf, numpy as np
    >>> V = [[x, y, 0] for y in range(5) for x in range(5)]
    >>> F = [t for i in range(20) if i % 5 < 4 for t in ([i, i + 1, i + 6], [i, i + 6, i + 5])]
    >>> faces, uv = bf.decal(bf.Mesh(V, F), 12, [1, 0, 0], 2.0)
    >>> uv[[12, 13, 17]].round(9).tolist()
    [[0.5, 0.5], [1.0, 0.5], [0.5, 1.0]]
    """
    wide = number(width, "width")
    high = wide if height is None else number(height, "height")
    if not (0 < wide < np.inf and 0 < high < np.inf):
        raise BrushfireError("decal: width and height are finite numbers greater than 0")
    if not mesh.face_count or len(mesh.vertices) < mesh.vertex_count:
        raise BrushfireError("decal: a mesh with faces and positions is needed")
    longest = float(np.linalg.norm(np.ptp(mesh.vertices, axis=0)))
    edges = mesh.vertices[mesh.faces] - mesh.vertices[np.roll(mesh.faces, 1, axis=1)]
    reach = np.hypot(wide, high) / 2 + float(np.linalg.norm(edges, axis=2).max())
    log = mesh.log_map(place, min(reach, 4 * longest), direction=direction)
    uv: Floats = log.uv / [wide, high] + 0.5
    corners = uv[mesh.faces]
    touched = (
        np.isfinite(corners).all(axis=(1, 2))
        & (corners.max(axis=1) >= 0).all(axis=1)
        & (corners.min(axis=1) <= 1).all(axis=1)
    )
    return np.flatnonzero(touched).astype(np.int32), uv


def _write_glb(place: str, vertices: Floats, faces: npt.NDArray[Any], texture: Floats) -> None:
    """glTF 2.0 in one binary file: positions, texture coordinates (v counts downwards there), triangles."""
    arrays = [
        vertices.astype("<f4"),
        np.column_stack([texture[:, 0], 1 - texture[:, 1]]).astype("<f4"),
        faces.astype("<u4").reshape(-1),
    ]
    views, begin = [], 0
    for array, target in zip(arrays, (34962, 34962, 34963), strict=True):
        views.append({"buffer": 0, "byteOffset": begin, "byteLength": array.nbytes, "target": target})
        begin += array.nbytes
    bounds = {"min": arrays[0].min(axis=0).tolist(), "max": arrays[0].max(axis=0).tolist()}
    count = len(vertices)
    accessors: list[dict[str, Any]] = [
        {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3", **bounds},
        {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC2"},
        {"bufferView": 2, "componentType": 5125, "count": int(faces.size), "type": "SCALAR"},
    ]
    head = {
        "asset": {"version": "2.0", "generator": "brushfire"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": begin}],
    }
    text = json.dumps(head).encode()
    text += b" " * (-len(text) % 4)
    body = b"".join(array.tobytes() for array in arrays)
    total = 12 + 8 + len(text) + 8 + len(body)
    try:
        with open(place, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, total))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(body), b"BIN\0") + body)
    except OSError as error:
        raise BrushfireError(f"{place}: {error.strerror}", "file_not_writable") from None
