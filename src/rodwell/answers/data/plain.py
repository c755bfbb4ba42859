"""An answer as plain data, for JSON."""

from __future__ import annotations

import math
from typing import Any

from rodwell._version import __version__
from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.state.wall import lying_step_loads
from rodwell.analysis.straight.lying import lies_between
from rodwell.answers.comparison.beside import FormulaRow
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.assessment import Assessment, AtLoad
from rodwell.answers.result.reach import out_of_reach, why_out_of_reach
from rodwell.answers.result.spread import Spread
from rodwell.answers.words.curved import left_out
from rodwell.answers.words.steps import steps_data
from rodwell.answers.words.verdict import verdict
from rodwell.answers.words.wording import side_of
from rodwell.problem.words import ends_text
from rodwell.quantities.names import UNITS
from rodwell.quantities.scales import Scales
from rodwell.quantities.value import Value
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.local import LocalLimits


def assessment_dict(a: Assessment) -> dict[str, Any]:
    """Verdict, loads that act, window with limits, states with stresses, local limits, formulas."""
    window, scales = a.window, a.case.scales
    return {
        "verdict": verdict(a),
        "window": {
            "buckling": _quantity(scales, window.buckling),
            "lift_off": None if window.lift_off is None else _quantity(scales, window.lift_off),
            "width": None if window.width is None else _quantity(scales, window.width),
            "percent_of_compression_at_bottom": window.percent,
            "ends_by": None if window.end is None else window.end.kind,
            "limits": [
                {
                    "kind": limit.kind,
                    "name": limit.name,
                    "force": None if limit.load is None else _quantity(scales, limit.load),
                    "s": limit.s,
                    "buckled": limit.buckled,
                }
                for limit in window.limits
            ],
        },
        "states": [state_dict(a, state) for state in a.states],
        "applied": [_applied(scales, at) for at in a.applied],
        "local": None if a.local is None else _local(a.local),
        "formulas": [_formula(scales, row) for row in a.formulas],
    }


def _quantity(scales: Scales | None, number: Value, dimension: str = "force") -> dict[str, Any]:
    """Value and error in units B = L = 1, and in SI where the case has dimensions."""
    out: dict[str, Any] = {"value": number.value, "error": number.error, "unit": UNITS[dimension]}
    return out if scales is None else out | {"si": scales.si(number, dimension)}


def state_dict(a: Assessment, state: LoadedRod) -> dict[str, Any]:
    """A state: forces at both ends, contact, shortening, stress, supports."""
    contact, scales = state.contact, a.case.scales
    out: dict[str, Any] = {
        "name": state.name,
        "shape": "buckled" if not state.straight else "straight" if a.case.problem.hole is None else "along the hole",
        "force": _quantity(scales, state.load),
        "force_at_bottom": _quantity(scales, Value(state.at_bottom, state.error)),
        "largest_wall_force": _quantity(scales, contact, "force_per_length") | {"s": contact.s},
        "total_wall_force": _quantity(scales, state.total_contact),
        "end_shortening": _quantity(scales, state.shortening, "length"),
    }
    stress = a.stress(state)
    if stress is not None:
        out["rod_stress"] = {
            "von_Mises_Pa": stress.value, "error_Pa": stress.error, "s": stress.s, "fibre": stress.fibre,
            "axial_Pa": stress.axial, "bending_Pa": stress.bending, "torsion_Pa": stress.torsion,
            "safety_factor": None if stress.safety is None else stress.safety.value,
            "safety_factor_error": None if stress.safety is None else stress.safety.error,
        }  # fmt: skip
    cylinder = a.cylinder(state)
    if cylinder is not None:
        out["cylinder_stress"] = {
            "von_Mises_Pa": cylinder.value, "error_Pa": cylinder.error, "s": cylinder.s, "used": cylinder.utilisation,
        }  # fmt: skip
    out["supports"] = [
        {"kind": support.kind, "on": support.on, "s": support.s, "value": support.value, "error": support.error,
         "capacity": support.capacity, "used": support.utilisation}
        for support in a.supports(state)
    ]  # fmt: skip
    over = a.over_local(state)
    if over is not None:
        out["over_local_limit_up_to_s"] = over.to
    return out


def _applied(scales: Scales | None, at: AtLoad) -> dict[str, Any]:
    load = at.load
    return {
        "given": load.given,
        "at": "bottom" if load.bottom else "top",
        "kind": "real" if load.real else "effective",
        "force": _quantity(scales, Value(load.force)),
        "what": at.what,
        "reached": at.reached,
        "why": at.why,
        "state": None if at.state is None else at.state.name,
    }


def _local(local: LocalLimits) -> dict[str, Any]:
    loads = {"critical": local.critical, "lift_off": local.lift_off}
    out: dict[str, Any] = {"half_waves": local.half_waves, "applies": local.applies}
    for name, load in loads.items():
        value, error = (None, 0.0) if load.compression is None else load.compression
        out[name] = {"compression_N": value, "error_N": error, "reason": load.reason}
    if local.applies:
        out["relative_gap_to_an_endless_rod"] = local.length_effect
    return out


def _formula(scales: Scales | None, row: FormulaRow) -> dict[str, Any]:
    main, f = row.main, row.formula
    assert main is not None
    assert row.value is not None
    return {
        "key": f.key, "name": f.name, "place": f.place, "compression": _quantity(scales, Value(row.value)),
        "against": row.against, "exact": _quantity(scales, Value(main.exact, main.error)), "percent": main.percent,
        "safe": main.safe, "valid": row.valid, "outside_because": list(row.reasons),
    }  # fmt: skip


def answer_dict(answer: Answer, *, path: bool = False) -> dict[str, Any]:
    """Return the answer as plain data, for JSON; with ``path``, what happens beyond lift-off too."""
    case, problem = answer.case, answer.case.problem
    load, assessment = answer.lift_off_load, assessment_dict(answer.assessment)
    return {
        "title": case.title,
        "verdict": assessment.pop("verdict"),
        "rodwell_version": __version__,
        "conventions": "units B = L = 1 unless si, field or mm; end force at s = 1, tension positive"
        + (", effective" if case.with_fluids else "")
        + "; "
        + ends_text(problem),
        "problem": {
            "weight": problem.weight,
            "alpha": problem.alpha,
            "clearance": problem.clearance,
            "poisson": problem.poisson,
            "twist": problem.twist,
            "ends": list(problem.ends),
            **({"floats": True} if problem.floats else {}),
            **({} if math.isinf(case.wall_stiffness) else {"wall_stiffness": case.wall_stiffness}),
            **problem.given_more,
        },
        **_critical_loads(answer),
        "until": _until(answer),
        "lift_off": None
        if load is None
        else {
            "force": load.value,
            "error": load.error,
            "s": list(answer.lift_off_places),
            "coincides_with_buckling": answer.off_at_once,
        },
        **({} if problem.hole is None else {"lying": _lying(answer)}),
        "other_arm": _other_arm(answer),
        "conversions": [fact.as_dict() for fact in case.facts],
        "yield_strength_Pa": case.yield_strength,
        "figures": {name: key.as_dict(case) for name, key in answer.key_numbers.items()},
        "branches": [_branch_dict(branch) for branch in answer.branches],
        "assessment": assessment,
        "validity": answer.assessment.validity.as_dict(),
        "sensitivities": [
            load.as_dict() | _spread(spread) for load, spread in zip(answer.sensitivities, answer.spreads, strict=True)
        ],
        "converged": answer.converged,
        "certificate": answer.worst_certificate.as_dict(),
        "rtol": case.rtol,
        **({"beyond_lift_off": _beyond(answer)} if path else {}),
    }


def _beyond(answer: Answer) -> dict[str, Any]:
    from rodwell.answers.data.beyond import beyond_dict  # noqa: PLC0415 - takes a third of a second: only where the load path is asked for

    return beyond_dict(answer.case, answer.beyond)


def _critical_loads(answer: Answer) -> dict[str, Any]:
    """Loads with the wall's help, as met, and without; those of a rod kept on the wall where these are others."""
    kept, alone = answer.critical, answer.without_wall
    loads = {"critical_loads": [float(f) for f in kept.forces], "critical_errors": [float(e) for e in kept.errors]}
    out: dict[str, Any] = loads
    if answer.untouched:
        kept_on_wall = {"loads": loads["critical_loads"], "error": loads["critical_errors"]}
        met = answer.first_met
        out = {"critical_loads": [met.force], "critical_errors": [met.error], "kept_on_wall": kept_on_wall}
    return out | {"without_wall": None if alone is None else {"loads": [alone.force], "error": [alone.error]}}


def _lying(answer: Answer) -> dict[str, Any]:
    """Between which end forces the rod lies on the wall of a curved hole by itself, and what is not told there."""
    rest = {"leaves_before_buckling": answer.left_before is not None, "left_out": left_out(answer)}
    if answer.lying is not None:
        return {**answer.lying.as_dict(), **rest}
    (low, high), free = lies_between(answer.case.problem), answer.not_held_at_steps
    ends = {"lowest_force": low, "highest_force": high}
    return {
        "side": side_of(answer.case),
        **{
            name: None if one is None else {"value": one.value, "error": one.error, "s": one.s}
            for name, one in ends.items()
        },
        **({"steps": steps_data(lying_step_loads(answer.case.problem))} if answer.case.problem.sections else {}),
        **({} if free is None else {"not_held_at_steps": free if isinstance(free, str) else free.as_dict()}),
        **rest,
    }


def _other_arm(answer: Answer) -> dict[str, Any] | None:
    """Lift-off of the other arm of mode 1, where twist makes the two differ; None where it is an image."""
    if answer.other_arm is None:
        return None
    lift = answer.other_arm.lift_off
    ended = {"ended_because": answer.other_arm.ended_because}
    return ended if lift is None else {"force": lift.force, "error": lift.error, "s": list(lift.s)}


def _until(answer: Answer) -> dict[str, Any] | None:
    """The end force asked for, and whether the branch of mode 1 reaches it; None where none was asked for."""
    until, scales = answer.case.until, answer.case.scales
    if until is None:
        return None
    missed = out_of_reach(answer.first, until)
    why = why_out_of_reach(answer.first, scales) if missed else ""
    return {"force": _quantity(scales, Value(until)), "reached": not missed, "why": why}


def _spread(spread: Spread | None) -> dict[str, Any]:
    """Uncertainty from the inputs, for JSON: in B/L², or in N for a case with dimensions."""
    if spread is None:
        return {"from_inputs": None}
    return {"from_inputs": {"total": spread.total, "parts": spread.parts}}


def _branch_dict(branch: Branch) -> dict[str, Any]:
    return {
        "mode": branch.mode.number if branch.mode else None,
        "points": len(branch),
        "reached_end": branch.reached_end,
        "ended_because": branch.ended_because,
        "special_points": [
            point.as_dict() | {"converged": branch.meets_tolerance(point)} for point in branch.special_points
        ],
    }
