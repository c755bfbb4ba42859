"""Branches of random problems: no exception, closed chains of the index, and the same branch with another step.

    python benchmarks/campaigns/branches.py [--count 10000] [--workers 2]

Problem number i comes from the seed (SEED, i) alone, so the campaign can be stopped and taken up again: what is done
stands in ``branches.jsonl``, a line for each problem, and the summary in ``branches.json``. A problem is any pair of
ends, inclination, weight, clearance and twist; the branch of one of its first three modes is followed with the usual
step and with a third of it. A *fault* is

- an exception other than those that say what is wrong with the input or could not be computed;
- two points of which the first leaves the branch with another index than that with which the second meets it;
- special points of other kinds, indices or places (beyond the errors given) with the other step, where both
  ended alike.
"""

from __future__ import annotations

import argparse
import datetime
import json
import math
import os
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import Any

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import numpy as np
from resumable import finished, machine

import rodwell

SEED = 16
HERE = Path(__file__).parent
LINES, SUMMARY = HERE / "branches.jsonl", HERE / "branches.json"
KINDS = ("clamped", "pinned", "guided", "free")
STEPS = (0.06, 0.02)
SPARE = 1e-6
"""Relative difference of loads that is let pass beside the errors given."""


def problem_of(number: int) -> tuple[rodwell.Problem, int, float]:
    """The problem of a number, a mode, and how far the branch is followed, in parts of the square of its wavenumber."""
    rng = np.random.default_rng((SEED, number))
    ends = tuple(KINDS[i] for i in rng.integers(0, 4, 2))
    weight = 0.0 if rng.random() < 0.08 else float(10.0 ** rng.uniform(-0.5, 2.8))
    alpha = float(rng.choice([90.0, 0.0, rng.uniform(0.0, 90.0), 90.0 - 10.0 ** rng.uniform(-5.0, 1.0)]))
    clearance = float(10.0 ** rng.uniform(-3.0, -1.2))
    twist = 0.0 if "free" in ends or rng.random() < 0.5 else float(rng.normal() * 10.0 ** rng.uniform(-3.0, 0.5))
    problem = rodwell.Problem(weight, alpha, clearance=clearance, twist=twist, ends=ends)
    return problem, int(rng.integers(1, 4)), float(rng.uniform(0.5, 2.5))


def trial(number: int) -> dict[str, Any]:
    """What came of one problem."""
    problem, mode, reach = problem_of(number)
    out: dict[str, Any] = {"number": number, "fault": None}
    try:
        first = rodwell.critical_loads(problem, mode)[mode - 1]
        until = first.force - reach * first.wavenumber**2
        branches = [rodwell.follow(problem, first, until=until, largest_step=step) for step in STEPS]
    except (rodwell.InputError, rodwell.NotConvergedError) as error:
        return out | {"ended": type(error).__name__, "why": str(error)[:200]}
    except Exception as error:
        return out | {"fault": f"{type(error).__name__}: {error}"[:300], "problem": repr(problem)}
    usual, other = branches
    fault = chain_fault(usual) or chain_fault(other) or difference(usual, other)
    out |= {"ended": usual.ended_because[:80], "converged": usual.converged, "points": len(usual), "fault": fault}
    out["kinds"] = dict(Counter(point.kind for point in usual.special_points))
    if fault:
        out |= {"problem": repr(problem), "mode": mode, "until": until}
    return out


def chain_fault(branch: rodwell.Branch) -> str | None:
    """Where the index after one special point is not that before the next."""
    for one, after in pairwise(branch.special_points):
        if one.index_after != after.index_before:
            return (
                f"index {one.index_after} after {one.kind} at {one.value:.8g}, {after.index_before} before {after.kind}"
            )
    return None


def difference(usual: rodwell.Branch, other: rodwell.Branch) -> str | None:
    """What differs between two courses of one branch; None also where one of them could not be followed as far."""
    if not (usual.reached_end and other.reached_end):
        return None
    mine, theirs = (
        [(p.kind, p.index_before, p.index_after) for p in branch.special_points] for branch in (usual, other)
    )
    if mine != theirs:
        return f"{mine} against {theirs}"[:400]
    for p, q in zip(usual.special_points, other.special_points, strict=True):
        if abs(p.force - q.force) > p.error + q.error + SPARE * (1.0 + abs(p.force)) and p.kind != "uncertain":
            return f"{p.kind} at {p.force:.10g} ± {p.error:.1e} against {q.force:.10g} ± {q.error:.1e}"
    return None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--workers", type=int, default=2)
    given = parser.parse_args()
    results = finished(trial, given.count, LINES, given.workers, 8)
    faults = [result for result in results if result["fault"]]
    followed = [result for result in results if "kinds" in result]
    summary = {
        "campaign": "branches", "seed": SEED, "count": given.count, "date": datetime.date.today().isoformat(),
        "machine": machine(),
        "followed": len(followed), "converged": sum(result["converged"] for result in followed),
        "points": sum(result["points"] for result in followed),
        "ended": dict(Counter(result["ended"] for result in results if "ended" in result).most_common(12)),
        "special_points": dict(sum((Counter(result["kinds"]) for result in followed), Counter())),
        "faults": len(faults), "faulty": faults[:50],
        "fault_rate": len(faults) / max(len(results), 1),
    }  # fmt: skip
    assert math.isfinite(summary["fault_rate"])
    SUMMARY.write_text(json.dumps(summary, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"{len(results)} problems, {len(followed)} branches, {summary['converged']} converged, {len(faults)} faults")


if __name__ == "__main__":
    main()
