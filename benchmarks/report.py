"""Turns the results of suite.py into docs/benchmarks.md and docs/pareto.svg.

    python report.py results.json [FOLDER]      into docs/, or that folder
"""

import importlib.metadata
import json
import math
import platform
import re
import subprocess
import sys
from pathlib import Path

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
    "gc-fmm-cpp": "geometry-central FMM, C++ †",
    "vcg": "VCG, C++ †",
    "vtp": "VTP research code †",
    "gc-exact": "geometry-central exact, C++ †",
    "cgal": "CGAL exact, C++ †",
}
MARCHING_PEERS = ["meshlib", "gc-fmm", "gc-fmm-cpp", "pymeshlab", "vcg"]
EXACT_PEERS = ["vtp", "gc-exact", "pygeodesic", "cgal"]
EXACT = 1e-9  # what is counted as exact: it has no place on a logarithmic scale, and is drawn on a line of its own


def is_ours(name):
    return name not in NAMES


def label(name):
    return f"**`{name}`**" if is_ours(name) else NAMES[name]


def first(result):
    return result.get("first_s", result["set_up_s"] + result["solve_s"])


def number(value):
    return "" if value is None else "< 1e-12" if value < 1e-12 else f"{value:.2g}"


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


def marching_summary(rows):
    """novotni-klein against the fastest fast marching peer of each mesh, and against MeshLib end to end."""
    lines = [
        "| mesh | vertices | solve ns/v | fastest peer | its ns/v | ratio | mean error / its | mean error / VCG's |"
        " arrays to field, ratio to MeshLib |",
        "|---|--:|--:|---|--:|--:|--:|--:|--:|",
    ]
    for row in rows:
        peers, ours = ran(row, MARCHING_PEERS), ran(row, ["novotni-klein"]).get("novotni-klein")
        if not ours or not peers:
            continue
        name, fastest = min(peers.items(), key=lambda item: item[1]["solve_s"])
        vcg = peers.get("vcg") or peers.get("pymeshlab")
        error = ours.get("mean_error")
        share = ratio(error / fastest["mean_error"], 2) if error is not None and fastest.get("mean_error") else ""
        share_vcg = ratio(error / vcg["mean_error"], 2) if vcg and error and vcg.get("mean_error", 0) > 1e-9 else ""
        total = ratio(first(peers["meshlib"]) / first(ours)) if "meshlib" in peers else ""
        lines.append(
            f"| {row['mesh']} | {row['vertices']} | {1e9 * ours['solve_s'] / row['vertices']:.0f} | {NAMES[name]} |"
            f" {1e9 * fastest['solve_s'] / row['vertices']:.0f} | {ratio(fastest['solve_s'] / ours['solve_s'])} |"
            f" {share} | {share_vcg} | {total} |"
        )
    return "\n".join(lines) + "\n"


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


def annotate(axes, points):
    """Writes (x, y, text, colour) beside their points, each where it covers nothing; farther ones with a line."""
    frame = axes.get_window_extent()
    near = 7  # pixels around a point that stay free
    centres = [axes.transData.transform((x, y)) for x, y, _, _ in points]
    taken = [(x - near, y - near, x + near, y + near) for x, y in centres] + [axes.get_legend().get_window_extent().extents]
    places = [(10, -4, "left"), (-10, -4, "right")]
    places += [(0, sign * dy, side) for dy in range(12, 200, 12) for sign in (1, -1) for side in ("left", "right")]
    for x, y, text, colour in sorted(points):
        beside = {"xy": (x, y), "textcoords": "offset points", "color": colour, "fontsize": 8}
        for dx, dy, side in places:
            note = axes.annotate(text, xytext=(dx, dy), ha=side, **beside)
            left, low, right, top = note.get_window_extent().extents
            inside = frame.x0 < left and right < frame.x1 and frame.y0 < low and top < frame.y1
            if inside and all(right < l or r < left or top < b or t < low for l, b, r, t in taken):
                taken.append((left - 3, low, right + 3, top))
                if abs(dy) > 20:
                    axes.annotate("", xytext=(0, dy), arrowprops={"arrowstyle": "-", "color": colour, "lw": 0.5}, **beside)
                break
            note.remove()


def pareto(rows, file):
    """Error against time, one point a program: geometric means over the meshes that all of them solved."""
    import matplotlib

    matplotlib.use("agg")  # measures text, for annotate(); the file is SVG by its name
    import matplotlib.pyplot as plt

    matplotlib.rcParams["svg.hashsalt"] = "brushfire"
    matplotlib.rcParams["svg.fonttype"] = "none"
    rows = [row for row in rows if row["truth"] and len(ran(row, MARCHING_PEERS)) >= 3]
    if not rows:
        return []
    names = [n for n in rows[0]["results"] if all(n in ran(row, [n]) for row in rows)]
    mean = lambda values: math.exp(sum(map(math.log, values)) / len(values))  # noqa: E731
    figure, axes = plt.subplots(figsize=(8.5, 6), dpi=72)  # a pixel is a point, as in the SVG
    points = []
    for name in names:
        results = [row["results"][name] for row in rows]
        x = mean([1e9 * first(r) / row["vertices"] for r, row in zip(results, rows)])
        errors = [r.get("mean_error", 1) for r in results]
        y = mean(errors) if min(errors) > EXACT else None
        colour = "#c0392b" if is_ours(name) else "#34495e"
        points.append((x, y, NAMES.get(name, name), colour))
    # What is exact stands on a line of its own, a decade below the least error that is one.
    line = min([y for _, y, _, _ in points if y] or [1e-6]) / 10
    points = [(x, y or line, text, colour) for x, y, text, colour in points]
    for x, y, text, colour in points:
        axes.plot(x, y, "s" if text in NAMES.values() else "o", color=colour)
    axes.axhline(line, color="#999999", lw=0.8, ls=":")
    axes.text(0.005, line, "exact", transform=axes.get_yaxis_transform(), va="bottom", fontsize=8, color="#666666")
    axes.set(xscale="log", yscale="log", xlabel="arrays to field: ns per vertex, one thread")
    axes.set(ylabel="mean relative error", title="Error against time; lower left is better")
    axes.grid(True, which="major", alpha=0.3)
    axes.set_xmargin(0.12)
    axes.set_ymargin(0.1)
    axes.plot([], [], "o", color="#c0392b", label="brushfire")
    axes.plot([], [], "s", color="#34495e", label="other programs")
    axes.legend(loc="upper right")
    figure.tight_layout()
    figure.canvas.draw()
    annotate(axes, points)
    figure.savefig(file, metadata={"Date": None}, bbox_inches="tight")
    return [row["mesh"] for row in rows]


def processor():
    match = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    megahertz = re.search(r"cpu MHz\s*: ([0-9.]+)", Path("/proc/cpuinfo").read_text())
    speed = f" at {float(megahertz[1]) / 1000:.1f} GHz" if megahertz else ""
    return (match[1] if match else platform.processor()) + speed


def versions():
    pins = (HERE / "requirements.txt").read_text().splitlines()
    names = [line.split("==")[0] for line in pins if line and not line.startswith("#")]
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    return compiler + "; " + ", ".join(f"{n} {importlib.metadata.version(n)}" for n in names)


def main():
    folder = Path(sys.argv[2]) if len(sys.argv) > 2 else DOCS
    rows = sorted(json.loads(Path(sys.argv[1]).read_text()), key=lambda row: row["vertices"])
    scans = [r for r in rows if not r["mesh"].endswith(("-x10", "-shear")) and not r["mesh"].startswith("grid")]
    stretched = [r for r in rows if r not in scans]
    drawn = pareto([r for r in scans if "-s" not in r["mesh"]], folder / "pareto.svg")
    places = {
        "processor": processor(),
        "versions": versions(),
        "marching": marching_summary(scans),
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
