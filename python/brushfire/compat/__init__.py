"""Drop-in replacements: code that uses another geodesic package moves by changing its import.

=============================================  ==============================================================
instead of                                     write
=============================================  ==============================================================
``import gdist``                               ``import brushfire.compat.gdist as gdist``
``import pygeodesic.geodesic as geodesic``     ``import brushfire.compat.pygeodesic.geodesic as geodesic``
``import potpourri3d as pp3d``                 ``import brushfire.compat.potpourri3d as pp3d``
``import igl`` (exact and heat geodesics)      ``import brushfire.compat.igl as igl``
=============================================  ==============================================================

The calls, their arguments and the shapes of what they return are the originals'; distances are exact, but for
those that are named after heat in igl. Where the original gives a wrong number or none at all each module says what it
does instead. Nothing of the originals is imported.
"""
