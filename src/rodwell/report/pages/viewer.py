"""The rod in three dimensions for a browser: turn and zoom, in one file, without a network.

The page carries three.js, the viewer (``assets/viewer.js``) and the scene. Where a browser has no WebGL, and on paper,
the still picture is shown instead.
"""

from __future__ import annotations

import base64
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.space.geometry import Geometry, geometry
from rodwell.analysis.space.scene import STOPS, InSpace, Part, drawn, enlarged, limits, load_of, scene
from rodwell.analysis.space.surfaces import straight_contact, wall_rings
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.plots.units import axis
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.as_json import as_json
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain
from rodwell.quantities.value import Value
from rodwell.report.pages.templates import HERE, template

PLACES, SIDES = (321, 801), 16
"""Fewest and most places along the rod, sides around it: what a page can carry and an eye can tell apart."""


@dataclass(frozen=True)
class View:
    """What there is to see, whichever page shows it: the scene for the script, the scale of colours, the caption."""

    data: dict[str, Any]
    bar: dict[str, str]
    caption: str


@dataclass(frozen=True)
class Viewer:
    """What a page needs to show the rod: markup with the scene in it, style sheet, scripts, caption."""

    markup: str
    css: str
    scripts: tuple[str, ...]
    caption: str


def view(
    solution: InSpace,
    scales: Scales | None = None,
    rod: Geometry | None = None,
    sides: int = SIDES,
    *,
    readings: bool = True,
    known: tuple[str, ...] = (),
) -> View:
    """Return what there is to see of a solution, to be shown by as many pages as one likes.

    Parameters
    ----------
    solution, scales
        The state, and the units in which it is described.
    rod
        Its geometry; None: the radius of the case, a scale that can be read.
    sides
        How many sides around the rod.
    readings
        Whether the pointer reads numbers along the rod.
    known
        How names of parts begin whose triangles a page has from a state before: they are left out.
    """
    if rod is None:
        elements = 0 if isinstance(solution, PatternedState) else solution.meshes.fine.space.breaks.size - 1
        rod = drawn(solution, scales, min(max(PLACES[0], 2 * elements + 1), PLACES[1]))
    data = _data(solution.problem, rod, sides, known)
    if readings:
        data["along"] = _along(rod, scales)
    if isinstance(solution, Equilibrium) and rod.bent and rod.radial_scale != 1.0:  # scaling does not set back bends
        data["true_scale"] = _true_scale(solution, rod, sides)
    return View(data, _bar(rod, scales), caption(solution, rod, scales))


def viewer(seen: View, *, still: str = "", full: bool = False) -> Viewer:
    """Return the viewer of what there is to see.

    Parameters
    ----------
    seen
        From :func:`view`.
    still
        Address of the picture that stands in where nothing can be turned, and prints.
    full
        The viewer fills a page of its own; else it is part of a page that scrolls.
    """
    data = as_json(seen.data | {"embedded": not full}, compact=True)
    markup = template("viewer.html.j2").render(
        data=data, bar=seen.bar, still=still, full=full, says=seen.data["says"], enlarged=seen.data["enlarged"] != 1.0
    )
    three = f"/*\n{_asset('LICENSE-three.txt')}\n*/\n{_asset('three.min.js')}"
    return Viewer(markup, _asset("viewer.css"), (three, _asset("parts.js"), _asset("viewer.js")), seen.caption)


def write_viewer(path: Path, seen: View, title: str = "", *, still: str = "") -> None:
    """Write the viewer as a page of its own; ``still`` as in :func:`viewer`."""
    shown = viewer(seen, still=still, full=True)
    page = template("rod3d.html.j2").render(
        title=title or "Rod in its cylinder", viewer=shown.markup, css=shown.css, scripts=shown.scripts,
        caption=shown.caption,
    )  # fmt: skip
    path.write_text(page, encoding="utf-8")


def caption(solution: InSpace, rod: Geometry, scales: Scales | None) -> str:
    """What is shown, in which scale."""
    load = Forces(scales, solution.problem.hung_weight).load(Value(load_of(solution)))
    radius = (
        f"{plain(rod.rod_radius / rod.clearance, 3)} Δ" if scales is None else scales.text(rod.rod_radius, "length")
    )
    rings = "ends of contact, and points of contact" if rod.may_leave else "places of lift-off"
    marks = f" Red rings: {rings}." if rod.lift_off else ""
    return (
        f"{load[:1].upper()}{load[1:]}; {enlarged(rod)}; rod radius drawn {radius}. Thin lines are material "
        f"lines of the rod; the cylinder is the wall that its surface touches.{marks}"
    )


def _data(problem: Problem, rod: Geometry, sides: int, known: tuple[str, ...] = ()) -> dict[str, Any]:
    """The scene for viewer.js: x along the cylinder from mid-length, y up (i), z sideways (j), in L."""

    def shift(points: FloatArray) -> FloatArray:
        return np.asarray(_view(points) - _middle(rod))

    angle = np.radians(problem.alpha)
    reach = max(rod.wall_radius, rod.radial_scale * (rod.clearance + rod.rod_radius))
    ends, axis = shift(rod.axis[[0, -1]]), shift(rod.axis)
    above = ends[1] + np.array([0.0, reach + 0.1, 0.0])
    return {
        "parts": [
            _part(part, shift(part.mesh.vertices)) | ({} if part.name.startswith(known) else _triangles(part))
            for part in scene(rod, sides)
        ],
        "lines": [
            *({"group": "wall", "points": _rounded(shift(circle))} for circle in _rims(rod)),
            {"group": "wall", "points": _rounded(shift(straight_contact(rod)))},
        ],
        "labels": [
            {"text": f"s = {s}", "at": (end - np.array([0.0, 1.1 * reach, 0.0])).tolist()}
            for s, end in zip((0, 1), ends, strict=True)
        ]
        + ([{"text": "gravity", "at": above.tolist(), "above": True}] if problem.weight > 0.0 else []),
        "gravity": _rounded(_view(np.array([-np.sin(angle), 0.0, -np.cos(angle)]))),
        "arrow": above.tolist(),
        "weight": problem.weight,
        "height": 2.0 * reach + float(np.ptp(axis[:, 1])),
        "sides": sides,
        "enlarged": rod.radial_scale,
        "says": enlarged(rod),
    }


OF_SCALE = ("parts", "lines", "labels", "arrow", "height")
"""What of a scene is another in true scale."""

READINGS = 401
"""Places along the rod at which the pointer reads numbers."""


def _true_scale(solution: Equilibrium, rod: Geometry, sides: int) -> dict[str, Any]:
    """What is another in true scale: places of all that has its triangles and colours already."""
    true = geometry(solution, rod.s.size, rod_radius=rod.rod_radius, radial_scale=1.0)
    data = _data(solution.problem, true, sides, known=("",))
    for part in data["parts"]:
        del part["colours"]
    return {key: data[key] for key in OF_SCALE}


def _along(rod: Geometry, scales: Scales | None) -> dict[str, Any]:
    """What stands under the pointer, place by place: where it is in the picture, and the numbers there in words."""
    pick = np.unique(np.linspace(0, rod.s.size - 1, min(READINGS, rod.s.size)).round().astype(int))
    points = _view(rod.centreline[pick]) - _middle(rod)
    push = (1.0 if rod.outside else -1.0) * rod.fields["contact_pressure"][pick]
    name, away = ("gap", rod.clearance * rod.fields["gap"]) if rod.may_leave else ("sideways", rod.fields["y"])
    says = []
    for s, p, far in zip(rod.s[pick], push, away[pick], strict=True):
        if scales is None:
            says.append(f"s/L = {plain(s, 3)}, push {plain(p, 3)} B/L³, {name} {plain(far, 3)} L")
            continue
        place = scales.text(float(s), "length", 4)
        per_length = scales.text(float(p), "force_per_length", 3)
        says.append(f"{place} from s = 0, push {per_length}, {name} {scales.text(float(far), 'length', 3)}")
    return {"points": _rounded(points), "says": says}


def _view(points: FloatArray) -> FloatArray:
    """From i, j, k to x, y, z of the view: k, i, j."""
    return np.asarray(points[..., [2, 0, 1]])


def _middle(rod: Geometry) -> FloatArray:
    """Middle of what the axis takes up, in the view."""
    axis = _view(rod.axis)
    return np.asarray(0.5 * (axis.min(axis=0) + axis.max(axis=0)))


def _rims(rod: Geometry) -> FloatArray:
    """Circles at both ends of the wall."""
    return wall_rings(rod, np.linspace(0.0, 2.0 * np.pi, 97), np.array([0, rod.s.size - 1]))


def _part(part: Part, points: FloatArray) -> dict[str, Any]:
    low, high = points.min(axis=0), points.max(axis=0)
    span = np.where(high > low, high - low, 1.0)
    each = part.colour.ndim == 2
    colours = _base64(np.round(255.0 * part.colour).astype(np.uint8)) if each else _rounded(part.colour)
    return {
        "name": part.name,
        "low": [float(x) for x in low],
        "high": [float(x) for x in high],
        "positions": _base64(np.round(65535.0 * (points - low) / span).astype("<u2")),
        "colours": colours,
        "opacity": part.opacity,
    }


def _triangles(part: Part) -> dict[str, str]:
    return {"triangles": _base64(part.mesh.triangles.astype("<u4"))}


def _base64(values: Any) -> str:
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode()


def _rounded(points: FloatArray) -> Any:
    return np.round(points, 6).tolist()


def _bar(rod: Geometry, scales: Scales | None) -> dict[str, str]:
    """The scale of colours: from the most pressed to no pressure, or to where the wall would have to pull most."""
    low, high = limits(rod.pull)
    factor, unit = axis("contact_pressure", scales, max(-low, high))
    sign = (-1.0 if rod.outside else 1.0) * (1.0 if scales is None else -1.0)  # engineers count the push on the wall
    stops = [(place, colour) for place, colour in STOPS if place <= 0.0 or high > 0.0]
    start, width = (low, high - low) if high > low else (-1.0, 1.0)
    where = [(-place * low if place <= 0.0 else high, colour) for place, colour in stops]
    text = ", ".join(f"{colour} {100.0 * (value - start) / width:.1f}%" for value, colour in where)
    first, last = (plain(sign * x * factor) for x in (low, high))
    name = "contact pressure p" if scales is None else "push on the wall"
    gradient = f"linear-gradient(90deg, {text})"
    return {"first": first, "last": last, "unit": f"{unit} {name}", "gradient": gradient}


@cache
def _asset(name: str) -> str:
    return (HERE / "assets" / name).read_text(encoding="utf-8")
