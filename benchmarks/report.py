"""Turns the results of suite.py into docs/benchmarks.md and docs/pareto.svg.

    python report.py results.json [FOLDER]      into docs/, or that folder
"""

import importlib.metadata
import json
import os
import platform
import re
import statistics
import subprocess
import sys
from pathlib import Path

import pareto

HERE = Path(__file__).resolve().parent
DOCS = HERE.parent / "docs"

# How the peers are called in the tables, and which of our methods stand beside them. Programs that are not on PyPI are
# measured where they are at hand; the name says so.
NAMES = {
    "meshlib": "MeshLib",
    "pymeshlab": "PyMeshLab (VCG)",
    "gc-fmm": "geometry-central FMM, potpourri3d",
    "gc-heat": "geometry-central heat, potpourri3d",
    "pygeodesic": "pygeodesic (MMP)",
    "gdist": "tvb-gdist (MMP)",
    "igl-exact": "igl.exact_geodesic",
    "gsp": "GSP, C++ †",
    "gc-fmm-cpp": "geometry-central FMM, C++ †",
    "vcg": "VCG, C++ †",
    "vtp": "VTP research code †",
    "gc-exact": "geometry-central exact, C++ †",
    "cgal": "CGAL exact, C++ †",
}
MARCHING = ["carried-source", "novotni-klein", "kimmel-sethian"]
MARCHING_PEERS = ["gsp", "meshlib", "gc-fmm", "gc-fmm-cpp", "pymeshlab", "vcg"]
EXACT_PEERS = ["vtp", "gc-exact", "pygeodesic", "cgal"]
EXACT = 1e-9  # what is counted as exact: it has no place on a logarithmic scale, and is drawn in a band of its own


def is_ours(name):
    return name not in NAMES


def label(name):
    return f"**`{name}`**" if is_ours(name) else NAMES[name]


def first(result):
    return result.get("first_s", result["set_up_s"] + result["solve_s"])


def number(value):
    return "" if value is None else "rounding" if value < EXACT else f"{value:.2g}"


def mesh_table(row):
    """All programs on one mesh."""
    n = row["vertices"]
    lines = [
        "| | set-up ns/v | solve ns/v | arrays to field ns/v | mean error | 99 % below | largest | MiB |",
        "|---|--:|--:|--:|--:|--:|--:|--:|",
    ]
    for name, r in row["results"].items():
        if "failure" in r:
            lines.append(f"| {label(name)} | {r['failure'].replace('|', ' ')} |||||||")
            continue
        times = [f"{1e9 * t / n:.0f}" for t in (r["set_up_s"], r["solve_s"], first(r))]
        errors = [number(r.get(key)) for key in ("mean_error", "p99_error", "max_error")]
        lines.append(f"| {label(name)} | " + " | ".join([*times, *errors, f"{r['memory_mib']:.0f}"]) + " |")
    heading = f"### {row['mesh']}: {n} vertices\n\nSource: vertex {row['source']}. Truth: {row['truth'] or 'none'}.\n"
    return heading + "\n" + "\n".join(lines) + "\n"


def ran(row, names):
    return {name: row["results"][name] for name in names if "failure" not in row["results"].get(name, {"failure": ""})}


def ratio(value, digits=1):
    return f"{value:.{digits}f}x"


def marching_summary(rows, cell):
    """The marching methods beside those of other programs: a line for each mesh, `cell` of each program's result."""
    names = [n for n in [*MARCHING, *MARCHING_PEERS] if any(ran(row, [n]) for row in rows)]
    lines = [
        "| mesh | vertices | " + " | ".join(label(n) for n in names) + " |",
        "|---|--:|" + "--:|" * len(names),
    ]
    for row in rows:
        results = ran(row, names)
        cells = [cell(row, results[n]) if n in results else "" for n in names]
        lines.append(f"| {row['mesh']} | {row['vertices']} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def solve_time(row, result):
    return f"{1e9 * result['solve_s'] / row['vertices']:.0f}"


def both_errors(_, result):
    if "mean_error" not in result:
        return ""
    return " / ".join("0" if e < EXACT else f"{100 * e:.2g}" for e in (result["mean_error"], result["max_error"]))


def exact_summary(rows):
    """exact against every exact peer: ratio of the solves."""
    lines = [
        "| mesh | vertices | exact ns/v | " + " | ".join(NAMES[p] for p in EXACT_PEERS) + " | B/vertex, VTP's |",
        "|---|--:|--:|" + "--:|" * (len(EXACT_PEERS) + 1),
    ]
    for row in rows:
        ours, peers = ran(row, ["exact"]).get("exact"), ran(row, EXACT_PEERS)
        if not ours or not peers:
            continue
        cells = [ratio(peers[p]["solve_s"] / ours["solve_s"]) if p in peers else "" for p in EXACT_PEERS]
        memory = [f"{r['memory_mib'] * 2**20 / row['vertices']:.0f}" for r in (ours, peers.get("vtp")) if r]
        lines.append(
            f"| {row['mesh']} | {row['vertices']} | {1e9 * ours['solve_s'] / row['vertices']:.0f} | "
            + " | ".join(cells)
            + f" | {', '.join(memory)} |"
        )
    return "\n".join(lines) + "\n"


def programs_of(rows):
    """For pareto.draw(), what all meshes were solved by: geometric means of times, means of errors."""
    rows = [row for row in rows if row["truth"] and len(ran(row, MARCHING_PEERS)) >= 3]
    programs = []
    for name in rows[0]["results"] if rows else []:
        results = [ran(row, [name]).get(name) for row in rows]
        if not all(results):
            continue
        times = [1e9 * first(r) / row["vertices"] for r, row in zip(results, rows)]
        error = statistics.mean(r.get("mean_error", 1) for r in results)
        programs.append((NAMES.get(name, name), statistics.geometric_mean(times), error if error > EXACT else None, is_ours(name)))
    return programs, [row["mesh"] for row in rows]


def processor():
    match = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    megahertz = re.search(r"cpu MHz\s*: ([0-9.]+)", Path("/proc/cpuinfo").read_text())
    speed = f" at {float(megahertz[1]) / 1000:.1f} GHz" if megahertz else ""
    return (match[1] if match else platform.processor()) + speed


def versions():
    pins = (HERE / "requirements.txt").read_text().splitlines()
    names = [line.split("==")[0] for line in pins if line and not line.startswith("#")]
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    installed = {d.metadata["Name"].lower(): d.version for d in importlib.metadata.distributions()}
    return compiler + "; " + ", ".join(f"{n} {installed[n]}" for n in names if n in installed)


def when(rows):
    """The days and the load of the machine, as peers.py noted them."""
    days = sorted({row["date"] for row in rows if "date" in row})
    loads = [row["load"] for row in rows if "load" in row]
    if not days:
        return "at a time that was not noted"
    span = f"on {days[0]}" if len(days) == 1 else f"from {days[0]} to {days[-1]}"
    counts = sorted({r["rounds"] for row in rows for r in row["results"].values() if "rounds" in r})
    rounds = f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else f"{counts[0]}"
    busy = f"{min(loads):.1f} to {max(loads):.1f} programs ran or waited at a time, these included"
    return f"{span}, on {os.cpu_count()} processors of a machine on which\n  {busy} (load averages), {rounds} rounds"


def main():
    folder = Path(sys.argv[2]) if len(sys.argv) > 2 else DOCS
    rows = sorted(json.loads(Path(sys.argv[1]).read_text()), key=lambda row: row["vertices"])
    scans = [r for r in rows if not r["mesh"].endswith(("-x10", "-shear")) and not r["mesh"].startswith("grid")]
    stretched = [r for r in rows if r not in scans]
    programs, drawn = programs_of([r for r in scans if "-s" not in r["mesh"]])
    if programs:
        pareto.draw(programs, folder / "pareto.svg", "Error against time")
    places = {
        "processor": processor(),
        "when": when(rows),
        "versions": versions(),
        "marching times": marching_summary(rows, solve_time),
        "marching errors": marching_summary(rows, both_errors),
        "exact": exact_summary(rows),
        "pareto meshes": ", ".join(drawn),
        "scans": "\n".join(mesh_table(r) for r in scans),
        "stretched": "\n".join(mesh_table(r) for r in stretched),
    }
    page = (HERE / "benchmarks.md.in").read_text()
    page = re.sub(r"\{\{(.*?)\}\}", lambda place: places[place[1]], page)
    (folder / "benchmarks.md").write_text(page)


if __name__ == "__main__":
    main()
