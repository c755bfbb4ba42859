"""Error estimates against true errors: random problems over all pairs of ends, seeded, resumable.

    python benchmarks/campaigns/errors.py [--problems 2000] [--seed 16] [--minutes M]

Each problem is drawn from its own seed and followed; its lift-offs, folds and branch points, and the seven numbers
of its last state, are computed once more by a second method in extended precision (``extended.py``,
``extended_rod.py``). When ``--minutes`` have passed, what was done stands in ``errors.jsonl``, and the next run goes on
there; ``errors.json`` is written each time and says how many problems it stands on.
"""

from __future__ import annotations

import argparse
import json
import platform
import sys
import time
import traceback
from collections import Counter
from datetime import date
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

import extended
from extended import UnsettledError
from extended_rod import LONG, Rod

import rodwell
from rodwell import NotConvergedError, Problem
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.discrete.measures import measure as measured_of
from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.parameters import CLEARANCE, LATERAL_WEIGHT

HERE = Path(__file__).parent
OUT, PART = HERE / "errors.json", HERE / "errors.jsonl"
SIDES = ("clamped", "pinned", "guided", "free")
PAIRS = tuple(f"{a}-{b}" for a in SIDES for b in SIDES)
SPECIAL = ("lift_off", "touch_down", "fold", "branch_point")

COVERED, FACTOR, CAUTION = 0.999, 3.0, 100.0
"""What is asked: estimates that hold, at most so many times too small, and in the median so many times too large."""


class Judged(NamedTuple):
    """One number: kind, tolerance asked for, estimate and true error, both relative to the scale of the number."""

    kind: str
    rtol: float
    claimed: float
    true: float


def random_problem(seed: int) -> tuple[Problem, int, float, float]:
    """A problem, a mode, how far beyond its critical load it is followed (in k²), and a tolerance."""
    draw = np.random.default_rng(seed)
    ends = PAIRS[seed % len(PAIRS)]
    first, _, last = ends.partition("-")
    level = draw.random() < (0.6 if first == last else 0.2)
    problem = Problem(
        float(10.0 ** draw.uniform(0.5, 2.7)),
        alpha=90.0 if level else float(draw.uniform(5.0, 90.0)),
        clearance=float(10.0 ** draw.uniform(-2.5, -1.3)),
        twist=0.0 if "free" in ends else float(draw.choice([0.0, draw.uniform(-3.0, 3.0)])),
        ends=ends,  # type: ignore[arg-type]
    )
    return problem, int(draw.integers(1, 4)), float(draw.uniform(0.3, 3.0)), float(10.0 ** draw.uniform(-10.0, -6.0))


def followed(problem: Problem, mode: int, reach: float, rtol: float) -> Any:
    """The branch of a mode, followed so far."""
    first = rodwell.critical_loads(problem, mode)[-1]
    return rodwell.follow(problem, first, until=first.force - reach * first.wavenumber**2, rtol=rtol)


def start_of(solution: Solution, every: int = 2) -> tuple[Rod, np.ndarray, float]:
    """The second method's rod, on every other mesh point, and the engine's state there."""
    coarse = solution.levels[0][1].space.breaks
    family, state = solution.levels[1]
    parameters = family.parameters(state.lam)
    rod = Rod(parameters, solution.problem.ends, np.append(coarse[:-1:every], coarse[-1]))
    s = rod.s.astype(float)
    u = state.space.evaluate(state.c, s, 4)
    _, _, gradient, _, hessian = rod_density(s, *u[:3], parameters, np.zeros(7))
    x = np.stack([*u[:3], gradient[1] - hessian[1][2] * u[2] - hessian[2][2] * u[3]], axis=1)
    return rod, x, state.lam


def load_of(solution: Solution, kind: str, every: int = 2) -> Any:
    """The load of a special point, in extended precision."""
    rod, x, lam = start_of(solution, every)
    if kind in ("lift_off", "touch_down"):
        return extended.lift_off(rod, x, lam)[1]
    return extended.singular(rod, x, lam, fold=kind == "fold")[1]


def numbers_of(solution: Solution, every: int = 2) -> np.ndarray:
    """The seven measured numbers of a state, in extended precision."""
    rod, x, lam = start_of(solution, every)
    x = extended.at_load(rod, x, lam)
    parameters = rod._at(LONG(lam))
    y, y1, y2, _ = x.T
    weights = np.zeros(rod.count, dtype=LONG)
    np.add.at(weights, rod.where, rod.half[:, None] * rod.rule[-1])
    cos, clearance = np.sqrt((1 - y1) * (1 + y1)), parameters[CLEARANCE]
    out = np.empty(len(Measured), dtype=LONG)
    out[Measured.P_MAX] = rod.highest(x, LONG(lam))[0]
    out[Measured.ENERGY] = weights @ rod_density(rod.s, y, y1, y2, parameters, np.zeros(7))[0]
    out[Measured.SHORTENING] = weights @ (y1 * y1 / (1 + cos))
    out[Measured.OMEGA2_0], out[Measured.OMEGA2_1] = -(y2 / cos)[[0, -1]]
    out[Measured.ANGLE_MID] = rod.read(y, 0.5) / clearance
    out[Measured.TORQUE_0] = -(weights @ (clearance * parameters[LATERAL_WEIGHT] * np.sin(y / clearance)))
    return out


def judged(seed: int, every: int = 2) -> tuple[list[Judged], list[str]]:
    """Everything of one problem that could be compared, and why the rest could not."""
    problem, mode, reach, rtol = random_problem(seed)
    try:
        branch = followed(problem, mode, reach, rtol)
    except NotConvergedError as error:
        return [], [f"not followed: {str(error).partition(',')[0][:24]}"]
    rows, left = [], []
    for point in branch.special_points:
        if point.kind not in SPECIAL:
            continue
        if point.kind == "branch_point" and point.solution.point.fine.symmetry == 0:
            left.append("branch point that breaks no symmetry of the state")
            continue
        try:
            true = float(abs(load_of(point.solution, point.kind, every) - LONG(point.force)))
        except (UnsettledError, RuntimeError) as error:
            left.append(f"{point.kind}: {str(error).partition(':')[0]}")
            continue
        size = abs(point.force)
        rows.append(_judged(point.kind, rtol, point.error / size, true / size))
    last = branch[-1]
    if not branch.reached_end:
        left.append(f"ended early: {branch.ended_because}")
    try:
        exact = numbers_of(last, every)
    except (UnsettledError, RuntimeError) as error:
        return rows, [*left, f"state: {str(error).partition(':')[0]}"]
    scales = measured_of(last.meshes.fine, last.point.fine)[1]
    for which in Measured:
        value = last.number(which)
        true = float(abs(exact[which] - LONG(value.value)))
        rows.append(_judged(which.name.lower(), rtol, value.error / scales[which], true / scales[which]))
    return rows, left


def _judged(kind: str, rtol: float, claimed: float, true: float) -> Judged:
    """As it is written: with three digits."""
    return Judged(kind, *(float(f"{x:.2e}") for x in (rtol, claimed, true)))


def summary(rows: list[Judged]) -> dict[str, Any]:
    """Fractions, worst ratios and medians of some of them."""
    ratio = np.array([row.true / row.claimed for row in rows])
    worst = int(np.argmax(ratio))
    return {
        "numbers": len(rows),
        "within": float(np.mean(ratio <= 1.0)),
        "above": int(np.sum(ratio > 1.0)),
        "worst": float(ratio[worst]),
        "median_caution": float(1.0 / max(np.median(ratio), 1e-30)),
        "median_estimate": float(np.median([row.claimed for row in rows])),
    }


def report(done: list[dict[str, Any]], seed: int) -> dict[str, Any]:
    """What is committed: by kind, by tolerance, by pair of ends; every number whose estimate failed; all of them."""
    rows = [(one["seed"], Judged(*row)) for one in done for row in one["rows"]]
    kinds = sorted({row.kind for _, row in rows})
    tolerance = [(low, [r for _, r in rows if low <= r.rtol < 10.0 * low]) for low in (1e-10, 1e-9, 1e-8, 1e-7)]
    loads = [r for _, r in rows if r.kind in (*SPECIAL, "p_max")]
    return {
        "what": "error estimates against true errors, by a second method in extended precision, random problems",
        "seed": seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}",
        "problems": len(done), "asked": {"within": COVERED, "worst": FACTOR, "median_caution": CAUTION},
        "special_points_and_largest_pressures": summary(loads),
        "all": summary([r for _, r in rows]),
        "by_kind": {kind: summary([r for _, r in rows if r.kind == kind]) for kind in kinds},
        "by_tolerance": {f"{low:.0e}": summary(part) for low, part in tolerance if part},
        "by_ends": {ends: summary(part) for ends in PAIRS
                    if (part := [r for s, r in rows if PAIRS[s % len(PAIRS)] == ends])},
        "failed": [{"seed": s, "ends": PAIRS[s % len(PAIRS)], **r._asdict()} for s, r in rows if r.true > r.claimed],
        "not_compared": dict(Counter(text for one in done for text in one["left"]).most_common()),
    }  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--problems", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=16)
    parser.add_argument("--minutes", type=float, default=np.inf)
    given = parser.parse_args()
    base = given.seed * 1_000_000
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if base <= one["seed"] < base + 1_000_000]
    until = time.perf_counter() + 60.0 * given.minutes
    with PART.open("a") as part:
        for number in range(len(done), given.problems):
            if time.perf_counter() > until:
                break
            try:
                rows, left = judged(base + number)
            except Exception:
                rows, left = [], [f"exception: {traceback.format_exc().splitlines()[-1][:80]}"]
            done.append({"seed": base + number, "rows": rows, "left": left})
            part.write(json.dumps(done[-1]) + "\n")
            part.flush()
    result = report(done, given.seed)
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    shown = ("problems", "special_points_and_largest_pressures", "by_kind", "not_compared")
    print(json.dumps({key: result[key] for key in shown}, indent=1))


if __name__ == "__main__":
    main()
