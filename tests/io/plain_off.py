"""OFF files by a few lines of Python: packages pass over polygons, or cut them where they are not convex."""
import numpy as np


def faces_of_off(path):
    """Positions, (n, 3), and faces, a list of lists of any length."""
    with open(path, encoding="latin-1") as file:
        lines = [line.split("#")[0].split() for line in file]
    lines = [line for line in lines if line]
    words = lines[0][1:] if lines[0][0].endswith("OFF") else lines[0]
    first = 1 if words else 2
    counts = [int(w) for w in (words or lines[1])]
    positions = [[float(w) for w in line[:3]] for line in lines[first:first + counts[0]]]
    faces = [[int(w) for w in line[1:1 + int(line[0])]] for line in lines[first + counts[0]:first + counts[0] + counts[1]]]
    return np.array(positions), faces
