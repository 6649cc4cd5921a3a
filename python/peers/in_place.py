"""A pytest plugin: puts the adapters in the places of the packages that they stand for, for tests that are not ours.

    python -m pytest -p in_place FILE

libigl is far more than its geodesics: of it only these are replaced.
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
    original = importlib.import_module("igl")
    for name in igl.__all__:
        setattr(original, name, getattr(igl, name))
except ImportError:
    sys.modules["igl"] = igl
