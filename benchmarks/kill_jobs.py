"""kill_jobs.py PROGRAM MESH [--kills 20] [--seed 1] [--shards 16] [--dask]: matrices whose processes are killed -9 at random times.

Four jobs, each killed as often as told and then left to end; each must have the bytes of a run that nobody disturbed:
`brushfire matrix` to .npy and to .zarr, shards in random order with their merge, and with --dask a cluster of three
workers (which needs the Python package and dask.distributed). Prints a table in Markdown; ends with 1 where a byte
differs. docs/cluster.md
"""

from __future__ import annotations

import argparse
import hashlib
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path


def content(path: Path) -> str:
    """Of a file, or of all files of a store."""
    digest = hashlib.sha256()
    for file in sorted(p for p in path.rglob("*") if p.is_file()) if path.is_dir() else [path]:
        digest.update(f"{file.relative_to(path)}\0".encode() if path.is_dir() else b"")
        with file.open("rb") as stream:
            while block := stream.read(1 << 20):
                digest.update(block)
    return digest.hexdigest()


class Killer:
    """Runs commands, and kills those that it may at a random time of what they take undisturbed."""

    def __init__(self, kills: int, seed: int) -> None:
        self.left, self.done, self.random = kills, 0, random.Random(seed)
        self.resumed: list[int] = []

    def run(self, command: list[str], seconds: float) -> None:
        """Again and again until it ends by itself."""
        while True:
            with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
                if self.left > 0:
                    try:
                        process.wait(self.random.uniform(0, seconds))
                    except subprocess.TimeoutExpired:
                        process.send_signal(signal.SIGKILL)
                said = process.stderr.read() if process.stderr else ""
            if "resuming at row" in said:
                self.resumed.append(int(said.split("resuming at row ")[1].split()[0]))
            if process.returncode == 0:
                return
            if process.returncode != -signal.SIGKILL:
                sys.exit(f"{' '.join(command)}: exit code {process.returncode}\n{said}")
            self.left, self.done = self.left - 1, self.done + 1


def timed(command: list[str]) -> float:
    start = time.monotonic()
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    return time.monotonic() - start


def row(what: str, killer: Killer, same: bool) -> bool:
    told = f"{min(killer.resumed)} to {max(killer.resumed)}" if killer.resumed else ""
    print(f"| {what} | {killer.done} | {told} | {'the same bytes' if same else '**OTHER BYTES**'} |", flush=True)
    return same


def by_dask(folder: Path, mesh_file: str, kills: int, seed: int) -> bool:
    import distributed

    import brushfire as bf
    import brushfire.dask

    mesh = bf.read(mesh_file)
    mesh.write_distance_matrix(folder / "alone.zarr", method="carried-source", threads=1)
    killer, ended = Killer(kills, seed), threading.Event()
    with (
        distributed.LocalCluster(n_workers=3, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster,
        distributed.Client(cluster) as client,
    ):
        # As often as told: by default Dask gives a task up that three workers have died with.
        cluster.scheduler.allowed_failures = kills + 3

        def kill() -> None:
            while killer.left > 0 and not ended.wait(killer.random.uniform(0.2, 1.0)):
                # One that is at work: a nanny gives a worker up that dies while it starts.
                known = client.scheduler_info(n_workers=-1).get("workers", {})
                pids = [w.process.pid for w in cluster.workers.values() if w.worker_address in known and w.process]
                if pids:
                    os.kill(killer.random.choice(pids), signal.SIGKILL)
                    killer.left, killer.done = killer.left - 1, killer.done + 1

        while killer.left > 0:  # a mesh that is quick is computed again, until all kills have been made
            subprocess.run(["rm", "-rf", str(folder / "dask.zarr")], check=True)
            ended.clear()
            thread = threading.Thread(target=kill)
            thread.start()
            brushfire.dask.distance_matrix(mesh, store=folder / "dask.zarr", client=client, method="carried-source")
            ended.set()
            thread.join()
            if content(folder / "dask.zarr") != content(folder / "alone.zarr"):
                return row("Dask, three workers", killer, False)
    return row("Dask, three workers", killer, True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("mesh")
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--shards", type=int, default=16)
    parser.add_argument("--dask", action="store_true")
    a = parser.parse_args()
    fine = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        matrix = [a.program, "matrix", a.mesh, "--method", "carried-source"]
        print("| job | kills -9 | resumed at row | after all |\n|---|---|---|---|")
        for kind in ("npy", "zarr"):
            alone, killed = folder / f"alone.{kind}", folder / f"killed.{kind}"
            seconds = timed([*matrix, "-o", str(alone)])
            killer = Killer(a.kills, a.seed)
            while killer.left > 0:
                subprocess.run(["rm", "-rf", str(killed)], check=True)
                killer.run([*matrix, "-o", str(killed)], seconds)
            fine &= row(f"`brushfire matrix -o d.{kind}`", killer, content(killed) == content(alone))
        killer = Killer(a.kills, a.seed)
        shards = [f"{k}/{a.shards}" for k in range(1, a.shards + 1)]
        killer.random.shuffle(shards)
        seconds = timed([*matrix, "--shard", shards[0], "-o", str(folder / "timed.npy")])
        while killer.left > 0:
            for file in folder.glob("d.*"):
                file.unlink()
            for shard in shards:
                killer.run([*matrix, "--shard", shard, "-o", str(folder / "d.npy")], seconds)
        files = sorted(str(p) for p in folder.glob(f"d.*-of-{a.shards}.npy"))
        subprocess.run([a.program, "merge", *files, "-o", str(folder / "d.npy"), "--quiet"], check=True)
        same = content(folder / "d.npy") == content(folder / "alone.npy")
        fine &= row(f"{a.shards} shards, and `brushfire merge`", killer, same)
        if a.dask:
            fine &= by_dask(folder, a.mesh, a.kills, a.seed)
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
