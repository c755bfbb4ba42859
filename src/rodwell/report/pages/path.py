"""A load path in three dimensions for a browser: a slider through its states, beside load against shortening."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rodwell.analysis.path.events import SNAP, PathPoint
from rodwell.analysis.path.frames import Frame, frames
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.space.scene import drawn
from rodwell.answers.words.wording import forces_in
from rodwell.case.case import Case
from rodwell.plots.paths.axes import Units, across_of, units_of, words
from rodwell.problem.words import ends_text
from rodwell.quantities.as_json import as_json
from rodwell.report.pages.templates import HERE, template
from rodwell.report.pages.viewer import View, view, viewer

PAGE = "load-path-3d.html"
"""Name of the page in a folder of results."""

PLACES, SIDES = 121, 10
"""Places along the rod and sides around it: what a page of many states can carry."""


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
    said = forces_in(path, case)
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
            | _at(frame, path, units)
            for frame, seen in zip(shown, views, strict=True)
        ],
        "shared": _shared(views),
        "events": [
            {"text": event.meaning, "frame": _frame_of(event, shown), "snap": event.kind == SNAP}
            for event in path.events
        ],
        "axes": units._asdict() | {"load": None},
    }
    first = viewer(views[0])
    page = template("path3d.html.j2").render(
        title=title or "A rod in its hole as the load grows and comes back", viewer=first.markup, css=first.css,
        scripts=(*first.scripts, (HERE / "assets" / "path.js").read_text(encoding="utf-8")),
        data=as_json(data, compact=True).replace("</", "<\\/"),
        assumptions=path.assumptions, ends=ends_text(path.problem), reached=said.retold(path.ended_because),
    )  # fmt: skip
    file.write_text(page, encoding="utf-8")


def _at(frame: Frame, path: LoadPath, units: Units) -> dict[str, float]:
    """Where a state lies in load against shortening, as drawn: of the span, or of the end that is driven."""
    shortening = frame.state.solved.out.energy_by_load * frame.state.problem.clearance**2
    across = across_of(path, shortening, frame.state.load)
    return {"x": float(units.shortening * across), "y": float(units.load(frame.state.load))}


def _frame_of(event: PathPoint, shown: list[Frame]) -> int:
    """The number of the state nearest to an event; of a snap, that to which the rod has snapped: it begins a run."""
    force = event.force.value if event.to is None else event.to.force.value
    there = [i for i, frame in enumerate(shown) if frame.leg == event.leg]
    begins = [i for i in there if event.kind == SNAP and i > 0 and shown[i].run != shown[i - 1].run]
    return min(begins or there, key=lambda i: abs(shown[i].state.load - force), default=0)


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
