"""A torus of 1,280 vertices, in place of a mesh that tests of others read and that could not be fetched.

    python stand_in.py FILE
"""

import sys

import numpy as np

import brushfire as bf

ROWS, COLUMNS = 40, 32

u, v = np.meshgrid(np.arange(ROWS) * 2 * np.pi / ROWS, np.arange(COLUMNS) * 2 * np.pi / COLUMNS, indexing="ij")
positions = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], axis=-1).reshape(-1, 3)
i, j = np.meshgrid(np.arange(ROWS), np.arange(COLUMNS), indexing="ij")
a, b, c, d = (
    (((i + k) % ROWS) * COLUMNS + (j + m) % COLUMNS).ravel() for k, m in ((0, 0), (1, 0), (1, 1), (0, 1))
)
bf.Mesh(positions, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])).save(sys.argv[1])
