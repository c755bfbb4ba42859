"""Key numbers of strength and of the safe window."""

from __future__ import annotations

from rodwell.answers.result.assessment import Assessment
from rodwell.answers.result.key_number import KeyNumber, force_scale
from rodwell.quantities.text import percent
from rodwell.quantities.value import Value
from rodwell.strength.limits import LIFTS_OFF, Limit
from rodwell.strength.loaded import LoadedRod


def assessment_numbers(a: Assessment) -> list[KeyNumber]:
    """Forces at the lower end, the window, limits; stress, safety and supports at buckling and lift-off."""
    out = [*_at_bottom(a), *_window(a)]
    for state, name in ((a.at_buckling, "buckling"), (a.at_lift_off, "lift_off")):
        if state is not None:
            out += _stress(a, state, name)
    state = a.at_lift_off or a.at_buckling
    for support in a.supports(state):
        label = f"Largest load on a support {state.name}, part of its capacity: {support.text}"
        used = Value(support.utilisation, support.error / support.capacity)
        note = f"{percent(used)} of its capacity"
        out.append(KeyNumber(f"support_{support.kind}_used", label, used, "1", max(1.0, used.value), note))
    return out


def _at_bottom(a: Assessment) -> list[KeyNumber]:
    """Critical and lift-off load as effective force at the lower end, where it differs from that at the upper one."""
    weight = a.case.problem.hung_weight
    if weight == 0.0:
        return []
    note = f"N(0) = F {'+' if a.case.problem.floats else '−'} mg L cos α"
    note += ": the most compressed place" if weight > 0.0 else "; the most compressed place is s = 1"
    if a.case.problem.hole is not None:
        note = "F less the weight over the height of the rod in its hole"
        note = note.replace("less the weight", "and the lift") if a.case.problem.floats else note
    loads = [] if a.computed.left_before else [("critical_load_1", "Critical load of mode 1", a.window.buckling)]
    if a.computed.lying is not None:  # the load at which it buckles; else there is none, or it stands as a limit
        loads = (
            [("buckling_load", "Load at which the rod buckles", a.window.buckling)] if a.computed.lying.buckled else []
        )
    if a.window.lift_off is not None:
        loads.append(("lift_off_load", "Lift-off load", a.window.lift_off))
    out = []
    for name, label, load in loads:
        scale, bottom = force_scale(load.value) + abs(weight), Value(load.value - weight, load.error)
        which = "upper" if a.case.scales is not None and a.case.scales.climbs else "lower"
        where = f"{label}, effective force at the {which} end s = 0"
        out.append(KeyNumber(f"{name}_bottom", where, bottom, "force", scale, note))
    return out


def _window(a: Assessment) -> list[KeyNumber]:
    """Width of the window, and the limits on the way."""
    out, window = [], a.window
    width, end = window.width, window.end
    if width is not None and end is not None and not a.computed.no_window:
        parts = [] if window.share is None else [f"{percent(window.share, 4)} of the compression at s = 0 at buckling"]
        parts.append(f"ends by {end.name}")
        if a.limiting is not None:
            parts.append(f"limited before by {a.limiting.name}")
        label = "Safe window: compression from buckling on, buckled but stable and on the wall"
        out.append(KeyNumber("window", label, width, "force", force_scale(window.buckling.value), "; ".join(parts)))
    for limit in window.limits:
        if limit.kind == LIFTS_OFF or limit.load is None:
            continue
        label = f"{limit.name[:1].upper()}{limit.name[1:]}, end force at s = 1"
        scale = force_scale(limit.load.value) + a.case.problem.heaviest
        out.append(KeyNumber(f"limit_{limit.kind}", label, limit.load, "force", scale, _when(a, limit), _places(limit)))
    return out


def _places(limit: Limit) -> tuple[float, ...]:
    return () if limit.s is None else (limit.s,)


def _when(a: Assessment, limit: Limit) -> str:
    if a.computed.lying is not None and not limit.buckled:
        return "on the rod as it lies"
    return "on the buckled rod" if limit.buckled else "on the straight rod, before it buckles"


def _stress(a: Assessment, state: LoadedRod, name: str) -> list[KeyNumber]:
    """Largest von Mises stress in the rod in a state, and the safety factor."""
    largest, scales = a.stress(state), a.case.scales
    if largest is None or scales is None:
        return []
    unit = scales.factor("stress")
    stress = Value(largest.value / unit, largest.error / unit)
    label = f"Largest von Mises stress in the rod {state.name}"
    out = [KeyNumber(f"rod_stress_{name}", label, stress, "stress", stress.value, largest.fibre, (largest.s,))]
    if largest.safety is not None:
        label = f"Safety factor of the rod against yield {state.name}"
        note = "yield strength / von Mises stress" + ("" if a.case.string is None else ", the least of all sections")
        out.append(KeyNumber(f"safety_factor_{name}", label, largest.safety, "1", largest.safety.value, note))
    return out
