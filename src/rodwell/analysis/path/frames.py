"""The states of a load path that a page or an animation shows, in order of happening."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.path.events import LOADING, Leg
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.path.straightening import straight_state
from rodwell.quantities.arrays import FloatArray

MOST = 60
"""States that are shown: of each run by how far the load goes and how many states were found, first and last always."""

ENDS = 2
"""The first state and the last: of the straight rod no others are needed."""


@dataclass(frozen=True)
class Frame:
    """A state that is shown: its leg, the number of its run (a snap begins a new one), and the state."""

    leg: str
    run: int
    state: PatternedState


def frames(path: LoadPath) -> list[Frame]:
    """The states of a path that are shown, in order of happening."""
    runs = [(leg.name, run) for leg in path.legs for run in _runs(path, leg) if run]
    loads = [state.load for _, run in runs for state in run]
    whole = max(max(loads) - min(loads), 1e-300)
    total = sum(len(run) for _, run in runs)
    travelled = [_travelled(run, whole, total) for _, run in runs]
    each = sum(float(way[-1]) for way, (_, run) in zip(travelled, runs, strict=True) if len(run) > ENDS) / MOST
    out = []
    for number, ((leg, run), way) in enumerate(zip(runs, travelled, strict=True)):
        wanted = np.linspace(0.0, way[-1], min(len(run), ENDS + round(float(way[-1]) / (each or 1.0))))
        chosen = np.unique([int(np.argmin(np.abs(way - at))) for at in wanted])
        out += [Frame(leg, number, run[i]) for i in chosen]
    return out


def _travelled(run: list[PatternedState], whole: float, total: int) -> FloatArray:
    """How far each state of a run is from its first: by load, and by number, for they lie close where much happens."""
    by_load = np.cumsum(np.abs(np.diff([state.load for state in run]))) / whole
    return np.concatenate([[0.0], by_load + np.arange(1, len(run)) / total])


def _runs(path: LoadPath, leg: Leg) -> Iterator[list[PatternedState]]:
    """Runs of a leg with the straight rod before it buckles, or after it has fallen back."""
    model = rod_in_hole(path.problem, path.wall_stiffness)
    straight = [[straight_state(model, force) for force in ends] for ends in leg.straight]
    yield from straight if leg.name == LOADING else ()
    yield from leg.runs
    yield from () if leg.name == LOADING else straight
