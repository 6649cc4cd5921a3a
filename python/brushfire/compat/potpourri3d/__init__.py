"""Every class and function of potpourri3d 1.4: the same calls, arguments and shapes.

=======================================================  ==============================================================
calls                                                    computed by
=======================================================  ==============================================================
``MeshHeatMethodDistanceSolver``, ``compute_distance``,  the exact polyhedral distance; ``method="heat"`` for what the
``compute_distance_multisource``                         original computes
``MeshFastMarchingDistanceSolver``                       the exact polyhedral distance; with ``sign=True``,
                                                         :class:`brushfire.SignedHeatSolver`
``MeshVectorHeatSolver``                                 :class:`brushfire.VectorHeatSolver`
``MeshSignedHeatSolver``                                 :class:`brushfire.SignedHeatSolver`
``PolygonMeshHeatSolver``                                polygons are cut into triangles, then as above
``EdgeFlipGeodesicSolver``                               :meth:`brushfire.Mesh.shorten`, from the same paths along edges
``GeodesicTracer``                                       :meth:`brushfire.Mesh.trace`
``MeshMarchingTrianglesSolver``, ``marching_triangles``  :meth:`brushfire.Mesh.isolines`
``PointCloudHeatSolver``                                 local triangulations, and the heat method on their union
=======================================================  ==============================================================

Different from the original, on purpose:

- Distances are exact, where the original's heat method is several per cent wrong on coarse meshes and shifts fields of
  several sources. Where the heat method is meant (``method="heat"``), every source reads 0, other components +inf.
- Fast marching from a point inside a face starts with wrong distances to the corners in the original (version 1.4.0),
  unless the triangle has a right angle; here with the straight ones.
- ``EdgeFlipGeodesicSolver`` always ends, contractible loops included (a single point, given twice), on meshes that are not
  manifold too; ``max_iterations`` and ``max_relative_length_decrease`` are taken, and shortening goes on to the end.
- Signed distances: vectors live at vertices, not at edges; ``soft_level_set_weight`` <= 0 keeps the constraint.
- The tangent frames of vertices begin at another edge.
- A point cloud's triangulations share no code with the original's: distances agree as far as those of two triangulations of
  the same points do.
"""

from brushfire.compat.potpourri3d._distance import (
    MeshFastMarchingDistanceSolver,
    MeshHeatMethodDistanceSolver,
    compute_distance,
    compute_distance_multisource,
)
from brushfire.compat.potpourri3d._files import (
    read_mesh,
    read_point_cloud,
    read_polygon_mesh,
    write_mesh,
    write_point_cloud,
)
from brushfire.compat.potpourri3d._heat import MeshSignedHeatSolver, MeshVectorHeatSolver, PolygonMeshHeatSolver
from brushfire.compat.potpourri3d._operators import (
    cotan_laplacian,
    edges,
    face_areas,
    validate_mesh,
    validate_points,
    vertex_areas,
)
from brushfire.compat.potpourri3d._paths import (
    EdgeFlipGeodesicSolver,
    GeodesicTracer,
    MeshMarchingTrianglesSolver,
    marching_triangles,
)
from brushfire.compat.potpourri3d._points import PointCloudHeatSolver, PointCloudLocalTriangulation

__all__ = [
    "EdgeFlipGeodesicSolver",
    "GeodesicTracer",
    "MeshFastMarchingDistanceSolver",
    "MeshHeatMethodDistanceSolver",
    "MeshMarchingTrianglesSolver",
    "MeshSignedHeatSolver",
    "MeshVectorHeatSolver",
    "PointCloudHeatSolver",
    "PointCloudLocalTriangulation",
    "PolygonMeshHeatSolver",
    "compute_distance",
    "compute_distance_multisource",
    "cotan_laplacian",
    "edges",
    "face_areas",
    "marching_triangles",
    "read_mesh",
    "read_point_cloud",
    "read_polygon_mesh",
    "validate_mesh",
    "validate_points",
    "vertex_areas",
    "write_mesh",
    "write_point_cloud",
]
