"""Branches as labelled arrays: every field along the rod, with symbols, units, equations and errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rodwell._version import __version__
from rodwell.analysis.fields import GRID
from rodwell.analysis.measures import Measured
from rodwell.analysis.nomenclature import FIELDS, QUANTITIES, UNITS

if TYPE_CHECKING:
    import xarray as xr

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
    "Stability index: negative eigenvalues of the second variation under dead loads "
    "F and T1, for a rod kept on the wall."
)


class Variable(NamedTuple):
    """A labelled array: dimensions, values, metadata."""

    dims: tuple[str, ...]
    values: np.ndarray
    attrs: dict[str, Any]


def branch_variables(branch: Branch, places: int = GRID) -> dict[str, Variable]:
    """All points of a branch as labelled arrays, coordinates included.

    Dimensions: ``point`` (in order of travel), ``s`` (along the rod, 0 to 1), ``field`` (names of the fields),
    ``special`` (special points). Measured numbers have a variable ``…_error``; errors of the fields, the largest
    over s, are in ``field_error``.
    """
    s = np.linspace(0.0, 1.0, places)
    states = [solution.fields_with_errors(s) for solution in branch]
    out = {
        "s": Variable(("s",), s, {"long_name": "arclength of the rod from s = 0", "units": "L"}),
        "field": Variable(("field",), _text(FIELDS), {"long_name": "names of the fields"}),
        "force": Variable(("point",), branch.force, _about("force")),
        "parameter": Variable(("point",), branch.values, {"long_name": f"what varies: {branch.parameter}"}),
    }
    for which, name in _MEASURED.items():
        out[name] = Variable(("point",), branch.numbers(which), _about(name))
        out[f"{name}_error"] = Variable(("point",), branch.errors(which), _about_error(name))
    for name in FIELDS:
        out[name] = Variable(("point", "s"), np.array([fields[name] for fields, _ in states]), _about(name))
    errors = np.array([[error[name] for name in FIELDS] for _, error in states])
    about = {"long_name": "error estimate of each field, largest over s, in the field's units"}
    out["field_error"] = Variable(("point", "field"), errors, about)
    about = {"long_name": "number of negative eigenvalues of the second variation; 0 is stable", "units": "1"}
    out["stability_index"] = Variable(("point",), branch.stability_index, about)
    about = {"long_name": "largest residual of the paper's equations, relative to their largest terms", "units": "1"}
    out["certificate"] = Variable(("point",), branch.certificates, about)
    converged = np.array([solution.converged for solution in branch], dtype=np.int8)
    about = {"long_name": "1 if every measured number meets the tolerance", "units": "1"}
    out["converged"] = Variable(("point",), converged, about)
    return out | _special_points(branch)


def _special_points(branch: Branch) -> dict[str, Variable]:
    points = branch.special_points
    places = [", ".join(f"{x:.9g}" for x in p.s) for p in points]
    forces, errors = np.array([p.force for p in points]), np.array([p.error for p in points])
    return {
        "special_kind": Variable(("special",), _text(p.kind for p in points), {"long_name": "what happens there"}),
        "special_force": Variable(("special",), forces, _about("force")),
        "special_force_error": Variable(("special",), errors, _about_error("force")),
        "special_index_before": Variable(
            ("special",), np.array([p.index_before for p in points]), {"long_name": "stability index before"}
        ),
        "special_index_after": Variable(
            ("special",), np.array([p.index_after for p in points]), {"long_name": "stability index after"}
        ),
        "special_s": Variable(("special",), _text(places), {"long_name": "places along the rod that lift off"}),
    }


def branch_attributes(branch: Branch) -> dict[str, Any]:
    """What the arrays of a branch belong to: problem, conventions, tolerance, version."""
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
        "outside": int(problem.outside),
        "ends": "-".join(problem.ends),
        "name": branch.name,
        "parameter": branch.parameter,
        "mode": branch.mode.number if branch.mode else 0,
        "rtol": branch[0].ladder.rtol,
        "ended_because": branch.ended_because,
        "reached_end": int(branch.reached_end),
        "rodwell_version": __version__,
    }


def branch_dataset(branch: Branch, places: int = GRID) -> xr.Dataset:
    """Return :func:`branch_variables` as an xarray Dataset, fields at ``places`` places along the rod."""
    import xarray as xr  # noqa: PLC0415 - slow to import

    data = dict(branch_variables(branch, places))
    coords = {name: data.pop(name) for name in ("s", "field")}
    return xr.Dataset(data, coords=coords, attrs=branch_attributes(branch))


def _text(words: Any) -> np.ndarray:
    return np.array(list(words), dtype=object)


def _about(name: str) -> dict[str, Any]:
    """Metadata of a quantity: symbol, units, equation number, meaning."""
    q = QUANTITIES[name]
    return {"symbol": q.symbol, "units": UNITS[q.dimension], "equation": q.equation, "long_name": q.meaning}


def _about_error(name: str) -> dict[str, Any]:
    q = QUANTITIES[name]
    return {"long_name": f"error estimate of {name}", "units": UNITS[q.dimension]}
