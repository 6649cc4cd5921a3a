"""What the functions take that a mesh has, and a solver, which keeps its workspace between calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from brushfire._mesh import Mesh
    from brushfire._solver import Solver

Surface: TypeAlias = "Mesh | Solver"
