"""A map as labelled arrays: what its store and its dataset say of each of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell._version import __version__
from rodwell.problem.problem import Problem
from rodwell.problem.words import ends_text
from rodwell.quantities.table import Variable
from rodwell.studies.maps import jumps
from rodwell.studies.maps.axes import about_parameter
from rodwell.studies.maps.block import COLUMNS
from rodwell.studies.maps.cells import OUTCOMES
from rodwell.studies.maps.question import SAMPLE, Question
from rodwell.studies.maps.result import Map

if TYPE_CHECKING:
    import xarray as xr

CONVENTION = (
    "End forces act at s = 1, tension positive; places are parts of the length from s = 0. value and error are in the "
    "attribute units; where outcome says that there is no value, reason says why."
)


def coordinates(question: Question) -> dict[str, Variable]:
    """The values of all parameters."""
    out = {}
    for axis in question.axes:
        values = np.array(axis.numbers if axis.numbers is not None else [str(v) for v in axis.values])
        out[axis.name] = Variable((axis.name,), values, about_parameter(axis.name, axis.unit))
    for i, one in enumerate(question.distributions):
        about = about_parameter(one.name, one.unit)
        about["long_name"] += f", drawn from {one.text}"
        out[one.name] = Variable((SAMPLE,), question.drawn[:, i], about)
    return out


def of_columns(question: Question) -> dict[str, dict[str, Any]]:
    """Attributes of the columns of cells."""
    label = question.rods.number.label
    about: dict[str, dict[str, Any]] = {
        name: {"long_name": text, "units": "1"} for name, (_, _, text) in COLUMNS.items()
    }
    about["value"] = {"long_name": label, "units": question.unit}
    about["error"] = {"long_name": f"estimate of the error of value: {label}", "units": question.unit}
    about["place"]["units"] = "L"
    about["wavenumber"]["units"] = "rad/L"
    about["outcome"] = _flags(OUTCOMES, COLUMNS["outcome"][2])
    return about


def of_jumps(question: Question) -> dict[str, dict[str, Any]]:
    """Attributes of the columns of jumps."""
    units = {f"at_{axis.name}": about_parameter(axis.name, axis.unit)["units"] for axis in question.axes}
    units |= {"value_low": question.unit, "value_high": question.unit}
    columns = jumps.columns(question)
    about = {name: {"long_name": text, "units": units.get(name, "1")} for name, (_, _, text) in columns.items()}
    return about | {"outcome": _flags(jumps.KINDS, "what jumps")}


def _flags(meanings: tuple[str, ...], text: str) -> dict[str, Any]:
    """Attributes of a column of numbers that stand for words."""
    return {"long_name": text, "flag_values": list(range(len(meanings))), "flag_meanings": " ".join(meanings)}


def attributes(question: Question) -> dict[str, Any]:
    """What the arrays belong to."""
    others = [name for name in question.rods.names if name not in question.dims]
    return {
        "title": f"Map of {question.rods.quantity}" + (f": {question.title}" if question.title else ""),
        "convention": CONVENTION + _ends(question),
        "source": f"rodwell {__version__}",
        **({"coordinates": " ".join(others)} if others else {}),
    }


def _ends(question: Question) -> str:
    """End conditions in words, where they are the same in all cells and known without reading a case."""
    if question.rods.folder is not None or "ends" in question.rods.names:
        return ""
    return f" Ends: {ends_text(Problem(0.0, 90.0, ends=question.rods.given['ends']))}."


def map_dataset(result: Map) -> xr.Dataset:
    """A map as an xarray Dataset: that of its store, chunk by chunk when it is asked for, or from memory."""
    import xarray as xr  # noqa: PLC0415 - slow to import

    question = result.question
    if result.path is not None:
        found: xr.Dataset = xr.open_zarr(result.path)
        return found
    about = of_columns(question)
    data = {name: Variable(question.dims, column, about[name]) for name, column in result.cells.items()}
    kept = {name: value for name, value in attributes(question).items() if name != "coordinates"}
    return xr.Dataset(data, coords=coordinates(question), attrs=kept)
