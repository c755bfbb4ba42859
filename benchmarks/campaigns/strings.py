"""Random strings of sections: critical loads against transfer matrices in ball arithmetic, buckled states; resumable.

    python benchmarks/campaigns/strings.py [--count 1000] [--workers 1]

Strings of 1 to 20 sections lie in a horizontal cylinder, ratios of stiffness and weight from 1e-3 to 1e3, lengths,
ends, weight and clearance at random. In each section the linear equation (64) has constant coefficients, so the matrix
that takes (v, v′, b v″, b v‴ − N v′) from its lower to its upper end is an exponential, here of balls with 400 bits; a
critical load is a zero of a determinant of their product. It must change its sign, proved, within the engine's error of
each of the first two loads. Of what carries a twist or has a double load nothing is asked. Then the first branch is
followed to lift-off: nothing but an error that says that it did not converge may be raised, and what counts as
converged must pass the certificate. Results go to ``strings.json``; a campaign that was broken off goes on where it
ended (``strings.part``).
"""

from __future__ import annotations

import random
import time
from collections import Counter
from pathlib import Path
from typing import Any

from flint import arb, arb_mat, ctx
from resumable import campaign

from rodwell import Problem, critical_loads, follow
from rodwell.errors import NotConvergedError

HERE = Path(__file__).parent
SUMMARY, LINES = HERE / "strings.json", HERE / "strings.part"
SEED = 21
BITS = 400
MODES = 2

HELD = {"clamped": (0, 1), "pinned": (0, 2), "guided": (1, 3), "free": (2, 3)}
"""Which of v, v′, b v″, b v‴ − N v′ vanish at an end."""


def problem_of(number: int) -> Problem:
    """The random string of a trial."""
    rng = random.Random(f"{SEED}-{number}")
    count = rng.randint(1, 20)
    lengths = [rng.uniform(0.2, 1.0) for _ in range(count)]
    sections = [
        (length / sum(lengths), 10.0 ** rng.uniform(-3.0, 3.0), 10.0 ** rng.uniform(-3.0, 3.0)) for length in lengths
    ]
    ends = rng.choice(["clamped-clamped", "clamped-pinned", "pinned-clamped", "guided-clamped", "clamped-free"])
    weight, clearance = 10.0 ** rng.uniform(-2.0, 3.0), 10.0 ** rng.uniform(-3.5, -1.3)
    return Problem(weight, 90.0, clearance=clearance, ends=ends, sections=sections)


def transfer(length: float, stiffness: float, bed: float, force: float) -> arb_mat:
    """The matrix that takes (v, v′, b v″, b v‴ − N v′) along a piece of constant coefficients, in balls."""
    rates = arb_mat(4, 4, [0, 1, 0, 0, 0, 0, 1 / arb(stiffness), 0, 0, arb(force), 0, 1, -arb(bed), 0, 0, 0])
    return (rates * arb(length)).exp()


def end_determinant(whole: arb_mat, ends: tuple[str, str]) -> arb:
    """What vanishes where the product of all transfer matrices meets the conditions at both ends."""
    first, last = (HELD[end] for end in ends)
    free = [i for i in range(4) if i not in first]
    a, b, c, d = (whole[i, j] for i in last for j in free)
    return a * d - b * c


def misfit(problem: Problem, force: float) -> arb:
    """Determinant that vanishes at critical loads."""
    whole = arb_mat(4, 4, [int(i == j) for i in range(4) for j in range(4)])
    breaks = [float(s) for s in problem.rod.breaks]
    for i, (_, b, q, *_) in enumerate(problem.sections or ((1.0, 1.0, 1.0, 1.0, 1.0),)):
        bed = arb(q) * arb(problem.foundation) / arb(problem.clearance)
        whole = transfer(arb(breaks[i + 1]) - arb(breaks[i]), b, bed, force) * whole
    return end_determinant(whole, problem.ends)


def trial(number: int) -> dict[str, Any]:
    """One string: what was found, and what is wrong with it."""
    ctx.prec = BITS
    problem, start = problem_of(number), time.process_time()
    out: dict[str, Any] = {"number": number, "sections": len(problem.sections), "fault": ""}
    try:
        loads = critical_loads(problem, MODES)
        out["largest_error"] = max(float(mode.error / abs(mode.force)) for mode in loads)
        for mode in loads:
            signs = misfit(problem, mode.force - mode.error) * misfit(problem, mode.force + mode.error)
            if not signs < 0:
                double = abs(loads[0].force - loads[1].force) <= loads[0].error + loads[1].error
                out["double" if double else "fault"] = f"mode {mode.number} at {mode.force!r} ± {mode.error:.1e}"
        out |= followed(problem)
    except NotConvergedError as error:
        out["ended"] = f"NotConvergedError: {error}"[:90]
    except Exception as error:
        out["fault"] = repr(error)[:300]
    out["seconds"] = round(time.process_time() - start, 3)
    return out


def followed(problem: Problem) -> dict[str, Any]:
    """The first branch up to lift-off."""
    try:
        branch = follow(problem)
    except NotConvergedError as error:
        return {"ended": f"NotConvergedError: {error}"[:90]}
    lift = branch.lift_off
    state = branch[-1] if lift is None else lift.solution
    found: dict[str, Any] = {"ended": branch.ended_because, "lift_off": lift is not None, "converged": state.converged}
    if state.converged and not state.certificate.passed:
        found["fault"] = f"certificate {state.certificate.worst:.1e}"
    return found


def told(results: list[dict[str, Any]]) -> dict[str, Any]:
    """What the summary says of the trials."""
    return {
        "critical_loads": sum("largest_error" in result for result in results),
        "largest_relative_error": max(result.get("largest_error", 0.0) for result in results),
        "double": sum("double" in result for result in results),
        "lift_off": sum(result.get("lift_off", False) for result in results),
        "converged": sum(result.get("converged", False) for result in results),
        "ended": dict(Counter(result.get("ended", "")[:60] for result in results).most_common(15)),
    }


def main() -> None:
    results, data = campaign(__doc__ or "", trial, SEED, LINES, SUMMARY, told)
    print(f"{len(results)} strings, {data['converged']} states converged, {data['faults']} faults")


if __name__ == "__main__":
    main()
