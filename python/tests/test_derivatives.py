"""Derivatives of distances: numpy, torch and jax against central differences."""

from __future__ import annotations

import importlib

import numpy as np
import pytest
from conftest import grid

import brushfire as bf


def installed(name):
    """The module, where it is there and can be used: a torch made for a graphics card that is not there cannot."""
    try:
        return importlib.import_module(name)
    except Exception as why:  # noqa: BLE001, whatever its import throws
        pytest.skip(f"{name}: {why}")


def bumpy_grid(n=7, seed=3):
    vertices, faces = grid(n, 0.6)
    return vertices + np.random.default_rng(seed).uniform(-0.1, 0.1, vertices.shape), faces


def rate(function, x, direction, step=1e-6):
    return (function(x + step * direction) - function(x - step * direction)) / (2 * step)


def test_the_vertices_gradient_is_the_rate_of_change():
    vertices, faces = bumpy_grid()
    dice = np.random.default_rng(0)
    upstream = dice.uniform(-1, 1, len(vertices))
    sources = [0, 30]
    gradient = bf.Mesh(vertices, faces).distance_vjp(sources, offset=[0.0, 0.3]).vjp(upstream)

    def total(v):
        return float(upstream @ bf.Mesh(v, faces).distance(sources, offset=[0.0, 0.3], method="exact"))

    for _ in range(5):
        direction = dice.uniform(-1, 1, vertices.shape)
        expected = rate(total, vertices, direction)
        assert np.sum(gradient.vertices * direction) == pytest.approx(expected, abs=1e-6 * np.abs(upstream).sum())


def test_the_places_and_offsets_gradients_are_the_rates_of_change():
    vertices, faces = bumpy_grid()
    mesh = bf.Mesh(vertices, faces)
    upstream = np.random.default_rng(1).uniform(-1, 1, len(vertices))
    weights = np.array([[0.5, 0.2, 0.3], [0.3, 0.7, 0.0]])  # inside of a face, and on an edge
    face = np.array([10, 40])
    gradient = mesh.distance_vjp(bf.Points(face, weights), offset=[0.0, 0.2]).vjp(upstream)

    def total(w, offset):
        return float(upstream @ mesh.distance(bf.Points(face, w), offset=offset, method="exact"))

    inside = np.array([[0.3, -0.1, -0.2], [0.0, 0.0, 0.0]])
    along_edge = np.array([[0.0, 0.0, 0.0], [0.4, -0.4, 0.0]])
    for direction in (inside, along_edge):
        moves = np.einsum("kc,kcx->kx", direction, vertices[faces[face]])
        expected = rate(lambda w: total(w, np.array([0.0, 0.2])), weights, direction)
        assert np.sum(gradient.places * moves) == pytest.approx(expected, abs=1e-6)
    for k in (0, 1):
        expected = rate(lambda o: total(weights, o), np.array([0.0, 0.2]), np.eye(2)[k])
        assert gradient.offsets[k] == pytest.approx(expected, abs=1e-6)


def test_a_source_at_a_vertex_has_no_gradient_of_its_place(square):
    assert np.isnan(square.distance_vjp(0).vjp([0, 0, 1, 0]).places).all()


def test_unreached_vertices_count_nothing():
    mesh = bf.Mesh([[0, 0], [1, 0], [0, 1], [5, 5], [6, 5], [5, 6]], [[0, 1, 2], [3, 4, 5]])
    gradient = mesh.distance_vjp(0).vjp(np.ones(6))
    assert (gradient.vertices[3:] == 0).all() and gradient.offsets.tolist() == [3.0]


def test_walls_are_gone_around():
    vertices, faces = bumpy_grid()
    mesh = bf.Mesh(vertices, faces).walled(edges=[(k, k + 7) for k in range(3, 38, 7)])
    upstream = np.random.default_rng(2).uniform(0, 1, len(vertices))
    walls = dict(edges=[(k, k + 7) for k in range(3, 38, 7)])
    direction = np.random.default_rng(4).uniform(-1, 1, vertices.shape)

    def total(v):
        return float(upstream @ bf.Mesh(v, faces).walled(**walls).distance(8, method="exact"))

    gradient = mesh.distance_vjp(8).vjp(upstream)
    assert np.sum(gradient.vertices * direction) == pytest.approx(rate(total, vertices, direction), abs=1e-5)


def test_the_cut_locus_is_told():
    # The far side of a cone's base circle is reached around both sides alike.
    angle = np.arange(12) * np.pi / 6
    vertices = np.concatenate([[[0, 0, 2.0]], np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])])
    faces = [[0, k, k % 12 + 1] for k in range(1, 13)]
    tied = bf.Mesh(vertices, faces).distance_vjp(1).one_sided()
    assert np.flatnonzero(tied).tolist() == [7]
    assert not bf.Mesh(*bumpy_grid()).distance_vjp(0).one_sided().any()


def test_a_paths_hessian_is_the_rate_of_change_of_its_gradient():
    vertices, faces = bumpy_grid()
    sources = bf.Points([10], [[0.5, 0.2, 0.3]])
    path = bf.Mesh(vertices, faces).distance_vjp(sources).path_length(44)
    assert path.length == pytest.approx(bf.Mesh(vertices, faces).distance(sources, method="exact")[44])
    assert not path.one_sided and len(path.vertices) > 6
    hessian = path.hessian()
    np.testing.assert_allclose(hessian, hessian.T, atol=1e-12)

    def gradient(v):
        return bf.Mesh(v, faces).distance_vjp(sources).vjp(np.eye(len(vertices))[44]).vertices

    moves = np.random.default_rng(5).uniform(-1, 1, path.gradient.shape)
    direction = np.zeros_like(vertices)
    direction[path.vertices] = moves
    expected = rate(gradient, vertices, direction)[path.vertices]
    np.testing.assert_allclose(path.hessian_times(moves), expected, atol=1e-6)
    np.testing.assert_allclose(hessian @ moves.ravel(), expected.ravel(), atol=1e-6)


def test_second_derivatives_tell_where_they_are_one_sided():
    flat = bf.Mesh(*grid(5)).distance_vjp(0)
    assert flat.path_length(2).one_sided and not flat.path_length(1).one_sided  # through a vertex; along an edge
    between = bf.Mesh(*grid(5)).distance_vjp([5, 9])
    assert between.path_length(7).one_sided  # as far from the one as from the other


def test_wrong_arguments_are_told(square):
    with pytest.raises(bf.BrushfireError, match="target 4"):
        square.distance_vjp(0).path_length(4)
    with pytest.raises(bf.BrushfireError, match="shape"):
        square.distance_vjp(0).path_length(2).hessian_times([1, 2])
    field = square.distance_vjp(0)
    with pytest.raises(bf.BrushfireError, match="shape"):
        field.vjp([1, 2])
    with pytest.raises(bf.BrushfireError, match="not finite"):
        field.vjp([1, 2, np.nan, 3])
    flat = bf.Mesh.from_lengths([[0, 1, 2]], [[1, 1, 1]])
    with pytest.raises(bf.BrushfireError, match="positions"):
        flat.distance_vjp(0).vjp([1, 1, 1])


def test_torch_gradcheck():
    torch = installed("torch")
    import brushfire.torch

    vertices, faces = bumpy_grid(5)
    v = torch.tensor(vertices, requires_grad=True)
    weights = torch.tensor([[0.5, 0.2, 0.3], [0.2, 0.3, 0.5]], dtype=torch.float64, requires_grad=True)
    offset = torch.tensor([0.0, 0.1], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(lambda v: brushfire.torch.distance(v, faces, [0, 13]), (v,), atol=1e-6)
    assert torch.autograd.gradcheck(
        lambda v, w, o: bf.torch.distance(v, faces, [4, 20], weights=w, offset=o), (v, weights, offset), atol=1e-6
    )
    single = v.detach().float().requires_grad_()
    bf.torch.distance(single, torch.tensor(faces), 3).sum().backward()
    assert single.grad.dtype == torch.float32 and torch.isfinite(single.grad).all()
    length = lambda v: bf.torch.path_length(v, faces, [4, 20], 13, weights=weights.detach())  # noqa: E731
    assert torch.autograd.gradcheck(length, (v,), atol=1e-6)
    assert torch.autograd.gradgradcheck(length, (v,), atol=1e-6)


def test_jax_check_grads():
    jax = installed("jax")
    from jax.test_util import check_grads

    import brushfire.jax

    with jax.enable_x64(True) if hasattr(jax, "enable_x64") else jax.experimental.enable_x64():
        vertices, faces = bumpy_grid(5)
        weights = np.array([[0.5, 0.2, 0.3]])
        v = jax.numpy.asarray(vertices)
        check_grads(lambda v: brushfire.jax.distance(v, faces, [0, 13]), (v,), 1, modes=["rev"], atol=1e-6, rtol=1e-6)
        check_grads(
            lambda v, w: bf.jax.distance(v, faces, 4, weights=w), (v, weights), 1, modes=["rev"], atol=1e-6, rtol=1e-6
        )
        length = lambda v: bf.jax.path_length(v, faces, 4, 20, weights=weights)  # noqa: E731
        check_grads(length, (v,), 2, modes=["rev"], atol=1e-6, rtol=1e-6)
        compiled = jax.jit(lambda v: brushfire.jax.distance(v, faces, 0).sum())
        np.testing.assert_allclose(
            jax.grad(compiled)(v), bf.Mesh(vertices, faces).distance_vjp(0).vjp(np.ones(25)).vertices
        )
