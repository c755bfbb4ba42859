"""How long the main job takes: start, a case from file to report, a branch; as ratios to the bare linear algebra.

    python benchmarks/spine.py            prints a table and writes benchmarks/results/spine.md

Needs the package with its test extra (SciPy for LAPACK). Everything is measured in one run on one machine; times
are the best of several, since other work on the machine only ever adds.
"""

from __future__ import annotations

import os
import platform
import resource
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

for variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import numpy as np
from scipy.linalg.lapack import dgbsv
from timing import best

import rodwell
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.straight.critical import critical_loads

HERE = Path(__file__).parent
EXAMPLE = HERE.parent / "examples" / "drill-string.toml"
COMMAND = [sys.executable, "-m", "rodwell"]
elapsed = partial(best, clock=time.perf_counter)
"""Commands run in processes of their own, so the clock on the wall is asked."""


def command(*arguments: str, cache: str | None = None) -> None:
    environment = dict(os.environ)
    if cache is not None:
        environment["NUMBA_CACHE_DIR"] = cache
    subprocess.run([*COMMAND, *arguments], check=True, capture_output=True, env=environment)


def banded_solve(unknowns: int, half_bandwidth: int) -> float:
    """Time of one LAPACK factorisation and solution with two right-hand sides: the limit for a Newton step."""
    band = np.zeros((3 * half_bandwidth + 1, unknowns))
    band[half_bandwidth:] = 0.1
    band[2 * half_bandwidth] = 10.0
    right = np.ones((unknowns, 2))
    return elapsed(lambda: dgbsv(half_bandwidth, half_bandwidth, band, right), 200)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder) / "results")
        cold = elapsed(lambda: command("run", str(EXAMPLE), "--no-path", "--out", out, cache=folder), 1)
        warm = elapsed(lambda: command("run", str(EXAMPLE), "--no-path", "--out", out, cache=folder), 5)
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024.0
    start = elapsed(lambda: command("--help"), 5)

    problem = rodwell.Problem(15.0)
    mode = critical_loads(problem, 1)[0]

    def branch() -> rodwell.Branch:
        return follow(problem, mode, until=-200.0, largest_step=0.0123)

    points, space = len(branch()), branch()[-1].point.fine.space
    per_branch = elapsed(branch, 20)
    whole = elapsed(lambda: rodwell.diagram(problem, until=-700.0), 6)
    curve = elapsed(lambda: rodwell.lift_off_curve(problem, "weight", (0.0, 300.0)), 3)
    limit = banded_solve(space.size - 4, space.degree)
    rows = [
        ("`rodwell --help`", f"{start:.2f} s", "0.3 s"),
        ("`rodwell run --no-path examples/drill-string.toml`, kernels compiled", f"{warm:.1f} s", "5 s"),
        ("the same, first time ever", f"{cold:.1f} s", "20 s"),
        ("largest memory of that", f"{memory:.0f} MB", "400 MB"),
        (
            f"branch of {points} points, w = 15, F to −200, rtol 1e-8, lift-off located",
            f"{1e3 * per_branch:.0f} ms",
            "100 ms",
        ),
        ("Fig. 3(c) complete: 4 primary and 2 secondary branches to F = −700", f"{1e3 * whole:.0f} ms", "500 ms"),
        ("lift-off load over weight 0 to 300, about 150 points", f"{curve:.2f} s", ""),
        (
            "one point of it (both meshes, all numbers, errors)",
            f"{1e3 * per_branch / points:.2f} ms",
            "",
        ),
        (f"one LAPACK banded solve of the finer mesh ({space.size - 4} unknowns)", f"{1e6 * limit:.0f} µs", ""),
        ("ratio of the two", f"{per_branch / points / limit:.0f}", ""),
    ]
    lines = [f"Measured on {platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}, "
             f"rodwell {rodwell.__version__}.", "", "| what | measured | limit |", "| --- | --- | --- |"]  # fmt: skip
    lines += [f"| {what} | {value} | {bound} |" for what, value, bound in rows]
    text = "\n".join(lines) + "\n"
    print(text)
    (HERE / "results").mkdir(exist_ok=True)
    (HERE / "results" / "spine.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
