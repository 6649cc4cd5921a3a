"""The files that the page speaks of."""

import brushfire as bf

mesh = bf.read("scan.ply")
for name in ("pose1.off", "pose2.off", "pose3.off"):
    mesh.save(name)
