"""Diagrams of inclined rods beside horizontal ones: processor time for a point, at the same tolerance.

    python benchmarks/inclined.py [--turns 9]

Diagrams are computed in turn, so that what else the machine does falls on all of them. A point is one of a branch,
with its error, index and measured numbers; what is located in between, and the search for branches, is in the time.
Writes ``results/inclined.md``.
"""

from __future__ import annotations

import argparse
import datetime
import os
import platform
import statistics
import time
from pathlib import Path

for variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import rodwell
from rodwell import Problem, diagram

OUT = Path(__file__).parent / "results" / "inclined.md"

RODS = {
    "horizontal, clamped": Problem(15.0, 90.0),
    "α = 60°, clamped": Problem(15.0, 60.0),
    "α = 89°, clamped": Problem(15.0, 89.0),
    "horizontal, pinned–clamped": Problem(15.0, 90.0, ends=("pinned", "clamped")),
    "α = 60°, pinned–clamped": Problem(15.0, 60.0, ends=("pinned", "clamped")),
}
UNTIL, MODES = -500.0, 3


def measured(problem: Problem) -> tuple[float, int]:
    """Processor time of a diagram in s, and its points."""
    start = time.process_time()
    found = diagram(problem, until=UNTIL, modes=MODES)
    return time.process_time() - start, sum(len(branch) for branch in found)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--turns", type=int, default=9)
    turns = parser.parse_args().turns
    for problem in RODS.values():
        measured(problem)  # kernels are read
    spent: dict[str, list[float]] = {name: [] for name in RODS}
    points = {}
    for _ in range(turns):
        for name, problem in RODS.items():
            seconds, points[name] = measured(problem)
            spent[name].append(seconds / points[name])
    lines = [
        "# Diagrams of inclined rods beside horizontal ones", "",
        f"`python benchmarks/inclined.py --turns {turns}`, w = 15, {MODES} modes, F to {UNTIL:g}, rtol 1e-8, "
        f"{datetime.date.today().isoformat()}, rodwell {rodwell.__version__}, {platform.machine()}, Python "
        f"{platform.python_version()}. Processor time for a point; ratios are medians over the turns, to the "
        "horizontal rod with the same ends in the same turn.", "",
        "| rod | points | a point, median | least | ratio to horizontal |", "| --- | --- | --- | --- | --- |",
    ]  # fmt: skip
    for name, each in spent.items():
        base = spent[f"horizontal, {name.rpartition(', ')[2]}"]
        ratio = statistics.median(a / b for a, b in zip(each, base, strict=True))
        middle = 1e3 * statistics.median(each)
        lines.append(f"| {name} | {points[name]} | {middle:.3f} ms | {1e3 * min(each):.3f} ms | {ratio:.2f} |")
        print(lines[-1])
    OUT.write_text("\n".join([*lines, ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
