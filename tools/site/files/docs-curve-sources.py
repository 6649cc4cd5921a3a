"""A star in front of the scan, and places on it."""

from pathlib import Path

import numpy as np

angle = 2 * np.pi * np.arange(10) / 10
radius = np.where(np.arange(10) % 2, 0.2, 0.5)
corners = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(10, 1.2)], axis=1)
lines = [f"v {x} {y} {z}" for x, y, z in corners] + ["l " + " ".join(map(str, [*range(1, 11), 1]))]
Path("star.obj").write_text("\n".join(lines) + "\n")
Path("seeds.txt").write_text("3\n300\n600\n")
