"""One Newton iteration against the bare LAPACK solve of its system, and a state against scipy.integrate.solve_bvp.

    python benchmarks/peers.py       prints two tables and writes benchmarks/results/peers.md; about a minute

Each ratio is of times measured in turn in one run, the least of many, since other work on the machine only adds.
"""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from pathlib import Path

for variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import numpy as np
from scipy.linalg.lapack import dgbsv
from timing import least

import rodwell
from rodwell.analysis.discrete.measures import Measured
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State

HERE = Path(__file__).parent
PROBLEM = rodwell.Problem(15.0)


def on_elements(solution: rodwell.Solution, least_elements: int) -> tuple[Family, State]:
    """The state on its finer mesh, halved until it has ``least_elements``."""
    family, state = solution.meshes.fine, solution.point.fine
    while family.space.elements < least_elements:
        old, family = family.space, family.on(family.space.refined())
        start = family.space.project(old.evaluate(state.c, family.space.points, 1)[0], family.ends)
        outcome, solved, _ = family.at(start, state.lam)
        assert solved is not None, outcome
        state = solved
    return family, state


def newton() -> list[tuple[str, ...]]:
    """One Newton iteration: assembly, factorisation with stability index, three solutions, tangent."""
    solution = rodwell.follow(PROBLEM, 1, until=-400.0)[-1]
    rows = []
    for elements in (0, 1_000, 4_000):
        family, state = on_elements(solution, elements)
        unknowns, p = family.space.size - 4, family.space.degree
        band = np.zeros((3 * p + 1, unknowns))
        band[p:] = 0.1
        band[2 * p] = 10.0
        right = np.ones((unknowns, 2))
        assert family.at(state.c, state.lam)[2] == 1  # it is one iteration that is timed
        bare, iteration = least((lambda b=band, r=right, p=p: dgbsv(p, p, b, r),  # type: ignore[misc]
                                 lambda f=family, s=state: f.at(s.c, s.lam)), 4.0)  # fmt: skip
        rows.append(
            (str(family.space.elements), f"{1e6 * bare:.0f} µs", f"{1e6 * iteration:.0f} µs", f"{iteration / bare:.1f}")
        )
    return rows


def collocation() -> list[tuple[str, ...]]:
    """The state at F = −122, before lift-off, from one nearby: solve_bvp on the fifteen equations, and rodwell."""
    force = -122.0
    branch = rodwell.follow(PROBLEM, 1, until=force)  # before lift-off: verify would locate it too
    state = branch.at(force)
    rows = []
    own = least((lambda: branch.at(0.5 * (force + branch.force[-2])),), 3.0)[0]
    for tolerance in (1e-6, 1e-8):
        spent = least((lambda rtol=tolerance: rodwell.verify(branch, [force], rtol=rtol),), 4.0)[0]  # type: ignore[misc]
        (checked,) = rodwell.verify(branch, [force], rtol=tolerance).states
        worst = max(checked.differences.values())
        rows.append(
            (f"solve_bvp, tolerance {tolerance:g}", f"{1e3 * spent:.0f} ms", f"{spent / own:.0f}", f"{worst:.0e}")
        )
    error = state.number(Measured.P_MAX).error / abs(state.number(Measured.P_MAX).value)
    rows.append(("rodwell, rtol 1e-8", f"{1e3 * own:.2f} ms", "1", f"{error:.0e} (estimate)"))
    return rows


def table(head: str, rows: Sequence[tuple[str, ...]]) -> list[str]:
    columns = [c.strip() for c in head.split("|")]
    return [
        "| " + " | ".join(columns) + " |",
        "|" + " --- |" * len(columns),
        *("| " + " | ".join(r) + " |" for r in rows),
    ]


def main() -> None:
    lines = [
        f"Measured on {platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}, rodwell "
        f"{rodwell.__version__}; w = 15, α = 90°, Δ = 0.01, mode 1.", "",
        "## One Newton iteration", "",
        "At F = −400: energy, gradient and Hessian, factorisation with the stability index, three solutions, tangent; "
        "against LAPACK's `dgbsv`, factorisation and two right-hand sides, on a matrix of the same size and band.", "",
        *table("elements | LAPACK | Newton iteration | ratio", newton()), "",
        "## One state", "",
        "At F = −122, before lift-off, from a state nearby (solve_bvp: 5 % of the way back to buckling). "
        "rodwell: two meshes, all numbers, errors, stability index.", "",
        *table("code | time | ratio | largest difference of a field", collocation()),
    ]  # fmt: skip
    text = "\n".join(lines) + "\n"
    print(text)
    (HERE / "results").mkdir(exist_ok=True)
    (HERE / "results" / "peers.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
