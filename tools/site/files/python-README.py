"""The files that the page speaks of."""

import brushfire as bf

mesh = bf.read("scan.ply")
mesh.save("bunny.ply")
mesh.save("part.stl")
bf.write("way.obj", mesh.path(0, 600))
