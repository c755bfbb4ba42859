"""Files of what is shown: written by what writes them elsewhere, and handed to the page as bytes."""

from __future__ import annotations

import copy
import csv
import io
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.off_wall.state import ContactState
from rodwell.errors import InputError
from rodwell.report.folders.export import export
from rodwell.web.explored import Explored
from rodwell.web.inputs import as_toml, force_text, weight_below

Written = tuple[bytes, str]
"""Content of a file, and what kind it is."""

KINDS = {
    "glb": "model/gltf-binary", "png": "image/png", "svg": "image/svg+xml", "html": "text/html",
    "csv": "text/csv", "nc": "application/x-netcdf", "toml": "application/toml",
}  # fmt: skip
"""Kinds of files by suffix."""


def file_of(explored: Explored, solution: Solution | ContactState, suffix: str) -> Written:
    """Return a file of a state, by its suffix.

    "glb", "png", "svg" and "html" show the rod in its cylinder, "csv" has fields along the rod with units in the head,
    "nc" the same with errors as a dataset, "toml" is the case with this load.

    Raises
    ------
    InputError
        For a suffix that is not known, or "nc" of a state off the wall.
    """
    writers: dict[str, Callable[[], bytes]] = {"toml": partial(_case_text, explored, solution.force)}
    through_export = ["glb", "png", "svg", "html"]
    if isinstance(solution, ContactState):
        through_export.append("csv")
        if suffix == "nc":
            raise InputError("file", suffix, "holds states on the wall: save CSV for a rod that may have left it")
    else:
        writers["csv"] = partial(_table, explored, solution)
        writers["nc"] = partial(_through_file, "state.nc", partial(_netcdf, explored, solution))
    for picture in through_export:
        write = partial(export, solution, scales=explored.case.scales)
        writers[picture] = partial(_through_file, f"rod.{picture}", write)
    if suffix not in writers:
        raise InputError("file", suffix, f"must be one of {', '.join(writers)}")
    return writers[suffix](), KINDS[suffix]


def _through_file(name: str, write: Callable[[Path], Any]) -> bytes:
    with tempfile.TemporaryDirectory(prefix="rodwell-") as folder:
        path = Path(folder) / name
        write(path)
        return path.read_bytes()


def _dataset(explored: Explored, solution: Solution) -> Any:
    scales = explored.case.scales
    if scales is None:
        return solution.dataset()
    return solution.dataset(length=scales.length, stiffness=scales.stiffness)


def _netcdf(explored: Explored, solution: Solution, path: Path) -> None:
    _dataset(explored, solution).to_netcdf(path, engine="h5netcdf")


def _table(explored: Explored, solution: Solution) -> bytes:
    """Fields along the rod, a line a place, as the dataset has them."""
    data = _dataset(explored, solution)
    names = [name for name in data.variables if data[name].dims == ("s",)]
    names.sort(key=lambda name: name != "s")
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow([f"{name} [{data[name].attrs.get('units', '1')}]" for name in names])
    out.writerows(zip(*([repr(float(x)) for x in data[name].values] for name in names), strict=True))
    return text.getvalue().encode()


def _case_text(explored: Explored, force: float) -> bytes:
    return case_data(explored, force)[1].encode()


def case_data(explored: Explored, force: float) -> tuple[dict[str, Any], str]:
    """Return the case with an end force F in B/L² as the load that acts: as data, and as the text of a file."""
    data: dict[str, Any] = copy.deepcopy(dict(explored.data))
    load, case = dict(data.get("load", {})), explored.case
    less = weight_below(case, load)
    load["applied"] = force_text(case, force - less)
    if "until" in load and case.until is not None:
        load["until"] = force_text(case, min(case.until, force) - less)
    if "kind" in load or "pressure" in data:
        load["kind"] = "effective"
    data["load"] = load
    return data, as_toml(data)
