"""A pytest plugin: puts the adapters in the places of the packages that they stand for, for tests that are not ours.

    python -m pytest -p in_place FILE

libigl is far more than its exact_geodesic: of it only that function is replaced.
"""

from __future__ import annotations

import importlib
import sys

from brushfire.compat import gdist, igl, potpourri3d, pygeodesic

sys.modules["gdist"] = gdist
sys.modules["potpourri3d"] = potpourri3d
sys.modules["pygeodesic"] = pygeodesic
sys.modules["pygeodesic.geodesic"] = pygeodesic.geodesic
try:
    importlib.import_module("igl").exact_geodesic = igl.exact_geodesic
except ImportError:
    sys.modules["igl"] = igl
