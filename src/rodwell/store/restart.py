"""Branches kept in files, and read back to the last bit: what an analysis goes on from.

The file is NetCDF. Its root holds the branch for reading, as :func:`rodwell.store.dataset.branch_variables` describes
it. The group ``restart`` holds what the branch is made of, bit by bit:

==================  ======================================================================================
``breaks``          mesh points of the coarse meshes, one mesh after the other; ``mesh_elements`` (mesh): how many each
``kinked``          derivatives continuous at kinks, 0 elsewhere; in files without it kinks are at steps of a string
``mesh_parity``     parity that states on it keep; ``mesh_floor``: excess of errors below which refining does not help
``coefficients``    of all states in turn: spline coefficients, tangent and its covector, each of the size of the space
``state``           (state, 5): λ, its parts of tangent and covector, stability index, energy; coarse and fine in turn
``values, errors``  (pair, …) the measured numbers of each pair of states, and their errors; ``excess`` (pair)
``pair_mesh``       number of the mesh on which each pair stands; the first pairs are the points of the branch
``event``           (event, 7): error of λ, index before and after, rising, fold, certain, point that it follows
``event_name``      (event) what was located; its pairs come after those of the points
==================  ======================================================================================

States off the wall stand in the group ``off_wall``, for reading; a branch that is read back finds them again from
lift-off, by the attributes ``off_wall_until`` and ``off_wall_rtol``.

Attributes hold the format's number, the problem (JSON), the parameter, name and origin of the branch, the metric
(``scale_c``, ``slope_scale``, ``lam_scale``), degree, Gauss points in an element, and tolerances.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np

from rodwell._version import __version__
from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.making import made
from rodwell.analysis.branch.special import Origin
from rodwell.analysis.branch.watching import crossed
from rodwell.analysis.discrete.family import family
from rodwell.analysis.discrete.measures import measured_meshes
from rodwell.analysis.straight.critical import critical_loads
from rodwell.errors import InputError
from rodwell.numerics.continuation.events import LocatedEvent
from rodwell.numerics.continuation.walk import Trace
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.problem import Problem
from rodwell.problem.varying import ParameterPath, words_for
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.table import Variable
from rodwell.store.dataset import branch_attributes, branch_variables
from rodwell.store.folder import whole_folder
from rodwell.store.netcdf import write_off_wall, write_variables

FORMAT = 1
"""Number of the format; a change of what the group holds gets another."""

GROUP = "restart"


def save_branch(branch: Branch, path: str | Path) -> Path:
    """Keep a branch in a NetCDF file, from which :func:`load_branch` has it back to the last bit.

    Parameters
    ----------
    branch
        The branch. Events and stop conditions of one's own are functions, which no file keeps: their points are in the
        arrays for reading, and are found again by following.
    path
        File, usually ``NAME.nc``. It is written whole or not at all; one that is there is replaced.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If the file cannot be written, or the branch follows a path of one's own.
    """
    path = Path(path)
    if isinstance(branch.parameter, ParameterPath):
        reason = "is a path of functions, which no file keeps: keep a branch in one parameter, from one of its states"
        raise InputError("parameter", words_for(branch.parameter), reason)
    if not path.name:
        raise InputError("path", str(path), "must name a file")
    with whole_folder(path.parent, "path") as folder, h5netcdf.File(folder / path.name, "w") as file:
        write_variables(file, branch_variables(branch), branch_attributes(branch))
        _write(branch, file.create_group(GROUP))
        if branch.beyond is not None:
            write_off_wall(file.create_group("off_wall"), branch.beyond)
    return path


def load_branch(path: str | Path) -> Branch:
    """Read a branch that :func:`save_branch` kept: points, special points and what it takes to go on, bit by bit.

    Raises
    ------
    InputError
        If the file cannot be read, or holds no such branch.
    """
    try:
        with h5netcdf.File(path, "r") as file:
            if GROUP not in file.groups:
                raise InputError("path", str(path), "holds no branch to go on from: keep one with save_branch")
            group = file[GROUP]
            attributes = {name: group.attrs[name] for name in group.attrs}
            arrays = {name: group.variables[name][...] for name in group.variables}
    except OSError as error:
        raise InputError("path", str(path), f"cannot be read as NetCDF: {error}") from None
    kept = attributes.get("format")
    if kept is None or int(kept) != FORMAT:
        reason = f"is kept in format {kept}; this version of rodwell ({__version__}) reads format {FORMAT}"
        raise InputError("path", str(path), reason)
    try:
        return _Reading(attributes, arrays).branch()
    except (KeyError, ValueError, IndexError, TypeError) as error:
        reason = f"is damaged: what belongs to the branch is missing or does not fit ({error})"
        raise InputError("path", str(path), reason) from None


def _kinked(space: SplineSpace) -> FloatArray:
    """Of each mesh point how many derivatives are continuous, if it is a kink; else 0."""
    out = np.zeros(space.breaks.size)
    out[space.kink_elements] = space.smooth
    return out


def _write(branch: Branch, group: Any) -> None:
    trace = branch.trace
    pairs = [*zip(trace.points, trace.meshes, strict=True), *((event.point, event.meshes) for event in trace.found)]
    meshes = list({id(mesh): mesh for _, mesh in pairs}.values())
    number, spaces = {id(mesh): i for i, mesh in enumerate(meshes)}, [mesh.coarse.space for mesh in meshes]
    states = [state for point, _ in pairs for state in (point.coarse, point.fine)]
    events = [(e.lam_error, e.index_before, e.index_after, e.rising, e.fold, e.certain, e.after) for e in trace.found]
    arrays = {
        "breaks": np.concatenate([space.breaks for space in spaces]),
        "kinked": np.concatenate([_kinked(space) for space in spaces]),
        "mesh_elements": np.array([mesh.coarse.space.elements for mesh in meshes]),
        "mesh_parity": np.array([mesh.coarse.parity for mesh in meshes]),
        "mesh_floor": np.array([mesh.floor for mesh in meshes]),
        "coefficients": np.concatenate([np.concatenate([s.c, s.tangent, s.row]) for s in states]),
        "state": np.array([(s.lam, s.tangent_lam, s.row_lam, s.index, s.energy) for s in states]),
        "values": np.array([point.values for point, _ in pairs]),
        "errors": np.array([point.error for point, _ in pairs]),
        "excess": np.array([point.excess for point, _ in pairs]),
        "pair_mesh": np.array([number[id(mesh)] for _, mesh in pairs]),
        "event": np.array(events, dtype=float).reshape(-1, 7),
        "event_name": np.array([event.name for event in trace.found], dtype=object),
    }
    variables = {
        name: Variable(tuple(f"{name}_{axis}" for axis in range(values.ndim)), values, {})
        for name, values in arrays.items()
    }
    write_variables(group, variables, _attributes(branch, len(trace.points)))


def _attributes(branch: Branch, points: int) -> dict[str, Any]:
    meshes, origin, beyond = branch.trace.meshes[0], branch.origin, branch.beyond
    equilibria = meshes.coarse
    return {
        "format": FORMAT,
        "rodwell_version": __version__,
        "problem": json.dumps(asdict(branch.problem)),
        "parameter": branch.parameter,
        "force": branch[0].force,
        "name": origin.name,
        "mode": origin.mode.number if origin.mode else 0,
        "switched": int(origin.switched),
        "parent": origin.parent or "",
        "mirror": int(origin.mirror),
        "start_error": origin.error,
        "points": points,
        "end": branch.trace.end,
        "ended_because": branch.ended_because,
        "reached_end": int(branch.reached_end),
        "degree": equilibria.space.degree,
        "per_element": equilibria.space.per_element,
        "slope_scale": equilibria.slope_scale,
        "lam_scale": equilibria.lam_scale,
        "rtol": meshes.rtol,
        "most_elements": meshes.most_elements,
    } | ({} if beyond is None else {"off_wall_until": beyond.until, "off_wall_rtol": beyond.rtol})


class _Reading:
    """A branch in the making, from attributes and arrays of a file."""

    def __init__(self, attributes: dict[str, Any], arrays: dict[str, np.ndarray]) -> None:
        self.about, self.arrays = attributes, arrays
        given: dict[str, Any] = json.loads(str(attributes["problem"]))
        self.problem = Problem(**given | {"ends": tuple(given["ends"])})

    def branch(self) -> Branch:
        """The branch."""
        about = self.about
        meshes = self._meshes()
        on = [meshes[int(i)] for i in self.arrays["pair_mesh"]]
        pairs = list(zip(self._pairs(on), on, strict=True))
        points, located = pairs[: int(about["points"])], pairs[int(about["points"]) :]
        rows = zip(located, self.arrays["event"], self.arrays["event_name"], strict=True)
        found = [_event(_text(name), point, mesh, row) for (point, mesh), row, name in rows]
        trace = Trace([point for point, _ in points], [mesh for _, mesh in points], found, str(about["end"]))
        number = int(about["mode"])
        mode = critical_loads(self.problem, number, rtol=float(about["rtol"]))[-1] if number else None
        parent = str(about["parent"]) or None
        error = float(about.get("start_error", mode.error if mode else 0.0))
        origin = Origin(str(about["name"]), mode, bool(about["switched"]), parent, bool(about["mirror"]), error)
        ending = bool(about["reached_end"]), str(about["ended_because"])
        branch = made(self.problem, origin, trace, *ending, str(about["parameter"]))
        if "off_wall_until" not in about:
            return branch
        return crossed(branch, float(about["off_wall_until"]), float(about["off_wall_rtol"]))

    def _meshes(self) -> list[TwoMeshes]:
        about, out, start, every = self.about, list[TwoMeshes](), 0, self.arrays["breaks"]
        marks = self.arrays.get("kinked", np.isin(every, self.problem.rod.breaks[1:-1]).astype(float))
        for i, elements in enumerate(self.arrays["mesh_elements"]):
            breaks, kinked = (one[start : start + int(elements) + 1] for one in (every, marks))
            start += int(elements) + 1
            kinks, smooth = breaks[kinked > 0.0], kinked[kinked > 0.0].astype(np.int64)
            space = SplineSpace(breaks, int(about["degree"]), int(about["per_element"]), kinks, smooth)
            equilibria = family(
                self.problem, space, parity=int(self.arrays["mesh_parity"][i]), wavenumber=1.0,
                scale=float(about["lam_scale"]), parameter=str(about["parameter"]), force=float(about["force"]),
            )  # fmt: skip
            equilibria = replace(equilibria, slope_scale=float(about["slope_scale"]))
            meshes = measured_meshes(equilibria, float(about["rtol"]), int(about["most_elements"]))
            meshes.floor = float(self.arrays["mesh_floor"][i])
            out.append(meshes)
        return out

    def _pairs(self, meshes: Sequence[TwoMeshes]) -> list[MeshedState]:
        """All pairs of states, coarse and fine, on the meshes of each."""
        values, errors, excess = (self.arrays[name] for name in ("values", "errors", "excess"))
        coefficients = iter(np.split(self.arrays["coefficients"], np.cumsum(self._sizes(meshes))[:-1]))
        rows = iter(self.arrays["state"])

        def state(space: SplineSpace) -> State:
            c, tangent, row = np.array(next(coefficients)).reshape(3, space.size)
            lam, tangent_lam, row_lam, index, energy = map(float, next(rows))
            return State(space, c, lam, tangent, tangent_lam, row, row_lam, int(index), energy)

        return [
            MeshedState(state(mesh.coarse.space), state(mesh.fine.space), values[i], errors[i], float(excess[i]))
            for i, mesh in enumerate(meshes)
        ]

    @staticmethod
    def _sizes(meshes: Sequence[TwoMeshes]) -> list[int]:
        """Numbers that each state has: coefficients, tangent, covector."""
        return [3 * level.space.size for mesh in meshes for level in (mesh.coarse, mesh.fine)]


def _event(name: str, point: MeshedState, meshes: TwoMeshes, row: np.ndarray) -> LocatedEvent:
    error, before, after, rising, fold, certain, follows = row
    return LocatedEvent(
        name, point, meshes, float(error), int(before), int(after),
        rising=bool(rising), fold=bool(fold), certain=bool(certain), after=int(follows),
    )  # fmt: skip


def _text(name: bytes | str) -> str:
    return name.decode() if isinstance(name, bytes) else str(name)
