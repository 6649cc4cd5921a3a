"""The package satisfies mypy --strict, its installed stubs match the compiled module, every public name has a doctest."""

from __future__ import annotations

import doctest
import importlib
import importlib.resources
import inspect
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import brushfire as bf

CONFIGURATION = Path(__file__).parents[2] / "pyproject.toml"


def modules():
    yield bf
    for info in pkgutil.walk_packages(bf.__path__, "brushfire."):
        if info.name in ("brushfire.torch", "brushfire.jax", "brushfire.pyvista", "brushfire.dask"):  # tested where those are
            continue
        yield importlib.import_module(info.name)


@pytest.mark.parametrize("module", list(modules()), ids=lambda m: m.__name__)
def test_examples_in_docstrings(module):
    if "heat" not in bf.methods() and module.__name__.endswith((".igl", "._heat", "potpourri3d._points")):
        pytest.skip("this build has no Eigen")
    if module.__name__ != "brushfire._core":
        assert doctest.testmod(module).failed == 0


def test_every_public_function_and_method_has_an_example():
    plain = {
        "MeshReport",
        "FileInfo",
        "Flattening",
        "Patches",
        "ReebGraph",
        "Path",
        "PathLength",
        "LogMap",
        "At",
        "Border",
        "Certificate",
        "Comparison",
        "Descent",
        "DifferentiableDistance",
        "DistanceGradient",
        "Distortion",
        "Errors",
        "Isoline",
        "Panel",
        "Samples",
        "Voronoi",
        "Cut",
        "Boundary",
        "Costs",
        "WeightedPath",
        "Centroidal",
        "Discs",
        "Extent",
        "Mean",
        "Medoids",
        "Parcels",
        "BrushfireWarning",
    }  # what is returned: shown where it is
    for name in bf.__all__:
        thing = getattr(bf, name)
        if name in plain or not (inspect.isclass(thing) or inspect.isfunction(thing)):
            continue
        assert ">>>" in (thing.__doc__ or ""), name
        for method, function in vars(thing).items() if inspect.isclass(thing) else ():
            if inspect.isfunction(function) and not method.startswith("_") and method != "solver":
                assert ">>>" in (function.__doc__ or ""), f"{name}.{method}"


def test_mypy_strict(tmp_path):  # mypy keeps a cache where it runs, and / belongs to root
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--strict", "-p", "brushfire", "--config-file", str(CONFIGURATION)]
    ended = subprocess.run(command, check=False, capture_output=True, text=True, cwd=tmp_path)
    assert ended.returncode == 0, ended.stdout


def test_the_stub_of_the_core_names_what_is_there():
    from brushfire import _core

    stub = importlib.resources.files("brushfire").joinpath("_core.pyi").read_text()
    for name in dir(_core):
        if not name.startswith("_"):
            assert f"class {name}" in stub or f"def {name}" in stub or f"{name}:" in stub, name
