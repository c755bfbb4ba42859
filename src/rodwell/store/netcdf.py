"""NetCDF files: all branches of a case, with units, equation numbers, tolerance, version and the case itself."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Literal

import numpy as np
import xarray as xr

from rodwell.analysis.nomenclature import QUANTITIES
from rodwell.practice.answer import Answer
from rodwell.practice.scales import Scales

ENGINE: Literal["h5netcdf"] = "h5netcdf"


def answer_dataset(answer: Answer) -> xr.Dataset:
    """All branches of an answer in one Dataset.

    Points of all branches follow each other along ``point``; ``branch`` (point) holds the number of the mode, as
    ``special_branch`` does for the special points. Critical loads stand along ``mode``.
    """
    case = answer.case
    parts = []
    for branch in answer.branches:
        assert branch.mode is not None
        part = branch.dataset.drop_vars("point")
        number = branch.mode.number
        part["branch"] = ("point", np.full(part.sizes["point"], number), {"long_name": "number of the mode"})
        part["special_branch"] = ("special", np.full(part.sizes["special"], number))
        parts.append(part)
    shared = xr.concat(
        [part.drop_dims("special") for part in parts],
        "point",
        combine_attrs="drop_conflicts",
        data_vars="minimal",
    )
    special = xr.concat(
        [part[[v for v in part.data_vars if part[v].dims == ("special",)]] for part in parts], "special"
    )
    out = shared.merge(special)
    out["critical_load"] = ("mode", answer.critical.forces, {"units": "B/L^2", "equation": "(64), (65)"})
    out["critical_load_error"] = ("mode", answer.critical.errors, {"units": "B/L^2"})
    out = out.assign_coords(mode=[mode.number for mode in answer.critical])
    out.attrs |= {
        "title": case.title,
        "case": case.text or json.dumps(dict(case.given)),
        "converged": int(answer.converged),
        "certificate": answer.worst_certificate,
    }
    if case.scales is not None:
        out.attrs |= {"length_m": case.scales.length, "bending_stiffness_N_m2": case.scales.stiffness}
        out = with_si(out, case.scales)
    return out


def write_answer(answer: Answer, path: Path) -> None:
    """Write all branches of an answer to a NetCDF file."""
    answer_dataset(answer).to_netcdf(path, engine=ENGINE)


def with_si(data: xr.Dataset, scales: Scales) -> xr.Dataset:
    """Add to every variable the factor that turns it into SI units, and the unit."""
    out = data.copy()
    for name in out.data_vars:
        quantity = str(name).removesuffix("_error").removeprefix("special_")
        if quantity in QUANTITIES:
            factor, unit = scales.of(quantity)
            out[name].attrs |= {"si_factor": factor, "si_units": unit}
    return out
