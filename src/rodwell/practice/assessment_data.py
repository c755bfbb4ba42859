"""An assessment as key figures and as plain data, for tables and JSON."""

from __future__ import annotations

from typing import Any

from rodwell.analysis.nomenclature import SI_UNITS, UNITS
from rodwell.practice.assessment import Assessment, AtLoad
from rodwell.practice.audit import Row
from rodwell.practice.figures import Figure, force_scale
from rodwell.practice.limits import LIFTS_OFF, Limit
from rodwell.practice.loaded import LoadedRod
from rodwell.practice.units import plain
from rodwell.practice.wording import percent


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


def assessment_dict(a: Assessment) -> dict[str, Any]:
    """Verdict, loads that act, window with limits, states with stresses, local limits, formulas."""
    from rodwell.practice.verdict import verdict  # noqa: PLC0415 - it looks at answers

    window = a.window
    return {
        "verdict": verdict(a.answer),
        "window": {
            "buckling": _force(a, *window.buckling),
            "lift_off": None if window.lift_off is None else _force(a, *window.lift_off),
            "width": None if window.width is None else _force(a, *window.width),
            "percent_of_compression_at_bottom": window.percent,
            "ends_by": None if window.end is None else window.end.kind,
            "limits": [
                {
                    "kind": limit.kind,
                    "name": limit.name,
                    "force": None if limit.force is None else _force(a, limit.force, limit.error),
                    "s": limit.s,
                    "buckled": limit.buckled,
                }
                for limit in window.limits
            ],
        },
        "states": [state_dict(a, state) for state in a.states],
        "applied": [_applied(a, at) for at in a.applied],
        "local": _local(a),
        "formulas": [_formula(a, row) for row in a.formulas],
    }


def _quantity(a: Assessment, value: float, error: float, dimension: str) -> dict[str, Any]:
    """Value and error in units B = L = 1, and in SI where the case has dimensions."""
    out: dict[str, Any] = {"value": value, "error": error, "unit": UNITS[dimension]}
    if a.case.scales is not None:
        factor = a.case.scales.factor(dimension)
        out["si"] = {"value": value * factor, "error": error * factor, "unit": SI_UNITS[dimension]}
    return out


def _force(a: Assessment, value: float, error: float) -> dict[str, Any]:
    return _quantity(a, value, error, "force")


def state_dict(a: Assessment, state: LoadedRod) -> dict[str, Any]:
    """A state: forces at both ends, contact, shortening, stress, supports."""
    contact = state.contact
    out: dict[str, Any] = {
        "name": state.name,
        "shape": "straight" if state.straight else "buckled",
        "force": _force(a, state.force, state.error),
        "force_at_bottom": _force(a, state.at_bottom, state.error),
        "largest_wall_force": _quantity(a, contact.value, contact.error, "force_per_length") | {"s": contact.s},
        "total_wall_force": _force(a, *state.total_contact),
        "end_shortening": _quantity(a, *state.shortening, "length"),
    }
    found = a.stress(state)
    if found is not None:
        out["rod_stress"] = {
            "von_Mises_Pa": found.value, "error_Pa": found.error, "s": found.s, "fibre": found.fibre,
            "axial_Pa": found.axial, "bending_Pa": found.bending, "torsion_Pa": found.torsion,
            "safety_factor": None if found.safety is None else found.safety[0],
            "safety_factor_error": None if found.safety is None else found.safety[1],
        }  # fmt: skip
    cylinder = a.cylinder(state)
    if cylinder is not None:
        out["cylinder_stress"] = {
            "von_Mises_Pa": cylinder.value, "error_Pa": cylinder.error, "s": cylinder.s, "used": cylinder.utilisation,
        }  # fmt: skip
    out["supports"] = [
        {"kind": one.kind, "on": one.on, "s": one.s, "value": one.value, "error": one.error,
         "capacity": one.capacity, "used": one.utilisation}
        for one in a.supports(state)
    ]  # fmt: skip
    over = a.over_local(state)
    if over is not None:
        out["over_local_limit_up_to_s"] = over.to
    return out


def _applied(a: Assessment, at: AtLoad) -> dict[str, Any]:
    load = at.load
    return {
        "given": load.given,
        "at": "bottom" if load.bottom else "top",
        "kind": "real" if load.real else "effective",
        "force": _force(a, load.force, 0.0),
        "what": at.what,
        "why": at.why,
        "state": None if at.state is None else at.state.name,
    }


def _local(a: Assessment) -> dict[str, Any] | None:
    local = a.local
    if local is None:
        return None
    loads = {"critical": local.critical, "lift_off": local.lift_off}
    out: dict[str, Any] = {"half_waves": local.half_waves, "applies": local.applies}
    for name, load in loads.items():
        out[name] = {"compression_N": load.value, "error_N": load.error, "reason": load.reason}
    if local.applies:
        out["relative_gap_to_an_endless_rod"] = local.length_effect
    return out


def _formula(a: Assessment, row: Row) -> dict[str, Any]:
    main, f = row.main, row.formula
    assert main is not None
    assert row.value is not None
    return {
        "key": f.key, "name": f.name, "place": f.place, "compression": _force(a, row.value, 0.0),
        "against": row.against, "exact": _force(a, main.exact, main.error), "percent": main.percent,
        "safe": main.safe, "valid": row.valid, "outside_because": list(row.reasons),
    }  # fmt: skip
