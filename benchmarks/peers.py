"""Measures our methods and the peers on one mesh, interleaved, and adds the result to a JSON file.

    python peers.py MESH --json results.json [--refine ROUNDS] [--source V] [--rounds N] [--core C]
                         [--methods A,B] [--peers A,B] [--other NAME=COMMAND ...] [--truth FILE.npy | NAME]
                         [--patience SECONDS] [--once A,B]

Every program sits in a process of its own, all on one core, and gets one round after the other in turn, so that
whatever disturbs the machine disturbs all of them; the median of the rounds counts. Times are processor time. Errors
are relative to the truth: a .npy file, or the field of one of the programs that take part (default: exact).

--other adds a program of your own that answers like time_solver (see there): COMMAND VERTICES FACES SOURCE ... with
{v} {f} {s} {d} standing for the arrays, the source and the file for the distances.
"""

import argparse
import contextlib
import json
import os
import select
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent


class Contestant:
    """One program, waiting for its next round."""

    def __init__(self, name, command, distances):
        self.name, self.distances, self.rounds, self.failure = name, distances, [], None
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    def round(self, patience):
        if self.failure:
            return
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.write("\n")
            self.process.stdin.flush()
        if not select.select([self.process.stdout], [], [], patience)[0]:
            self.process.kill()
            self.failure = f"no answer after {patience:g} s"
            return
        answer = self.process.stdout.readline()
        if answer:
            self.rounds.append(json.loads(answer))
        else:
            self.process.wait()
            lines = self.process.stderr.read().strip().splitlines()
            status = self.process.returncode
            self.failure = f"ended by signal {-status}" if status < 0 else lines[-1] if lines else f"exit status {status}"

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()
        self.process.wait()

    def field(self):
        if self.failure or not os.path.exists(self.distances):
            return None
        return np.fromfile(self.distances, dtype="<f8")

    def result(self):
        if self.failure:
            return {"failure": self.failure}
        median = {key: statistics.median(r[key] for r in self.rounds) for key in self.rounds[0]}
        median["memory_mib"] = self.rounds[0].get("memory_mib")
        return median | {"rounds": len(self.rounds)}


def errors(distance, truth):
    """Relative errors over the vertices that the truth reaches, the source left out."""
    valid = np.isfinite(truth) & (truth > 0)
    relative = (distance[valid] - truth[valid]) / truth[valid]
    finite = np.isfinite(relative) & (distance[valid] < 1e30)
    relative = relative[finite]
    magnitude = np.abs(relative)
    return {
        "mean_error": float(magnitude.mean()),
        "p99_error": float(np.quantile(magnitude, 0.99)),
        "max_error": float(magnitude.max()),
        "shortest": float(min(0.0, relative.min())),
        "lost": int((~finite).sum()),
    }


def command_of(name, build, files):
    """The command of one of our methods ("novotni-klein") or of a peer ("peer:meshlib")."""
    if name.startswith("peer:"):
        return [sys.executable, HERE / "peer.py", files["v"], files["f"], files["s"], name[5:], files["d"]]
    return [build / "time_solver", files["v"], files["f"], files["s"], name, files["d"]]


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", type=Path)
    parser.add_argument("--name", help="of the mesh in the results; default: its file name")
    parser.add_argument("--refine", type=int, default=0, help="rounds of curved one-to-four subdivision")
    parser.add_argument("--source", type=int, default=0, help="vertex")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--once", default="", help="programs that get one round only: the slow ones")
    parser.add_argument("--patience", type=float, default=60, help="seconds to wait for one round")
    parser.add_argument("--core", type=int, help="pin everything to this processor")
    parser.add_argument("--methods", default="novotni-klein,kimmel-sethian")
    parser.add_argument("--peers", default="meshlib,pymeshlab,gc-fmm")
    parser.add_argument("--other", action="append", default=[], metavar="NAME=COMMAND")
    parser.add_argument("--truth", default="exact", help="a .npy file or the name of a contestant")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build/benchmark/benchmarks")
    parser.add_argument("--json", type=Path, help="results are added to this file")
    return parser.parse_args(arguments)


def measure(options, folder):
    vertices, faces = folder / "vertices", folder / "faces"
    subprocess.run(
        [options.build / "make_arrays", options.mesh, vertices, faces, str(options.refine)],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    names = [m for m in options.methods.split(",") if m] + ["peer:" + p for p in options.peers.split(",") if p]
    others = dict(o.split("=", 1) for o in options.other)
    contestants = []
    for number, name in enumerate([*names, *others]):
        files = {"v": str(vertices), "f": str(faces), "s": str(options.source), "d": str(folder / f"distances{number}")}
        command = (
            shlex.split(others[name].format(**files)) if name in others else command_of(name, options.build, files)
        )
        contestants.append(Contestant(name.removeprefix("peer:"), command, files["d"]))
    for round_number in range(options.rounds):
        for contestant in contestants:
            if round_number == 0 or contestant.name not in options.once.split(","):
                contestant.round(options.patience)
    for contestant in contestants:
        contestant.close()

    truth = None
    if options.truth.endswith(".npy"):
        truth = np.load(options.truth)
    else:
        truth = next((c.field() for c in contestants if c.name == options.truth), None)
    results = {}
    for contestant in contestants:
        results[contestant.name] = contestant.result()
        field = contestant.field()
        if truth is not None and field is not None:
            results[contestant.name] |= errors(field, truth)
    return {
        "mesh": options.name or options.mesh.stem + (f"-s{options.refine}" if options.refine else ""),
        "vertices": vertices.stat().st_size // 24,
        "faces": faces.stat().st_size // 12,
        "source": options.source,
        "date": time.strftime("%Y-%m-%d"),
        "load": round(os.getloadavg()[1], 1),  # of the last five minutes
        "truth": os.path.basename(options.truth) if truth is not None else None,
        "results": results,
    }


def show(row):
    print(f"\n{row['mesh']}: {row['vertices']} vertices, source {row['source']}, truth: {row['truth']}")
    header = ("", "set-up ms", "solve ms", "ns/vertex", "arrays->field ns/v", "mean error", "max error", "MiB")
    print("{:>20} {:>10} {:>10} {:>10} {:>19} {:>11} {:>10} {:>8}".format(*header))
    for name, r in row["results"].items():
        if "failure" in r:
            print(f"{name:>20} failed: {r['failure']}")
            continue
        n = row["vertices"]
        print(
            f"{name:>20} {1e3 * r['set_up_s']:10.2f} {1e3 * r['solve_s']:10.2f} {1e9 * r['solve_s'] / n:10.0f}"
            f" {1e9 * r.get('first_s', r['set_up_s'] + r['solve_s']) / n:19.0f}"
            f" {r.get('mean_error', float('nan')):11.2e} {r.get('max_error', float('nan')):10.2e}"
            f" {r.get('memory_mib') or 0:8.1f}"
        )


def run(options):
    if options.core is not None:
        os.sched_setaffinity(0, {options.core})
    with tempfile.TemporaryDirectory() as folder:
        row = measure(options, Path(folder))
    show(row)
    if options.json:
        rows = json.loads(options.json.read_text()) if options.json.exists() else []
        rows = [r for r in rows if (r["mesh"], r["source"]) != (row["mesh"], row["source"])] + [row]
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    run(parse())
