"""docs/python-objects.md anew: every object that the tests of from_any() know, of the libraries that are installed.

python python/peers/from_any_table.py > docs/python-objects.md
"""

from __future__ import annotations

import importlib.metadata
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import brushfire as bf

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import test_from_any as cases

HEAD = """# Meshes out of Python objects

What `brushfire.from_any()` takes and refuses, tried with the libraries themselves: what comes out is compared with the arrays
that went in, or, where it numbers them in another way, the number of faces and their area ("its surface"). "imitated": by an
object with the same attributes. {count} kinds of objects. Made by `python python/peers/from_any_table.py`; the same cases
are tests (`python/tests/test_from_any.py`), with those libraries that are installed.
"""

DISTRIBUTIONS = {"vtkmodules": "vtk", "jax.numpy": "jax", "open3d": "open3d-cpu"}
used: list[str] = []


def lib(name: str):
    """As the tests import, with the library's name and version kept."""
    module = pytest.importorskip(name, exc_type=ImportError)
    top = name.split(".")[0]
    for distribution in (DISTRIBUTIONS.get(name), DISTRIBUTIONS.get(top), top):
        try:
            used.append(f"{top} {importlib.metadata.version(distribution)}")
            break
        except (importlib.metadata.PackageNotFoundError, TypeError, ValueError):
            continue
    return module


def outcome(make: Callable[[], object]) -> tuple[str, bf.Mesh | None, str]:
    """The library, the mesh if one came out, and the message if none did."""
    used.clear()
    try:
        source = make()
    except pytest.skip.Exception:
        return "not installed", None, ""
    library = used[0] if used else "imitated"
    try:
        return library, bf.from_any(source), ""
    except cases.REFUSED as error:
        return library, None, str(error)


def row(*cells: str) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"


def taken() -> list[str]:
    rows = [row("object", "library", "mesh", "as it went in"), row(*["---"] * 4)]
    for name, make in cases.SAME.items():
        library, mesh, message = outcome(make)
        if mesh is None:
            rows.append(row(name, library, message, "" if library == "not installed" else "NO"))
            continue
        same = np.allclose(mesh.vertices, cases.V, atol=1e-7) and np.array_equal(mesh.faces, cases.F)
        rows.append(
            row(name, library, f"{mesh.vertex_count} vertices, {mesh.face_count} faces", "yes" if same else "NO")
        )
    return rows


def another() -> list[str]:
    rows = []
    for name, (make, measures) in cases.ANOTHER.items():
        library, mesh, message = outcome(make)
        if mesh is None:
            rows.append(row(name, library, message, "" if library == "not installed" else "NO"))
            continue
        faces, area = measures()
        same = mesh.face_count == faces and np.isclose(mesh.area, area)
        rows.append(
            row(name, library, f"{mesh.vertex_count} vertices, {mesh.face_count} faces", "its surface" if same else "NO")
        )
    return rows


def refused() -> list[str]:
    rows = [row("object", "library", "what is said"), row(*["---"] * 3)]
    for name, (make, _) in cases.REFUSALS.items():
        library, mesh, message = outcome(make)
        rows.append(row(name, library, message if mesh is None else f"NOT REFUSED: {mesh!r}"))
    return rows


if __name__ == "__main__":
    cases.lib = lib
    head = HEAD.replace("{count}", str(len(cases.SAME) + len(cases.ANOTHER) + len(cases.REFUSALS)))
    text = "\n".join([head, "## Taken", "", *taken(), *another(), "", "## Refused", "", *refused()])
    print(text)
    sys.exit("NO |" in text or "NOT REFUSED" in text)
