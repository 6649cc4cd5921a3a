# Third-party libraries. The library itself uses header-only ones, privately: nothing of them shows in its public headers
# or in its installed package.

# Boost headers (Polygon, Geometry, Multiprecision) as system headers: their warnings are not ours.
find_package(Boost 1.74 REQUIRED)
