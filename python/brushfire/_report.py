"""What is in a mesh."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class MeshReport:
    """What is in a mesh. ``remarks`` says in sentences what is unusual about it; empty for a clean closed mesh."""

    vertices: int
    faces: int
    edges: int
    components: int
    boundary_edges: int
    nonmanifold_edges: int
    misoriented_edges: int
    nonmanifold_vertices: int
    isolated_vertices: int
    repeated_index_faces: int
    zero_area_faces: int
    zero_length_edges: int
    duplicate_faces: int
    duplicate_positions: int
    looks_like_soup: bool
    min_edge_length: float
    mean_edge_length: float
    max_edge_length: float
    area: float
    euler_characteristic: int
    length_precision: float
    remarks: tuple[str, ...]

    def __str__(self) -> str:
        head = f"{self.vertices} vertices, {self.faces} faces, {self.components} component(s)"
        return "\n".join([head, *self.remarks])
