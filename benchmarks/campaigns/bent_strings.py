"""Random strings with steps of the stiffness in bends: off the wall beside their steps until they buckle sideways.

    python benchmarks/campaigns/bent_strings.py [--count 100] [--workers 1]

Strings of 2 to 4 sections of one clearance in a hole of one curvature, up or down; weight, inclination, clearance,
curvature, lengths and ratios of the weight at random, ratios of the stiffness from 0.1 to 10 in every second string, by
0.05 % to 10 % beside 1 in the others. Each is followed in the vertical plane until it buckles
(:func:`rodwell.analysis.path.follow.not_held_at_steps`); its load stands beside that of the string whose slope is held
at its steps, on the wall all along. Nothing but an error that says what was not found may be raised, and what counts as
converged must pass the certificate of balance in space. Results go to ``bent_strings.json``.
"""

from __future__ import annotations

import random
import time
from collections import Counter
from pathlib import Path
from typing import Any

from bridged_strings import kind
from resumable import campaign

from rodwell import Problem, critical_loads
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.path.bridging import bridged, unstretched
from rodwell.analysis.path.follow import not_held_at_steps
from rodwell.errors import NotConvergedError

HERE = Path(__file__).parent
SUMMARY, LINES = HERE / "bent_strings.json", HERE / "bent_strings.part"
SEED = 31
PATIENCE = 60.0
"""Seconds of processor time after which a path is ended; it says so."""


def problem_of(number: int) -> Problem:
    """The random string of a trial."""
    rng = random.Random(f"{SEED}-{number}")
    lengths = [rng.uniform(0.2, 1.0) for _ in range(rng.randint(2, 4))]

    def stiffness() -> float:
        if number % 2:
            return 1.0 + rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-3.3, -1.0)
        return float(10.0 ** rng.uniform(-1.0, 1.0))

    sections = [(length / sum(lengths), stiffness(), 10.0 ** rng.uniform(-0.5, 0.5)) for length in lengths]
    return Problem(
        10.0 ** rng.uniform(0.5, 2.5), rng.uniform(20.0, 120.0), 10.0 ** rng.uniform(-4.0, -2.0),
        build=rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-2.0, -0.3), sections=sections,
    )  # fmt: skip


def trial(number: int) -> dict[str, Any]:
    """One string: what was found, and what is wrong with it."""
    problem, begun = problem_of(number), time.process_time()
    out: dict[str, Any] = {"number": number, "build": problem.build, "fault": "", "ended": ""}

    def progress(_leg: str, _force: float) -> str | None:
        return None if time.process_time() - begun < PATIENCE else "the time allowed is used up"

    try:
        model = rod_in_hole(problem)
        out["starts"] = bridged(model, unstretched(model)) is not None
        found = not_held_at_steps(problem, progress=progress)
        if isinstance(found, str):
            out["ended"] = found
        elif found is not None and found.state is not None:
            out |= {"load": found.force.value, "error": found.force.error, "met": found.met}
            if found.met and not found.state.certificate.passed:
                out["fault"] = f"certificate at {found.force.value!r}"
        out["held"] = critical_loads(problem, 1)[0].force
    except NotConvergedError as error:
        out["not_held"] = str(error)
    except Exception as error:
        out["fault"] = repr(error)[:300]
    out["seconds"] = round(time.process_time() - begun, 3)
    return out


def told(results: list[dict[str, Any]]) -> dict[str, Any]:
    """What the summary says of the trials; of the parts by which loads differ, lower ones are negative."""
    both = [one for one in results if "load" in one and one.get("held", 0.0) < 0.0]
    parts = [one["load"] / one["held"] - 1.0 for one in both]
    return {
        "starts": sum(one.get("starts", False) for one in results),
        "buckle": sum("load" in one for one in results),
        "met": sum(one.get("met", False) for one in results),
        "beside_a_held_one_in_compression": len(both),
        "lower": sum(part < 0.0 for part in parts),
        "lowest": min(parts, default=0.0),
        "highest": max(parts, default=0.0),
        "ended": dict(Counter(kind(one["ended"]) for one in results if one["ended"]).most_common(15)),
    }


def main() -> None:
    results, data = campaign(__doc__ or "", trial, SEED, LINES, SUMMARY, told)
    print(f"{len(results)} strings, {data['buckle']} buckle, {data['lower']} of them lower, {data['faults']} faults")


if __name__ == "__main__":
    main()
