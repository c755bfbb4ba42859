"""What it means that the clearance of a case varies along its rod, in sentences."""

from __future__ import annotations

from rodwell.analysis.branch.solution import Solution
from rodwell.answers.result.varying import Varying
from rodwell.answers.words.advice import BAD, GOOD, OPEN, Status
from rodwell.answers.words.wording import forces_of, place_text, places_text, size_text
from rodwell.quantities.text import amount, plain
from rodwell.quantities.value import Value
from rodwell.strength.loaded import LoadedRod


def varying_sentences(found: Varying) -> list[str]:
    """The verdict first; then the loads that act, how the rod lies, its lift-off, stress, and what is not computed."""
    return [
        verdict(found),
        *(_under(found, i) for i in range(len(found.applied))),
        _lies(found),
        lifts_off(found),
        *stress_sentences(found),
        *varying_limits(),
    ]


def verdict(found: Varying) -> str:
    """In one sentence: when the rod buckles, and whether it does under the loads that act."""
    load = forces_of(found.case).load(found.critical[0].load, other=True)
    if any(found.buckles(one) for one, _ in found.applied):
        return f"The rod buckles under the load that acts: at {load}."
    stable = "is stable under the loads that act: it " if found.applied else ""
    return f"The rod lies on a wall whose clearance varies, and {stable}buckles at {load}."


def lifts_off(found: Varying) -> str:
    """When the buckled rod lifts off, and how far its axial force may be off there."""
    lift = found.lift_off
    if lift is None:
        return f"Where the buckled rod lifts off the wall was not found: {found.unfollowed}."
    load, place = forces_of(found.case).load(Value(lift.force, lift.error)), places_text(found.case, lift)
    off = size_text(found.case.scales, Value(lift.solution.axial_contact_error), "force", "B/L²")
    return (
        f"The buckled rod lifts off the wall at {load}, {place}. What the wall pushes along the hole is taken as on "
        f"the rod that lies straight; its own contact would change its axial force by {off} at most."
    )


def stress_sentences(found: Varying) -> list[str]:
    """The largest stress at buckling and lift-off, and under the loads that act; none where no section is known."""
    parts = [f"{text} {state.name}" for state in found.states if (text := _stress(found, state))]
    return [f"The largest von Mises stress is {', '.join(parts)}."] if parts else []


def _stress(found: Varying, state: LoadedRod | None) -> str:
    stress, scales = found.stress(state), found.case.scales
    if stress is None or scales is None:
        return ""
    safety = "" if stress.safety is None else f" (safety factor {amount(stress.safety, 3)})"
    return f"{scales.system.amount(stress, 'stress', 4)}{safety}"


def push_note(solution: Solution) -> str:
    """What a branch takes of the wall's push along the hole where the clearance varies; nothing elsewhere."""
    if not solution.problem.ramps:
        return ""
    off = plain(solution.axial_contact_error, 2)
    return (
        "The clearance varies: what the wall pushes along the hole is taken as on the rod that lies straight. The "
        f"contact of the buckled rod at {plain(solution.force, 6)} B/L² would change the axial force along it by "
        f"{off} B/L² at most."
    )


def varying_limits() -> tuple[str, ...]:
    """What is not computed."""
    return (
        "What the rod does off the wall: `rodwell path`. Not computed where the clearance varies: formulas of practice "
        "beside the loads.",
    )


def _lies(found: Varying) -> str:
    case, least = found.case, found.least
    size = size_text(case.scales, least, "force_per_length", "B/L³")
    pushed = size_text(case.scales, Value(abs(found.critical.axial_contact)), "force", "B/L²")
    end = f"the end s = {1 if found.critical.axial_contact < 0.0 else 0}"
    return (
        f"At buckling the wall presses the rod everywhere, least by {size}, {place_text(case, Value(least.s))}, and "
        f"pushes it along the hole with {pushed} in all, towards {end}."
    )


def _under(found: Varying, number: int) -> str:
    """What is known under a load that acts."""
    load, least = found.applied[number]
    said = forces_of(found.case).load(Value(load.force))
    stress = _stress(found, found.under(number))
    more = f", with a von Mises stress of at most {stress}" if stress else ""
    if found.lifted(load):
        return f"Under {said} the rod has buckled and lifted off the wall: what it does then is not computed."
    if found.buckles(load):
        on = " and lies on the wall" if found.under(number) is not None else ""
        return f"Under {said} the rod has buckled{on}{more}."
    if not found.lies(least):
        place = place_text(found.case, Value(least.s))
        return f"Under {said} the wall would have to pull the rod {place}: it bridges the wall there, not computed."
    return f"Under {said} it lies still, pressed to the wall everywhere{more}."


def varying_statuses(found: Varying) -> tuple[Status, ...]:
    """Buckling, strength and the numbers, each in a word with its reason."""
    if not found.applied:
        buckling = Status("Buckling", OPEN, "no load given", "load.applied says what acts")
    else:
        bad = any(found.buckles(load) for load, _ in found.applied)
        off = any(found.lifted(load) or not (found.buckles(load) or found.lies(least)) for load, least in found.applied)
        why = "see the loads that act" if bad or off else "pressed to the wall everywhere"
        buckling = Status("Buckling", BAD if bad else OPEN if off else GOOD,
                          "buckles" if bad else "leaves the wall" if off else "stable", why)  # fmt: skip
    converged, missed = not found.missed, "; ".join(found.missed)
    numbers = Status("Numbers", GOOD if converged else BAD, "converged" if converged else "NOT CONVERGED",
                     "every load is within its tolerance" if converged else missed)  # fmt: skip
    return buckling, _strength(found), numbers


def _strength(found: Varying) -> Status:
    """Whether the rod bears the loads that act."""
    stresses = [found.stress(found.under(i)) for i in range(len(found.applied))]
    factors = [stress.safety.value for stress in stresses if stress is not None and stress.safety is not None]
    if not factors or len(factors) < len(stresses):
        return Status("Strength", OPEN, "not judged", "no strength is given, or no state known under a load that acts")
    least = min(factors)
    word = "yields" if least < 1.0 else "bears it"
    return Status("Strength", GOOD if least >= 1.0 else BAD, word, f"least safety factor {least:.3g}")
