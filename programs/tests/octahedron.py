"""A surface whose distances are known: an octahedron, every face a triangle with sides sqrt(2)."""

import math

VERTICES = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
FACES = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
SIDE = math.sqrt(2)
# Two faces unfolded around their edge: twice the height of one.
OPPOSITE = math.sqrt(3) * SIDE
