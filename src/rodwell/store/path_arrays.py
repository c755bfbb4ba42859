"""Load paths, and branches off the wall, as labelled arrays: states, what touches in each, and events."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rodwell._version import __version__
from rodwell.analysis.beyond.off_wall_branch import OffWallBranch
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.state.fields import GRID
from rodwell.errors import NotConvergedError
from rodwell.quantities.names import UNITS
from rodwell.quantities.table import Variable
from rodwell.store.dataset import problem_attributes, text_array

if TYPE_CHECKING:
    import xarray as xr

FIELDS = {
    "x": ("length", "position across the hole, away from the side to which the rod is pressed: that is at −Δ"),
    "y": ("length", "position across the hole, sideways from its axis, y = z × x"),
    "z": ("length", "position along the hole from the end s = 0"),
    "gap": ("1", "gap between rod and wall, in clearances Δ"),
    "angle": ("angle", "angle around the hole from that side, between −π and π"),
    "curvature": ("curvature", "curvature of the rod"),
    "bending_moment": ("moment", "bending moment in the rod"),
    "tension": ("force", "axial force in the rod, tension positive"),
    "contact_pressure": ("force_per_length", "contact pressure p, negative in contact, without concentrated forces"),
}
"""Fields along the rod: dimension, meaning."""

NUMBERS = {
    "energy": ("energy", "energy relative to the straight rod under the same load"),
    "shortening": ("length", "approach of the ends"),
    "contact_total": ("force", "all contact forces, distributed and concentrated, without regard to direction"),
    "largest_pressure": ("force_per_length", "largest contact force per length, positive"),
}
"""Numbers of a state with errors: dimension, meaning."""

CONVENTIONS = (
    "Units B = L = 1 (bending stiffness, rod length), gaps in clearances. Tension positive. The end force acts at "
    "s = 1. Contact pressure p < 0 is contact. Stability index: negative eigenvalues of the second variation where "
    "what is controlled is held, with contacts that push kept closed."
)


BRANCH = "branch"


class Told(NamedTuple):
    """A state of a path: on which leg, in which of its unbroken pieces (from 0 along the path), its stability index."""

    leg: str
    run: int
    state: ContactState
    stability: int


def path_variables(path: LoadPath, places: int = GRID) -> tuple[dict[str, Variable], int]:
    """States and events of a load path as labelled arrays, and how many states had to be left out.

    Those whose errors could not be had: right at a limit point finer elements may find no state at the same load; what
    happens there stands among the events.

    Dimensions: ``state`` (in order), ``s`` (along the rod), ``field`` (names of the fields), ``gap``, ``contact``
    (stretches), ``point`` (concentrated forces), ``event``, ``straight`` (ranges of the load in which the rod is
    straight); ``gap_state``, ``contact_state``, ``point_state`` are the numbers of the states they belong to, from 0.
    What a path has none of is left out.
    """
    told, left_out = _told(path)
    return state_variables(told, places) | _events(path) | _straight(path), left_out


def off_wall_variables(beyond: OffWallBranch, places: int = GRID) -> tuple[dict[str, Variable], int]:
    """States of a branch off the wall, what touches in them, and special points; how many had to be left out.

    Dimensions as in :func:`path_variables`; ``special`` (special points).
    """
    told, left_out = [], 0
    for i in range(len(beyond)):
        try:
            state = beyond.state(i)
        except NotConvergedError:
            left_out += 1
            continue
        told.append(Told(BRANCH, 0, state, state.stability_index))
    points = beyond.special_points
    special = {
        "special_kind": _along("special", [point.kind for point in points], "what happens there"),
        **_numbers("special", "special_force", [point.reached for point in points], "end force there", "force"),
        "special_index_before": _along("special", [point.index_before for point in points], "stability index before"),
        "special_index_after": _along("special", [point.index_after for point in points], "stability index after"),
        "special_s": _along("special", [", ".join(f"{s:.9g}" for s in point.s) for point in points], "where"),
        "special_met": _along("special", [int(point.met) for point in points], "1 if its load meets the tolerance"),
    }
    states = state_variables(told, places)
    return {name: variable for name, variable in states.items() if name not in ("leg", "run")} | special, left_out


def off_wall_attributes(beyond: OffWallBranch, left_out: int) -> dict[str, Any]:
    """What the arrays of a branch off the wall belong to."""
    return problem_attributes(beyond.problem) | {
        "title": "Branch of a heavy rod in a hole, off its wall", "conventions": CONVENTIONS, "until": beyond.until,
        "reached_end": int(beyond.reached_end), "ended_because": beyond.ended_because,
        "converged": int(beyond.converged), "states_left_out": left_out, "rtol": beyond.rtol,
        "rodwell_version": __version__,
    }  # fmt: skip


def off_wall_dataset(beyond: OffWallBranch, places: int = GRID) -> xr.Dataset:
    """Return :func:`off_wall_variables` as an xarray Dataset, fields at ``places`` places along the rod."""
    return _as_dataset(*off_wall_variables(beyond, places), off_wall_attributes, beyond)


def state_variables(told: list[Told], places: int) -> dict[str, Variable]:
    """States as labelled arrays, with fields along the rod and what touches in each."""
    s = np.linspace(0.0, 1.0, places)
    fields = [one.state.fields(s) for one in told]
    errors = [one.state.field_errors(s) for one in told]
    out = {
        "s": Variable(("s",), s, {"long_name": "arclength of the rod from s = 0", "units": "L"}),
        "field": Variable(("field",), text_array(FIELDS), {"long_name": "names of the fields"}),
    }
    if not told:  # of a rod that has not buckled
        return out
    out |= {
        "leg": _along("state", [one.leg for one in told], "which way the load goes"),
        "run": _along("state", [one.run for one in told], "unbroken piece of the path: a snap begins another"),
        "force": _along("state", [one.state.force for one in told], "end force at s = 1, tension positive", "force"),
        "kind": _along("state", [one.state.kind for one in told], "what the state is"),
        "turns": _along("state", [one.state.turns for one in told], "whole turns around the hole"),
        "stability_index": _along("state", [one.stability for one in told], "0 is stable"),
        "certificate": _along(
            "state", [one.state.certificate.worst for one in told], "worst residual of its certificate"
        ),
    }
    for name, (dimension, meaning) in NUMBERS.items():
        out |= _numbers("state", name, [getattr(one.state, name) for one in told], meaning, dimension)
    for name, (dimension, meaning) in FIELDS.items():
        about = {"long_name": meaning, "units": UNITS[dimension]}
        out[name] = Variable(("state", "s"), np.array([found[name] for found in fields]), about)
    about = {"long_name": "error estimate of each field, largest over s, in the field's units"}
    out["field_error"] = Variable(("state", "field"), np.array([[e[name] for name in FIELDS] for e in errors]), about)
    return out | _touching(told)


def path_attributes(path: LoadPath, left_out: int) -> dict[str, Any]:
    """What the arrays of a path belong to."""
    return problem_attributes(path.problem) | {
        "title": "Load path of a heavy rod in a hole that it may leave the wall of",
        "conventions": CONVENTIONS,
        "assumptions": path.assumptions,
        "control": path.control,
        "compliance": path.compliance,
        "until": path.until,
        **({} if path.unload_to is None else {"unload_to": path.unload_to}),
        **({} if np.isinf(path.wall_stiffness) else {"wall_stiffness": path.wall_stiffness}),
        "mirror": int(path.mirror),
        "reached": int(path.reached),
        "ended_because": path.ended_because,
        "converged": int(not path.missed),
        "states_left_out": left_out,
        "rtol": path.rtol,
        "rodwell_version": __version__,
    }


def path_dataset(path: LoadPath, places: int = GRID) -> xr.Dataset:
    """Return :func:`path_variables` as an xarray Dataset, fields at ``places`` places along the rod."""
    return _as_dataset(*path_variables(path, places), path_attributes, path)


def _as_dataset(
    data: dict[str, Variable], left_out: int, attributes: Callable[[Any, int], dict[str, Any]], result: object
) -> xr.Dataset:
    import xarray as xr  # noqa: PLC0415 - slow to import

    coords = {name: data.pop(name) for name in ("s", "field")}
    return xr.Dataset(data, coords=coords, attrs=attributes(result, left_out))


def _told(path: LoadPath) -> tuple[list[Told], int]:
    """States of a path on two sets of elements, and how many could not be had."""
    found: list[Told] = []
    known = {id(event.state.coarse): event.state for event in path.events if event.state is not None}
    run, left_out = 0, 0
    for leg in path.legs:
        for states in leg.runs:
            for state in states:
                try:
                    here = known.get(id(state)) or contact_state(state)
                except NotConvergedError:
                    left_out += 1
                    continue
                found.append(Told(leg.name, run, here, path.way.index_at(here.fine.solved)))
            run += 1
    return found, left_out


def _along(dim: str, values: Any, meaning: str, dimension: str | None = None) -> Variable:
    """A variable along one dimension."""
    about = {"long_name": meaning} | ({} if dimension is None else {"units": UNITS[dimension]})
    return Variable((dim,), text_array(values) if values and isinstance(values[0], str) else np.array(values), about)


def _numbers(dim: str, name: str, values: Any, meaning: str, dimension: str) -> dict[str, Variable]:
    """Numbers with errors along one dimension."""
    return {
        name: _along(dim, [one.value for one in values], meaning, dimension),
        f"{name}_error": _along(dim, [one.error for one in values], f"error estimate of {name}", dimension),
    }


def _touching(told: list[Told]) -> dict[str, Variable]:
    """Gaps, stretches in contact and concentrated forces of all states."""

    def rows(name: str) -> Iterator[tuple[int, Any]]:
        return ((number, one) for number, here in enumerate(told) for one in getattr(here.state, name))

    out: dict[str, Variable] = {}
    for dim, name, columns in (
        ("gap", "gaps", (
            ("from", "start", "where a gap begins, s", "length"), ("to", "end", "where it ends, s", "length"),
            ("largest", "largest", "the largest gap, in clearances Δ", "1"),
        )),
        ("contact", "contacts", (
            ("from", "start", "where a stretch in contact begins, s", "length"),
            ("to", "end", "where it ends, s", "length"),
            ("force", "force", "contact force along it, without the concentrated ones at its ends", "force"),
        )),
        ("point", "point_forces", (
            ("s", "s", "where a concentrated force is, s", "length"), ("force", "force", "its size", "force"),
        )),
    ):  # fmt: skip
        found = list(rows(name))
        if not found:
            continue
        out[f"{dim}_state"] = _along(dim, [number for number, _ in found], "number of its state, from 0")
        for column, attribute, meaning, dimension in columns:
            values = [getattr(one, attribute) for _, one in found]
            out |= _numbers(dim, f"{dim}_{column}", values, meaning, dimension)
        if dim == "gap":
            out["gap_at"] = _along(dim, [one.at for _, one in found], "where it is largest, s", "length")
        if dim == "point":
            out["point_kind"] = _along(dim, [one.kind for _, one in found], "point of contact, or end of a stretch")
    return out


def _events(path: LoadPath) -> dict[str, Variable]:
    events = path.events
    if not events:
        return {}
    to = [("" if one.to is None else one.to.kind) for one in events]
    turns = [0 if one.to is None else one.to.turns for one in events]
    return {
        "event_kind": _along("event", [one.kind for one in events], "what happens"),
        "event_leg": _along("event", [one.leg for one in events], "which way the load goes"),
        **_numbers("event", "event_force", [one.force for one in events], "end force there", "force"),
        "event_met": _along("event", [int(one.met) for one in events], "1 if its load meets the tolerance"),
        "event_s": _along(
            "event", [", ".join(f"{s:.9g}" for s in one.s) for one in events], "places along the rod it concerns"
        ),
        "event_to": _along("event", to, "the state that a snap leads to"),
        "event_to_turns": _along("event", turns, "turns around the hole of that state"),
    }


def _straight(path: LoadPath) -> dict[str, Variable]:
    ranges = [(leg.name, *sides) for leg in path.legs for sides in leg.straight]
    if not ranges:
        return {}
    return {
        "straight_leg": _along("straight", [name for name, _, _ in ranges], "which way the load goes"),
        "straight_from": _along("straight", [a for _, a, _ in ranges], "end force from which it is straight", "force"),
        "straight_to": _along("straight", [b for _, _, b in ranges], "end force to which it is straight", "force"),
    }
