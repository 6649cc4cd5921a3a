"""A surface fitted to measured distances: heights of a terrain from how far its points are to walk."""

import numpy as np

import brushfire as bf

side = 12
y, x = np.mgrid[0:side, 0:side]
hills = 1.5 * np.exp(-((x - 3) ** 2 + (y - 4) ** 2) / 6) + 1.0 * np.exp(-((x - 8) ** 2 + (y - 8) ** 2) / 4)
v = (np.arange((side - 1) * side).reshape(side - 1, side)[:, :-1]).ravel()
faces = np.concatenate([np.column_stack([v, v + 1, v + side]), np.column_stack([v + 1, v + side + 1, v + side])])


def surface(heights):
    return bf.Mesh(np.column_stack([x.ravel(), y.ravel(), heights]), faces)


# What was measured: from nine stations to everywhere.
stations = [r * side + c for r in (1, 5, 10) for c in (1, 6, 10)]
measured = [surface(hills.ravel()).distance(s, method="exact") for s in stations]


def misfit(heights):
    """The sum of squares, and its gradient by one backward sweep for each station."""
    mesh, value, gradient = surface(heights), 0.0, np.zeros(len(heights))
    for station, truth in zip(stations, measured, strict=True):
        field = mesh.distance_vjp(station)
        off = field.distance - truth
        value += off @ off
        gradient += field.vjp(2 * off).vertices[:, 2]
    return value, gradient


# Nearly flat to begin with. (Quite flat, all slopes are 0: up is as good as down.)
heights = 0.1 * hills.ravel() + 0.05
first, gradient = misfit(heights)
step = 0.02
value, momentum, rate = first, np.zeros_like(heights), np.zeros_like(heights)
for k in range(1, 301):  # Adam
    momentum = 0.9 * momentum + 0.1 * gradient
    rate = 0.99 * rate + 0.01 * gradient**2
    heights -= step * (momentum / (1 - 0.9**k)) / (np.sqrt(rate / (1 - 0.99**k)) + 1e-9)
    value, gradient = misfit(heights)
print(f"misfit {first:.2f}, fitted {value:.4f}")
lift = np.mean(heights - hills.ravel())  # distances do not know how high the whole lies
off = np.sqrt(np.mean((heights - lift - hills.ravel()) ** 2))
print(f"heights off by {off:.3f} of {hills.max():.2f} (root mean square)")
