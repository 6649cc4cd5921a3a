"""The page that python_peers.py writes of what it measured."""

import importlib.metadata
import importlib.util
import platform

import brushfire as bf

FIELDS = {
    "brushfire": "brushfire, tolerance 1e-3 (default)",
    "brushfire-exact": "brushfire, exact",
    "brushfire-nk": "brushfire, novotni-klein, float64",
    "brushfire-nk-float": "brushfire, novotni-klein, float32",
    "meshlib": "meshlib",
    "pymeshlab": "pymeshlab",
    "gc-fmm": "potpourri3d, FMM",
    "gc-heat": "potpourri3d, heat",
    "pyvista": "pyvista (edges)",
    "pygeodesic": "pygeodesic",
    "gdist": "tvb-gdist",
    "igl-exact": "libigl, exact_geodesic",
}
OURS = {
    "exact": {"method": "exact"},
    "tolerance 1e-3": {"tolerance": 1e-3},
    "novotni-klein, float64": {"method": "novotni-klein", "precision": "float64"},
    "novotni-klein, float32": {"method": "novotni-klein", "precision": "float32"},
}


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def short(x, digits=3):
    return f"{x:.{digits}g}" if x < 10**digits else f"{x:.0f}"


def percent(x):
    return "exact" if x < 1e-9 else short(100 * x, 2) + " %"


def page(kept):
    packages = ("tvb-gdist", "pygeodesic", "libigl", "potpourri3d", "meshlib", "pymeshlab", "pyvista")
    found = [p for p in packages if importlib.util.find_spec(p.replace("tvb-", "").replace("lib", "", p == "libigl"))]
    versions = ", ".join(f"{p} {importlib.metadata.version(p)}" for p in found)
    lines = [
        "# The Python package beside its peers",
        "",
        "Written by `python benchmarks/python_peers.py`; do not edit. Processor time of one thread; ratios below are to be",
        "read as orders: the machine was shared. `gpytoolbox` has no distance along surfaces and is left out.",
        "",
        f"brushfire {bf.__version__}, {versions}. Python {platform.python_version()}, {platform.machine()}.",
        "",
    ]
    if "fields" in kept:
        lines += ["## One source, all vertices", "", "Seconds; relative errors against the exact distance.", ""]
        for mesh in dict.fromkeys(r["mesh"] for r in kept["fields"]):
            rows = [r for r in kept["fields"] if r["mesh"] == mesh]
            lines += [f"### {mesh}: {rows[0]['vertices']} vertices", ""]
            lines += table(
                ("", "set-up", "solve", "mean error", "largest error"),
                [
                    (
                        FIELDS[r["peer"]],
                        short(r["set_up_s"]),
                        short(r["solve_s"]),
                        percent(r["mean"]),
                        percent(r["max"]),
                    )
                    if "solve_s" in r
                    else (FIELDS[r["peer"]], "", f"over {r['patience']:.0f}", "", "")
                    for r in rows
                ],
            )
        lines += ["tvb-gdist and libigl build their mesh anew in every call: it is in their solve.", ""]
    if "local" in kept:
        lines += [
            "## Everything within a radius of every vertex",
            "",
            "Microseconds per row; in brackets how many times faster than `gdist.local_gdist_matrix`, which looks at all",
            "vertices for every row. That part of its cost grows with the mesh, ours with what the radius reaches: a factor",
            "of a hundred comes where a row reaches a small part of the mesh, and not at large radii.",
            "",
        ]
        rows = []
        for r in kept["local"]:
            per_row = 1e6 / r["vertices"]
            ours = [f"{short(per_row * r[n])} ({short(r['gdist'] / r[n], 2)}x)" for n in OURS]
            rows.append((r["mesh"], f"{r['radius']:g} mm", f"{r['entries']:.0f}", short(per_row * r["gdist"]), *ours))
        lines += table(("", "radius", "entries per row", "gdist", *OURS), rows)
        worst = max(r["difference"] for r in kept["local"])
        lines += [f"The distances that both matrices hold differ by {worst:.1e} mm at most (exact).", ""]
    if "pairs" in kept:
        lines += ["## All pairs", "", "Rows per second, one thread.", ""]
        rows = []
        for r in kept["pairs"]:
            wb = r.get("workbench")
            wb_text = (
                f"{short(wb['rows per second'])} (error {percent(wb['mean'])}, at most {percent(wb['max'])})"
                if wb
                else ""
            )
            rows.append((r["mesh"], *(short(r[n]) for n in OURS), short(r["gdist"]), wb_text))
        lines += table(("", *OURS, "gdist.compute_gdist", "Connectome Workbench"), rows)
    if "threads" in kept:
        lines += [
            "## Two threads",
            "",
            "Wall time of one thread over that of two (the best of the rounds: the machine is shared), and the processor",
            "time that two threads need together over that of one: 1.00 would be a factor of 2 on an idle machine.",
            "",
        ]
        rows = [(r["mesh"], r["what"], f"{r['wall']:.2f}", f"{r['work']:.3f}") for r in kept["threads"]]
        lines += table(("", "", "wall time, one / two", "work, two / one"), rows)
    if kept.get("overhead"):
        lines += [
            "## What Python costs",
            "",
            "On stanford-bunny: milliseconds in C++, through Python, and the ratio.",
            "",
        ]
        rows = []
        for r in kept["overhead"]:
            for key, what in (("first_s", "arrays to first field"), ("solve_s", "second field")):
                cpp, python, ratio = r[key]
                rows.append((r["method"], what, short(1e3 * cpp), short(1e3 * python), f"{ratio:.3f}"))
        lines += table(("", "", "C++", "Python", "ratio"), rows)
    return "\n".join(lines).rstrip() + "\n"
