"""What blocks.py and the trials of packages read of a page: its blocks, what they print, the mesh that they speak of.

Nothing but Python's own library: it is needed where brushfire is not installed.
"""

from __future__ import annotations

import difflib
import math
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PROGRAM = ROOT / "build/release/brushfire"
PROSE = {"", "text", "ts", "{toctree}", "{drawing}", "{eval-rst}", "{viewer}"}
LANGUAGES = {"python": "python", "sh": "sh", "bash": "sh", "console": "console", "c++": "c++", "cpp": "c++", "js": "js"}


@dataclass
class Block:
    page: str
    line: int
    language: str
    text: str
    expected: str | None = None
    reason: str | None = None  # why it is not run
    hidden: bool = False


class Failure(Exception):
    pass


def blocks_of(file: Path) -> list[Block]:
    page = (file.relative_to(ROOT) if file.is_relative_to(ROOT) else file).as_posix()
    lines = file.read_text().splitlines()
    found: list[Block] = []
    reason: str | None = None
    follows = False  # whether only blank lines lie between the last block and here
    i = 0
    while i < len(lines):
        line = lines[i]
        start = i + 1
        if fence := re.match(r"(`{3,}|:{3,})(\S*)", line):
            end = next((k for k in range(i + 1, len(lines)) if lines[k].strip() == fence[1]), None)
            if end is None:
                raise Failure(f"{page}:{start}: the block does not end")
            text = "\n".join(lines[i + 1 : end])
            i = end + 1
            if fence[2] == "text" and follows and reason is None and found and found[-1].reason is None:
                found[-1].expected = text
                follows = False
                continue
            if fence[2] in PROSE:
                continue
            if fence[2] not in LANGUAGES and reason is None:
                raise Failure(
                    f"{page}:{start}: nobody runs a block of {fence[2]}; say why above it: <!-- not run: REASON -->"
                )
            found.append(Block(page, start, LANGUAGES.get(fence[2], fence[2]), text, reason=reason))
            reason, follows = None, True
            continue
        if hidden := re.match(r"<!-- run: (\w[\w+]*)$", line):
            end = next(k for k in range(i + 1, len(lines)) if lines[k].strip() == "-->")
            found.append(Block(page, start, LANGUAGES[hidden[1]], "\n".join(lines[i + 1 : end]), hidden=True))
            i = end + 1
            continue
        if said := re.search(r"<!-- not run: (.*) -->$", line):
            reason, follows = said[1], False
        elif re.match(r" {4}(brushfire|\./run|git) ", line) and (i == 0 or not lines[i - 1].strip()):
            end = next((k for k in range(i, len(lines)) if not lines[k].startswith("    ")), len(lines))
            found.append(Block(page, start, "sh", "\n".join(x[4:] for x in lines[i:end]), reason=reason))
            reason, follows = None, True
            i = end
            continue
        elif line.strip():
            follows = False
        i += 1
    return found


def compare(expected: str, printed: str) -> None:
    """`...` stands for anything, spaces for any spaces."""
    wanted, got = " ".join(expected.split()), " ".join(printed.split())
    pattern = r".*?".join(re.escape(part) for part in wanted.split("..."))
    if not re.fullmatch(pattern, got):
        difference = "\n".join(difflib.ndiff(expected.strip().splitlines(), printed.strip().splitlines()))
        raise Failure(f"prints something else:\n{difference}")


def make_scan(file: Path) -> None:
    """Round and dented as scanned things are; what is rougher makes all-pairs computations slow."""
    sphere = file.with_suffix(".obj")
    subprocess.run([PROGRAM, "shape", "sphere", "-n", "642", "-o", sphere, "--quiet"], check=True)
    rows = [line.split() for line in sphere.read_text().splitlines()]
    vertices, faces = ([row[1:] for row in rows if row[:1] == [kind]] for kind in "vf")
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}", *(f"property double {axis}" for axis in "xyz"),
             f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]  # fmt: skip
    for x, y, z in (map(float, vertex) for vertex in vertices):
        radius = 1 + 0.12 * math.sin(4 * x + 1) * math.cos(3 * y) + 0.08 * math.sin(5 * z) * math.cos(4 * x)
        lines.append(f"{x * radius!r} {y * radius!r} {z * radius!r}")
    lines += [" ".join(["3", *(str(int(corner) - 1) for corner in face)]) for face in faces]
    file.write_text("\n".join(lines) + "\n")
    sphere.unlink()
