"""Random strings on walls whose clearance varies smoothly: branches to lift-off, each with its certificate.

    python benchmarks/campaigns/varying_clearances.py [--count 1000] [--workers 1]

One to three ramps between constant pieces, widening or narrowing by up to half, sections of other stiffness and weight,
ends, inclination, weight and clearance at random. Nothing but a refusal with the place where the wall would have to
pull, or an error that says that it did not converge, may be raised; the branch must leave the straight rod at its
critical load, and its last state must pass the certificate. Results go to ``varying_clearances.json``; a campaign that
was broken off goes on where it ended (``varying_clearances.part``).
"""

from __future__ import annotations

import random
import time
from collections import Counter
from pathlib import Path
from typing import Any

from resumable import campaign

from rodwell import Problem, follow, ramp
from rodwell.errors import InputError, NotConvergedError

HERE = Path(__file__).parent
SUMMARY, LINES = HERE / "varying_clearances.json", HERE / "varying_clearances.part"
SEED = 31


def problem_of(number: int) -> Problem:
    """The random string of a trial."""
    rng = random.Random(f"{SEED}-{number}")
    ramps = rng.randint(1, 3)
    lengths = [rng.uniform(0.3, 1.0) for _ in range(2 * ramps + 1)]
    whole, ratio, sections = sum(lengths), 1.0, []
    stiffness, weight = 1.0, 1.0
    for k, length in enumerate(lengths):
        if k % 2 == 0:
            if rng.random() < 0.3:
                stiffness, weight = 2.0 ** rng.uniform(-1.0, 1.0), 2.0 ** rng.uniform(-1.0, 1.0)
            sections.append((length / whole, stiffness, weight, ratio))
        else:
            other = ratio * (1.0 + rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-2.5, -0.3))
            sections += ramp(length / whole, ratio, other, stiffness=(stiffness,) * 2, weight=(weight,) * 2)
            ratio = other
    ends = rng.choice(["clamped-clamped", "clamped-pinned", "pinned-clamped", "pinned-pinned", "clamped-free"])
    load, alpha = 10.0 ** rng.uniform(1.0, 3.5), rng.uniform(20.0, 160.0)
    return Problem(load, alpha, clearance=10.0 ** rng.uniform(-4.0, -1.5), ends=ends, sections=tuple(sections))


def trial(number: int) -> dict[str, Any]:
    """One string: what was found, and what is wrong with it."""
    start = time.process_time()
    out: dict[str, Any] = {"number": number, "fault": ""}
    try:
        problem = problem_of(number)
        out["sections"] = len(problem.sections)
        branch = follow(problem)
        last, mode = branch[-1], branch.mode
        assert mode is not None
        out["ended"], out["lift_off"] = branch.ended_because, branch.lift_off is not None
        out["critical"], out["last"], out["converged"] = mode.force, last.force, bool(last.converged)
        out["off"] = last.axial_contact_error / abs(last.force)
        out["left"] = max(last.certificate.residuals.values())
        if not last.certificate.passed:
            out["fault"] = f"certificate {out['left']:.1e}"
        if abs(float(branch.force[0]) - mode.force) > 1e-7 * (1.0 + abs(mode.force)):
            out["fault"] = f"starts at {branch.force[0]!r}, not at {mode.force!r}"
    except InputError as error:
        out["ended"] = f"InputError: {error}"
        if "s/L" not in str(error):
            out["fault"] = str(error)[:300]
    except NotConvergedError as error:
        out["ended"] = f"NotConvergedError: {error}"
    except Exception as error:
        out["fault"] = repr(error)[:300]
    out["seconds"] = round(time.process_time() - start, 3)
    return out


def kind(ended: str) -> str:
    """Why a branch ended, without its numbers."""
    return " ".join(word for word in ended.split() if not any(sign.isdigit() for sign in word))[:90]


def told(results: list[dict[str, Any]]) -> dict[str, Any]:
    """What the summary says of the trials."""
    followed = [result for result in results if "left" in result]
    return {
        "followed": len(followed),
        "lift_off": sum(result["lift_off"] for result in followed),
        "converged": sum(result["converged"] for result in followed),
        "largest_left": max((result["left"] for result in followed), default=None),
        "largest_axial_contact_error": max((result["off"] for result in followed), default=None),
        "ended": dict(Counter(kind(result.get("ended", "")) for result in results).most_common(15)),
    }


def main() -> None:
    results, data = campaign(__doc__ or "", trial, SEED, LINES, SUMMARY, told)
    print(f"{len(results)} strings, {data['followed']} followed, {data['faults']} faults")


if __name__ == "__main__":
    main()
