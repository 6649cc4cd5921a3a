"""The compiled core. Private: `brushfire` is the interface."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

_Floats: TypeAlias = npt.NDArray[np.float64]
_Ints: TypeAlias = npt.NDArray[np.int64]
_Signed: TypeAlias = npt.NDArray[np.int32]
_Options: TypeAlias = dict[str, str | float]
_Progress: TypeAlias = Callable[[float], object] | None

version: str
default_method: str

class Mesh:
    vertex_count: int
    face_count: int
    has_positions: bool
    vertices: _Floats
    faces: _Signed
    def lengths(self) -> _Floats: ...
    def report(self) -> dict[str, object]: ...
    def positions(self, index: _Ints, weights: _Floats | None) -> _Floats: ...

class Solver:
    def __init__(self, mesh: Mesh) -> None: ...
    def solve(
        self,
        index: _Ints,
        weights: _Floats | None,
        offsets: _Floats,
        target_index: _Ints | None,
        target_weights: _Floats | None,
        options: _Options,
        progress: _Progress,
    ) -> tuple[_Floats, _Signed, _Floats | None]: ...

class NearestPointFinder:
    def __init__(self, mesh: Mesh) -> None: ...
    def nearest(self, xyz: _Floats) -> tuple[_Signed, _Floats, _Floats]: ...

def path(mesh: Mesh, index: _Ints, weights: _Floats | None, closed: bool) -> tuple[_Signed, _Floats, float]: ...
def trace(
    mesh: Mesh, index: _Ints, weights: _Floats | None, angle: float, direction: _Floats | None, length: float
) -> tuple[_Signed, _Floats, float, str]: ...
def log_map(mesh: Mesh, index: _Ints, weights: _Floats | None, max_radius: float) -> tuple[_Floats, _Floats, float]: ...
def make_mesh(vertices: _Floats, faces: npt.NDArray[np.uint32]) -> Mesh: ...
def make_from_lengths(vertex_count: int, faces: npt.NDArray[np.uint32], lengths: _Floats) -> Mesh: ...
def read(path: str) -> tuple[Mesh, str, tuple[str, ...], _Signed, _Signed]: ...
def method_names() -> tuple[str, ...]: ...
def fill_matrix(
    mesh: Mesh,
    out: npt.NDArray[np.floating],
    row_index: _Ints | None,
    row_weights: _Floats | None,
    column_index: _Ints | None,
    column_weights: _Floats | None,
    options: _Options,
    threads: int,
    progress: _Progress,
) -> None: ...
def sparse_float32(
    mesh: Mesh,
    radius: float,
    row_index: _Ints | None,
    row_weights: _Floats | None,
    options: _Options,
    threads: int,
    memory_limit: int,
    progress: _Progress,
) -> tuple[npt.NDArray[np.float32], _Signed, _Ints]: ...
def sparse_float64(
    mesh: Mesh,
    radius: float,
    row_index: _Ints | None,
    row_weights: _Floats | None,
    options: _Options,
    threads: int,
    memory_limit: int,
    progress: _Progress,
) -> tuple[_Floats, _Signed, _Ints]: ...
def write_matrix(
    mesh: Mesh,
    path: str,
    float32: bool,
    row_index: _Ints | None,
    row_weights: _Floats | None,
    column_index: _Ints | None,
    column_weights: _Floats | None,
    options: _Options,
    threads: int,
    progress: _Progress,
) -> None: ...
def require_dense_memory(rows: int, columns: int, float32: bool, limit: int) -> None: ...
