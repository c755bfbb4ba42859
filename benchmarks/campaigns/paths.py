"""Load paths of random problems to twice the lift-off load: no exception, no penetration, no contact that pulls.

    python benchmarks/campaigns/paths.py [--count 100] [--workers 2]

Problem number i comes from the seed (SEED, i) alone, so a campaign that was broken off goes on where it ended
(``paths.part``); the summary is ``paths.json``. A problem has a weight of 1 to
300, an inclination of 20 to 90 degrees, a clearance of 1e-3 to 0.05, any ends but loose ones, and twist in half of
them. A *fault* is

- an exception other than those that say what is wrong with the input or could not be computed;
- a state along the path that reaches more than 1e-8 Δ into the wall, or contact that pulls by more than 1e-7 of the
  load;
- balance along the rod, or a point force by two routes, missed by more than 1e-7 of the end force, in the states
  looked at;
- a change of the stability index without an event.

A path that cannot be followed to its end is no fault, if it says why; how many there are stands in the summary.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import platform
import time
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import Any

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import numpy as np
from resumable import finished

import rodwell
from rodwell.analysis.off_wall.conditions import conditions
from rodwell.analysis.off_wall.state import contact_state

SEED = 20
HERE = Path(__file__).parent
LINES, SUMMARY = HERE / "paths.part", HERE / "paths.json"
KINDS = ("clamped", "pinned", "guided", "free", "ball")
PULL, BALANCE, DEEP = 1e-7, 1e-7, 1e-8
LOOKED_AT = 6
"""States of each run whose certificate is evaluated."""


def problem_of(number: int) -> rodwell.Problem:
    """The problem of a number."""
    rng = np.random.default_rng((SEED, number))
    ends = tuple(KINDS[i] for i in rng.integers(0, len(KINDS), 2))
    weight, clearance = 10.0 ** rng.uniform(0.0, np.log10(300.0)), 10.0 ** rng.uniform(-3.0, np.log10(0.05))
    alpha = float(rng.choice([90.0, rng.uniform(20.0, 90.0)]))
    twist = 0.0 if "free" in ends or rng.random() < 0.5 else float(rng.normal() * 2.0)
    return rodwell.Problem(float(weight), alpha, clearance=float(clearance), twist=twist, ends=ends)


def trial(number: int) -> dict[str, Any]:
    """What came of one problem."""
    problem, began = problem_of(number), time.process_time()
    out: dict[str, Any] = {"number": number, "problem": repr(problem), "faults": []}
    try:
        out |= _followed(problem)
    except rodwell.RodwellError as error:
        out["refused"] = str(error)
    except Exception as error:
        out["faults"].append(f"{type(error).__name__}: {error}")
    out["seconds"] = round(time.process_time() - began, 1)
    return out


def _followed(problem: rodwell.Problem) -> dict[str, Any]:
    until = twice_lift_off(problem)
    path = rodwell.load_path(problem, until=until, seeds=1)
    faults: list[str] = []
    resolved = {id(event.state.coarse): event.state for event in path.events if event.state is not None}
    for run in path.legs[0].runs:
        marked = [event.force.value for event in path.events]
        for before, state in pairwise(run):
            low, high = sorted((before.load, state.load))
            slack = 1e-3 * abs(state.load)
            if before.solved.index != state.solved.index and not any(low - slack <= f <= high + slack for f in marked):
                faults.append(f"index changes between {before.load:.8g} and {state.load:.8g} without an event")
        for state in run[1:-1][:: max(1, len(run) // LOOKED_AT)]:
            faults += [] if id(state) in resolved else _faults(state)  # those at events are looked at below
    for event in path.events:
        if event.state is not None:
            faults += _missed(
                event.state.certificate, f"{event.kind} at F = {event.force.value:.10g}", event.state.force
            )
    kinds = [event.kind for event in path.events]
    return {
        "faults": faults,
        "until": until,
        "kinds": kinds,
        "reached": path.reached,
        "why": path.ended_because,
        "missed": list(path.missed),
    }


def twice_lift_off(problem: rodwell.Problem) -> float:
    """Twice the load at which the rod lifts off, or buckles, if it has ball joints or its branch ends before."""
    critical = float(rodwell.critical_loads(problem, 1)[0].force)
    lift = None
    if "ball" not in problem.ends:
        lift = rodwell.follow(problem, 1, until=None).lift_off
    load = critical if lift is None else float(lift.force)
    return 2.0 * load if load < 0.0 else critical - 1.2 * abs(critical)


def _faults(state: Any) -> list[str]:
    where = f"F = {state.load:.10g}, {state.pattern.text()}"
    found = []
    for one in conditions(state):
        if one.kind != "touches" and one.value < -PULL * max(abs(state.load), 1.0):
            found.append(f"{one.kind} {one.value:.2e} at {where}")
    try:
        certificate = contact_state(state).certificate
    except rodwell.NotConvergedError as error:
        return [*found, f"{error} at {where}"]
    return found + _missed(certificate, where, state.load)


def _missed(certificate: Any, where: str, force: float) -> list[str]:
    """What a certificate misses."""
    found = []
    if certificate.penetration > DEEP:
        found.append(f"penetration {certificate.penetration:.2e} at {where}")
    if certificate.worst > BALANCE:
        found.append(f"balance {certificate.worst:.2e} at {where}")
    if min(certificate.least_force, certificate.least_pressure) < -PULL * max(abs(force), 1.0):
        found.append(f"contact pulls, {certificate.least_force:.2e}, {certificate.least_pressure:.2e} at {where}")
    return found


def main() -> None:
    """Go on with the campaign, and write its summary."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--workers", type=int, default=2)
    given = parser.parse_args()
    done = finished(trial, given.count, LINES, given.workers, 1)
    SUMMARY.write_text(json.dumps(summary(done), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def summary(done: list[dict[str, Any]]) -> dict[str, Any]:
    """What came of all."""
    reasons = Counter(one["why"].split(" at ")[0].split(", F =")[0] for one in done if one.get("why"))
    return {
        "seed": SEED,
        "problems": len(done),
        "date": datetime.date.today().isoformat(),
        "machine": platform.machine(),
        "version": rodwell.__version__,
        "followed to the end": sum(bool(one.get("reached")) for one in done),
        "not followed to the end": dict(reasons),
        "refused": sum("refused" in one for one in done),
        "with faults": sum(bool(one["faults"]) for one in done),
        "faults": [{"number": one["number"], "faults": one["faults"]} for one in done if one["faults"]],
        "snaps": sum(one.get("kinds", []).count("snap") for one in done),
        "processor seconds, median": float(np.median([one["seconds"] for one in done])) if done else 0.0,
    }


if __name__ == "__main__":
    main()
