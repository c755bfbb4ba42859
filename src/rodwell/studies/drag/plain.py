"""Torque and drag as plain data, for JSON: SI units, forces tension positive, measured depths."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rodwell._version import __version__
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value
from rodwell.studies.drag.calibration import Calibration
from rodwell.studies.drag.contact import NAMES
from rodwell.studies.drag.drag import Drag, Ends, OperationResult
from rodwell.studies.drag.lock_up import Reach
from rodwell.studies.drag.road_map import RoadMap
from rodwell.studies.drag.tables import worst_depth
from rodwell.studies.drag.well_case import Well
from rodwell.studies.drag.words import FAILS, assumptions, failure, level_of, level_of_one, sentences

UNIT = {"force": "N", "force_per_length": "N/m", "torque": "N m", "depth": "m", "stress": "Pa", "angle": "rad"}
CONVENTION = (
    "effective axial force, tension positive, at the place named: hook load at surface without the block, bit force at "
    "the bit (weight on bit negative); depths measured along the hole from the surface; contact force per length, mean "
    "of the local state; from the bit up"
)


def drag_dict(found: Drag, calibration: Calibration | None = None) -> dict[str, Any]:
    """Everything that was found."""
    well = found.well
    return {
        "title": well.title,
        "rodwell_version": __version__,
        "unit": UNIT,
        "convention": CONVENTION,
        "verdict": level_of(found),
        "summary": sentences(found),
        "assumptions": assumptions(found),
        "contact": well.settings.contact,
        "string": well.settings.string,
        "state_rule": well.settings.state_rule,
        "block_weight": well.settings.block_weight,
        "survey": well.survey.source,
        "operations": [operation_dict(well, one) for one in found.operations],
        "road_map": None if found.road_map is None else _road_map(found.road_map),
        "calibration": None if calibration is None else _calibration(calibration),
    }


def operation_dict(well: Well, one: OperationResult) -> dict[str, Any]:
    """What was found of one operation."""
    operation, run, strength = one.operation, one.run, one.strength
    return {
        "name": operation.name,
        "kind": operation.kind,
        "bit_depth": operation.bit_depth,
        "bit_force": number(Value(operation.bit_force)),
        "bit_torque": number(Value(operation.bit_torque)),
        "verdict": level_of_one(one),
        "why": failure(well, one) if level_of_one(one) == FAILS else None,
        "possible": one.possible,
        "hook_load": number(one.ends.hook_load),
        "surface_torque": number(one.ends.torque),
        "margin": number(one.margin),
        "bounds": {name: _ends(ends) for name, ends in one.bounds.items()},
        "compared": {name: _ends(ends) for name, ends in one.compared.items()},
        "locks_at": run.locked_at,
        "lock_up_depth": number(worst_depth(one, "lock_up")),
        "push_ends_depth": number(worst_depth(one, "push_ends")),
        "reach": {name: _reach(found) for name, found in one.reach.items()},
        "transfer": one.transfer,
        "neutral_points": list(run.neutral_points),
        "buckled": [{"from": high, "to": low, "state": NAMES[state]} for low, high, state in run.buckled],
        "largest_contact_force": number(largest(run.contacts)) if run.arrived else None,
        "largest_von_mises": number(largest(strength.von_mises)) if run.arrived else None,
        "largest_used": number(largest(strength.used)) if run.arrived else None,
        "not_judged": list(strength.not_judged),
        "stretch": number(strength.stretch) if run.arrived else None,
        "twist": number(strength.twist) if run.arrived else None,
        "balance": number(one.balance),
        "settled": one.settled,
        "along": {
            "measured_depth": listed(run.measured_depth),
            "axial_force": listed(run.forces),
            "true_axial_force": listed(strength.true_force),
            "contact_force": listed(run.contacts),
            "torque": listed(run.torques),
            "state": [NAMES[state] for state in run.states],
            "bending_stress": listed(strength.bending),
            "von_mises": listed(strength.von_mises),
            "error": listed(one.force_errors),
        },
    }


def _road_map(found: RoadMap) -> dict[str, Any]:
    curves = [
        {
            "kind": curve.kind, "label": curve.label, "friction": list(curve.friction),
            "hook_load": listed(curve.hook_load), "error": listed(curve.error), "surface_torque": listed(curve.torque),
            "possible": [bool(one) for one in curve.possible],
        }
        for curve in found.curves
    ]  # fmt: skip
    return {"bit_depth": listed(found.depths), "state_rule": "early", "curves": curves}


def _calibration(found: Calibration) -> dict[str, Any]:
    return {
        "friction": [
            {"section": name, "value": value.value, "error": value.error if math.isfinite(value.error) else None}
            for name, value in zip(found.names, found.friction, strict=True)
        ],
        "correlation": [listed(row) for row in found.correlation],
        "standard_deviation": {"hook_load": found.spread[0], "surface_torque": found.spread[1]},
        "notes": list(found.notes),
        "measurements": len(found.measured),
        "residuals": {"hook_load": listed(found.residuals[:, 0]), "surface_torque": listed(found.residuals[:, 1])},
    }


def number(value: Value | None) -> dict[str, float | None] | None:
    """A number with its error; null where there is none, and for an error that is not known."""
    if value is None or not math.isfinite(value.value):
        return None
    return {"value": value.value, "error": value.error if math.isfinite(value.error) else None}


def listed(values: FloatArray) -> list[float | None]:
    """An array as a list; null where a number is not known."""
    return [float(v) if math.isfinite(v) else None for v in values]


def _ends(ends: Ends) -> dict[str, Any]:
    return {"hook_load": number(ends.hook_load), "surface_torque": number(ends.torque)}


def _reach(found: Reach) -> dict[str, Any]:
    return {
        "lock_up_depth": number(found.lock_up), "push_ends_depth": number(found.push_ends),
        "searched_from": found.searched_from, "searched_to": found.searched_to, "looked_at": found.looked_at,
        "on_the_way": found.on_the_way,
    }  # fmt: skip


def largest(values: FloatArray) -> Value | None:
    """The largest along the string; its error is half of what it changes over the steps beside it."""
    if np.all(np.isnan(values)):
        return None
    i = int(np.nanargmax(values))
    near = values[max(i - 1, 0) : i + 2]
    near = near[np.isfinite(near)]
    return Value(float(values[i]), float(np.max(np.abs(near - values[i]))) / 8.0)
