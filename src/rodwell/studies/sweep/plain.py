"""A study as plain data, for JSON."""

from __future__ import annotations

from typing import Any

from rodwell._version import __version__
from rodwell.quantities.scales import Scales
from rodwell.quantities.value import Value
from rodwell.studies.sweep.loads import LoadResult
from rodwell.studies.sweep.points import StudyPoint
from rodwell.studies.sweep.study import Study
from rodwell.studies.sweep.tables import LOADS, sentences


def study_dict(study: Study) -> dict[str, Any]:
    """Everything as plain data, for JSON."""
    worst = {name: None if (p := study.worst(name)) is None else p.number + 1 for name in LOADS}
    return {
        "title": study.title,
        "rodwell_version": __version__,
        "conventions": "units B = L = 1 unless si; end force at s = 1, tension positive; points are numbered from 1",
        "varied": [
            {"key": v.name, "written": v.written, "unit": v.unit, "values": list(v.numbers or v.values)}
            for v in study.varied
        ],
        "worst": worst,
        "summary": sentences(study),
        "points": [_point_dict(study, point) for point in study.points],
    }


def _point_dict(study: Study, point: StudyPoint) -> dict[str, Any]:
    problem = None if point.case is None else point.case.problem
    out: dict[str, Any] = {
        "point": point.number + 1,
        "inputs": {v.name: v.values[i] for v, i in zip(study.varied, point.at, strict=True)},
        "problem": None
        if problem is None
        else {
            "weight": problem.weight, "alpha": problem.alpha, "clearance": problem.clearance,
            "poisson": problem.poisson, "twist": problem.twist, "ends": list(problem.ends),
            **problem.given_more,
        },
        "half_waves": point.half_waves,
        "places": list(point.places),
        "reasons": dict(point.reasons or {}),
    }  # fmt: skip
    out["validity"] = None if point.validity is None else point.validity.as_dict()
    out["applied"] = [load_dict(point, state) for state in point.loads]
    out["used_at_lift_off"] = {kind: _number(used) for kind, used in point.used.items()}
    for name, dimension in (
        ("critical", "force"),
        ("lift_off", "force"),
        ("contact", "force_per_length"),
        ("without_wall", "force"),
        ("other_arm", "force"),
    ):
        out[name] = _number(getattr(point, name), point.scales, dimension)
    return out


def _number(number: Value | None, scales: Scales | None = None, dimension: str = "1") -> dict[str, Any] | None:
    """A number with its error, and both in SI where there are dimensions."""
    if number is None:
        return None
    out: dict[str, Any] = {"value": number.value, "error": number.error}
    return out if scales is None else out | {"si": scales.si(number, dimension)}


def load_dict(point: StudyPoint, state: LoadResult) -> dict[str, Any]:
    """One load as plain data, for JSON: units B = L = 1, SI beside where there are dimensions; stress in Pa."""
    return {
        "given": state.load.given,
        "at": "bottom" if state.load.bottom else "top",
        "kind": "real" if state.load.real else "effective",
        "force": _number(Value(state.load.force), point.scales, "force"),
        "what": state.what,
        "reached": state.reached,
        "why": state.why,
        "to_spare": {kind: _number(spare, point.scales, "force") for kind, spare in state.spare.items()},
        "exceeded_at_any_load": list(state.exceeded),
        "largest_wall_force": _number(state.contact, point.scales, "force_per_length"),
        "rod_stress_Pa": _number(state.stress),
        "safety_factor": _number(state.safety),
    }
