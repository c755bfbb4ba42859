"""A load path in three dimensions for a browser: a slider through its states, beside load against shortening."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rodwell.analysis.off_wall.arrange import turns_of
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.measured import measured
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.state import HELIX, kind_of
from rodwell.analysis.path.events import LOADING, SNAP, Leg, PathPoint
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.path.straightening import straight_state
from rodwell.analysis.space.scene import drawn
from rodwell.answers.words.wording import forces_of
from rodwell.case.case import Case
from rodwell.numerics.stretches.carry import sampler
from rodwell.plots.paths.axes import Units, units_of
from rodwell.problem.words import ends_text
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.as_json import as_json
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain
from rodwell.report.pages.templates import HERE, template
from rodwell.report.pages.viewer import View, view, viewer

PAGE = "load-path-3d.html"
"""Name of the page in a folder of results."""

MOST = 60
"""States that are shown: of each run by how far the load goes and how many states were found, first and last always."""

PLACES, SIDES = 121, 10
"""Places along the rod and sides around it: what a page of many states can carry."""


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
    model = RodInHole(path.problem, path.wall_stiffness)
    straight = [[straight_state(model, force) for force in ends] for ends in leg.straight]
    yield from straight if leg.name == LOADING else ()
    yield from leg.runs
    yield from () if leg.name == LOADING else straight


def write_path_page(file: Path, path: LoadPath, case: Case | None = None, title: str = "") -> None:
    """Write the states of a path as a page with a slider, beside load against shortening.

    Parameters
    ----------
    file
        The page.
    path
        The load path.
    case
        In whose units numbers stand; None: B = L = 1.
    title
        Of the page.
    """
    shown, scales = frames(path), None if case is None else case.scales
    said = Forces(None, path.problem.hung_weight) if case is None else forces_of(case)
    # one enlargement for all, so that they can be compared: that of the state which bears the least
    rods = [drawn(frame.state, scales, PLACES) for frame in shown]
    enlarged = min(rod.radial_scale for rod in rods)
    views = [
        view(
            frame.state,
            scales,
            rod if rod.radial_scale == enlarged else drawn(frame.state, scales, PLACES, None, enlarged),
            SIDES,
            readings=False,
        )
        for frame, rod in zip(shown, rods, strict=True)
    ]
    units = units_of(path, case)
    data = {
        "frames": [
            {"scene": _lean(seen), "leg": frame.leg, "run": frame.run, "says": words(frame, said), "bar": seen.bar}
            | _at(frame, units)
            for frame, seen in zip(shown, views, strict=True)
        ],
        "shared": _shared(views),
        "events": [{"text": event.meaning, "frame": _frame_of(event, shown)} for event in path.events],
        "axes": units._asdict() | {"load": None},
    }
    first = viewer(views[0])
    page = template("path3d.html.j2").render(
        title=title or "A rod in its hole as the load grows and comes back", viewer=first.markup, css=first.css,
        scripts=(*first.scripts, (HERE / "assets" / "path.js").read_text(encoding="utf-8")),
        data=as_json(data, compact=True).replace("</", "<\\/"),
        assumptions=path.assumptions, ends=ends_text(path.problem), reached=path.ended_because,
    )  # fmt: skip
    file.write_text(page, encoding="utf-8")


def words(frame: Frame, said: Forces) -> str:
    """What is shown, in one line."""
    return f"{frame.leg}, {said.label(frame.state.load)}: {described(frame.state, said.scales)}"


def described(state: PatternedState, scales: Scales | None) -> str:
    """What a state is: its kind, gaps, the largest point force, stability."""
    turns = turns_of(state.model, sampler(state.solved.shape))
    kind, numbers = kind_of(state, turns), measured(state)
    parts = [f"{kind} of {abs(turns)} turn{'s' if abs(turns) != 1 else ''}" if kind == HELIX else kind]
    gaps = [float(gap) for gap, on in zip(numbers.gaps, state.touching, strict=True) if not on]
    if gaps:
        parts.append(f"{len(gaps)} gap{'s' if len(gaps) != 1 else ''} up to {plain(max(gaps), 3)} of the clearance")
    if numbers.points.size:
        largest = float(np.max(np.abs(numbers.points)))
        text = f"{plain(largest, 3)} B/L²" if scales is None else scales.text(largest, "force", 3)
        parts.append(f"largest point force {text}")
    parts.append("stable" if state.solved.index == 0 else f"unstable (index {state.solved.index})")
    return ", ".join(parts)


def _at(frame: Frame, units: Units) -> dict[str, float]:
    """Where a state lies in load against shortening, as drawn."""
    shortening = frame.state.solved.out.energy_by_load * frame.state.problem.clearance**2
    return {"x": float(units.shortening * shortening), "y": float(units.load(frame.state.load))}


def _frame_of(event: PathPoint, shown: list[Frame]) -> int:
    """The number of the state nearest to an event; of a snap, that to which the rod has snapped."""
    force = event.force.value if event.to is None else event.to.force.value
    far = [abs(frame.state.load - force) if frame.leg == event.leg else np.inf for frame in shown]
    nearest = [i for i, each in enumerate(far) if each <= min(far) + 1e-9 * abs(force)]
    return nearest[-1 if event.kind == SNAP else 0]


RINGS = "end of contact"
"""How names of rings in a scene begin."""


def _lean(seen: View) -> dict[str, Any]:
    """Of a scene what belongs to its state: where rod, lines and rings are. Triangles and the hole are shared."""
    parts, rings = [], 0
    for part in seen.data["parts"]:
        if part["name"] == "cylinder":
            continue
        own = {key: value for key, value in part.items() if key != "triangles"}
        if part["name"].startswith(RINGS):
            rings += 1
            own["name"] = f"ring {rings}"
        parts.append(own)
    return {"parts": parts}


def _shared(views: list[View]) -> dict[str, Any]:
    """Of all scenes what they share: triangles by name ("ring": of all rings), the hole, labels, gravity."""
    triangles: dict[str, str] = {}
    for part in (part for seen in views for part in seen.data["parts"]):
        triangles.setdefault("ring" if part["name"].startswith(RINGS) else part["name"], part["triangles"])
    hole = [part for part in views[0].data["parts"] if part["name"] == "cylinder"]
    return {"triangles": triangles, "scene": {**views[0].data, "parts": hole}}
