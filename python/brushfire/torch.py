"""Exact geodesic distances that PyTorch can differentiate: ``import brushfire.torch``.

>>> import torch, brushfire.torch  # doctest: +SKIP
>>> V = torch.tensor([[0.0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], dtype=torch.float64, requires_grad=True)
>>> brushfire.torch.distance(V, torch.tensor([[0, 1, 2], [0, 2, 3]]), 1).sum().backward()  # doctest: +SKIP
>>> V.grad[1].tolist()  # doctest: +SKIP
[1.6, -1.8]
"""

from __future__ import annotations

from typing import Any

import numpy as np
import torch

from brushfire._derivatives import PathLength, weighted_places
from brushfire._mesh import Mesh
from brushfire._places import Points

__all__ = ["distance", "path_length"]


def _numbers(tensor: torch.Tensor) -> Any:
    return tensor.detach().cpu().to(torch.float64).contiguous().numpy()


class _Distance(torch.autograd.Function):
    @staticmethod
    def forward(  # type: ignore[override]
        ctx: Any, vertices: torch.Tensor, faces: Any, index: Any, weights: torch.Tensor | None, offset: torch.Tensor
    ) -> torch.Tensor:
        mesh = Mesh(_numbers(vertices), faces)
        sources: Any = index if weights is None else Points(index, _numbers(weights))
        ctx.field = mesh.distance_vjp(sources, offset=_numbers(offset))
        ctx.corners = None if weights is None else mesh.vertices[mesh.faces[index]]
        ctx.like = (vertices, weights, offset)
        return torch.from_numpy(ctx.field.distance).to(vertices)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:  # type: ignore[override]
        vertices, weights, offset = ctx.like
        # Where nothing is reached the distance is constant, whatever a loss makes of infinity.
        given = np.where(np.isfinite(ctx.field.distance), _numbers(upstream), 0.0)
        gradient = ctx.field.vjp(given)
        places = None
        if weights is not None and ctx.needs_input_grad[3]:
            places = torch.from_numpy(np.einsum("kcx,kx->kc", ctx.corners, gradient.places)).to(weights)
        return (
            torch.from_numpy(gradient.vertices).to(vertices),
            None,
            None,
            places,
            torch.from_numpy(gradient.offsets).to(offset),
        )


class _Length(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, vertices: torch.Tensor, path: PathLength) -> torch.Tensor:  # type: ignore[override]
        ctx.path = path
        ctx.save_for_backward(vertices)
        return vertices.new_tensor(path.length)

    @staticmethod
    def backward(ctx: Any, upstream: torch.Tensor) -> Any:  # type: ignore[override]
        return _LengthGradient.apply(*ctx.saved_tensors, upstream, ctx.path), None


class _LengthGradient(torch.autograd.Function):
    @staticmethod
    def forward(  # type: ignore[override]
        ctx: Any, vertices: torch.Tensor, upstream: torch.Tensor, path: PathLength
    ) -> torch.Tensor:
        ctx.path = path
        ctx.save_for_backward(vertices, upstream)
        return upstream * _spread(path, path.gradient, vertices)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, direction: torch.Tensor) -> Any:  # type: ignore[override]
        vertices, upstream = ctx.saved_tensors
        moves = _numbers(direction)[ctx.path.vertices]
        turned = _spread(ctx.path, ctx.path.hessian_times(moves), vertices)
        return upstream * turned, upstream.new_tensor((moves * ctx.path.gradient).sum()), None


def _spread(path: PathLength, values: Any, vertices: torch.Tensor) -> torch.Tensor:
    """Values of a path's vertices as ones of all."""
    result = torch.zeros_like(vertices)
    result[torch.from_numpy(path.vertices.astype(np.int64)).to(vertices.device)] = torch.from_numpy(values).to(vertices)
    return result


def _plain(faces: Any) -> Any:
    return faces.detach().cpu().numpy() if isinstance(faces, torch.Tensor) else np.asarray(faces)


def distance(
    V: torch.Tensor,
    F: Any,
    sources: Any,
    *,
    weights: torch.Tensor | None = None,
    offset: torch.Tensor | float = 0.0,
) -> torch.Tensor:
    """Exact distances from the nearest source to every vertex, (vertex_count,), in V's type and on its device.

    :param V: (n, 3) positions. Computed is in float64 on the CPU.
    :param F: (m, 3) vertex numbers, a tensor or whatever holds integers.
    :param sources: vertex numbers, one or (k,); with ``weights`` face numbers.
    :param weights: (k, 3) barycentric weights of the sources in their faces; what they sum to is divided by.
    :param offset: the values at the sources, one or (k,).
    :raises BrushfireError: as :meth:`brushfire.Mesh.distance_vjp` does.

    Gradients go to V, ``weights`` and ``offset``; they are exact where the distance has one: on the cut locus they are
    those of one of the shortest paths, and a source at a vertex (given by weights) gets NaN. First derivatives only:
    second ones are :func:`path_length`'s.
    """
    index, _ = weighted_places(sources, None)
    if weights is not None:
        weights = weights / weights.sum(dim=-1, keepdim=True)
        weighted_places(index, _numbers(weights))
    starts = torch.as_tensor(offset, dtype=V.dtype, device=V.device).expand(len(index))
    result: torch.Tensor = _Distance.apply(V, _plain(F), index, weights, starts)
    return result


def path_length(V: torch.Tensor, F: Any, sources: Any, target: int, *, weights: Any = None) -> torch.Tensor:
    """The length of the shortest path from the nearest source to vertex ``target``: differentiable twice, by V.

    :param V, F, sources: as for :func:`distance`.
    :param weights: (k, 3) numbers: barycentric weights that the sources keep in their faces.
    :raises BrushfireError: as :meth:`brushfire.DifferentiableDistance.path_length` does, which also tells where second
        derivatives are one-sided.

    Second derivatives times a vector (``torch.autograd.grad`` of a gradient made with ``create_graph=True``,
    ``torch.autograd.functional.hvp``) take time by the edges that the path crosses.
    """
    index, places = weighted_places(sources, weights)
    start: Any = index if places is None else Points(index, places)
    path = Mesh(_numbers(V), _plain(F)).distance_vjp(start).path_length(target)
    result: torch.Tensor = _Length.apply(V, path)
    return result
