"""Exact geodesic distances that JAX can differentiate: ``import brushfire.jax``.

>>> import jax, brushfire.jax  # doctest: +SKIP
>>> total = lambda V: brushfire.jax.distance(V, [[0, 1, 2], [0, 2, 3]], 1).sum()
>>> jax.grad(total)(V)  # doctest: +SKIP
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from brushfire._derivatives import PathLength, weighted_places
from brushfire._mesh import Mesh
from brushfire._places import Points

__all__ = ["distance", "path_length"]


class _Faces:
    """Numbers that a compiled function is made for: compared by what they are."""

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

    Reverse mode, first derivatives, to V, ``weights`` and ``offset``; see :func:`brushfire.torch.distance`. Second ones
    are :func:`path_length`'s.
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


@dataclass(frozen=True)
class _Way:
    """Which path: what compiled functions are made for."""

    faces: _Faces
    index: _Faces
    places: _Faces | None
    target: int

    def path(self, V: Any) -> PathLength:
        start: Any = self.index.array if self.places is None else Points(self.index.array, self.places.array)
        mesh = Mesh(np.asarray(V, dtype=np.float64), self.faces.array)
        return mesh.distance_vjp(start).path_length(self.target)

    def spread(self, path: PathLength, values: Any, like: Any) -> Any:
        """Values of the path's vertices as ones of all."""
        result = np.zeros(like.shape, dtype=like.dtype)
        result[path.vertices] = values
        return result


@partial(jax.custom_vjp, nondiff_argnums=(0,))
def _length(way: _Way, V: Any) -> Any:
    shape = jax.ShapeDtypeStruct((), V.dtype)
    return jax.pure_callback(lambda V: np.asarray(way.path(V).length, V.dtype), shape, V, vmap_method="sequential")


@partial(jax.custom_vjp, nondiff_argnums=(0,))
def _length_gradient(way: _Way, V: Any) -> Any:
    def compute(V: Any) -> Any:
        path = way.path(V)
        return way.spread(path, path.gradient, V)

    return jax.pure_callback(compute, jax.ShapeDtypeStruct(V.shape, V.dtype), V, vmap_method="sequential")


def _length_hessian_times(way: _Way, V: Any, direction: Any) -> Any:
    def compute(V: Any, direction: Any) -> Any:
        path = way.path(V)
        return way.spread(path, path.hessian_times(np.asarray(direction, dtype=np.float64)[path.vertices]), V)

    return jax.pure_callback(compute, jax.ShapeDtypeStruct(V.shape, V.dtype), V, direction, vmap_method="sequential")


_length.defvjp(
    lambda way, V: (_length(way, V), V),
    lambda way, V, upstream: (upstream * _length_gradient(way, V),),
)
_length_gradient.defvjp(
    lambda way, V: (_length_gradient(way, V), V),
    lambda way, V, direction: (_length_hessian_times(way, V, direction),),
)


def path_length(V: Any, F: Any, sources: Any, target: int, *, weights: Any = None) -> jax.Array:
    """The length of the shortest path from the nearest source to vertex ``target``: differentiable twice, by V.

    :param V, F, sources: as for :func:`distance`.
    :param weights: (k, 3) numbers that are not traced: barycentric weights that the sources keep in their faces.

    Reverse mode, twice: ``jax.jacrev(jax.grad(..))``, not ``jax.hessian``, whose outer pass is forward mode. Functions
    keep nothing between passes: each computes the path anew.
    """
    index, places = weighted_places(sources, weights)
    way = _Way(_Faces(F), _Faces(index), None if places is None else _Faces(places), int(target))
    result: jax.Array = _length(way, jnp.asarray(V))
    return result
