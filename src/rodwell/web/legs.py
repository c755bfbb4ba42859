"""The load path of what was computed as plain data for the page: its legs as two more branches, where it snaps."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.path.events import Leg, PathPoint
from rodwell.analysis.path.load_path import LoadPath
from rodwell.quantities.value import Value
from rodwell.web import off_wall
from rodwell.web.explored import Explored, farthest


def plain_path(explored: Explored, path: LoadPath) -> dict[str, Any]:
    """Return the legs as branches, and where the rod snaps."""
    return {
        "branches": [_leg(explored, path, leg) for leg in path.legs if any(leg.runs)],
        "snaps_at": _snap(explored, path),
    }


def _snap(explored: Explored, path: LoadPath) -> dict[str, Any]:
    """Where the rod snaps first as the load grows, or up to where it does not, in words."""
    snap = off_wall.snaps_at(path)
    if snap is not None:
        return explored.load_data(snap.force) | {"to": snap.meaning}
    return {"text": f"not up to {explored.load_data(Value(farthest(path)))['text']}", "load": None}


def _leg(explored: Explored, path: LoadPath, leg: Leg) -> dict[str, Any]:
    """A leg of the load path as a branch; ``breaks`` are vertices to which a snap leads."""
    runs, name = [run for run in leg.runs if run], off_wall.LEGS[leg.name]
    states = [state for run in runs for state in run]
    return {
        "name": name,
        "mode": None,
        "parent": "",
        "load": [explored.shown(state.load) for state in states],
        "y": explored.lines(off_wall.ordinates(state) for state in states),
        "images": [],
        "index": [state.solved.index for state in states],
        "off": [False] * len(states),
        "breaks": np.cumsum([len(run) for run in runs])[:-1].tolist(),
        "special": [_event(explored, event) for event in off_wall.events_of(path, name)],
        "ended": path.ended_because,
        "reached": path.reached,
        "converged": not path.missed,
    }


def _event(explored: Explored, event: PathPoint) -> dict[str, Any]:
    assert event.state is not None
    return explored.load_data(event.force if event.to is None else event.to.force) | {
        "kind": event.kind,
        "label": event.meaning,
        "y": explored.ordinates(off_wall.ordinates(event.state.fine)),
        "index_before": None,
        "index_after": event.state.stability_index,
        "s": list(event.s),
        "converged": event.met,
    }
