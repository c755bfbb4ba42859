"""Key figures of strength and of the safe window."""

from __future__ import annotations

from rodwell.answers.result.assessment import Assessment
from rodwell.answers.result.figure import Figure, force_scale
from rodwell.quantities.text import percent, plain
from rodwell.strength.limits import LIFTS_OFF, Limit
from rodwell.strength.loaded import LoadedRod


def assessment_figures(a: Assessment) -> list[Figure]:
    """Forces at the lower end, the window, limits; stress, safety and supports at buckling and lift-off."""
    out = [*_at_bottom(a), *_window(a)]
    for state, name in ((a.at_buckling, "buckling"), (a.at_lift_off, "lift_off")):
        if state is not None:
            out += _stress(a, state, name)
    state = a.at_lift_off or a.at_buckling
    for support in a.supports(state):
        label = f"Largest load on a support {state.name}, part of its capacity: {support.text}"
        error = support.error / support.capacity
        out.append(Figure(f"support_{support.kind}_used", label, support.utilisation, error, "1",
                          max(1.0, support.utilisation),
                          f"{plain(100.0 * support.utilisation, 3)} % of its capacity"))  # fmt: skip
    return out


def _at_bottom(a: Assessment) -> list[Figure]:
    """Critical and lift-off load as effective force at the lower end, where it differs from that at the upper one."""
    weight = a.case.problem.axial_weight
    if weight == 0.0:
        return []
    note = "N(0) = F − mg L cos α: the most compressed place"
    loads = [("critical_load_1", "Critical load of mode 1", a.window.buckling)]
    if a.window.lift_off is not None:
        loads.append(("lift_off_load", "Lift-off load", a.window.lift_off))
    return [
        Figure(f"{name}_bottom", f"{label}, effective force at the lower end s = 0", force - weight, error, "force",
               force_scale(force) + weight, note)
        for name, label, (force, error) in loads
    ]  # fmt: skip


def _window(a: Assessment) -> list[Figure]:
    """Width of the window, and the limits on the way."""
    out, window = [], a.window
    width, end = window.width, window.end
    if width is not None and end is not None and not a.branch.lift_off_at_buckling:
        parts = [] if window.share is None else [f"{percent(*window.share, 4)} of the compression at s = 0 at buckling"]
        parts.append(f"ends by {end.name}")
        if a.limiting is not None:
            parts.append(f"limited before by {a.limiting.name}")
        label = "Safe window: compression from buckling on, buckled but stable and on the wall"
        out.append(Figure("window", label, *width, "force", force_scale(window.buckling[0]), "; ".join(parts)))
    for limit in window.limits:
        if limit.kind == LIFTS_OFF or limit.force is None:
            continue
        label = f"{limit.name[:1].upper()}{limit.name[1:]}, end force at s = 1"
        out.append(Figure(f"limit_{limit.kind}", label, limit.force, limit.error, "force",
                          force_scale(limit.force) + a.case.problem.axial_weight, _place(limit)))  # fmt: skip
    return out


def _place(limit: Limit) -> str:
    where = [] if limit.s is None else [f"at s/L = {limit.s:.4g}"]
    return "; ".join([*where, "on the buckled rod" if limit.buckled else "on the straight rod, before it buckles"])


def _stress(a: Assessment, state: LoadedRod, name: str) -> list[Figure]:
    """Largest von Mises stress in the rod in a state, and the safety factor."""
    found, scales = a.stress(state), a.case.scales
    if found is None or scales is None:
        return []
    unit, value = scales.factor("stress"), found.value / scales.factor("stress")
    note = f"at s/L = {found.s:.4g}, {found.fibre}"
    label = f"Largest von Mises stress in the rod {state.name}"
    out = [Figure(f"rod_stress_{name}", label, value, found.error / unit, "stress", value, note)]
    if found.safety is not None:
        factor, error = found.safety
        label = f"Safety factor of the rod against yield {state.name}"
        out.append(
            Figure(f"safety_factor_{name}", label, factor, error, "1", factor, "yield strength / von Mises stress")
        )
    return out
