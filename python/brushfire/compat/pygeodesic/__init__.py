"""The calls of pygeodesic: see :mod:`brushfire.compat.pygeodesic.geodesic`."""

from brushfire.compat.pygeodesic import geodesic

__all__ = ["geodesic"]
