"""Branches as xarray Datasets: every field along the rod, with symbols, units, equations and errors."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from rodwell._version import __version__
from rodwell.analysis.measures import Measured
from rodwell.analysis.nomenclature import FIELDS, QUANTITIES, UNITS
from rodwell.analysis.solution import GRID

if TYPE_CHECKING:
    from rodwell.analysis.branches import Branch

_MEASURED = {
    Measured.P_MAX: "largest_pressure",
    Measured.ENERGY: "energy",
    Measured.SHORTENING: "end_shortening",
    Measured.OMEGA2_0: "omega2_at_0",
    Measured.OMEGA2_1: "omega2_at_1",
    Measured.ANGLE_MID: "angle_at_middle",
    Measured.TORQUE_0: "support_torque",
}

CONVENTIONS = (
    "Units B = L = 1 (bending stiffness, rod length). Tension positive. The end force acts at s = 1. "
    "Contact pressure p < 0 presses the rod on the wall from inside; lift-off where max p = 0. "
    "Both ends clamped. Stability index: negative eigenvalues of the second variation under dead loads "
    "F and T1, for a rod kept on the wall."
)


def attributes(name: str) -> dict[str, str]:
    """Metadata of a quantity: symbol, units, equation number, meaning."""
    q = QUANTITIES[name]
    return {"symbol": q.symbol, "units": UNITS[q.dimension], "equation": q.equation, "long_name": q.meaning}


def branch_dataset(branch: Branch, places: int = GRID) -> xr.Dataset:
    """All points of a branch as a Dataset.

    Dimensions: ``point`` (in order of travel), ``s`` (along the rod, 0 to 1), ``field`` (names of the fields),
    ``special`` (special points). Measured numbers have a variable ``…_error``; errors of the fields, the largest
    over s, are in ``field_error``.
    """
    s = np.linspace(0.0, 1.0, places)
    solutions = list(branch)
    states = [solution.fields_with_errors(s) for solution in solutions]
    data: dict[str, tuple[object, ...]] = {"force": ("point", branch.force, attributes("force"))}
    for which, name in _MEASURED.items():
        data[name] = ("point", branch.numbers(which), attributes(name))
        data[f"{name}_error"] = ("point", branch.errors(which), _error_attributes(name))
    for name in FIELDS:
        data[name] = (("point", "s"), np.array([fields[name] for fields, _ in states]), attributes(name))
    field_error = np.array([[errors[name] for name in FIELDS] for _, errors in states])
    data["field_error"] = (
        ("point", "field"), field_error, {"long_name": "error estimate, largest over s, in the field's units"}
    )  # fmt: skip
    data["stability_index"] = (
        "point",
        branch.stability_index,
        {"long_name": "stability index", "units": "1"},
    )
    converged = np.array([solution.converged for solution in solutions], dtype=np.int8)
    about = {"long_name": "1 if every measured number meets the tolerance", "units": "1"}
    data["converged"] = ("point", converged, about)
    return xr.Dataset(
        data | _special_points(branch),
        coords={
            "point": np.arange(len(solutions)),
            "s": ("s", s, {"long_name": "arclength of the rod from s = 0", "units": "L"}),
            "field": list(FIELDS),
        },
        attrs=_problem_attributes(branch),
    )


def _special_points(branch: Branch) -> dict[str, tuple[object, ...]]:
    points = branch.special_points
    places = [", ".join(f"{x:.9g}" for x in p.s) for p in points]
    return {
        "special_kind": ("special", np.array([p.kind for p in points], dtype=object), {}),
        "special_force": ("special", np.array([p.force for p in points]), attributes("force")),
        "special_force_error": ("special", np.array([p.error for p in points]), _error_attributes("force")),
        "special_s": (
            "special", np.array(places, dtype=object), {"long_name": "places along the rod that lift off"}
        ),
    }  # fmt: skip


def _problem_attributes(branch: Branch) -> dict[str, object]:
    problem = branch.problem
    return {
        "title": "Branch of equilibria of a heavy rod on a cylinder",
        "conventions": CONVENTIONS,
        "weight": problem.weight,
        "alpha_degrees": problem.alpha,
        "clearance": problem.clearance,
        "poisson": problem.poisson,
        "twist": problem.twist,
        "turns": problem.turns,
        "on_top": int(problem.on_top),
        "mode": branch.mode.number if branch.mode else 0,
        "rtol": branch[0].ladder.rtol,
        "ended_because": branch.ended_because,
        "reached_end": int(branch.reached_end),
        "rodwell_version": __version__,
    }


def _error_attributes(name: str) -> dict[str, str]:
    q = QUANTITIES[name]
    return {"long_name": f"error estimate of {name}", "units": UNITS[q.dimension]}
