"""What a three-dimensional picture shows: the rod with its material lines, the cylinder, places of lift-off, colours.

The static figure, the viewer of the report and the exported scenes are made from it, so they look alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.space.geometry import Geometry, geometry
from rodwell.analysis.space.in_hole import geometry_in_hole
from rodwell.analysis.space.surfaces import SIDES, Mesh, cylinder, material_lines, ring, tube
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain

STOPS = ((-1.0, "#08306b"), (-0.5, "#2f7fbf"), (0.0, "#d3e3f0"), (1.0, "#b3261e"))
"""Colours of the contact pressure: pressed most, half as much, not at all, and where the wall would have to pull."""

LINE, WALL, MARK = "#1f2933", "#9fb3c8", "#e03131"
"""Colours of material lines, of the cylinder, of places of lift-off."""

WALL_OPACITY = 0.22
NO_PULL = 1e-3
"""A pull below this part of the largest pressure is none: at lift-off the largest value is zero up to its error."""


InSpace = Equilibrium | PatternedState
"""A state that can be drawn: on the wall, or where the rod may have left it."""


def load_of(state: InSpace) -> float:
    """End force F at s = 1 in B/L², tension positive."""
    return state.load if isinstance(state, PatternedState) else state.force


@dataclass(frozen=True)
class Part:
    """A mesh with its colour (r, g, b from 0 to 1, sRGB), one for all vertices (3,) or one each (n, 3)."""

    name: str
    mesh: Mesh
    colour: FloatArray
    opacity: float = 1.0


def enlarged(rod: Geometry) -> str:
    """By how much a picture is enlarged across the axis, to stand in it."""
    return "true scale" if rod.radial_scale == 1.0 else f"× {plain(rod.radial_scale, 3)} across the axis"


def drawn(
    solution: InSpace,
    scales: Scales | None,
    places: int | None = None,
    rod_radius: float | None = None,
    radial_scale: float | None = None,
) -> Geometry:
    """The rod in space, with the radius that the case gives where there is one, in a scale that can be read.

    ``rod_radius`` in L; the case's own is left aside where the bends of this state would not admit it.
    """

    def made(radius: float | None) -> Geometry:
        if isinstance(solution, PatternedState):
            return geometry_in_hole(solution, places, rod_radius=radius, radial_scale=radial_scale)
        return geometry(solution, places, rod_radius=radius, radial_scale=radial_scale)

    if rod_radius is None and scales is not None and scales.radius is not None:
        try:
            return made(scales.radius / scales.length)
        except InputError as error:
            if error.field != "rod_radius":
                raise
    return made(rod_radius)


def scene(geometry: Geometry, sides: int = SIDES, lines: int = 4) -> list[Part]:
    """The parts of the picture, the translucent cylinder last."""
    body = tube(geometry, sides)
    parts = [Part("rod", body, pressure_colours(geometry.pull)[body.place])]
    for number, mesh in enumerate(material_lines(geometry, lines), start=1):
        parts.append(Part(f"material line {number}", mesh, rgb(LINE if number == 1 else "#f8fafc")))
    what = "end of contact" if geometry.may_leave else "lift-off"
    for s in geometry.lift_off:
        parts.append(Part(f"{what} at s = {s:.6g}", ring(geometry, s), rgb(MARK)))
    parts.append(Part("cylinder", cylinder(geometry), rgb(WALL), WALL_OPACITY))
    return parts


def limits(pull: FloatArray) -> tuple[float, float]:
    """Contact pressures of the first and the last colour: negative in contact, the last one 0 if nothing pulls."""
    low, high = min(float(pull.min()), 0.0), max(float(pull.max()), 0.0)
    if high <= NO_PULL * -low:
        high = 0.0
    return min(low, -NO_PULL * high), high


def pressure_colours(pull: FloatArray) -> FloatArray:
    """Colours (m, 3) of contact pressures (m,) that are negative in contact."""
    low, high = limits(pull)
    below = np.clip(pull, low, 0.0) / (-low or 1.0)
    above = np.clip(pull, 0.0, high) / (high or 1.0)
    return palette(below + above)


def palette(t: FloatArray) -> FloatArray:
    """Colours (m, 3) at positions (m,) from −1 (pressed most) to 1 (pulled most)."""
    places = np.array([place for place, _ in STOPS])
    colours = np.array([rgb(colour) for _, colour in STOPS])
    return np.stack([np.interp(t, places, colours[:, i]) for i in range(3)], axis=-1)


def linear_colours(colours: FloatArray) -> FloatArray:
    """From sRGB to linear light, as glTF has its colours (IEC 61966-2-1)."""
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)


def rgb(text: str) -> FloatArray:
    """A colour written as #rrggbb, from 0 to 1."""
    return np.array([int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])
