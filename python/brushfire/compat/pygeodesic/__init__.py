"""The calls of pygeodesic: see :mod:`brushfire.compat.pygeodesic.geodesic`."""

from brushfire._core import version as __version__
from brushfire.compat.pygeodesic import geodesic

__all__ = ["__version__", "geodesic"]
