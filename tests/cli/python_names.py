"""python_names.py PROGRAM SOURCES: options of the program and arguments of the Python package have the same names.

What a verb's --help lists is held against the arguments of the functions that do the same, both ways: --chord-error is
chord_error=. Where a name has no counterpart, or another one, it stands here with the reason.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

# What does the same as a verb, and what is done for every verb by functions that read, place, block and write.
FUNCTIONS = {
    "info": [],
    "distance": ["distance", "weighted", "costs"],
    "path": ["paths", "weighted"],
    "isolines": ["isolines", "curved_isolines", "distance", "weighted"],
    "log-map": ["log_map"],
    "gradient": ["gradient", "distance", "weighted"],
    "matrix": ["distance_matrix", "write_distance_matrix", "distance_matrices", "weighted"],
    "pairs": ["pair_distances", "weighted"],
    "merge": ["merge_shards"],
    "render": ["render", "panel", "animate", "distance", "weighted"],
    "compare": ["compare"],
    "certify": ["certify"],
    "voronoi": ["voronoi", "weighted"],
    "sample": ["farthest_points", "centroidal_voronoi", "weighted"],
    "measure": ["extent", "eccentricity", "discs"],
    "parcels": ["parcels", "weighted"],
    "smooth": ["smooth"],
    "convert": ["read_lines"],
    "view": ["page"],
    "flatten": ["flatten", "distance"],
    "terrain": ["terrain"],
    "isochrones": ["isochrones", "weighted", "distance"],
}
FOR_EVERY_VERB = {"read": {"weld"}, "at": {"snap_within"}, "walled": {"mask", "faces", "edges", "vertices"},
                  "write": {"unit", "view", "outline"}}  # fmt: skip
NOT_IN_PYTHON = {
    "bench": "timeit",
    "shape": "something to try the program on",
    "completion": "of a shell",
    "manual": "of a shell",
}

# "verb --option" or "--option": what it is called in Python instead ("" for nothing), and why.
OTHERWISE = {
    "--help": ("", "help() shows docstrings"),
    "--json": ("", "results are objects"),
    "--quiet": ("", "nothing is printed unasked: progress="),
    "--output": ("", "write() and save() take a path and an object"),
    "render --output": ("file", "the picture is returned, too"),
    "--source": ("sources", "one name for one and for several places"),
    "log-map --sources": ("source", "there is one"),
    "sample --source": ("first", "the first samples"),
    "sample --sources": ("first", "the first samples"),
    "matrix --source": ("rows", "the rows' places"),
    "matrix --sources": ("rows", "the rows' places"),
    "distance --signed": ("", "signed_distance() is a function of its own"),
    "distance --target": ("targets", "one name for one and for several places"),
    "path --to": ("targets", "one name for one and for several places"),
    "path --via": ("", "path() takes all places of one path, in their order"),
    "path --closed": ("", "of path()"),
    "path --tighten": ("", "of path()"),
    "path --method": ("", "edge_path() is what method dijkstra measures"),
    "path --threads": ("", "one run on one thread, as far as the farthest target"),
    "log-map --threads": ("", "one run on one thread, as far as the radius"),
    "--scalar": ("values", "an array that is there, in place of a file to read"),
    "convert --scalar": ("", "write() takes the array"),
    "--cost": ("weights", "numpy looks them up: costs[labels]"),
    "--name": ("", "arrays have no columns to choose from"),
    "--region": ("mask", "numpy makes the mask: labels == 3"),
    "--block-faces": ("faces", "walled() is what blocks"),
    "--block-edges": ("edges", "walled() is what blocks"),
    "--block-vertices": ("vertices", "walled() is what blocks"),
    "distance --labels": ("return_source", "write(labels=) puts them into the file"),
    "voronoi --borders": ("", "Voronoi.borders, for write()"),
    "render --label-file": ("labels", "an array in place of a file"),
    "render --signed": ("values", "what signed_distance() returns"),
    "render --error": ("", "a panel of the difference of two arrays"),
    "render --error-range": ("scales", "each scale has its own range"),
    "render --path": ("paths", "those that are there, in place of ends to compute one to"),
    "render --size": ("width", "width and height are two numbers; on a command line 640x480 is one word"),
    "render --range": ("low", "low and high are two numbers, and either may be left out"),
    "render --no-bar": ("bar", "bar=False"),
    "render --ambient-occlusion": ("openness", "Mesh.ambient_occlusion() computes it, once for several pictures"),
    "compare --mesh": ("weights", "of any kind: Mesh.vertex_areas()"),
    "compare --fail-above": ("", "an exit code"),
    "certify --show": ("", "slices do that: Certificate.wrong_vertices[:10]"),
    "sample --lloyd": ("sites", "a function of its own: centroidal_voronoi(sites)"),
    "terrain --values": ("", "of Terrain.write(file, values)"),
    "terrain --cell": ("transform", "GDAL's six numbers, which also say where the grid lies"),
    "measure --of": ("", "functions of their own"),
}


class Package:
    """The arguments of every public function of the package, overloads and methods of one name together."""

    def __init__(self, folder: Path) -> None:
        self.arguments: dict[str, set[str]] = {}
        for file in sorted(folder.glob("_*.py")):
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                    a = node.args
                    named = a.posonlyargs + a.args + a.kwonlyargs + ([a.vararg] if a.vararg else [])
                    self.arguments.setdefault(node.name, set()).update(x.arg for x in named)
        self.arguments["render"] |= self._look(folder / "_picture.py")

    @staticmethod
    def _look(file: Path) -> set[str]:
        """What render(**look) takes."""
        names = {"threads", "scales"}
        for node in ast.parse(file.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Tuple):
                names |= {e.value for e in node.value.elts if isinstance(e, ast.Constant)}
        return names

    def of(self, verb: str) -> set[str]:
        """Of what does the same as the verb."""
        shared = set()
        for function, names in FOR_EVERY_VERB.items():
            assert names <= self.arguments[function], (function, names)
            shared |= names
        return shared.union(*(self.arguments[f] for f in FUNCTIONS[verb]))


def options(program: str, verb: str) -> list[list[str]]:
    """The names of each option of a verb, the first one first."""
    text = subprocess.run([program, verb, "--help"], check=True, capture_output=True, text=True).stdout
    rows = re.findall(r"^ {2}(?:-\w,)?(--[\w-]+(?:,--[\w-]+)*)", text, re.MULTILINE)
    return [row.split(",") for row in rows]


def differences(program: str, package: Package) -> list[str]:
    listed = subprocess.run([program, "--help"], check=True, capture_output=True, text=True).stdout
    verbs = re.findall(r"^ {2}(\w[\w-]*) ", listed[listed.index("Verbs:") :].split("\n\n")[0], re.MULTILINE)
    found, needed = [], set()
    missing = set(FUNCTIONS) | set(NOT_IN_PYTHON)
    for verb in verbs:
        missing.discard(verb)
        if verb in NOT_IN_PYTHON:
            if verb.replace("-", "_") in package.arguments:
                found.append(f"{verb}: Python has {verb}() now")
            continue
        if verb not in FUNCTIONS:
            found.append(f"{verb}: which functions of Python do this?")
            continue
        arguments = package.of(verb)
        for names in options(program, verb):
            if names[0].removeprefix("--").replace("-", "_") in arguments:
                continue
            keys = [key for key in (f"{verb} {names[0]}", names[0]) if key in OTHERWISE]
            if not keys:
                found.append(f"{verb} {names[0]} has no {names[0].removeprefix('--').replace('-', '_')}= in Python")
                continue
            needed.add(keys[0])
            other = OTHERWISE[keys[0]][0]
            if other and other not in arguments:
                found.append(f"{verb} {names[0]}: there is no {other}= in Python")
    found += [f"{verb}: there is no such verb" for verb in sorted(missing)]
    return found + [f"OTHERWISE[{key!r}] is not needed" for key in OTHERWISE if key not in needed]


if __name__ == "__main__":
    problems = differences(sys.argv[1], Package(Path(sys.argv[2]) / "python" / "brushfire"))
    print("\n".join(problems) or f"every option has its argument; {len(OTHERWISE)} stand here with a reason")
    sys.exit(bool(problems))
