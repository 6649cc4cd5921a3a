"""The tables of docs/decisions/marching.md: carried-source beside other marching methods, in error and in time.

    python marching_table.py errors results.json MESH... [--sources N] [--deform] [--other NAME=COMMAND ...]
    python marching_table.py times results.json MESH[:ROUNDS]... [--rounds N] [--peers A,B] [--other NAME=COMMAND ...]
    python marching_table.py print results.json

A MESH is a file, or a name of meshes.py; --deform takes each stretched tenfold and sheared, too. Errors are those of
every vertex against exact, from N sources spread over the vertices inside (GSP begins nowhere else; default 4). Times
are the medians of interleaved rounds (peers.py) from vertex 0, the mesh refined ROUNDS times. What results.json holds
already is not measured again. Then prints the tables as Markdown.
"""

import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

import meshes
import numpy as np
import peers

OURS, BEFORE = "carried-source", "novotni-klein"
METHODS = f"{OURS},{BEFORE},exact"


def load(mesh, folder, build):
    """Vertices and faces of a file, or of a mesh of meshes.py."""
    if not Path(mesh).exists():
        return meshes.arrays(mesh)
    vertices, faces = folder / "v", folder / "f"
    subprocess.run([build / "make_arrays", mesh, vertices, faces, "0"], check=True, stdout=subprocess.DEVNULL)
    return np.fromfile(vertices, "<f8").reshape(-1, 3), np.fromfile(faces, "<i4").reshape(-1, 3)


def sources_of(vertices, faces, count):
    """Vertices inside the surface, evenly spread over their numbers."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, uses = np.unique(edges, axis=0, return_counts=True)
    inside = np.zeros(len(vertices), bool)
    inside[faces] = True
    inside[unique[uses != 2]] = False
    (candidates,) = np.nonzero(inside)
    return [int(candidates[i * len(candidates) // count]) for i in range(min(count, len(candidates)))]


class Results:
    """Rows of peers.py in a file."""

    def __init__(self, file):
        self.file = file
        self.rows = json.loads(file.read_text()) if file.exists() else []

    def has(self, kind, mesh, source):
        return any((r["kind"], r["mesh"], r["source"]) == (kind, mesh, source) for r in self.rows)

    def add(self, row):
        self.rows.append(row)
        self.file.write_text(json.dumps(self.rows, indent=1) + "\n")


def measure(kind, mesh, name, source, options, results, **settings):
    if results.has(kind, name, source):
        return
    arguments = [str(mesh), "--name", name, "--source", str(source), "--build", str(options.build)]
    for option, value in settings.items():
        arguments += [f"--{option}", str(value)]
    for other in options.other:
        arguments += ["--other", other]
    with tempfile.TemporaryDirectory() as folder:
        row = peers.measure(peers.parse(arguments), Path(folder))
    peers.show(row)
    results.add({"kind": kind} | row)


def measure_errors(options, results):
    for mesh in options.meshes:
        for ending in ("", *meshes.DEFORMATIONS) if options.deform else ("",):
            with tempfile.TemporaryDirectory() as folder:
                folder = Path(folder)
                found = load(mesh, folder, options.build)
                if found is None:
                    print(f"{mesh}: left out, CGAL's demonstration data (Debian's libcgal-demo) is not at hand")
                    break
                vertices, faces = found
                if ending:
                    vertices = vertices @ meshes.DEFORMATIONS[ending]
                file = folder / "mesh.off"
                meshes.write_off(file, vertices, faces)
                for source in sources_of(vertices, faces, options.sources):
                    measure("errors", file, Path(mesh).stem + ending, source, options, results,
                            methods=METHODS, peers="", rounds=1, patience=120)  # fmt: skip


def measure_times(options, results):
    for mesh in options.meshes:
        mesh, _, rounds = mesh.partition(":")
        with tempfile.TemporaryDirectory() as folder:
            file = mesh if Path(mesh).exists() else meshes.find(mesh, folder)
            name = Path(mesh).stem + (f"-s{rounds}" if rounds else "")
            measure("times", file, name, 0, options, results, methods=f"{OURS},{BEFORE}", peers=options.peers,
                    rounds=options.rounds, refine=rounds or 0, patience=300, truth="none")  # fmt: skip


def is_scan(mesh):
    return not mesh.endswith(tuple(meshes.DEFORMATIONS)) and not mesh.startswith(("grid", "square"))


def programs(rows):
    return [n for n in dict.fromkeys(n for r in rows for n in r["results"]) if n != "exact"]


def errors_of(row, program, key):
    """In percent; None where the program failed or left out vertices that can be reached."""
    result = row["results"].get(program, {})
    return 100 * result[key] if result.get(key) is not None and not result["lost"] else None


def percent(value):
    return "failed" if value is None else "0" if value < 1e-4 else f"{value:.3f}" if value < 1 else f"{value:.3g}"


def is_below(ours, other):
    """Rounding is not told apart: floats have 6 to 7 digits."""
    return other is None or ours <= max(other, 1e-3)


def print_errors(rows):
    names = programs(rows)
    rivals = [n for n in names if n != OURS]
    print("| mesh | sources | " + " | ".join(names) + " | largest is the least |\n|---|--:|" + "--:|" * (len(names) + 1))
    worse, won, below = [], 0, dict.fromkeys(rivals, 0)
    for mesh in dict.fromkeys(r["mesh"] for r in rows):
        of_mesh = [r for r in rows if r["mesh"] == mesh]
        cells, means = [], {}
        for name in names:
            mean = [errors_of(r, name, "mean_error") for r in of_mesh]
            most = [errors_of(r, name, "max_error") for r in of_mesh]
            failed = None in mean
            means[name] = None if failed else statistics.mean(mean)
            cells.append("failed" if failed else f"{percent(means[name])} / {percent(max(most))}")
        wins = {n: [is_below(errors_of(r, OURS, "max_error"), errors_of(r, n, "max_error")) for r in of_mesh] for n in rivals}
        least = sum(all(of_run) for of_run in zip(*wins.values()))
        won += least
        for n in rivals:
            below[n] += sum(wins[n])
        if not all(is_below(means[OURS], means[n]) for n in rivals):
            worse.append(mesh)
        print(f"| {mesh} | {len(of_mesh)} | " + " | ".join(cells) + f" | {least} of {len(of_mesh)} |")
    shares = [f"below {n}'s in {100 * below[n] / len(rows):.1f} %" for n in rivals]
    print(f"\nThe largest error is {', '.join(shares)}, the least of all in {won} of {len(rows)} runs ({100 * won / len(rows):.1f} %).")
    print("The mean is not the least on " + (", ".join(worse) or "none") + ".")
    scans = [r for r in rows if is_scan(r["mesh"])]
    for name in names:
        means = [errors_of(r, name, "mean_error") for r in scans]
        good = [m for m in means if m]
        print(f"Geometric mean of {name}'s means over {len(good)} of {len(means)} runs on scans: {statistics.geometric_mean(good):.4f} %.")


def print_times(rows):
    names = programs(rows)
    print("| mesh | vertices | " + " | ".join(names) + " |\n|---|--:|" + "--:|" * len(names))
    for row in sorted(rows, key=lambda r: r["vertices"]):
        cells = []
        for name in names:
            result = row["results"].get(name, {"failure": ""})
            cells.append("failed" if "failure" in result else " / ".join(
                f"{1e9 * result[key] / row['vertices']:.0f}" for key in ("solve_s", "set_up_s")))  # fmt: skip
        print(f"| {row['mesh']} | {row['vertices']} | " + " | ".join(cells) + " |")
    print("\nNanoseconds a vertex, solve / set-up.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["errors", "times", "print"])
    parser.add_argument("json", type=Path)
    parser.add_argument("meshes", nargs="*")
    parser.add_argument("--sources", type=int, default=4)
    parser.add_argument("--deform", action="store_true", help="each mesh stretched and sheared, too")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--peers", default="meshlib")
    parser.add_argument("--other", action="append", default=[], metavar="NAME=COMMAND")
    parser.add_argument("--build", type=Path, default=peers.HERE.parent / "build/benchmark/benchmarks")
    options = parser.parse_args()
    results = Results(options.json)
    if options.what == "errors":
        measure_errors(options, results)
    if options.what == "times":
        measure_times(options, results)
    for kind, show in (("errors", print_errors), ("times", print_times)):
        rows = [r for r in results.rows if r["kind"] == kind]
        if rows:
            print()
            show(rows)


if __name__ == "__main__":
    main()
