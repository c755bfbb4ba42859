"""A study as plain data, for JSON."""

from __future__ import annotations

from typing import Any

from rodwell._version import __version__
from rodwell.studies.sweep.loads import LoadResult, Result
from rodwell.studies.sweep.points import Point
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


def _point_dict(study: Study, point: Point) -> dict[str, Any]:
    problem = None if point.case is None else point.case.problem
    out: dict[str, Any] = {
        "point": point.number + 1,
        "inputs": {v.name: v.values[i] for v, i in zip(study.varied, point.at, strict=True)},
        "problem": None
        if problem is None
        else {
            "weight": problem.weight, "alpha": problem.alpha, "clearance": problem.clearance,
            "poisson": problem.poisson, "twist": problem.twist, "ends": list(problem.ends),
        },
        "half_waves": point.half_waves,
        "places": list(point.places),
        "reasons": dict(point.reasons or {}),
    }  # fmt: skip
    out["applied"] = [load_dict(point, one) for one in point.loads]
    out["used_at_lift_off"] = {kind: {"value": r.value, "error": r.error} for kind, r in point.used.items()}
    for name, dimension in (("critical", "force"), ("lift_off", "force"), ("contact", "force_per_length")):
        found = getattr(point, name)
        if found is None:
            out[name] = None
            continue
        out[name] = {"value": found.value, "error": found.error}
        if point.case is not None and point.case.scales is not None:
            unit = point.factor(dimension)
            si = "N" if dimension == "force" else "N/m"
            out[name]["si"] = {"value": found.value * unit, "error": found.error * unit, "unit": si}
    return out


def load_dict(point: Point, one: LoadResult) -> dict[str, Any]:
    """One load as plain data, for JSON: units B = L = 1, SI beside where there are dimensions; stress in Pa."""
    scaled = point.case is not None and point.case.scales is not None

    def quantity(found: Result | None, dimension: str, si: str) -> dict[str, Any] | None:
        if found is None:
            return None
        out: dict[str, Any] = {"value": found.value, "error": found.error}
        if scaled:
            unit = point.factor(dimension)
            out["si"] = {"value": found.value * unit, "error": found.error * unit, "unit": si}
        return out

    return {
        "given": one.load.given,
        "at": "bottom" if one.load.bottom else "top",
        "kind": "real" if one.load.real else "effective",
        "force": quantity(Result(one.load.force, 0.0), "force", "N"),
        "what": one.what,
        "why": one.why,
        "to_spare": {kind: quantity(found, "force", "N") for kind, found in one.spare.items()},
        "exceeded_at_any_load": list(one.exceeded),
        "largest_wall_force": quantity(one.contact, "force_per_length", "N/m"),
        "rod_stress_Pa": None if one.stress is None else {"value": one.stress.value, "error": one.stress.error},
        "safety_factor": None if one.safety is None else {"value": one.safety.value, "error": one.safety.error},
    }
