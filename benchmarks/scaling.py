"""How cost and memory grow: with elements of a mesh, weight of the rod, number of modes, joints of a string.

    python benchmarks/scaling.py            writes benchmarks/results/scaling.md and docs/_static/scaling.png

Times are processor times, the best of several runs: other work on the machine only ever adds. Memory is that of a
process of its own for each size, less that of the smallest size (Linux).
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

for variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import matplotlib as mpl
import numpy as np
from timing import best

import rodwell
from rodwell.analysis.discrete.choices import DEGREE, POINTS_OF_BRANCH
from rodwell.analysis.discrete.family import family
from rodwell.analysis.straight.critical import critical_loads
from rodwell.numerics.splines import banded
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.exact.horizontal import horizontal_loads
from rodwell.plots.style import MODES as COLORS
from rodwell.plots.style import RC, new_axes

HERE = Path(__file__).parent
ELEMENTS = (100, 1_000, 10_000, 100_000)
WEIGHTS = tuple(10.0**k for k in range(1, 10))
INCLINATIONS = (90.0, 60.0, 0.0)
MODES = (1, 3, 10, 30, 100)
PROBLEMS = (1, 10, 100)
BRIDGED = (10, 30, 100, 300, 1_000)
JOINTS = (10, 100, 300, 1_000, 3_000, 10_000)
FOUNDATIONS = (1e4, 1e6, 1e8, 1e10, 1e12, 1e14, 1e16)


def newton(elements: int) -> Callable[[], object]:
    """Assembly, factorisation and solution of one step of Newton's method, on a mesh that is there already."""
    problem = rodwell.Problem(1e3)
    space = SplineSpace(np.linspace(0.0, 1.0, elements + 1), DEGREE, POINTS_OF_BRANCH)
    states = family(problem, space, parity=0, wavenumber=20.0, scale=100.0)
    c = 1e-4 * np.sin(6.0 * np.pi * space.greville)
    c[:2] = c[-2:] = 0.0
    row = np.zeros_like(c)
    one = states.__class__(**{**states.__dict__, "most_steps": 1})
    return lambda: one.correct(c, -600.0, row, 1.0, -600.0)


def iteration(elements: int) -> Callable[[], object]:
    """One step towards critical loads on a new mesh: tables, matrices, a count, inverse iteration, Gram matrices."""
    rng = np.random.default_rng(0)

    def work() -> None:
        space = SplineSpace(np.linspace(0.0, 1.0, elements + 1), DEGREE)
        factors = np.array(
            [np.full(space.points.size, 1.0), np.full(space.points.size, -2.0), np.ones(space.points.size)]
        )
        stiffness, gram = space.form(factors), space.slope_gram
        stiffness[:, 0] += gram[:, 0]
        banded.factorise(stiffness)
        block = rng.standard_normal((5, space.size))
        for vector in block:
            banded.solve(stiffness, vector)
        space.grams(factors, block)

    return work


WORKS = {"newton": newton, "critical": iteration}


def memory(what: str, elements: int) -> float:
    """Largest memory in MB of a process that does one work."""
    command = [sys.executable, __file__, what, str(elements)]
    return float(json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout))


def alone(what: str, elements: int) -> None:
    """Do one work in this process and print the largest memory it took."""
    WORKS[what](elements)()
    status = Path("/proc/self/status").read_text(encoding="utf-8")  # getrusage would tell that of the parent, if larger
    line = next(row for row in status.splitlines() if row.startswith("VmHWM"))
    print(json.dumps(int(line.split()[1]) / 1024.0))


def main() -> None:
    for work in WORKS.values():
        work(100)()  # compile
    runs = {100: 100, 1_000: 40, 10_000: 15, 100_000: 6}
    times = {what: [best(make(n), runs[n]) for n in ELEMENTS] for what, make in WORKS.items()}
    least = {what: memory(what, ELEMENTS[0]) for what in WORKS}
    sizes = {what: [memory(what, n) - least[what] for n in ELEMENTS] for what in WORKS}
    by_weight = {
        alpha: [best(lambda w=w, a=alpha: critical_loads(rodwell.Problem(w, alpha=a), 1), 15) for w in WEIGHTS]
        for alpha in INCLINATIONS
    }
    by_modes = {
        alpha: [best(lambda n=n, a=alpha: critical_loads(rodwell.Problem(1e6, alpha=a), n), 2) for n in MODES]
        for alpha in INCLINATIONS
    }
    text = (
        report(times, sizes, by_weight, by_modes)
        + "\n"
        + "\n".join([*problems(), "", *horizontal(), "", *joints(), "", *bridging()])
        + "\n"
    )
    print(text)
    (HERE / "results" / "scaling.md").write_text(text, encoding="utf-8")
    draw(times, by_weight, HERE.parent / "docs" / "_static" / "scaling.png")


def problems() -> list[str]:
    """Time for each of several problems, α = 60°, weights evenly spread between 10 and 100."""
    rows = ["| problems, γ from 10 to 100, α = 60° | first critical load, each | lift-off of mode 1, each |"]
    rows += ["| --- | --- | --- |"]
    for count in PROBLEMS:
        those = [rodwell.Problem(float(w), alpha=60.0) for w in np.linspace(10.0, 100.0, count)]
        loads = best(lambda those=those: [critical_loads(p, 1) for p in those], 3)
        branches = best(lambda those=those: [rodwell.follow(p) for p in those], 2)
        rows.append(f"| {count} | {1e3 * loads / count:.3g} ms | {1e3 * branches / count:.3g} ms |")
    return rows


def report(times: dict, sizes: dict, by_weight: dict, by_modes: dict) -> str:
    """Everything as Markdown."""
    lines = [f"Measured on {platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}, "
             f"rodwell {rodwell.__version__}.", ""]  # fmt: skip
    lines += ["| elements | Newton step | per element | memory | step towards critical loads | per element | memory |"]
    lines += ["| --- | --- | --- | --- | --- | --- | --- |"]
    for i, n in enumerate(ELEMENTS):
        cells = []
        for what in WORKS:
            t, size = times[what][i], sizes[what][i]
            cells += [f"{1e3 * t:.3g} ms", f"{1e6 * t / n:.2f} µs", f"{size:.0f} MB" if i else "–"]
        lines.append(f"| {n:,} | {' | '.join(cells)} |")
    exponents = ", ".join(f"{what}: {exponent(ELEMENTS[1:], t[1:]):.2f}" for what, t in times.items())
    lines += ["", f"Time goes with the elements to the power ({exponents}), from 1,000 to 100,000.", ""]
    head = " | ".join(f"α = {alpha:g}°" for alpha in INCLINATIONS)
    for title, values, table in (("γ", WEIGHTS, by_weight), ("modes, γ = 10⁶", MODES, by_modes)):
        lines += [f"| first critical load, {title} | {head} |" if title == "γ" else f"| {title} | {head} |"]
        lines += ["| --- | --- | --- | --- |"]
        for i, value in enumerate(values):
            lines.append(f"| {value:g} | " + " | ".join(f"{1e3 * table[a][i]:.3g} ms" for a in INCLINATIONS) + " |")
        lines.append("")
    return "\n".join(lines)


def horizontal() -> list[str]:
    """Lines of a table: horizontal rods up to the heaviest that are allowed, against the closed form (77)."""
    lines = ["| b = wₗ/Δ, α = 90° | elements | first critical load | error estimate | off (77) |"]
    lines += ["| --- | --- | --- | --- | --- |"]
    for b in FOUNDATIONS:
        clearance = max(1e-7, min(1e-2, 1e9 / b))
        rod = rodwell.Problem(min(1e9, b * clearance), clearance=clearance)
        mode = critical_loads(rod, 1)[0]
        spent, exact = best(lambda r=rod: critical_loads(r, 1), 40), horizontal_loads(rod.weight / clearance, 1)[0]
        off = abs(mode.force / exact - 1.0)
        lines.append(f"| {b:.0e} | {mode.space.elements} | {1e3 * spent:.3g} ms | "
                     f"{mode.error / abs(exact):.0e} | {off:.0e} |")  # fmt: skip
    return lines


def joints() -> list[str]:
    """Lines of a table: strings in a straight hole, and in a surveyed one that builds from 55° at the top to 88°.

    Joints by turns of two kinds, the second 15 % stiffer and 8 % heavier; as long as some half waves, or some of them
    in one half wave. 300 of 10 m are a string of 3,000 m.
    """
    lines = ["| joints | first critical load, straight hole, α = 60° | per joint | surveyed hole | per joint |"]
    lines += ["| --- | --- | --- | --- | --- |"]
    for count in JOINTS:
        kinds = (1.0, 1.0), (1.15, 1.08)
        string = tuple((1.0 / count, *kinds[i % 2]) for i in range(count))
        rods = (
            rodwell.Problem(2e6, 60.0, 3e-5, sections=string),
            rodwell.Problem(2e6, clearance=3e-5, axis=surveyed(), sections=string),
        )
        cells = [f"{count:,}"]
        for rod in rods:
            spent = best(lambda r=rod: critical_loads(r, 1), 3 if count <= 1_000 else 1)
            cells += [f"{spent:.3g} s", f"{1e3 * spent / count:.2g} ms"]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def bridging() -> list[str]:
    """Lines of a table: tool joints that a string bridges, in a level hole, followed until it buckles sideways.

    Joints of length l with w l³/B = 0.15 in a hole of 0.006 l about their bodies, 0.6 of it about their tool joints.
    """
    lines = [
        "| bridged tool joints, α = 90° | until it buckles sideways | per joint | load |",
        "| --- | --- | --- | --- |",
    ]
    for count in BRIDGED:
        joint = 1.0 / count
        half, body, whole = ((part * joint, *ratios) for part, ratios in (
            (0.03, (3.0, 2.0, 0.6)), (0.94, (1.0, 1.0, 1.0)), (0.06, (3.0, 2.0, 0.6))
        ))  # fmt: skip
        string = (half, *[body, whole] * (count - 1), body, half)
        rod = rodwell.Problem(0.15 * count**3, 90.0, clearance=0.006 * joint, sections=string)
        found: list[rodwell.LoadPath] = []
        spent = best(lambda r=rod, out=found: out.append(rodwell.load_path(r)), 1)
        event = found[-1].first("critical")
        load = "not found" if event is None else f"{event.force.value:.10g} B/L²"
        lines.append(f"| {count} | {spent:.3g} s | {1e3 * spent / count:.2g} ms | {load} |")
    return lines


def surveyed() -> np.ndarray:
    """Points of a hole's axis in L, (101, 3), from the lower end: inclined by 88° there, by 55° at the upper end."""
    s = np.linspace(0.0, 1.0, 4001)
    slope = np.radians(np.interp(s, (0.0, 0.4, 0.8, 1.0), (88.0, 84.0, 60.0, 55.0)))
    steps = np.stack([np.sin(slope), 0.0 * slope, np.cos(slope)], axis=1)
    points = np.cumsum(0.5 * (steps[1:] + steps[:-1]) * np.diff(s)[:, None], axis=0)
    return np.concatenate([np.zeros((1, 3)), points])[::40]


def exponent(x: tuple[int, ...], y: list[float]) -> float:
    """Slope of a straight line through the logarithms."""
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def draw(times: dict, by_weight: dict, path: Path) -> None:
    """Draw time against elements, and against weight."""
    names = {"newton": "one Newton step", "critical": "one step towards critical loads"}
    with mpl.rc_context(RC):
        left = new_axes(size=(6.0, 6.4), nrows=2, index=1)
        right = left.figure.add_subplot(2, 1, 2)
        for color, (what, t) in zip(COLORS, times.items(), strict=False):
            left.loglog(ELEMENTS, 1e3 * np.array(t), "o-", color=color, label=names[what])
        left.set_xlabel("elements")
        left.set_ylabel("time  [ms]")
        left.legend()
        for color, (alpha, t) in zip(COLORS, by_weight.items(), strict=False):
            right.loglog(WEIGHTS, 1e3 * np.array(t), "o-", color=color, label=f"α = {alpha:g}°")
        right.set_xlabel("weight γ = mg L³/B")
        right.set_ylabel("first critical load  [ms]")
        right.legend()
        left.figure.savefig(path, dpi=140)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        alone(sys.argv[1], int(sys.argv[2]))
    else:
        main()
