"""The compiled core. Private: `brushfire` is the interface."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

_Floats: TypeAlias = npt.NDArray[np.float64]
_Ints: TypeAlias = npt.NDArray[np.int64]
_Signed: TypeAlias = npt.NDArray[np.int32]
_Options: TypeAlias = dict[str, str | float]
_Progress: TypeAlias = Callable[[float], object] | None
PathArrays: TypeAlias = tuple[_Signed, _Floats, float, bool]

version: str
default_method: str

class Mesh:
    vertex_count: int
    face_count: int
    has_positions: bool
    size: float
    vertices: _Floats
    faces: _Signed
    def lengths(self) -> _Floats: ...
    def report(self) -> dict[str, object]: ...
    def positions(self, index: _Ints, weights: _Floats | None) -> _Floats: ...

class Domain:
    def __init__(self, mesh: Mesh) -> None: ...
    def open_part(self) -> dict[str, Any]: ...

Space: TypeAlias = Mesh | Domain

_CurveArrays: TypeAlias = tuple[int, _Ints, _Floats | None, _Ints, bool, _Floats | None, _Ints]

class Sources: ...

def make_sources(
    mesh: Mesh, index: _Ints, weights: _Floats | None, offsets: _Floats, curves: list[_CurveArrays]
) -> Sources: ...
def signed_distance(domain: Space, sources: Sources, options: _Options, progress: _Progress) -> _Floats: ...
def region_of_vertices(mesh: Mesh, vertices: npt.NDArray[np.uint8]) -> tuple[_Signed, _Floats, _Ints, _Ints]: ...
def region_of_faces(mesh: Mesh, faces: _Ints) -> tuple[_Signed, _Floats, _Ints, _Ints]: ...

class Solver:
    def __init__(self, domain: Space) -> None: ...
    def set_up(self, options: _Options) -> None: ...
    def solve(
        self,
        sources: Sources,
        target_index: _Ints | None,
        target_weights: _Floats | None,
        options: _Options,
        progress: _Progress,
    ) -> tuple[_Floats, _Signed, _Floats | None]: ...

class Weighting:
    @property
    def domain(self) -> Domain: ...

class WeightedSolver:
    def __init__(
        self,
        domain: Space,
        face: _Floats | None,
        edge_vertices: _Ints,
        along: _Floats,
        crossing: _Floats,
        slope: str,
        slopes: _Floats | None,
        paces: _Floats | None,
        steepest: float,
        tacking: bool,
        grain: _Floats | None,
    ) -> None: ...
    def weighting(self, tolerance: float, towards: bool, method: str) -> Weighting: ...
    def solve(
        self,
        sources: Sources,
        target_index: _Ints | None,
        target_weights: _Floats | None,
        tolerance: float,
        refinements: int,
        lower: bool,
        towards: bool,
        max_distance: float,
        method: str,
        progress: _Progress,
    ) -> tuple[_Floats, _Signed, _Floats | None, float, float, str, tuple[int, int, float]]: ...
    def paths(
        self,
        sources: Sources,
        target_index: _Ints,
        target_weights: _Floats | None,
        tolerance: float,
        towards: bool,
        max_distance: float,
    ) -> tuple[_Signed, list[tuple[PathArrays, float, float, _Signed, _Floats, _Floats, _Floats, _Signed]]]: ...

class Replanner:
    renewed: float
    def __init__(
        self, weighted: WeightedSolver, sources: Sources, tolerance: float, towards: bool, progress: _Progress
    ) -> None: ...
    def change(self, weighted: WeightedSolver, progress: _Progress) -> None: ...
    def move(self, sources: Sources, progress: _Progress) -> None: ...
    def distance(self) -> _Floats: ...
    def source(self) -> _Signed: ...
    def paths(
        self, target_index: _Ints, target_weights: _Floats | None
    ) -> tuple[_Signed, list[tuple[PathArrays, float, float, _Signed, _Floats, _Floats, _Floats, _Signed]]]: ...

def laplacian(domain: Space, delaunay: bool) -> tuple[_Signed, _Signed, _Floats, _Floats]: ...

class _Heat:
    def __init__(
        self, domain: Space, time_factor: float, time: float, boundary: str, delaunay: bool, poisson_shift: float
    ) -> None: ...

class HeatSolver(_Heat):
    time: float
    mean_edge_length: float
    def distances(self, index: _Ints, weights: _Floats | None, offsets: _Floats, starts: _Ints) -> _Floats: ...

class VectorHeatSolver(_Heat):
    time: float
    def extend(self, index: _Ints, values: _Floats) -> _Floats: ...
    def transport(self, index: _Ints, vectors: _Floats) -> _Floats: ...
    def log_map(self, index: _Ints, strategy: int) -> _Floats: ...
    def tangent_frames(self) -> tuple[_Floats, _Floats, _Floats]: ...
    def connection_laplacian(self) -> tuple[_Signed, _Signed, _Floats]: ...

class SignedHeatSolver(_Heat):
    def distance(
        self,
        index: _Ints,
        weights: _Floats | None,
        starts: _Ints,
        is_signed: _Ints,
        point_index: _Ints,
        point_weights: _Floats | None,
        constraint: int,
        soft_weight: float,
        preserve_normals: bool,
    ) -> _Floats: ...

def isochrones(domain: Space, values: _Floats, levels: _Floats) -> str: ...

def read_grid(path: str) -> tuple[_Floats, int, int, _Floats, str]: ...
def write_grid(
    path: str, values: _Floats, columns: int, rows: int, placement: _Floats, reference: str
) -> None: ...

class Terrain:
    mesh: Mesh
    def __init__(self, heights: _Floats, columns: int, rows: int, placement: _Floats, no_data: float) -> None: ...
    def below(self, xy: _Floats) -> tuple[_Signed, _Floats]: ...

class CutMesh:
    mesh: Mesh
    def original_vertex(self) -> _Signed: ...
    def original_face(self) -> _Signed: ...
    def cut_face(self) -> _Signed: ...
    def values_to_original(self, values: _Floats) -> _Floats: ...
    def points_to_original(self, index: _Ints, weights: _Floats | None) -> tuple[_Signed, _Floats]: ...
    def points_from_original(
        self, original: Mesh, index: _Ints, weights: _Floats | None
    ) -> tuple[_Signed, _Floats, _Signed]: ...

class NearestPointFinder:
    def __init__(self, mesh: Mesh) -> None: ...
    def nearest(self, xyz: _Floats) -> tuple[_Signed, _Floats, _Floats]: ...

def path(
    solver: Solver, index: _Ints, weights: _Floats | None, closed: bool, tighten: bool, max_distance: float
) -> PathArrays: ...
def shorten(domain: Space, index: _Ints, weights: _Floats | None, closed: bool) -> PathArrays: ...
def length_of(mesh: Mesh, index: _Ints, weights: _Floats | None, closed: bool) -> float: ...
def paths(
    solver: Solver,
    sources: Sources,
    target_index: _Ints,
    target_weights: _Floats | None,
    max_distance: float,
) -> tuple[_Signed, list[PathArrays]]: ...
def edge_path(solver: Solver, sources: Sources, target: int) -> PathArrays: ...
def angle_of(domain: Space, index: _Ints, weights: _Floats | None, direction: _Floats) -> tuple[float, float]: ...
def trace(
    domain: Space, index: _Ints, weights: _Floats | None, angle: float, direction: _Floats | None, length: float
) -> tuple[PathArrays, str]: ...
def isolines(domain: Space, values: _Floats, levels: _Floats) -> list[tuple[float, int, PathArrays]]: ...
def curved_isolines(
    solver: Solver,
    sources: Sources,
    options: _Options,
    levels: _Floats | None,
    every: float | None,
    count: int,
    chord_error: float,
    progress: _Progress,
) -> list[tuple[float, int, PathArrays]]: ...
def levels_every(values: _Floats, step: float) -> _Floats: ...
def levels_between(values: _Floats, count: int) -> _Floats: ...
def gradients(domain: Space, values: _Floats, on_vertices: bool) -> _Floats: ...
def steepest_descent(
    domain: Space, values: _Floats, index: _Ints, weights: _Floats | None
) -> tuple[int, tuple[float, float, float], float, _Floats | None] | None: ...
def compare_fields(field: _Floats, reference: _Floats, weights: _Floats | None) -> dict[str, Any]: ...
def certify(
    domain: Space,
    field: _Floats,
    sources: Sources,
    tolerance: float,
    within: float,
    max_distance: float,
    threads: int,
    progress: _Progress,
) -> dict[str, Any]: ...
def finding_names() -> tuple[str, ...]: ...
def vertex_areas(domain: Space) -> _Floats: ...
def voronoi(
    domain: Space, sources: Sources, options: _Options, progress: _Progress
) -> tuple[_Floats, _Signed, _Floats, list[tuple[int, int, PathArrays]], _Signed]: ...
def farthest_points(
    domain: Space, count: int, first: _Ints, options: _Options, progress: _Progress
) -> tuple[_Signed, _Floats, _Floats, _Signed, float]: ...
def make_domain(mesh: Mesh, vertices: _Ints, faces: _Ints, edge_ends: _Ints) -> Domain: ...
def cut(mesh: Mesh, vertices: _Ints, faces: _Ints, edge_ends: _Ints) -> CutMesh: ...
def render(panels: list[tuple[Mesh, dict[str, Any]]], look: dict[str, Any]) -> npt.NDArray[np.uint8]: ...
def render_svg(panels: list[tuple[Mesh, dict[str, Any]]], look: dict[str, Any]) -> str: ...
def encode_png(rgba: npt.NDArray[np.uint8]) -> bytes: ...
def encode_webp(frames: list[npt.NDArray[np.uint8]], milliseconds: int) -> bytes: ...
def ambient_occlusion(
    mesh: Mesh, directions: int, reach: float, threads: int, progress: _Progress
) -> npt.NDArray[np.float32]: ...
def log_map(
    solver: Solver, index: _Ints, weights: _Floats | None, max_radius: float, direction: _Floats | None
) -> tuple[_Signed, _Floats, _Floats, float, _Floats]: ...
def make_mesh(vertices: _Floats, faces: npt.NDArray[np.uint32]) -> Mesh: ...
def make_from_lengths(vertex_count: int, faces: npt.NDArray[np.uint32], lengths: _Floats) -> Mesh: ...
def read(path: str) -> tuple[Mesh, str, tuple[str, ...], _Signed, _Signed]: ...
def read_bytes(content: bytes, name: str) -> tuple[Mesh, str, tuple[str, ...], _Signed, _Signed]: ...
def write_field(
    path: str,
    mesh: Mesh,
    values: _Floats | None,
    labels: _Signed | None,
    name: str,
    label_name: str,
    structure: str,
    format: str,
) -> None: ...
def write_lines(
    path: str,
    mesh: Mesh,
    curves: list[tuple[_Ints, _Floats, bool, float]],
    value_name: str,
    format: str,
    millimetres: float,
    view: str,
    outline: bool,
) -> None: ...

_Lines = tuple[str, str, list[tuple[_Floats, tuple[_Signed, _Floats] | None, bool, float]]]

def read_lines(path: str) -> _Lines: ...
def read_lines_bytes(content: bytes, name: str) -> _Lines: ...
def write_map(path: str, mesh: Mesh, rows: _Signed, values: _Floats, format: str) -> None: ...
def weld(mesh: Mesh, tolerance: float) -> tuple[Mesh, _Signed, int]: ...
def method_names() -> tuple[str, ...]: ...
def fill_matrix(
    domain: Space,
    out: npt.NDArray[np.floating],
    row_index: _Ints | None,
    row_weights: _Floats | None,
    column_index: _Ints | None,
    column_weights: _Floats | None,
    options: _Options,
    threads: int,
    progress: _Progress,
) -> None: ...
def pair_distances(
    domain: Space, start: _Ints, end: _Ints, options: _Options, threads: int, progress: _Progress
) -> _Floats: ...
def sparse_float32(
    domain: Space,
    radius: float,
    row_index: _Ints | None,
    row_weights: _Floats | None,
    options: _Options,
    threads: int,
    memory_limit: int,
    progress: _Progress,
) -> tuple[npt.NDArray[np.float32], _Signed, _Ints]: ...
def sparse_float64(
    domain: Space,
    radius: float,
    row_index: _Ints | None,
    row_weights: _Floats | None,
    options: _Options,
    threads: int,
    memory_limit: int,
    progress: _Progress,
) -> tuple[_Floats, _Signed, _Ints]: ...
def sparse_rows(
    solver: Solver, radius: float, index: _Ints, weights: _Floats | None, options: _Options, progress: _Progress
) -> tuple[_Floats, _Signed, _Ints]: ...
def write_matrix(
    domain: Space,
    path: str,
    float32: bool,
    row_index: _Ints | None,
    row_weights: _Floats | None,
    column_index: _Ints | None,
    column_weights: _Floats | None,
    options: _Options,
    threads: int,
    symmetric: str,
    chunk_rows: int,
    zarr_format: int,
    shard: int,
    shards: int,
    nearest: int,
    progress: _Progress,
) -> str: ...
class MatrixJob:
    def __init__(
        self,
        domain: Space,
        path: str,
        float32: bool,
        row_index: _Ints | None,
        row_weights: _Floats | None,
        column_index: _Ints | None,
        column_weights: _Floats | None,
        options: _Options,
        threads: int,
        symmetric: str,
        chunk_rows: int,
        zarr_format: int,
    ) -> None: ...
    @property
    def rows(self) -> int: ...
    @property
    def done(self) -> int: ...
    def run_block(self, block: int, blocks: int) -> int: ...
    def run(self) -> None: ...

def merge_shards(
    shards: list[str], path: str, symmetric: str, chunk_rows: int, zarr_format: int, nearest: int
) -> None: ...
def require_dense_memory(rows: int, columns: int, float32: bool, limit: int) -> None: ...
def nearest_sources(
    domain: Space,
    sources: Sources,
    count: int,
    options: _Options,
    progress: _Progress,
) -> tuple[_Floats, _Signed]: ...
def extent(domain: Space, tolerance: float, most: int, threads: int, progress: _Progress) -> dict[str, Any]: ...
def eccentricities(
    domain: Space,
    index: _Ints | None,
    weights: _Floats | None,
    options: _Options,
    threads: int,
    progress: _Progress,
) -> _Floats: ...
def average_distances(
    domain: Space,
    index: _Ints | None,
    weights: _Floats | None,
    options: _Options,
    threads: int,
    progress: _Progress,
) -> _Floats: ...
def discs(
    domain: Space,
    share: float,
    index: _Ints | None,
    weights: _Floats | None,
    options: _Options,
    threads: int,
    progress: _Progress,
) -> tuple[_Floats, _Floats, _Floats]: ...
def karcher_mean(
    domain: Space, index: _Ints, place_weights: _Floats | None, weights: _Floats, tolerance: float
) -> tuple[_Signed, _Floats, float, bool]: ...
def centroidal_voronoi(
    domain: Space,
    count: int,
    index: _Ints | None,
    weights: _Floats | None,
    density: _Floats,
    rounds: int,
    tolerance: float,
    threads: int,
    progress: _Progress,
) -> tuple[_Signed, _Floats, _Floats, _Signed, _Floats]: ...
def k_medoids(distances: _Floats, count: int, weights: _Floats) -> tuple[_Signed, _Signed, float]: ...
def parcels(
    domain: Space,
    label: _Ints,
    kind: str,
    least_label: int,
    options: _Options,
    threads: int,
    progress: _Progress,
) -> tuple[_Ints, _Floats, _Signed, _Signed]: ...
def smoothing_kernel(
    domain: Space, sigma: float, options: _Options, threads: int, progress: _Progress
) -> tuple[_Floats, _Signed, _Ints]: ...
def boundaries(mesh: Mesh) -> list[tuple[_Signed, float, bool]]: ...
def curve_along(mesh: Mesh, vertices: _Ints, closed: bool) -> PathArrays: ...
def project_curve(
    domain: Space, xyz: _Floats, closed: bool
) -> tuple[PathArrays, float, tuple[float, float, float]]: ...

class TracedField:
    def gradient(self, upstream: _Floats) -> tuple[_Floats, _Floats, _Floats]: ...
    def one_sided(self, tie: float) -> npt.NDArray[np.uint8]: ...
    def path_length(self, target: int) -> PathLength: ...

class PathLength:
    def length(self) -> float: ...
    def vertices(self) -> _Signed: ...
    def gradient(self) -> _Floats: ...
    def is_one_sided(self) -> bool: ...
    def hessian_times(self, moves: _Floats) -> _Floats: ...
    def hessian(self) -> _Floats: ...

def traced_field(
    solver: Solver,
    index: _Ints,
    weights: _Floats | None,
    offsets: _Floats,
    options: _Options,
    progress: _Progress,
) -> tuple[_Floats, _Signed, TracedField]: ...

def flatten(
    domain: Space, landmarks: int, cut: bool, options: _Options, progress: _Progress
) -> tuple[Mesh, _Signed, _Signed, _Signed, _Floats, dict[str, float]]: ...
def distortion(mesh: Mesh, uv: _Floats) -> dict[str, float]: ...
def in_unit_square(uv: _Floats) -> _Floats: ...
def write_texture(path: str, mesh: Mesh, uv: _Floats) -> None: ...
def cut_to_disc(mesh: Mesh, base: int) -> list[tuple[int, int]]: ...
