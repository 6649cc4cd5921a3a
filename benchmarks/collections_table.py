"""Tables of collections of meshes that a reader has fetched: every method's time and error, over many meshes.

    python collections_table.py FOLDER [--each N] [--json results.json] [--build FOLDER] [--methods A,B] [--peers A,B]
                                [--other NAME=COMMAND ...] [--page docs/collections.md]

A collection is a folder in FOLDER (or FOLDER itself): FAUST (training/registrations/*.ply), TOSCA (*.vert beside *.tri, or
*.off), surfaces of the Human Connectome Project (*.midthickness.*.surf.gii), or any others that `brushfire info` reads.
Of each collection the first N meshes by name, evenly spread (default 10), from vertex 0, errors against `exact`; printed as
Markdown: nanoseconds per vertex are medians over the meshes, mean errors are means, the largest is the largest of all.
None of these collections may be handed on, so none comes with this. --other is that of peers.py; --page writes the tables
into collections.md.in.
"""

import argparse
import json
import re
import statistics
import tempfile
from pathlib import Path

import peers
import report

HERE = Path(__file__).resolve().parent
ENDINGS = (".ply", ".off", ".obj", ".stl", ".vtk", ".vtp", ".surf.gii", ".gii", ".tri")
METHODS = "novotni-klein,carried-source,windows:1e-2,windows:1e-3,exact"


def meshes_in(folder):
    """FreeSurfer's have no ending, so what lies in folders called surf counts, too."""
    found = [file for file in sorted(folder.rglob("*")) if file.is_file() and file.name.lower().endswith(ENDINGS)]
    return found + [file for file in sorted(folder.rglob("surf/*h.*")) if file.name in ("lh.white", "rh.white", "lh.pial", "rh.pial")]


def spread(files, count):
    return [files[i * len(files) // count] for i in range(min(count, len(files)))] if len(files) > count else files


def readable(file, folder):
    """TOSCA's text files, vertices and triangles counted from one, as OFF; others as they are."""
    if file.suffix != ".tri":
        return file
    vertices = file.with_suffix(".vert").read_text().split()
    corners = file.read_text().split()
    lines = [f"OFF\n{len(vertices) // 3} {len(corners) // 3} 0"]
    lines += [" ".join(vertices[i : i + 3]) for i in range(0, len(vertices), 3)]
    lines += ["3 " + " ".join(str(int(c) - 1) for c in corners[i : i + 3]) for i in range(0, len(corners), 3)]
    off = Path(folder) / f"{file.stem}.off"
    off.write_text("\n".join(lines) + "\n")
    return off


def table(name, rows):
    """One collection, a line for each program."""
    sizes = sorted({row["vertices"] for row in rows})
    span = f"{sizes[0]} to {sizes[-1]}" if len(sizes) > 1 else f"{sizes[0]}"
    lines = [f"## {name}: {len(rows)} meshes of {span} vertices\n",
             "| | set-up ns/v | solve ns/v | arrays to field ns/v | mean error | largest | failed |",
             "|---|--:|--:|--:|--:|--:|--:|"]  # fmt: skip
    for program in rows[0]["results"]:
        all_of_it = [(row["vertices"], row["results"][program]) for row in rows]
        good = [(n, r) for n, r in all_of_it if "failure" not in r]
        if not good:
            lines.append(f"| {report.label(program)} |||||| {len(all_of_it)} |")
            continue
        times = [statistics.median(1e9 * r[key] / n for n, r in good) for key in ("set_up_s", "solve_s", "first_s") if key in good[0][1]]
        times += [statistics.median(1e9 * (r["set_up_s"] + r["solve_s"]) / n for n, r in good)] * (3 - len(times))
        errors = [statistics.mean(r["mean_error"] for _, r in good), max(r["max_error"] for _, r in good)]
        cells = [f"{t:.0f}" for t in times] + [report.number(e) for e in errors] + [str(len(all_of_it) - len(good))]
        lines.append(f"| {report.label(program)} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def measured(files, options):
    rows = []
    for file in files:
        with tempfile.TemporaryDirectory() as folder:
            arguments = [str(readable(file, folder)), "--rounds", "2", "--patience", "60", "--methods", options.methods,
                         "--peers", options.peers, "--name", file.name]  # fmt: skip
            arguments += ["--build", str(options.build)] if options.build else []
            arguments += [word for other in options.other for word in ("--other", other)]
            rows.append(peers.measure(peers.parse(arguments), Path(folder)))
    return rows


def write_page(results, page):
    """docs/collections.md: the tables, and on what they were measured."""
    rows = [row for rows in results.values() for row in rows]
    places = {
        "processor": report.processor(),
        "when": report.when(rows),
        "versions": report.versions(),
        "tables": "\n".join(table(name, rows) for name, rows in results.items()),
    }
    text = (HERE / "collections.md.in").read_text()
    page.write_text(re.sub(r"\{\{(.*?)\}\}", lambda place: places[place[1]], text).rstrip() + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--each", type=int, default=10)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--build", type=Path)
    parser.add_argument("--methods", default=METHODS)
    parser.add_argument("--peers", default="meshlib,pymeshlab,gc-fmm,gc-heat")
    parser.add_argument("--other", action="append", default=[])
    parser.add_argument("--page", type=Path)
    options = parser.parse_args()
    folders = [folder for folder in sorted(options.folder.iterdir()) if folder.is_dir() and meshes_in(folder)]
    results = {}
    for folder in folders if folders and not any(options.folder.glob("*.*")) else [options.folder]:
        files = spread(meshes_in(folder), options.each)
        if not files:
            raise SystemExit(f"{folder}: no meshes ({', '.join(ENDINGS)})")
        results[folder.name] = measured(files, options)
        print(table(folder.name, results[folder.name]), flush=True)
    if options.json:
        options.json.write_text(json.dumps(results, indent=1) + "\n")
    if options.page:
        write_page(results, options.page)


if __name__ == "__main__":
    main()
