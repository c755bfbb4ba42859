"""Branches as labelled arrays: every field along the rod, with symbols, units, equations and errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell._version import __version__
from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.curves.curve import numbers_on
from rodwell.analysis.discrete.measures import MEASURES
from rodwell.analysis.state.balance import ENERGIES
from rodwell.analysis.state.fields import GRID
from rodwell.errors import InputError, checked_number
from rodwell.physics.on_wall.frames import AXES, FRAMES, frames
from rodwell.problem.problem import Problem
from rodwell.problem.varying import ParameterPath
from rodwell.quantities.names import FIELDS, POWERS, QUANTITIES, SI_UNITS, UNITS, VANISHING
from rodwell.quantities.table import Variable

if TYPE_CHECKING:
    import xarray as xr


CONVENTIONS = (
    "Units B = L = 1 (bending stiffness, rod length). Tension positive. The end force acts at s = 1. "
    "Contact pressure p < 0 presses the rod on the wall from inside; lift-off where max p = 0. "
    "Stability index: negative eigenvalues of the second variation under dead loads "
    "F and T1, for a rod kept on the wall."
)


def branch_variables(branch: Branch, places: int = GRID) -> dict[str, Variable]:
    """All points of a branch as labelled arrays, coordinates included.

    Dimensions: ``point`` (in order of travel), ``s`` (along the rod, 0 to 1), ``field`` (names of the fields),
    ``special`` (special points). Measured numbers have a variable ``…_error``; errors of the fields, the largest
    over s, are in ``field_error``.
    """
    s = np.linspace(0.0, 1.0, places)
    states = [solution.fields_with_errors(s) for solution in branch]
    names = [name for name in FIELDS if name in states[0][0]]
    out = {
        "s": Variable(("s",), s, {"long_name": "arclength of the rod from s = 0", "units": "L"}),
        "field": Variable(("field",), text_array(names), {"long_name": "names of the fields"}),
        "force": Variable(("point",), branch.force, _about("force")),
        "parameter": Variable(("point",), branch.values, {"long_name": f"what varies: {branch.parameter}"}),
    }
    if isinstance(branch.parameter, ParameterPath):
        out |= numbers_on(branch.parameter, branch.values)
    for which, name in MEASURES.items():
        out[name] = Variable(("point",), branch.numbers(which), _about(name))
        out[f"{name}_error"] = Variable(("point",), branch.errors(which), _about_error(name))
    energies = [solution.energies for solution in branch]
    for name in ENERGIES:
        out[name] = Variable(("point",), np.array([e[name].value for e in energies]), _about(name))
        out[f"{name}_error"] = Variable(("point",), np.array([e[name].error for e in energies]), _about_error(name))
    for name in names:
        out[name] = Variable(("point", "s"), np.array([fields[name] for fields, _ in states]), _about(name))
    errors = np.array([[error[name] for name in names] for _, error in states])
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
        "special_kind": Variable(("special",), text_array(p.kind for p in points), {"long_name": "what happens there"}),
        "special_force": Variable(("special",), forces, _about("force")),
        "special_force_error": Variable(("special",), errors, _about_error("force")),
        "special_index_before": Variable(
            ("special",), np.array([p.index_before for p in points]), {"long_name": "stability index before"}
        ),
        "special_index_after": Variable(
            ("special",), np.array([p.index_after for p in points]), {"long_name": "stability index after"}
        ),
        "special_s": Variable(("special",), text_array(places), {"long_name": "places along the rod that lift off"}),
    }


def branch_attributes(branch: Branch) -> dict[str, Any]:
    """What the arrays of a branch belong to: problem, conventions, tolerance, version."""
    return problem_attributes(branch.problem) | {
        "title": "Branch of equilibria of a heavy rod on a cylinder",
        "name": branch.name,
        "parameter": str(branch.parameter),
        "mode": branch.mode.number if branch.mode else 0,
        "rtol": branch[0].meshes.rtol,
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


def solution_dataset(
    solution: Solution, places: int = GRID, length: float | None = None, stiffness: float | None = None
) -> xr.Dataset:
    """Everything about one state as an xarray Dataset.

    All fields along ``s``, with the largest error estimate of each as attribute ``error``; the frames R₁₁, R₀₁,
    R₁₂, R₂₂ (s, axis, vector); contact loads, those that vanish without friction included; energies; reactions of the
    supports (axis); measured numbers; the certificate (equation).

    Parameters
    ----------
    solution
        The state.
    places
        Number of evenly spaced places along the rod.
    length, stiffness
        Length L of the rod in m and its bending stiffness B in N m². With both, everything is in SI units; without,
        in units B = L = 1.

    Raises
    ------
    InputError
        If only one of length and stiffness is given, or one is not positive.
    """
    import xarray as xr  # noqa: PLC0415 - slow to import

    unit = _Units.of(length, stiffness)
    s = np.linspace(0.0, 1.0, places)
    fields, errors = solution.fields_with_errors(s)
    data = {name: unit.array(name, ("s",), fields[name], errors[name]) for name in FIELDS if name in fields}
    for name in VANISHING if "cylinder_F1" in fields else ():
        data[name] = unit.array(name, ("s",), np.zeros(places), 0.0)
    for name, matrices in frames(fields["xi1"], fields["eta"], fields["xi2"]).items():
        about = {"long_name": f"frame, columns {', '.join(FRAMES[name])}", "equation": "(1)", "units": "1"}
        data[name] = (("s", "axis", "vector"), matrices, about)
    for name, (value, error) in solution.energies.items():
        data[name] = unit.array(name, (), np.array(value), error)
    for which, name in MEASURES.items():
        value, error = solution.number(which)
        data[name] = unit.array(name, (), np.array(value), error)
    data["force"] = unit.array("force", (), np.array(solution.force), 0.0)
    for reaction in solution.reactions:
        for kind in ("force", "moment"):
            error = float(np.max(getattr(reaction, f"{kind}_error")))
            values = getattr(reaction, kind)
            data[f"{reaction.on}_support_{kind}_{reaction.s:.0f}"] = unit.array(
                f"support_{kind}", ("axis",), values, error
            )
    residuals = solution.certificate.residuals
    about = {"long_name": "what is left of each equation of the paper, relative to its largest term", "units": "1"}
    data["residual"] = (("equation",), np.array(list(residuals.values())), about)
    coords = {
        "s": unit.array("s", ("s",), s, 0.0),
        "axis": list(AXES),
        "vector": [0, 1, 2],
        "equation": list(residuals),
    }
    return xr.Dataset(data, coords=coords, attrs=_solution_attributes(solution) | unit.attributes)


@dataclass(frozen=True)
class _Units:
    """Units of a dataset: SI with ``length`` and ``stiffness``, else B = L = 1."""

    length: float
    stiffness: float
    names: dict[str, str]
    attributes: dict[str, float]

    @classmethod
    def of(cls, length: float | None, stiffness: float | None) -> _Units:
        if length is None and stiffness is None:
            return cls(1.0, 1.0, UNITS, {})
        for name, value in (("length", length), ("stiffness", stiffness)):
            if value is None:
                raise InputError(name, None, "must be given too: SI units need both length (m) and stiffness (N m²)")
            checked_number(name, value, _SMALLEST, np.inf, "must be positive: length in m, stiffness in N m²")
        assert length is not None
        assert stiffness is not None
        return cls(length, stiffness, SI_UNITS, {"length_m": length, "bending_stiffness_N_m2": stiffness})

    def array(
        self, name: str, dims: tuple[str, ...], values: np.ndarray, error: float
    ) -> tuple[tuple[str, ...], np.ndarray, dict[str, Any]]:
        quantity = QUANTITIES[name]
        b, length = POWERS[quantity.dimension]
        factor = self.stiffness**b * self.length**length
        about = _about(name) | {"units": self.names[quantity.dimension], "error": error * factor}
        return dims, values * factor, about


_SMALLEST = 1e-300


def _solution_attributes(solution: Solution) -> dict[str, Any]:
    return problem_attributes(solution.problem) | {
        "title": "Equilibrium of a heavy rod on a cylinder",
        "stability_index": solution.stability_index,
        "converged": int(solution.converged),
        "certificate": solution.certificate.worst,
        "rtol": solution.meshes.rtol,
        "rodwell_version": __version__,
    }


def problem_attributes(problem: Problem) -> dict[str, Any]:
    """The problem that arrays belong to, and the conventions for rods on the wall."""
    return {
        "conventions": CONVENTIONS,
        "weight": problem.weight,
        "alpha_degrees": problem.alpha,
        "clearance": problem.clearance,
        "poisson": problem.poisson,
        "twist": problem.twist,
        "turns": problem.turns,
        "on_top": int(problem.on_top),
        "outside": int(problem.outside),
        "floats": int(problem.floats),
        "ends": "-".join(problem.ends),
        **problem.attributes,
    }


def text_array(words: Any) -> np.ndarray:
    """Words (n,) as an array of them."""
    return np.array(list(words), dtype=object)


def _about(name: str) -> dict[str, Any]:
    """Metadata of a quantity: symbol, units, equation number, meaning."""
    q = QUANTITIES[name]
    return {"symbol": q.symbol, "units": UNITS[q.dimension], "equation": q.equation, "long_name": q.meaning}


def _about_error(name: str) -> dict[str, Any]:
    q = QUANTITIES[name]
    return {"long_name": f"error estimate of {name}", "units": UNITS[q.dimension]}
