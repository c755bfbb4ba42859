"""What states off the wall cost, against states on it: one run, ratios.

    python benchmarks/off_wall.py           writes benchmarks/results/off_wall.md

Times are processor times, the least of several runs: other work on the machine only ever adds.
"""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

for variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import numpy as np
from timing import best

import rodwell
from rodwell import follow
from rodwell.analysis.path.load_path import LoadPath

HERE = Path(__file__).parent
ROD = rodwell.Problem(15.0)
ON_WALL, OFF_WALL = np.linspace(-112.0, -123.0, 10), np.linspace(-124.0, -146.5, 10)
"""End forces at which the rod is on the wall; and in partial contact as the load grows, a helix as it comes back."""


def path() -> LoadPath:
    """The whole loop of theory: up to −160, and back to −90."""
    return rodwell.load_path(ROD, until=-160.0, unload_to=-90.0)


def main() -> None:
    found = path()  # compiled, and imported
    branch, dense = follow(ROD, until=-400.0), partial(follow, ROD, until=-200.0, largest_step=0.0123)
    points = {
        "a point of a branch on the wall, large steps": best(lambda: follow(ROD, until=-400.0), 20) / len(branch),
        "the same, small steps": best(dense, 20) / len(dense()),
    }
    asked = {
        "a state on the wall that is asked for, with certificate": _each(branch.states_at, ON_WALL, 20),
        "a state off the wall that is asked for, with certificate": _each(
            lambda load: [one.state for one in found.at(load)], OFF_WALL, 10
        ),
    }
    first = asked["a state on the wall that is asked for, with certificate"]
    rows = [(what, f"{1e3 * spent:.3g} ms", spent / first) for what, spent in (points | asked).items()]
    whole = best(path, 5)
    count = sum(len(run) for leg in found.legs for run in leg.runs)
    what = f"the loop to −160 and back to −90: {count} states, {len(found.events)} events located, 2 snaps"
    rows.append((what, f"{whole:.3g} s", whole / first))
    lines = [
        f"Measured on {platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}, "
        f"rodwell {rodwell.__version__}: w = 15, α = 90°, Δ = 0.01, clamped ends. Processor times.",
        "",
        "| what | time | in states on the wall |",
        "| --- | --- | --- |",
        *(f"| {what} | {time} | {ratio:.3g} |" for what, time, ratio in rows),
    ]
    text = "\n".join(lines) + "\n"
    print(text)
    (HERE / "results" / "off_wall.md").write_text(text, encoding="utf-8")


def _each(states: Callable[[float], Iterable[Any]], loads: np.ndarray, times: int) -> float:
    """Time of a state with its certificate."""
    count = sum(len(list(states(float(load)))) for load in loads)
    return best(lambda: [one.certificate for load in loads for one in states(float(load))], times) / count


if __name__ == "__main__":
    main()
