"""Random strings of sections whose clearance has steps: bridged states and their buckling against transfer matrices.

    python benchmarks/campaigns/bridged_strings.py [--count 1000] [--workers 1]

Strings of 2 to 20 sections lie in a horizontal hole, ratios of stiffness and weight from 1e-3 to 1e3, of clearance from
0.5 to 2; lengths, ends, weight and clearance at random. Each is followed in the vertical plane until it buckles
(:func:`rodwell.load_path`): nothing but an error that says that it did not converge may be raised, and what counts as
converged must pass the certificate. Where both ends hold the angle and no other radial force than that of contact acts
on what moves, a buckling load is checked: out of the plane the linear problem of small slopes has constant coefficients
in each piece, a bed of the contact force per length over the clearance where the string touches, and a spring of each
point force over the clearance; the determinant of the product of their transfer matrices, in ball arithmetic, must
change its sign, proved, within the error of the load and what small slopes leave out of it. Results go to
``bridged_strings.json``; a campaign that was broken off goes on where it ended (``bridged_strings.part``).
"""

from __future__ import annotations

import random
import time
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from flint import arb, arb_mat, ctx
from resumable import campaign
from strings import BITS, end_determinant, transfer

from rodwell import Problem, load_path
from rodwell.analysis.off_wall.state import ContactState
from rodwell.errors import NotConvergedError

HERE = Path(__file__).parent
SUMMARY, LINES = HERE / "bridged_strings.json", HERE / "bridged_strings.part"
SEED = 22
PATIENCE = 60.0
"""Seconds of processor time after which a path is ended; it says so."""

CHECKED_ENDS = {"clamped", "pinned"}
SMALL = 4.0
"""What small slopes leave out of a load, in largest slopes squared of that load."""


NARROWER, NARROWER_YET = 0.1, 9
"""Loads that are looked at nearer and nearer by: long contact has pairs of buckling loads that are close together."""


def problem_of(number: int) -> Problem:
    """The random string of a trial."""
    rng = random.Random(f"{SEED}-{number}")
    count = rng.randint(2, 20)
    lengths = [rng.uniform(0.2, 1.0) for _ in range(count)]
    sections = [
        (length / sum(lengths), 10.0 ** rng.uniform(-3.0, 3.0), 10.0 ** rng.uniform(-3.0, 3.0), rng.uniform(0.5, 2.0))
        for length in lengths
    ]
    ends = rng.choice(["clamped-clamped", "clamped-pinned", "pinned-clamped", "guided-clamped", "clamped-free"])
    weight, clearance = 10.0 ** rng.uniform(-2.0, 3.0), 10.0 ** rng.uniform(-5.0, -2.0)
    return Problem(weight, 90.0, clearance=clearance, ends=ends, sections=sections)


def misfit(state: ContactState, force: float) -> arb:
    """Determinant that vanishes where a string that touches as in this state buckles out of its plane."""
    problem, fine = state.problem, state.fine
    rod, bounds = problem.rod, fine.bounds
    springs = {point.s.value: point.force.value for point in state.point_forces}
    whole = arb_mat(4, 4, [int(i == j) for i in range(4) for j in range(4)])
    for left, right in pairwise(sorted({*map(float, rod.breaks), *map(float, bounds), *springs})):
        middle = np.array([0.5 * (left + right)])
        b, q, ratio = (float(one(middle)[0]) for one in (rod.stiffness, rod.weight, rod.clearance))
        radius = problem.clearance * ratio
        touches = fine.pattern.touching[int(np.searchsorted(bounds, middle[0])) - 1]
        whole = transfer(right - left, b, q * problem.lateral_weight / radius if touches else 0.0, force) * whole
        if right in springs:
            beside = float(rod.clearance(np.array([np.nextafter(right, 2.0)]))[0])
            jump = arb_mat(4, 4, [int(i == j) for i in range(4) for j in range(4)])
            jump[3, 0] = -arb(springs[right]) / (problem.clearance * min(ratio, beside))
            whole = jump * whole
    return end_determinant(whole, problem.ends)


def checked(state: ContactState, force: float, error: float) -> dict[str, Any]:
    """A buckling load against transfer matrices."""
    shape = state.fine.solved.shape
    free = shape.chain.free
    rising = shape.along(free, np.broadcast_to(np.linspace(0.0, 1.0, 9), (free.size, 9)), 2)[0, 1]
    slope = state.problem.clearance * float(np.max(np.abs(rising)))
    near = error + SMALL * slope**2 * abs(force) + 1e-9 * abs(force)
    found: dict[str, Any] = {"slope": slope}
    if near > 0.01 * abs(force):
        return found  # steep: small slopes say nothing
    found["checked"] = near / abs(force)
    windows = (near * NARROWER**k for k in range(NARROWER_YET))  # two zeros in one leave the sign as it is
    if not any(misfit(state, force - part) * misfit(state, force + part) < 0 for part in windows):
        found["fault"] = f"no zero within {near:.1e} of {force!r}"
    return found


def trial(number: int) -> dict[str, Any]:
    """One string: what was found, and what is wrong with it."""
    ctx.prec = BITS
    problem, start = problem_of(number), time.process_time()
    out: dict[str, Any] = {"number": number, "sections": len(problem.sections), "fault": ""}

    def progress(_leg: str, _force: float) -> str | None:
        return None if time.process_time() - start < PATIENCE else "the time allowed is used up"

    try:
        path = load_path(problem, progress=progress)
        out["ended"] = path.ended_because
        for event in path.events:
            if event.state is not None and event.met and not event.state.certificate.passed:
                out["fault"] = f"certificate at {event.force.value!r}"
        critical = path.first("critical")
        if critical is not None and critical.state is not None:
            out["critical"], out["met"] = critical.force.value, critical.met
            if critical.met and set(problem.ends) <= CHECKED_ENDS:
                out |= checked(critical.state, critical.force.value, critical.force.error)
    except NotConvergedError as error:
        out["ended"] = f"NotConvergedError: {error}"
    except Exception as error:
        out["fault"] = repr(error)[:300]
    out["seconds"] = round(time.process_time() - start, 3)
    return out


def kind(ended: str) -> str:
    """Why a path ended, without its numbers."""
    words = [word for word in ended.split() if not any(sign.isdigit() for sign in word)]
    return " ".join(words)[:90]


def told(results: list[dict[str, Any]]) -> dict[str, Any]:
    """What the summary says of the trials."""
    return {
        "critical_loads": sum("critical" in result for result in results),
        "met": sum(result.get("met", False) for result in results),
        "checked": sum("checked" in result for result in results),
        "ended": dict(Counter(kind(result.get("ended", "")) for result in results).most_common(15)),
    }


def main() -> None:
    results, data = campaign(__doc__ or "", trial, SEED, LINES, SUMMARY, told)
    print(f"{len(results)} strings, {data['critical_loads']} buckle, {data['faults']} faults")


if __name__ == "__main__":
    main()
