"""Whether a change costs time: this tree beside another one, each piece of work in turns.

    git worktree add --detach ../before REVISION
    python benchmarks/paired.py ../before            prints a table and writes benchmarks/results/paired.md

Each tree gets a process of its own, with kernels of its own on disk, and both do the same work in turns, so that slow
phases of the machine fall on both. Times are of the processor; the ratio is the median over the turns, beside that of
the least times.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
TURNS = 30

WORK = {
    "branch, clamped, horizontal, F to −400": "rodwell.follow(rodwell.Problem(15, 90), 1, until=-400)",
    "branch, clamped, α = 60°, F to −200": "rodwell.follow(rodwell.Problem(15, 60), 1, until=-200)",
    "branch, free–clamped, α = 60°, F to −200": (
        'rodwell.follow(rodwell.Problem(15, 60, ends=("free", "clamped")), 1, until=-200)'
    ),
    "branch of a long rod, γ = 3000, α = 60°, to lift-off": "rodwell.follow(rodwell.Problem(3000, 60), 1)",
    "diagram, F to −700": "rodwell.diagram(rodwell.Problem(15, 90), until=-700)",
    "20 critical loads, α = 60°": "rodwell.critical_loads(rodwell.Problem(15, 60), 20)",
    "lift-off curve, α from 90° to 75°": 'rodwell.lift_off_curve(rodwell.Problem(15, 90), "alpha", (90, 75))',
}
"""What is measured: Python code by its description."""

SERVER = """
import sys, time
import rodwell
for line in sys.stdin:
    work = compile(line, "work", "eval")
    start = time.process_time()
    eval(work)
    print(time.process_time() - start, flush=True)
"""


class Tree:
    """A process that does work with the sources of a tree, and tells the processor time of each."""

    def __init__(self, root: Path, cache: str) -> None:
        environment = os.environ | {"PYTHONPATH": str(root / "src"), "NUMBA_CACHE_DIR": cache}
        environment["OPENBLAS_NUM_THREADS"] = "1"
        self.process = subprocess.Popen(
            [sys.executable, "-c", SERVER], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def time(self, work: str) -> float:
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        print(work, file=self.process.stdin, flush=True)
        return float(self.process.stdout.readline())


def paired(trees: list[Tree], work: str) -> tuple[list[float], float]:
    """Least time in each of two trees, and the median of the ratios of the second to the first."""
    for tree in trees:
        tree.time(work)  # compiles
    turns = [[tree.time(work) for tree in trees] for _ in range(TURNS)]
    return [min(times) for times in zip(*turns, strict=True)], statistics.median(b / a for a, b in turns)


def main() -> int:
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / "src" / "rodwell").is_dir():
        print(__doc__)
        return 2
    other = Path(sys.argv[1])
    revision = subprocess.run(
        ["git", "-C", str(other), "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False
    ).stdout.strip()
    rows = [
        f"This version beside {revision or 'another one'}, {TURNS} turns, processor time, {time.strftime('%Y-%m-%d')}.",
        "",
        "| work | before, least | now, least | least over least | median of the ratios |",
        "| --- | --- | --- | --- | --- |",
    ]
    with tempfile.TemporaryDirectory() as before, tempfile.TemporaryDirectory() as now:
        trees = [Tree(other, before), Tree(HERE.parent, now)]
        for what, work in WORK.items():
            (old, new), ratio = paired(trees, work)
            rows.append(f"| {what} | {1e3 * old:.1f} ms | {1e3 * new:.1f} ms | {new / old:.2f} | {ratio:.2f} |")
            print(rows[-1], flush=True)
        for tree in trees:
            tree.process.communicate()
    table = "\n".join(rows) + "\n"
    print(table)
    (HERE / "results" / "paired.md").write_text(table, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
