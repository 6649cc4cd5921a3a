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

from brushfire._derivatives import weighted_places
from brushfire._mesh import Mesh
from brushfire._places import Points

__all__ = ["distance"]


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
    those of one of the shortest paths, and a source at a vertex (given by weights) gets NaN. First derivatives only.
    """
    index, _ = weighted_places(sources, None)
    if weights is not None:
        weights = weights / weights.sum(dim=-1, keepdim=True)
        weighted_places(index, _numbers(weights))
    starts = torch.as_tensor(offset, dtype=V.dtype, device=V.device).expand(len(index))
    faces = F.detach().cpu().numpy() if isinstance(F, torch.Tensor) else np.asarray(F)
    result: torch.Tensor = _Distance.apply(V, faces, index, weights, starts)
    return result
