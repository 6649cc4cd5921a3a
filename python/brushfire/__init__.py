"""Geodesic distances and shortest paths on triangle meshes.

>>> import brushfire as bf
>>> V = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
>>> F = [[0, 1, 2], [0, 2, 3]]
>>> mesh = bf.Mesh(V, F)
>>> mesh.distance(0, method="dijkstra").round(3).tolist()
[0.0, 1.0, 1.414, 1.0]

Arrays go in as numpy arrays (or anything that numpy turns into one) and come out as numpy arrays that own their memory.
Positions are used as they are where they are C-contiguous float64, faces where they are C-contiguous int32 or uint32;
other numeric types, Fortran order and lists are converted, once, when the mesh is made. Distances that do not exist are
+inf, source numbers that do not exist -1.

Everything computes without the GIL, so that threads overlap; Ctrl-C stops it; meshes may be shared between threads.
"""

from brushfire._any import from_any
from brushfire._boundaries import Boundary
from brushfire._cells import Centroidal, Medoids, Parcels, k_medoids
from brushfire._certify import Certificate
from brushfire._core import version as __version__
from brushfire._curves import LogMap, Path
from brushfire._derivatives import DifferentiableDistance, DistanceGradient, PathLength
from brushfire._errors import BrushfireError, BrushfireIndexError, BrushfireTypeError, BrushfireWarning
from brushfire._extent import Discs, Extent, Mean
from brushfire._fields import Comparison, Descent, Errors, Isoline, compare
from brushfire._files import write
from brushfire._flatten import Distortion, Flattening, decal, distortion, flatten
from brushfire._heat import HeatSolver, SignedHeatSolver, VectorHeatSolver, laplacian
from brushfire._io import FileInfo, read
from brushfire._lines import read_lines
from brushfire._matrices import merge_shards
from brushfire._mesh import Mesh, methods
from brushfire._patches import Patches, patches
from brushfire._picture import Panel, animate, render, render_svg
from brushfire._places import At, Point, Points, at
from brushfire._reeb import ReebGraph, reeb_graph
from brushfire._regions import Border, Cut, Samples, Voronoi
from brushfire._replanner import Replanner
from brushfire._report import MeshReport
from brushfire._sets import distance_matrices
from brushfire._solver import Solver
from brushfire._sources import Curve
from brushfire._terrain import Terrain, terrain
from brushfire._weighted import Costs, Needed, Weighted, WeightedPath

__all__ = [
    "At",
    "Border",
    "Boundary",
    "BrushfireError",
    "BrushfireIndexError",
    "BrushfireTypeError",
    "BrushfireWarning",
    "Centroidal",
    "Certificate",
    "Comparison",
    "Costs",
    "Curve",
    "Cut",
    "Descent",
    "DifferentiableDistance",
    "Discs",
    "Distortion",
    "DistanceGradient",
    "Errors",
    "Extent",
    "FileInfo",
    "HeatSolver",
    "Flattening",
    "Isoline",
    "LogMap",
    "Mean",
    "Medoids",
    "Mesh",
    "MeshReport",
    "Needed",
    "Panel",
    "Parcels",
    "Patches",
    "Path",
    "PathLength",
    "Point",
    "Points",
    "ReebGraph",
    "Replanner",
    "Samples",
    "SignedHeatSolver",
    "Solver",
    "Terrain",
    "VectorHeatSolver",
    "Voronoi",
    "Weighted",
    "WeightedPath",
    "__version__",
    "animate",
    "at",
    "compare",
    "decal",
    "distance_matrices",
    "distortion",
    "flatten",
    "from_any",
    "k_medoids",
    "laplacian",
    "merge_shards",
    "methods",
    "patches",
    "read",
    "read_lines",
    "reeb_graph",
    "render",
    "render_svg",
    "terrain",
    "write",
]


def __getattr__(name: str) -> object:
    """``brushfire.torch``, ``jax`` and ``pyvista`` are imported when they are asked for: they need those packages."""
    if name in ("torch", "jax", "pyvista"):
        import importlib

        return importlib.import_module(f"brushfire.{name}")
    raise AttributeError(f"module 'brushfire' has no attribute {name!r}")
