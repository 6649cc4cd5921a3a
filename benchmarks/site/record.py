"""What the scripts of this folder share: processor time, errors, and the JSON that numbers of docs/ are held against."""

from __future__ import annotations

import datetime
import json
import platform
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import brushfire as bf

ROOT = Path(__file__).parents[2]


def processor_time(call: Callable[[], Any], rounds: int = 5) -> float:
    """Median of the rounds, in seconds; other load on the machine hardly shows in it."""
    taken = []
    for _ in range(rounds):
        begin = time.process_time()
        call()
        taken.append(time.process_time() - begin)
    return float(np.median(taken))


def errors(values: np.ndarray, truth: np.ndarray) -> dict[str, float]:
    """Relative, where the truth is neither 0 nor infinite."""
    counted = np.isfinite(truth) & (truth > 0)
    off = np.abs(values[counted] - truth[counted]) / truth[counted]
    return {"mean": float(off.mean()), "largest": float(off.max())}


def processor() -> str:
    names = [
        line.split(":")[1].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if line.startswith("model name")
    ]
    return names[0] if names else platform.machine()


def save(name: str, command: str, measured: dict[str, Any]) -> None:
    """docs/measured/NAME.json; numbers with four digits, which is more than they are good for."""

    def shortened(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: shortened(v) for key, v in value.items()}
        if isinstance(value, (list, tuple)):
            return [shortened(v) for v in value]
        return float(f"{value:.4g}") if isinstance(value, float) else value

    record = {
        "command": command,
        "date": datetime.date.today().isoformat(),
        "processor": processor(),
        "brushfire": bf.__version__,
        **shortened(measured),
    }
    file = ROOT / "docs/measured" / f"{name}.json"
    file.parent.mkdir(exist_ok=True)
    file.write_text(json.dumps(record, indent=1) + "\n")
    print(file.relative_to(ROOT))
