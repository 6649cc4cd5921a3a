"""Out into files: meshes, fields, curves and matrices, in every format that the program writes, and CIFTI-2."""

from __future__ import annotations

import contextlib
import importlib
import os
import tempfile
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, Labels
from brushfire._curves import LogMap, Path
from brushfire._errors import BrushfireError, BrushfireTypeError

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_DSCALAR = ".dscalar.nii"
_SPARSE = (".npz", ".mtx")
_UNITS = {"mm": 1.0, "um": 1e-3, "cm": 10.0, "m": 1000.0, "in": 25.4}


def save(
    mesh: Mesh,
    path: str | os.PathLike[str],
    field: npt.ArrayLike | None = None,
    *,
    labels: npt.ArrayLike | None = None,
    name: str = "distance",
    label_name: str = "source",
    format: str | None = None,
    structure: str | None = None,
) -> None:
    """The mesh, and what it carries, into a file: complete or not at all.

    :param path: whose extension decides: ply vtk vtp obj hold the mesh too; gii curv npy csv json and CIFTI-2
        (``.dscalar.nii``, written by nibabel) hold the values only. A mesh without values also goes into off stl
        ``surf.gii`` glb msh mesh meshb and FreeSurfer's formats.
    :param field: one value per vertex, +inf where there is none, (vertex_count,).
    :param labels: one integer per vertex, -1 for none: the sources of :meth:`distance`, (vertex_count,).
    :param name, label_name: what the file calls the two.
    :param format: an extension, for names that have none; ``"-"`` as the path is standard output.
    :param structure: for CIFTI-2 and GIFTI, the part of the brain that this is: ``"cortex_left"``, ... In CIFTI-2 only
        vertices with finite values are in the file.
    :raises BrushfireError: codes ``unknown_format``, ``file_not_writable``; ``invalid_argument`` for arrays that do not
        fit the mesh and for what a format has no place for.

    >>> import brushfire as bf, os, tempfile
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "distance.ply")
    ...     mesh.save(path, mesh.distance(0))
    ...     bf.read(path)
    Mesh(4 vertices, 2 faces)
    """
    _save(mesh._mesh, path, field, labels, name, label_name, format, structure)


def _save(
    core: _core.Mesh,
    path: str | os.PathLike[str],
    field: npt.ArrayLike | None,
    labels: npt.ArrayLike | None,
    name: str,
    label_name: str,
    format: str | None,
    structure: str | None,
) -> None:
    values = None if field is None else _one_each(_arrays.floats(field, "field"), "field")
    numbers = None if labels is None else _labels(labels)
    place, kind = _arrays.path_text(path), format or ""
    if place.endswith(_DSCALAR) or kind == _DSCALAR[1:]:
        _write_dscalar(place, core.vertex_count, values, numbers, (name, label_name), structure)
    else:
        _core.write_field(place, core, values, numbers, name, label_name, _gifti_name(structure), kind)


def write(
    path: str | os.PathLike[str],
    what: Any,
    *,
    mesh: Mesh | None = None,
    labels: npt.ArrayLike | None = None,
    name: str | None = None,
    label_name: str = "source",
    format: str | None = None,
    structure: str | None = None,
    unit: str = "mm",
    view: str = "",
    outline: bool = False,
) -> None:
    """Whatever was computed, into a file whose extension decides about the format: complete or not at all.

    :param what: one of

        - a Mesh: as :meth:`Mesh.save` does;
        - a field, (vertex_count,): npy csv json curv gii dscalar.nii; with ``mesh`` also ply vtk vtp obj;
        - a :class:`Path`, an :class:`Isoline`, a :class:`Border`, or several of them: json obj ply vtp csv svg dxf;
        - a :class:`LogMap`: npy csv json ply vtk obj, the last three with u and v as texture coordinates;
        - a dense matrix, (rows, columns): npy;
        - a scipy sparse matrix: npz (for ``scipy.sparse.load_npz``), mtx (MatrixMarket).
    :param mesh: to which a field belongs; curves that were made in this process know theirs.
    :param labels, label_name, structure: as for :meth:`Mesh.save`.
    :param name: of the values; ``distance`` of a field, ``length`` or ``level`` of curves if not given.
    :param format: an extension, for names that have none.
    :param unit: what the mesh is measured in, for curves in svg and dxf, which have the real size: mm um cm m in.
    :param view: of svg: front, back, left, right, top or bottom; along the shortest side of the curves if not given.
    :param outline: in svg and dxf draw the outline of the mesh, too.
    :raises BrushfireError: codes ``unknown_format``, ``file_not_writable``, ``invalid_argument``.
    :raises TypeError: for what is none of these.

    >>> import brushfire as bf, os, tempfile
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "way.obj")
    ...     bf.write(path, mesh.path(1, 3))
    ...     print(open(path).read().splitlines()[-1])
    l 1 2 3
    """
    from brushfire._mesh import Mesh

    place, kind = _arrays.path_text(path), format or ""
    curves = _curves(what)
    if curves is not None:
        _write_curves(place, curves, mesh, name, kind, (_millimetres(unit), _view(view), bool(outline)))
    elif isinstance(what, LogMap):
        _write_map(place, what, mesh, kind)
    elif isinstance(what, Mesh):
        what.save(path, labels=labels, label_name=label_name, format=format, structure=structure)
    elif hasattr(what, "tocsr"):
        _write_sparse(place, what, kind)
    else:
        values = _arrays.floats(what, "what")
        if values.ndim == 2:
            _write_dense(place, _arrays.any_array(what, "what"), kind)
        else:
            core = _without_faces(len(_one_each(values, "what"))) if mesh is None else mesh._mesh
            try:
                _save(core, path, values, labels, name or "distance", label_name, format, structure)
            except BrushfireError as error:
                if mesh is None and "positions" in str(error):
                    raise BrushfireError(f"{place}: this format holds a mesh, too: give it as mesh=") from None
                raise


def _gifti_name(structure: str | None) -> str:
    """cortex_left, CIFTI_STRUCTURE_CORTEX_LEFT and CortexLeft are all CortexLeft in GIFTI."""
    if structure is None:
        return ""
    name = structure.removeprefix("CIFTI_STRUCTURE_")
    is_plain = "_" in name or name.islower() or name.isupper()
    return "".join(part.capitalize() for part in name.split("_")) if is_plain else name


def _one_each(values: Floats, what: str) -> Floats:
    if values.ndim != 1:
        raise BrushfireError(f"{what}: one value per vertex is needed, shape (k,), not {values.shape}")
    return values


def _labels(values: npt.ArrayLike) -> Labels:
    numbers = _arrays.integers(values, "labels")
    if numbers.ndim != 1:
        raise BrushfireError(f"labels: one per vertex is needed, shape (k,), not {numbers.shape}")
    if numbers.size and (numbers.min() < -1 or numbers.max() > np.iinfo(np.int32).max):
        raise BrushfireError("labels: numbers from -1 (none) to 2147483647 are possible")
    return numbers.astype(np.int32)


def _without_faces(count: int) -> _core.Mesh:
    """As many vertices as a field has values, for formats that hold values only."""
    return _core.make_from_lengths(count, np.zeros((0, 3), dtype=np.uint32), np.zeros((0, 3)))


# ---- curves


def _curve(item: Any) -> tuple[Path, float, str] | None:
    """A curve, the number that belongs to it, and what that is."""
    if isinstance(item, Path):
        return item, item.length, "length"
    line = getattr(item, "line", None)
    if not isinstance(line, Path):
        return None
    return (line, float(item.level), "level") if hasattr(item, "level") else (line, line.length, "length")


def _curves(what: Any) -> list[tuple[Path, float, str]] | None:
    """None where these are no curves; an empty list of isolines is a list of curves."""
    one = _curve(what)
    if one is not None:
        return [one]
    if not isinstance(what, (list, tuple)):
        return None
    found = [_curve(item) for item in what]
    curves = [curve for curve in found if curve is not None]
    return curves if len(curves) == len(found) else None


def _write_curves(
    place: str,
    curves: list[tuple[Path, float, str]],
    mesh: Mesh | None,
    name: str | None,
    kind: str,
    drawing: tuple[float, str, bool],
) -> None:
    cores = [curve._mesh for curve, _, _ in curves] if mesh is None else [mesh._mesh]
    core = cores[0] if cores else _core.make_mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.uint32))
    if core is None:
        raise BrushfireError(f"{place}: these curves do not know their mesh any more: give it as mesh=")
    if any(other is not core for other in cores):
        raise BrushfireError(f"{place}: these curves are on several meshes: one file has curves of one")
    lines = [
        (_arrays.integers(c.points.face, "face"), _arrays.triples(c.points.weights, "weights"), c.closed, float(value))
        for c, value, _ in curves
    ]
    _core.write_lines(place, core, lines, name or (curves[0][2] if curves else "length"), kind, *drawing)


def _millimetres(unit: Any) -> float:
    if unit not in _UNITS:
        raise BrushfireError(f"unit: one of {', '.join(_UNITS)} is needed, not {unit!r}")
    return _UNITS[unit]


def _view(view: Any) -> str:
    if not isinstance(view, str):
        raise BrushfireTypeError(f"view: a string is needed, not {view!r}")
    return view


def _write_map(place: str, polar: LogMap, mesh: Mesh | None, kind: str) -> None:
    core = polar._mesh if mesh is None else mesh._mesh
    if core is None:
        raise BrushfireError(f"{place}: this log map does not know its mesh any more: give it as mesh=")
    sparse = polar.vertices is not None
    rows = polar.vertices if polar.vertices is not None else np.flatnonzero(np.isfinite(polar.radius)).astype(np.int32)
    chosen = slice(None) if sparse else rows
    columns = np.column_stack([polar.uv[chosen], polar.radius[chosen], polar.angle[chosen]])
    _core.write_map(place, core, rows, np.ascontiguousarray(columns).ravel(), kind)


# ---- matrices, and what nibabel writes


@contextlib.contextmanager
def _complete(place: str, suffix: str) -> Iterator[str]:
    """The name of a file beside the one that is meant, which it becomes in the end."""
    try:
        handle, part = tempfile.mkstemp(suffix=suffix, prefix=".brushfire-", dir=os.path.dirname(place) or ".")
    except OSError as error:
        raise BrushfireError(f"{place}: {error.strerror}", "file_not_writable") from None
    os.close(handle)
    try:
        yield part
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(part, 0o666 & ~umask)
        os.replace(part, place)
    except OSError as error:
        raise BrushfireError(f"{place}: {error.strerror}", "file_not_writable") from None
    finally:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(part)


def _extension(place: str, kind: str, known: Iterable[str], what: str) -> str:
    extension = "." + kind if kind else os.path.splitext(place)[1].lower()
    if extension not in known:
        names = " or ".join(e[1:] for e in known)
        raise BrushfireError(f"{place}: {what} is written as {names}, not as '{extension[1:]}'", "unknown_format")
    return extension


def _write_dense(place: str, matrix: npt.NDArray[Any], kind: str) -> None:
    _extension(place, kind, (".npy",), "a dense matrix")
    with _complete(place, ".npy") as part, open(part, "wb") as file:
        np.save(file, np.ascontiguousarray(matrix), allow_pickle=False)


def _write_sparse(place: str, matrix: Any, kind: str) -> None:
    import scipy.io
    import scipy.sparse

    extension = _extension(place, kind, _SPARSE, "a sparse matrix")
    with _complete(place, extension) as part, open(part, "wb") as file:
        if extension == ".npz":
            scipy.sparse.save_npz(file, matrix.tocsr(), compressed=False)
        else:
            scipy.io.mmwrite(file, matrix.tocoo(), symmetry="general")


def _write_dscalar(
    place: str,
    count: int,
    values: Floats | None,
    labels: Labels | None,
    names: tuple[str, str],
    structure: str | None,
) -> None:
    """Of CIFTI-2: maps over the vertices that have finite values; the others are in no map."""
    try:
        cifti2 = importlib.import_module("nibabel.cifti2")
    except ImportError:
        raise ImportError(f"{place}: CIFTI-2 is written by nibabel: pip install nibabel") from None
    maps = [(name, array) for name, array in zip(names, (values, labels), strict=True) if array is not None]
    if not maps or structure is None:
        raise BrushfireError(
            f"{place}: CIFTI-2 holds a field of a structure='cortex_left' or another part of the brain"
        )
    for _, array in maps:
        if len(array) != count:
            raise BrushfireError(f"{place}: {len(array)} values for a mesh of {count} vertices")
    inside = np.isfinite(values) if values is not None else np.ones(count, dtype=bool)
    try:
        brain = cifti2.BrainModelAxis.from_surface(np.flatnonzero(inside), count, name=structure)
    except ValueError as error:
        raise BrushfireError(f"structure: {error}") from None
    rows = np.array([array[inside] for _, array in maps], dtype=np.float32)
    image = cifti2.Cifti2Image(rows, header=(cifti2.ScalarAxis([name for name, _ in maps]), brain))
    image.nifti_header.set_intent("NIFTI_INTENT_CONNECTIVITY_DENSE_SCALARS")
    with _complete(place, _DSCALAR) as part:
        image.to_filename(part)
