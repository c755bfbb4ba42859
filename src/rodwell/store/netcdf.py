"""NetCDF files: branches of a case, curves, load paths, with units, equations, tolerance, version and the case."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5netcdf
import numpy as np

from rodwell.analysis.beyond.off_wall_branch import OffWallBranch
from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.diagram import Diagram
from rodwell.analysis.curves.curve import Curve
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.quantities.as_json import as_json
from rodwell.quantities.names import QUANTITIES
from rodwell.quantities.scales import Scales
from rodwell.quantities.table import Variable
from rodwell.store.dataset import branch_attributes, branch_variables
from rodwell.store.path_arrays import off_wall_attributes, off_wall_variables, path_attributes, path_variables

if TYPE_CHECKING:
    from rodwell.answers.result.answer import Answer  # what it is made of is slow to import


def joined_variables(branches: Sequence[Branch]) -> dict[str, Variable]:
    """Several branches as labelled arrays.

    Points of all branches follow each other along ``point``; ``branch`` (point) holds the number of the branch, from
    1, as ``special_branch`` does for the special points. Names of branches stand along ``branches``.
    """
    parts = []
    for number, branch in enumerate(branches, start=1):
        part = branch_variables(branch)
        about = {"long_name": "number of the branch, from 1: see branch_name"}
        for name, dim in (("branch", "point"), ("special_branch", "special")):
            count = len(branch) if dim == "point" else len(branch.special_points)
            part[name] = Variable((dim,), np.full(count, number), about)
        parts.append(part)
    out = {}
    for name, (dims, values, attrs) in parts[0].items():
        joined = dims[0] in ("point", "special")
        out[name] = Variable(dims, np.concatenate([p[name].values for p in parts]) if joined else values, attrs)
    for name, texts, meaning in (
        ("branch_name", [b.name for b in branches], "names of the branches"),
        ("branch_parent", [b.origin.parent or "" for b in branches], "branch that each one leaves"),
        ("branch_end", [b.ended_because for b in branches], "why each branch ended"),
    ):
        out[name] = Variable(("branches",), np.array(texts, dtype=object), {"long_name": meaning})
    return out


def _critical(critical: CriticalLoads) -> dict[str, Variable]:
    about = {"units": "B/L^2", "equation": "(64), (65)", "long_name": "critical end force at s = 1, tension positive"}
    return {
        "mode": Variable(("mode",), np.array([m.number for m in critical]), {"long_name": "number of the mode"}),
        "critical_load": Variable(("mode",), critical.forces, about),
        "critical_load_error": Variable(("mode",), critical.errors, {"units": "B/L^2"}),
    }


def answer_variables(answer: Answer) -> dict[str, Variable]:
    """All branches of an answer, and the critical loads along ``mode``."""
    return joined_variables(answer.branches) | _critical(answer.critical)


def _attributes(first: Branch) -> dict[str, Any]:
    """What all branches of a file have in common."""
    out = branch_attributes(first)
    for name in ("mode", "name", "ended_because", "reached_end"):  # these belong to single branches
        del out[name]
    return out


def answer_attributes(answer: Answer) -> dict[str, Any]:
    """What the file belongs to: the case as it was read, conventions, tolerance, version."""
    case = answer.case
    out = _attributes(answer.first) | {
        "title": case.title,
        "case": case.text or as_json(dict(case.given)),
        "converged": int(answer.converged),
        "certificate": answer.worst_certificate.worst,
    }
    if case.scales is not None:
        out |= {"length_m": case.scales.length, "bending_stiffness_N_m2": case.scales.stiffness}
    return out


def write_answer(answer: Answer, path: Path) -> None:
    """Write all branches of an answer to a NetCDF file; with SI factors where the case has dimensions."""
    scales = answer.case.scales
    variables = {
        name: Variable(v.dims, v.values, v.attrs | _si(name, scales)) for name, v in answer_variables(answer).items()
    }
    _write(variables, answer_attributes(answer), path)


def write_branches(diagram: Diagram, path: Path) -> None:
    """Write all branches of a diagram to a NetCDF file.

    States off the wall with which branch number k goes on, from 1, are in the group ``off_wall_k``.
    """
    variables = joined_variables(diagram.branches)
    if diagram.critical:
        variables |= _critical(diagram.critical)
    with h5netcdf.File(path, "w") as file:
        write_variables(file, variables, _attributes(diagram.branches[0]) | {"converged": int(diagram.converged)})
        for number, branch in enumerate(diagram.branches, start=1):
            if branch.beyond is not None:
                write_off_wall(file.create_group(f"off_wall_{number}"), branch.beyond)


def write_curves(curves: Sequence[Curve], path: Path) -> None:
    """Write curves to a NetCDF file; ``curve`` (point) holds the number of the curve, from 1."""
    parts = []
    for number, curve in enumerate(curves, start=1):
        part = curve.variables()
        part["curve"] = Variable(("point",), np.full(len(curve), number), {"long_name": "number of the curve, from 1"})
        parts.append(part)
    variables = {
        name: Variable(v.dims, np.concatenate([p[name].values for p in parts]), v.attrs) for name, v in parts[0].items()
    }
    names = np.array([f"{c.kind}, {c.name}" for c in curves], dtype=object)
    variables["curve_name"] = Variable(("curves",), names, {"long_name": "names of the curves"})
    marks = [(number, mark) for number, curve in enumerate(curves, start=1) for mark in curve.marks]
    if marks:
        for name in ("kind", "x", "x_error", "value", "error", "note"):
            values = np.array([getattr(m, name) for _, m in marks], dtype=object if name in ("kind", "note") else float)
            variables[f"mark_{name}"] = Variable(("mark",), values, {"long_name": f"special points: {name}"})
        variables["mark_curve"] = Variable(
            ("mark",), np.array([n for n, _ in marks]), {"long_name": "curve it lies on"}
        )
    _write(variables, curves[0].attributes(), path)


def write_load_path(result: LoadPath, path: Path) -> None:
    """Write states and events of a load path to a NetCDF file."""
    variables, left_out = path_variables(result)
    _write(variables, path_attributes(result, left_out), path)


def write_off_wall(group: h5netcdf.Group, beyond: OffWallBranch) -> None:
    """Write states off the wall with which a branch goes on to a group of a NetCDF file."""
    variables, left_out = off_wall_variables(beyond)
    write_variables(group, variables, off_wall_attributes(beyond, left_out))


def _write(variables: dict[str, Variable], attributes: dict[str, Any], path: Path) -> None:
    with h5netcdf.File(path, "w") as file:
        write_variables(file, variables, attributes)


def write_variables(group: h5netcdf.Group, variables: dict[str, Variable], attributes: dict[str, Any]) -> None:
    """Write labelled arrays with their attributes to a file, or to a group of one."""
    group.dimensions = {d: n for v in variables.values() for d, n in zip(v.dims, v.values.shape, strict=True)}
    group.attrs.update(attributes)
    for name, (dims, values, attrs) in variables.items():
        kind = h5netcdf.core.h5py.string_dtype() if values.dtype == object else values.dtype
        group.create_variable(name, dims, dtype=kind, data=values).attrs.update(attrs)


def _si(name: str, scales: Scales | None) -> dict[str, Any]:
    """The factor that turns a variable into SI units, and the unit."""
    quantity = name.removesuffix("_error").removeprefix("special_")
    if scales is None or quantity not in QUANTITIES:
        return {}
    factor, unit = scales.of(quantity)
    return {"si_factor": factor, "si_units": unit}
