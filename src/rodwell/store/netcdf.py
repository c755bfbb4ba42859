"""NetCDF files: all branches of a case, with units, equation numbers, tolerance, version and the case itself."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np

from rodwell.analysis.dataset import Variable, branch_attributes, branch_variables
from rodwell.analysis.nomenclature import QUANTITIES
from rodwell.practice.answer import Answer
from rodwell.practice.scales import Scales


def answer_variables(answer: Answer) -> dict[str, Variable]:
    """All branches of an answer as labelled arrays.

    Points of all branches follow each other along ``point``; ``branch`` (point) holds the number of the mode, as
    ``special_branch`` does for the special points. Critical loads stand along ``mode``.
    """
    parts = []
    for branch in answer.branches:
        assert branch.mode is not None
        part = branch_variables(branch)
        about = {"long_name": "number of the mode that the branch starts from"}
        for name, dim in (("branch", "point"), ("special_branch", "special")):
            count = len(branch) if dim == "point" else len(branch.special_points)
            part[name] = Variable((dim,), np.full(count, branch.mode.number), about)
        parts.append(part)
    out = {}
    for name, (dims, values, attrs) in parts[0].items():
        joined = dims[0] in ("point", "special")
        out[name] = Variable(dims, np.concatenate([p[name].values for p in parts]) if joined else values, attrs)
    about = {"units": "B/L^2", "equation": "(64), (65)", "long_name": "critical end force at s = 1, tension positive"}
    out["mode"] = Variable(
        ("mode",), np.array([m.number for m in answer.critical]), {"long_name": "number of the mode"}
    )
    out["critical_load"] = Variable(("mode",), answer.critical.forces, about)
    out["critical_load_error"] = Variable(("mode",), answer.critical.errors, {"units": "B/L^2"})
    return out


def answer_attributes(answer: Answer) -> dict[str, Any]:
    """What the file belongs to: the case as it was read, conventions, tolerance, version."""
    case = answer.case
    out = branch_attributes(answer.first) | {
        "title": case.title,
        "case": case.text or json.dumps(dict(case.given)),
        "converged": int(answer.converged),
        "certificate": answer.worst_certificate,
    }
    for name in ("mode", "ended_because", "reached_end"):  # these belong to single branches
        del out[name]
    if case.scales is not None:
        out |= {"length_m": case.scales.length, "bending_stiffness_N_m2": case.scales.stiffness}
    return out


def write_answer(answer: Answer, path: Path) -> None:
    """Write all branches of an answer to a NetCDF file; with SI factors where the case has dimensions."""
    variables = answer_variables(answer)
    with h5netcdf.File(path, "w") as file:
        sizes = {d: n for v in variables.values() for d, n in zip(v.dims, v.values.shape, strict=True)}
        file.dimensions = sizes
        file.attrs.update(answer_attributes(answer))
        for name, (dims, values, attrs) in variables.items():
            kind = h5netcdf.core.h5py.string_dtype() if values.dtype == object else values.dtype
            variable = file.create_variable(name, dims, dtype=kind, data=values)
            variable.attrs.update(attrs | _si(name, answer.case.scales))


def _si(name: str, scales: Scales | None) -> dict[str, Any]:
    """The factor that turns a variable into SI units, and the unit."""
    quantity = name.removesuffix("_error").removeprefix("special_")
    if scales is None or quantity not in QUANTITIES:
        return {}
    factor, unit = scales.of(quantity)
    return {"si_factor": factor, "si_units": unit}
