"""The exceptions of the package."""

from __future__ import annotations


class BrushfireError(ValueError):
    """Something that the library refuses, with the reason in one line and a code for programs.

    ``code`` is one of ``invalid_argument``, ``index_out_of_range``, ``invalid_mesh``, ``file_not_readable``,
    ``file_malformed``, ``file_not_writable``, ``unknown_format``, ``cancelled``, ``too_large``, ``internal``.

    >>> import brushfire as bf
    >>> try:
    ...     bf.Mesh([[0, 0, 0]], [[0, 0, 7]])
    ... except bf.BrushfireError as error:
    ...     print(error.code, "-", error)
    invalid_mesh - face 0 names vertex 7, but there are 1 vertices
    """

    code: str

    def __init__(self, message: str, code: str = "invalid_argument") -> None:
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type[BrushfireError], tuple[str, str]]:
        return type(self), (str(self), self.code)


class BrushfireIndexError(BrushfireError, IndexError):
    """A vertex, face or source number that does not exist: a BrushfireError and an IndexError.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> try:
    ...     mesh.distance(3, method="dijkstra")
    ... except IndexError as error:
    ...     print(error)
    vertex 3 does not exist: the mesh has 3 vertices
    """

    def __init__(self, message: str, code: str = "index_out_of_range") -> None:
        super().__init__(message, code)


class BrushfireTypeError(BrushfireError, TypeError):
    """A value of another type than the call takes: a BrushfireError and a TypeError.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> try:
    ...     mesh.distance(0, threads=1.5)
    ... except bf.BrushfireError as error:
    ...     print(error)
    threads: an integer is needed, not 1.5
    """


class BrushfireWarning(UserWarning):
    """Something that was done and may not be what was meant: a position far off was moved to the surface."""


def error_of(code: str, message: str) -> BrushfireError:
    """The exception for an error of the C++ library, which calls this."""
    if code == "index_out_of_range":
        return BrushfireIndexError(message)
    return BrushfireError(message, code)
