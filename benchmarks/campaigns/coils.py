"""Random starts of coils: each is a stable state that solves the equations, or it is said why there is none.

    python benchmarks/campaigns/coils.py [--count 1000] [--workers 2] [--stop 1000]

Problem number i comes from the seed (SEED, i) alone, so the campaign can be stopped (``--stop`` ends it after so many
problems) and taken up again: what is done stands in ``coils.jsonl``, a line for each problem, and the summary in
``coils.json``. A problem is a rod whose ends hold a coil, at any inclination from 0 to 180°, weight, clearance, number
of turns and twist, inside or outside, at the bottom or on top, and an end force. A *fault* is

- an exception other than those that say what is wrong with the input or could not be computed;
- a state that is no minimum of the energy, or that does not solve the paper's equations;
- an end that is not carried around as often as asked for.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import time
from collections import Counter
from pathlib import Path
from typing import Any

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import numpy as np
from resumable import finished, machine

import rodwell

SEED = 17
HERE = Path(__file__).parent
LINES, SUMMARY = HERE / "coils.jsonl", HERE / "coils.json"
KINDS = ("clamped", "pinned")
SOLVES = 1e-4
"""Largest residual of the paper's equations, relative to their terms, of a state that solves them at all."""

CARRIED = 1e-9
"""Largest error of ξ₂(1), relative to 2πn."""


def problem_of(number: int) -> tuple[rodwell.Problem, float]:
    """The problem of a number, and the end force at s = 1 in B/L²."""
    rng = np.random.default_rng((SEED, number))
    ends = tuple(KINDS[i] for i in rng.integers(0, 2, 2))
    turns = int(rng.integers(1, 7)) * int(rng.choice([-1, 1]))
    weight = 0.0 if rng.random() < 0.1 else float(10.0 ** rng.uniform(-1.0, 4.2))
    alpha = float(rng.choice([90.0, 0.0, rng.uniform(0.0, 180.0)]))
    steepest = float(rng.uniform(0.02, 0.95))  # slope of the even winding
    clearance = min(steepest / (2.0 * np.pi * abs(turns)), float(10.0 ** rng.uniform(-3.5, -0.7)))
    twist = 0.0 if rng.random() < 0.5 else float(rng.normal() * 10.0 ** rng.uniform(-2.0, 1.0))
    force = 0.0 if rng.random() < 0.3 else -float(rng.uniform(0.0, 8.0)) * (2.0 * np.pi * turns) ** 2
    where = {"on_top": bool(rng.random() < 0.15), "outside": bool(rng.random() < 0.15)}
    problem = rodwell.Problem(weight, alpha, clearance=clearance, twist=twist, turns=turns, ends=ends, **where)
    return problem, force


def trial(number: int) -> dict[str, Any]:
    """What came of one problem."""
    problem, force = problem_of(number)
    out: dict[str, Any] = {"number": number, "fault": None}
    begun = time.process_time()
    try:
        state = rodwell.equilibrium(problem, force)
        out |= {"ended": "found", "converged": state.converged, "fault": fault_of(problem, state)}
    except (rodwell.InputError, rodwell.NotConvergedError) as error:
        out |= {"ended": type(error).__name__, "why": str(error)[:200]}
    except Exception as error:
        out |= {"ended": "fault", "fault": f"{type(error).__name__}: {error}"[:300]}
    out["seconds"] = round(time.process_time() - begun, 3)
    if out["fault"] or out["ended"] != "found" or not out["converged"]:
        out |= {"problem": repr(problem), "force": force}
    return out


def fault_of(problem: rodwell.Problem, state: rodwell.Solution) -> str | None:
    """What is wrong with a state that was found."""
    if not state.stable:
        return f"stability index {state.stability_index}"
    if state.certificate.worst > SOLVES:
        return f"certificate {state.certificate.worst:.1e}"
    first, last = state.fields(np.array([0.0, 1.0]))["xi2"]
    whole = 2.0 * np.pi * problem.turns
    return f"carried by {last - first} rad" if abs(last - first - whole) > CARRIED * abs(whole) else None


def summary(results: list[dict[str, Any]]) -> dict[str, Any]:
    """The campaign in numbers."""
    found = [result for result in results if result["ended"] == "found"]
    faults = [result for result in results if result["fault"]]
    seconds = sorted(result["seconds"] for result in results)
    return {
        "campaign": "coils", "seed": SEED, "count": len(results), "date": datetime.date.today().isoformat(),
        "machine": machine(),
        "found": len(found), "converged": sum(result["converged"] for result in found),
        "not_found": dict(Counter(why_of(result) for result in results if "why" in result).most_common()),
        "seconds": {"median": seconds[len(seconds) // 2], "largest": seconds[-1], "whole": round(sum(seconds))},
        "faults": len(faults), "faulty": faults[:50], "fault_rate": len(faults) / max(len(results), 1),
    }  # fmt: skip


def why_of(result: dict[str, Any]) -> str:
    """Why there is no state, without the load at which."""
    return str(result["why"].partition(": ")[2] or result["why"])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=1_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--stop", type=int, help="end after so many problems; the rest another time")
    given = parser.parse_args()
    results = finished(trial, min(given.count, given.stop or given.count), LINES, given.workers, 4)
    if len(results) == given.count:
        SUMMARY.write_text(json.dumps(summary(results), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(json.dumps({key: value for key, value in summary(results).items() if key != "faulty"}, ensure_ascii=False))


if __name__ == "__main__":
    main()
