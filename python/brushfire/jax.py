"""Exact geodesic distances that JAX can differentiate: ``import brushfire.jax``.

>>> import jax, brushfire.jax  # doctest: +SKIP
>>> total = lambda V: brushfire.jax.distance(V, [[0, 1, 2], [0, 2, 3]], 1).sum()
>>> jax.grad(total)(V)  # doctest: +SKIP
"""

from __future__ import annotations

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from brushfire._derivatives import weighted_places
from brushfire._mesh import Mesh
from brushfire._places import Points

__all__ = ["distance"]


class _Faces:
    """Integers that a compiled function is made for: compared by what they are."""

    def __init__(self, array: Any) -> None:
        self.array = np.asarray(array)
        self._key = (self.array.shape, self.array.tobytes())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Faces) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


def _field(faces: _Faces, index: _Faces, by_weights: bool, V: Any, weights: Any, offset: Any) -> Any:
    mesh = Mesh(np.asarray(V, dtype=np.float64), faces.array)
    sources: Any = Points(index.array, np.asarray(weights, dtype=np.float64)) if by_weights else index.array
    return mesh, mesh.distance_vjp(sources, offset=np.asarray(offset, dtype=np.float64))


@partial(jax.custom_vjp, nondiff_argnums=(0, 1, 2))
def _distance(faces: _Faces, index: _Faces, by_weights: bool, V: Any, weights: Any, offset: Any) -> Any:
    def compute(V: Any, weights: Any, offset: Any) -> Any:
        return _field(faces, index, by_weights, V, weights, offset)[1].distance.astype(V.dtype)

    shape = jax.ShapeDtypeStruct((V.shape[0],), V.dtype)
    return jax.pure_callback(compute, shape, V, weights, offset, vmap_method="sequential")


def _forward(faces: _Faces, index: _Faces, by_weights: bool, V: Any, weights: Any, offset: Any) -> Any:
    return _distance(faces, index, by_weights, V, weights, offset), (V, weights, offset)


def _backward(faces: _Faces, index: _Faces, by_weights: bool, saved: Any, upstream: Any) -> Any:
    def compute(V: Any, weights: Any, offset: Any, upstream: Any) -> Any:
        # Pure functions keep nothing between the passes: the field is computed anew.
        mesh, field = _field(faces, index, by_weights, V, weights, offset)
        given = np.where(np.isfinite(field.distance), np.asarray(upstream, dtype=np.float64), 0.0)
        gradient = field.vjp(given)
        places = np.zeros(weights.shape)
        if by_weights:
            places = np.einsum("kcx,kx->kc", mesh.vertices[mesh.faces[index.array]], gradient.places)
        return tuple(
            part.astype(like.dtype)
            for part, like in zip((gradient.vertices, places, gradient.offsets), (V, weights, offset), strict=True)
        )

    shapes = tuple(jax.ShapeDtypeStruct(x.shape, x.dtype) for x in saved)
    return jax.pure_callback(compute, shapes, *saved, upstream, vmap_method="sequential")


_distance.defvjp(_forward, _backward)


def distance(V: Any, F: Any, sources: Any, *, weights: Any = None, offset: Any = 0.0) -> jax.Array:
    """Exact distances from the nearest source to every vertex, (vertex_count,), in V's type.

    :param V: (n, 3) positions. Computed is in float64 on the CPU, by a callback; ``jit`` and ``vmap`` work.
    :param F, sources: integers that are not traced: (m, 3) vertex numbers; vertices, or with ``weights`` faces.
    :param weights: (k, 3) barycentric weights of the sources in their faces; what they sum to is divided by.
    :param offset: the values at the sources, one or (k,).

    Reverse mode, first derivatives, to V, ``weights`` and ``offset``; see :func:`brushfire.torch.distance`.
    """
    V = jnp.asarray(V)
    index, _ = weighted_places(sources, None)
    by_weights = weights is not None
    if by_weights:
        weights = jnp.asarray(weights, dtype=V.dtype)
        weights = weights / weights.sum(axis=-1, keepdims=True)
    else:
        weights = jnp.zeros((len(index), 3), dtype=V.dtype)
    starts = jnp.broadcast_to(jnp.asarray(offset, dtype=V.dtype), (len(index),))
    result: jax.Array = _distance(_Faces(F), _Faces(index), by_weights, V, weights, starts)
    return result
