"""rodwell against AUTO-07p on the paper's fifteen equations: loads, states, accuracy, time.

    pip install bifpy==0.3.0         compiles AUTO-07p; needs gfortran and make (Debian: apt install gfortran make)
    python benchmarks/auto07p.py     prints tables and writes benchmarks/results/auto07p.md; takes some minutes

AUTO-07p solves (22)–(27), (32)–(36), (41)–(44) with (B1)–(B15), stated in ``auto07p_model.py``; it shares nothing with
rodwell. Times are processor times, so that other work on the machine matters little, the least of several runs; those
of AUTO-07p are of its compiled program alone, without bifpy. ``--as-installed`` measures AUTO-07p as bifpy compiles
it, without optimisation, and writes no file.
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

for variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")
if find_spec("bifpy") is None:
    sys.exit("This benchmark needs bifpy, a Python interface to AUTO-07p: pip install bifpy==0.3.0")
for tool in ("gfortran", "make"):
    if shutil.which(tool) is None:
        sys.exit(f"This benchmark needs {tool}, to compile AUTO-07p and its model: apt install {tool}")

import auto07p_diagram as diagram
import numpy as np
from auto07p_model import VARIABLES, F
from auto07p_runs import OPTIONS, Rod, State, optimised
from timing import best

import rodwell
from rodwell.analysis.discrete.measures import Measured

HERE = Path(__file__).parent
REPEATS = 3
CASES = {  # of states: problem, modes, end forces
    "w = 5": (rodwell.Problem(5.0), (1, 2), (-150.0, -250.0, -400.0)),
    "w = 15": (rodwell.Problem(15.0), (1, 2), (-200.0, -300.0, -400.0)),
    "w = 40": (rodwell.Problem(40.0), (1, 2), (-200.0, -300.0, -400.0)),
    "w = 40, α = 60°, T₁ = 1.5": (rodwell.Problem(40.0, alpha=60.0, twist=1.5), (1,), (-190.0, -300.0)),
}
STATE_MESH = 100
SAME_POINTS = 0.0118
"""Longest step at which rodwell takes as many points along the branch as AUTO-07p does, 137."""

MESHES, FINEST_MESH = (25, 50, 100, 200), 400
"""Meshes of AUTO-07p whose errors are measured, and the one that rodwell's are measured against."""

NAMES = dict(zip(VARIABLES, VARIABLES, strict=True)) | {f"{v}{i}": f"braid_{v}{i}" for v in "FM" for i in (1, 2, 3)}
ODD = {"F3", "M1", "M2", "T2", "eta", "xi2", "mu", "omega2"}
"""What changes sign with y, at T₁ = 0; so does ξ₁."""
NUMBERS = {"ω₂(1)": "omega2", "ω₂(0)": "omega2", "T₂(0)": "T2", "F₃(1)": "F3"}

Row = tuple[str, ...]


def rod_of(problem: rodwell.Problem) -> Rod:
    return Rod((-20.0, problem.twist, problem.axial_weight, problem.lateral_weight, problem.clearance, problem.poisson))


def compare(ours: rodwell.Solution, theirs: State) -> tuple[dict[str, float], float]:
    """Differences of the key figures, relative to the largest of their kind along the rod, and of all fields."""
    fields = ours.fields(theirs.s)
    size = {name: max(float(np.max(np.abs(theirs[name]))), 1e-6) for name in VARIABLES}
    numbers = {
        "ω₂(1)": ours.number(Measured.OMEGA2_1).value,
        "ω₂(0)": ours.number(Measured.OMEGA2_0).value,
        "T₂(0)": ours.number(Measured.TORQUE_0).value,
        "F₃(1)": float(fields["braid_F3"][-1]),
        "1 − z(1)": ours.number(Measured.SHORTENING).value,
        "max p": ours.highest_pressure[0],
    }
    sign = 1.0 if theirs["xi2"] @ fields["xi2"] > 0.0 else -1.0
    other = {key: value * (sign if key in NUMBERS else 1.0) for key, value in theirs.numbers().items()}
    scale = {key: size[NUMBERS[key]] if key in NUMBERS else abs(other[key]) for key in numbers}
    odd = ODD | {"xi1"}
    along = [
        float(np.max(np.abs(fields[NAMES[v]] - theirs[v] * (sign if v in odd else 1.0)))) / size[v] for v in VARIABLES
    ]
    return {key: abs(numbers[key] - other[key]) / scale[key] for key in numbers}, max(along)


def states() -> list[Row]:
    """One row for each mode: the largest differences over its end forces."""
    rows = []
    for title, (problem, modes, forces) in CASES.items():
        rod, loads = rod_of(problem), rodwell.critical_loads(problem, 4)
        points = rod.trivial(loads[modes[-1] - 1].force - 2.0).branch_points()
        for mode in modes:
            signs = (1.0, -1.0) if problem.twist else (1.0,)  # with twist the arms are not mirror images
            branch = rodwell.follow(problem, mode, until=min(forces) - 1.0, rtol=1e-8)
            best: tuple[dict[str, float], float] | None = None
            for sign in signs:
                run = rod.onward(points[mode - 1], min(forces) - 1.0, STATE_MESH, diagram.STEP / 2.0, switch=True,
                                 ds=0.05 * sign, uzr={F + 1: list(forces)})  # fmt: skip
                points_at = [run.at(F, f)[-1] for f in forces]
                found = [compare(branch.at(p.parameters[F]), State(p, rod)) for p in points_at]
                worst = {key: max(d[key] for d, _ in found) for key in found[0][0]}, max(a for _, a in found)
                best = worst if best is None or worst[1] < best[1] else best
            assert best is not None
            load = abs(points[mode - 1].parameters[F] / loads[mode - 1].force - 1.0)
            where = ", ".join(f"{f:g}".replace("-", "−") for f in forces)
            values = [f"{v:.0e}" for v in (load, *best[0].values(), best[1])]
            rows.append((f"{title}, mode {mode}", where, *values))
    return rows


class Cost(NamedTuple):
    """What a branch cost, and how far off its state at the end is."""

    name: str
    points: int
    spent: float
    error: dict[str, float]
    along: float

    @property
    def each(self) -> float:
        """Seconds a point."""
        return self.spent / self.points


def accuracy() -> tuple[list[Row], int, str]:
    """Time of a continuation point and accuracy, w = 15, mode 1 to F = −400.

    And the mesh of AUTO-07p at which its error is that of rodwell at rtol 1e-8, in the fifteen variables, and what a
    point costs there beside the cheapest of rodwell's that is no worse.
    """
    problem, force = rodwell.Problem(15.0), -400.0
    rod = rod_of(problem)
    point = rod.trivial(-115.0).branch_points()[0]
    branches = {r: rodwell.follow(problem, 1, until=force - 1.0, rtol=r) for r in (1e-6, 1e-7, 1e-8, 1e-10)}

    def state(mesh: int) -> State:
        run = rod.onward(point, force - 1.0, mesh, diagram.STEP, switch=True, uzr={F + 1: [force]})
        return State(run.at(F, force)[-1], rod)

    def against(rtol: float, theirs: State) -> tuple[dict[str, float], float]:
        return compare(branches[rtol].at(theirs.parameters[F]), theirs)  # −400 to nine digits

    def theirs(mesh: int) -> Cost:
        run = rod.onward(point, force, mesh, 4.0, switch=True)
        return Cost(f"AUTO-07p, NTST {mesh}", len(run.points), run.cost(REPEATS), *against(1e-8, state(mesh)))

    def ours(rtol: float) -> Cost:
        def branch() -> rodwell.Branch:
            return rodwell.follow(problem, 1, until=force, rtol=rtol, largest_step=SAME_POINTS)

        return Cost(f"rodwell, rtol {rtol:g}", len(branch()), best(branch, 4 * REPEATS), *against(rtol, finest))

    finest = state(FINEST_MESH)
    costs, own = [theirs(mesh) for mesh in MESHES], [ours(rtol) for rtol in branches]
    unit = own[list(branches).index(1e-8)]
    equal = mesh_at(unit.along, [cost.along for cost in costs])
    at_equal = theirs(equal)
    rows = [
        (one.name, str(one.points), f"{1e3 * one.each:.2f}", f"{one.each / unit.each:.1f}",
         *(f"{size:.0e}" for size in (one.error["ω₂(1)"], one.error["max p"], one.along)))
        for one in (*costs, at_equal, *own)
    ]  # fmt: skip
    cheapest = min((one for one in own if one.along <= at_equal.along), key=lambda one: one.each, default=unit)
    times = f"{at_equal.each / cheapest.each:.0f}"
    return rows, equal, f"The cheapest with no larger error is {cheapest.name}: AUTO-07p takes {times} times as long."


def mesh_at(error: float, errors: Sequence[float]) -> int:
    """The mesh of AUTO-07p with an error, from the last two of :data:`MESHES`: errors fall by a power of the mesh."""
    power = np.log(errors[-2] / errors[-1]) / np.log(MESHES[-1] / MESHES[-2])
    return round(float(MESHES[-1] * (errors[-1] / error) ** (1.0 / power)))


def loads_and_time(found: diagram.Fig3c, equal: int) -> tuple[list[Row], list[Row]]:
    """Critical and secondary loads of w = 15, and what the diagram costs; ``equal``: on the mesh of equal error too."""
    ours = rodwell.diagram(rodwell.Problem(15.0), until=diagram.END)
    special = {b.name: [p.force for p in b.special_points if p.kind == "branch_point"] for b in ours.primary}
    rows = [
        (
            f"critical, mode {i}",
            f"{load:.8f}",
            "",
            f"{ours.critical[i - 1].force:.8f}",
            f"{load - ours.critical[i - 1].force:.0e}",
        )
        for i, load in enumerate(found.critical, start=1)
    ]
    sharp = {1: diagram.load_by_torque(2, found.found[2]), 2: diagram.load_by_curvature(100),
             4: diagram.load_by_torque(4, found.found[4])}  # fmt: skip
    for mode, load in sorted(sharp.items()):
        own = special[f"mode {mode}"][0]
        located = found.found[mode].parameters[F]
        rows.append((f"secondary, mode {mode}", f"{load:.7f}", f"{located:.5f}", f"{own:.7f}", f"{load - own:.0e}"))
    rodwell.diagram(rodwell.Problem(15.0), until=diagram.END)  # compiled before it is measured
    spent = best(lambda: rodwell.diagram(rodwell.Problem(15.0), until=diagram.END), 4 * REPEATS)
    times = []
    for mesh, these in ((diagram.MESH, found), *((mesh, diagram.fig_3c(mesh)) for mesh in (MESHES[-1], equal))):
        theirs = sum(run.cost(REPEATS if mesh == diagram.MESH else 1) for run in these.runs)
        points = sum(len(run.points) for run in these.runs)
        times.append(
            (f"AUTO-07p, NTST {mesh}", str(len(these.runs)), str(points), f"{theirs:.2f}", f"{theirs / spent:.0f}")
        )
    times.append(("rodwell, rtol 1e-8", "1", str(sum(len(b) for b in ours.branches)), f"{spent:.3f}", "1"))
    return rows, times


def table(head: str, rows: list[Row]) -> list[str]:
    columns = head.split("|")
    lines = ["| " + " | ".join(c.strip() for c in columns) + " |", "|" + " --- |" * len(columns)]
    minus = re.compile(r"(?<!\w)-(?=\d)")  # not that of AUTO-07p or 1e-8
    return ["", *lines, *("| " + minus.sub("−", " | ".join(row)) + " |" for row in rows), ""]


def main() -> None:
    fast = "--as-installed" not in sys.argv[1:] and optimised()
    began = os.getloadavg()[0]
    found = diagram.fig_3c()
    speed, equal, beside = accuracy()
    (loads, times), compared = loads_and_time(found, equal), states()
    build = f"compiled with {OPTIONS}" if fast else "compiled as bifpy does it, without optimisation"
    lines = [
        f"Measured on {platform.machine()}, {os.cpu_count()} cores (load {began:.1f} before, {os.getloadavg()[0]:.1f} "
        f"after), Python {platform.python_version()}, rodwell {rodwell.__version__}, AUTO-07p of bifpy 0.3.0, {build}. "
        f"Processor times, least of {REPEATS} runs or more. Units B = L = 1, α = 90°, Δ = 0.01, ν = 0.3 unless said.",
        "", "## Loads, w = 15", "",
        "Sharp: F where ω₂(1) = 0 (mode 2) or T₂(0) = 0 (modes 1, 4), interpolated on AUTO-07p's branches. Located: "
        f"its own branch point. {found.failed} searches for a branch point failed before one succeeded.",
        *table("load | AUTO-07p, sharp | located | rodwell | difference", loads),
        "## Time for Fig. 3(c)", "",
        "The four primary branches of the figure to F = −700 and both secondary ones. AUTO-07p: straight rod, primary "
        "branches with steps up to 20 and no detection of branch points (with it, AUTO-07p leaves the branch there), "
        "two short runs with detection started just before the points, known beforehand, and two secondary branches.",
        *table("code | runs | points | seconds | ratio", times),
        "## Time of a continuation point, and accuracy: w = 15, mode 1 to F = −400", "",
        "Errors at F = −400 relative to the largest value along the rod: of AUTO-07p against rodwell at rtol 1e-8, of "
        f"rodwell against AUTO-07p at NTST {FINEST_MESH}, which writes 11 digits. rodwell's point includes two meshes, "
        "all numbers and their errors, stability, lift-off and the branch point located; AUTO-07p's the solution only.",
        *table("code | points | ms per point | ratio | ω₂(1) | max p | all 15, everywhere", speed),
        f"At NTST {equal} AUTO-07p has the error of rodwell at rtol 1e-8 in all 15: from those at {MESHES[-2]} and "
        f"{MESHES[-1]}, which fall by a power of the mesh. {beside}", "",
        "## States", "",
        f"Largest differences between AUTO-07p (NTST {STATE_MESH}) and rodwell (rtol 1e-8) over the end forces, "
        "relative to the largest value along the rod; max p and 1 − z(1) relative to themselves. Last column: the "
        "fifteen variables at all mesh points.",
        *table("branch | F | critical load | ω₂(1) | ω₂(0) | T₂(0) | F₃(1) | 1 − z(1) | max p | all", compared),
    ]  # fmt: skip
    text = "\n".join(lines).rstrip() + "\n"
    print(text)
    if fast:
        (HERE / "results").mkdir(exist_ok=True)
        (HERE / "results" / "auto07p.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
