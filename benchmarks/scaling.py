"""How time and memory grow with the mesh: exact, windows and novotni-klein from 5 thousand to 5 million vertices.

    python scaling.py results.json [--only MESH-sROUNDS,...] [options of peers.py, such as --core]

Each mesh of SERIES is refined by make_arrays again and again; one run of peers.py each, one thread. What the file holds
already is not measured again. Then prints, for every series and method, nanoseconds and bytes a vertex and the exponent
p of time ~ vertices^p, by least squares over the sizes from FROM up.
"""

import argparse
import json
import math
import tempfile
from pathlib import Path

import meshes
import peers

SERIES = {"rocker-arm": 4, "stanford-bunny": 3, "fertility": 5}  # the most rounds of refinement
METHODS = ["novotni-klein", "windows:1e-3", "exact"]
FROM = 10_000  # vertices; smaller meshes fit into the caches
LARGE = 1_000_000  # from here on one run is enough


def name_of(mesh, refine):
    return f"{mesh}-s{refine}" if refine else mesh


def measure(mesh, refine, vertices, results, passed_on):
    """Adds one row to the results."""
    with tempfile.TemporaryDirectory() as folder:
        file = meshes.find(mesh, folder)
        if file is None:
            print(f"{mesh}: left out, it is not in libcgal-demo")
            return
        rounds = 1 if vertices >= LARGE else 3
        options = {"refine": refine, "rounds": rounds, "methods": ",".join(METHODS), "patience": 600, "json": results}
        arguments = [str(file), "--peers", ""]
        for option, value in options.items():
            arguments += [f"--{option}", str(value)]
        peers.run(peers.parse([*arguments, *passed_on]))


def exponent(rows, key):
    """Of the power law through (vertices, key)."""
    points = [(math.log(vertices), math.log(result[key])) for vertices, result in rows if vertices >= FROM]
    if len(points) < 2:
        return math.nan
    x, y = (sum(column) / len(points) for column in zip(*points, strict=True))
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def table(rows):
    """In Markdown."""
    yield "| mesh | vertices | " + " | ".join(f"{m}: set-up ns/v | solve ns/v | bytes/v" for m in METHODS) + " |"
    yield "|---|--:|" + "--:|--:|--:|" * len(METHODS)
    for series, most in SERIES.items():
        found = [rows[name] for refine in range(most + 1) if (name := name_of(series, refine)) in rows]
        for row in found:
            n = row["vertices"]
            cells = [row["mesh"], f"{n:,}"]
            for r in (row["results"][m] for m in METHODS):
                cells += [f"{1e9 * r[key] / n:.0f}" for key in ("set_up_s", "solve_s")]
                cells.append(f"{r['memory_mib'] * 2**20 / n:.0f}")
            yield "| " + " | ".join(cells) + " |"
        if not found:
            continue
        cells = [f"{series}: exponent", ""]
        for m in METHODS:
            results = [(row["vertices"], row["results"][m]) for row in found]
            cells += [f"{exponent(results, key):.2f}" for key in ("set_up_s", "solve_s", "memory_mib")]
        yield "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json", type=Path)
    parser.add_argument("--only", help="names such as fertility-s3, separated by commas")
    chosen, passed_on = parser.parse_known_args()

    def rows():
        return {r["mesh"]: r for r in json.loads(chosen.json.read_text())} if chosen.json.exists() else {}

    for series, most in SERIES.items():
        for refine in range(most + 1):
            name = name_of(series, refine)
            if name in rows() or (chosen.only and name not in chosen.only.split(",")):
                continue
            coarser = rows().get(name_of(series, refine - 1), {"vertices": 0})
            measure(series, refine, 4 * coarser["vertices"], chosen.json, passed_on)
    print("\n" + "\n".join(table(rows())))


if __name__ == "__main__":
    main()
