"""Random curved holes: loads, branches, chains of the stability index, balance in space; resumable.

    python benchmarks/campaigns/holes.py [--count 300] [--workers 1]

Curvatures up to 1/L in both planes, inclination, weight, clearance and ends at random. Every other hole lies in a
vertical plane: critical loads of both signs, then the first branch. The others leave it: the state without end force,
followed into compression. Nothing but an error that says that it did not converge may be raised, or an input error that
says why there is nothing to compute (a rod that a torque turns, no stable force). Between the ends of a branch the
stability index must change at special points only, by what they say; what counts as converged must balance forces and
moments in space. Results go to ``holes.json``; a campaign that was broken off goes on where it ended (``holes.part``).
"""

from __future__ import annotations

import argparse
import datetime
import json
import random
import time
from collections import Counter
from pathlib import Path
from typing import Any

from resumable import finished, machine

from rodwell import Branch, Problem, critical_loads, equilibrium, follow, tensile_loads
from rodwell.errors import InputError, NotConvergedError

HERE = Path(__file__).parent
SUMMARY, LINES = HERE / "holes.json", HERE / "holes.part"
SEED = 22
ENDS = ("clamped-clamped", "clamped-pinned", "pinned-pinned", "guided-clamped", "clamped-free")


def problem_of(number: int) -> Problem:
    """The random hole of a trial."""
    rng = random.Random(f"{SEED}-{number}")
    ends = rng.choice(ENDS)
    return Problem(
        10.0 ** rng.uniform(-1.0, 2.3),
        rng.uniform(5.0, 175.0),
        clearance=10.0 ** rng.uniform(-3.0, -1.5),
        ends=ends,
        twist=rng.choice([0.0, 0.0, rng.uniform(-3.0, 3.0)]) if ends == "clamped-clamped" else 0.0,
        build=rng.uniform(-1.0, 1.0),
        walk=rng.uniform(-1.0, 1.0) if number % 2 else 0.0,
    )


def trial(number: int) -> dict[str, Any]:
    """One hole: what was found, and what is wrong with it."""
    problem, start = problem_of(number), time.process_time()
    out: dict[str, Any] = {"number": number, "spatial": problem.walk != 0.0, "fault": ""}
    try:
        out |= sideways(problem) if problem.walk != 0.0 else in_the_vertical_plane(problem)
    except (NotConvergedError, InputError) as error:
        out["ended"] = f"{type(error).__name__}: {error}"[:90]
    except Exception as error:
        out["fault"] = repr(error)[:300]
    out["seconds"] = round(time.process_time() - start, 3)
    return out


def in_the_vertical_plane(problem: Problem) -> dict[str, Any]:
    """Critical loads of both signs, and the first branch a little beyond buckling."""
    loads = critical_loads(problem, 2)
    tension = tensile_loads(problem, 2)
    found = {"largest_error": max(abs(mode.error / mode.force) for mode in (*loads, *tension))}
    until = loads[0].force - 0.1 * abs(loads[0].force) - 5.0
    return found | followed(follow(problem, loads[0], until=until))


def sideways(problem: Problem) -> dict[str, Any]:
    """How the rod lies without an end force, followed into compression."""
    state = equilibrium(problem, 0.0)
    if state.converged and not state.certificate.passed:
        return {"fault": f"certificate of the lying rod {state.certificate.worst:.1e}"}
    return followed(follow(problem, start=state, until=-40.0))


def followed(branch: Branch) -> dict[str, Any]:
    """The chain of the stability index along a branch, and the balance of its last state."""
    found: dict[str, Any] = {"ended": branch.ended_because, "converged": bool(branch[-1].converged)}
    index = int(branch.stability_index[1])
    for point in branch.special_points:
        if point.index_before != point.index_after:
            if point.index_before != index:
                return found | {"fault": f"index {index} before {point!r}"}
            index = point.index_after
    if index != branch.stability_index[-1]:
        return found | {"fault": f"index {index} at the end of the chain, {branch.stability_index[-1]} of the state"}
    found["certificate"] = branch[-1].certificate.worst
    found["place_error"] = branch[-1].place_errors["energy"] / max(abs(branch[-1].number("energy").value), 1e-300)
    return found


def main() -> None:
    """Run the campaign and write its summary."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--workers", type=int, default=1)
    given = parser.parse_args()
    results = finished(trial, given.count, LINES, given.workers, 4)
    faults = [result for result in results if result["fault"]]
    known = [result for result in results if "certificate" in result]
    summary = {
        "campaign": "holes", "seed": SEED, "count": given.count, "date": datetime.date.today().isoformat(),
        "machine": machine(),
        "largest_relative_error_of_loads": max(result.get("largest_error", 0.0) for result in results),
        "followed": len(known),
        "converged": sum(result["converged"] for result in known),
        "worst_certificate": max((result["certificate"] for result in known), default=None),
        "largest_relative_place_error_of_energy": max((result["place_error"] for result in known), default=None),
        "ended": dict(Counter(result.get("ended", "")[:60] for result in results).most_common(12)),
        "faults": faults,
        "seconds": round(sum(result["seconds"] for result in results), 1),
    }  # fmt: skip
    SUMMARY.write_text(json.dumps(summary, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(json.dumps(summary, indent=1, ensure_ascii=False))


if __name__ == "__main__":
    main()
