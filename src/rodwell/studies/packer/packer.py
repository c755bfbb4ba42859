"""Tubing in a packer, from a case file: changes of length, movement of the seals, forces, stress."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.endless.shortening import LOADING, UNLOADING, largest_curvature, state_at
from rodwell.case import schema
from rodwell.case.case import Case
from rodwell.case.checks.said import in_users_words
from rodwell.case.fluids import Fluids
from rodwell.case.pipe import PhysicalRod
from rodwell.errors import InputError
from rodwell.faces import Shown, drawn, plain
from rodwell.problem.sections import refuse_sections
from rodwell.quantities.tolerance import RTOL
from rodwell.strength.stress import Loading, Stresses, section_of, stresses
from rodwell.studies.packer.lengths import Conditions, Tubing, weights
from rodwell.studies.packer.motion import Moved, Stops, moved

if TYPE_CHECKING:
    from rodwell.faces import Axes


@dataclass(frozen=True)
class PackerAnswer(Shown):
    """What becomes of the tubing of a case with [packer]. SI units; forces tension positive.

    Attributes
    ----------
    case, given
        The case, and its section [packer].
    tubing, before, after, stops
        The string, the two states and what the packer allows.
    moved
        Changes of length, movement and forces, as the load grows: buckled places are sinusoidal as long as they can be.
    unloading
        The same where buckled places are helical as long as they can be; in a vertical hole they are the same.
    """

    case: Case
    given: schema.PackerInput
    tubing: Tubing
    before: Conditions
    after: Conditions
    stops: Stops
    moved: Moved
    unloading: Moved

    @property
    def converged(self) -> bool:
        """Whether lengths are known to 1e-4 of the largest change, 1e-8 in a vertical hole, and forces to as much."""
        rtol = RTOL if self.tubing.angle == 0.0 else 1e-4
        scale = max(abs(change.value) for change in self.moved.changes.values())
        stiffness = self.tubing.modulus * self.tubing.area / self.tubing.length
        return all(
            one.free.within(rtol, scale) and one.packer.within(rtol, scale * stiffness)
            for one in (self.moved, self.unloading)
        )

    @property
    def state(self) -> str:
        """State of the tubing just above the packer: ``"straight"``, ``"sinusoidal"`` or ``"helical"``."""
        return state_at(-self.moved.effective.value, *self._place, LOADING)

    @cached_property
    def stress(self) -> Stresses:
        """Stresses afterwards, just above the packer and at the top, (2,): bending is the larger of both histories."""
        section = section_of(self.case.rod) if self.case.rod is not None else None
        assert section is not None
        axial, _ = weights(self.tubing, self.after)
        air = self.case.rod.weight_in_air if self.case.rod is not None else 0.0
        real = self.moved.real.value + np.array([0.0, air * self.tubing.height])
        compression = -self.moved.effective.value - np.array([0.0, axial * self.tubing.length])
        curvature = [
            max(largest_curvature(float(p), *self._place, rule) for rule in (LOADING, UNLOADING)) for p in compression
        ]
        inside, outside = np.transpose([self.after.at(self.tubing.height), self.after.at(0.0)])
        bending = self.tubing.stiffness * np.array(curvature)
        return stresses(section, Loading(real, bending, np.zeros(2), inside, outside))

    @property
    def _place(self) -> tuple[float, float, float]:
        """Lateral weight, stiffness and clearance."""
        return weights(self.tubing, self.after)[1], self.tubing.stiffness, self.tubing.clearance

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain data, for JSON."""
        return plain(self)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the changes of length one after the other; return the axes."""
        return drawn(self, ax)

    def __repr__(self) -> str:
        return (
            f"<packer, motion {self.given.motion}: {self.moved.free.value:+.4g} m if free, moved "
            f"{self.moved.movement.value:+.4g} m, packer's force {self.moved.packer.value:+.5g} N (tension positive)>"
        )


def packer(case: Case) -> PackerAnswer:
    """Changes of length and the packer's force for a case with [packer].

    Parameters
    ----------
    case
        Tubing as [rod], casing as [hole], fluids and pressures when it was landed as [mud] and [pressure] (at the upper
        end, s = 1); what comes afterwards stands in [packer].

    Raises
    ------
    InputError
        If [packer] is missing, contradicts itself, or needs what the case does not give.
    NotConvergedError
        If no force of the packer holds the tubing.
    """
    try:
        return _answer(case)
    except InputError as error:
        raise InputError(*in_users_words(case.given, error)) from None


def _answer(case: Case) -> PackerAnswer:
    """What :func:`packer` returns; errors in SI units."""
    given = _given(case)
    refuse_sections(case.problem.sections, "tubing in a packer is one pipe from end to end: give it as [rod]")
    if case.problem.hole is not None:
        what = "lies in a curved hole, and changes of length are those of a straight one: give its inclination alone"
        raise InputError("hole", None, what)
    rod = case.rod
    assert rod is not None
    tubing = _tubing(case, given, rod)
    then = _afterwards(case.fluids, given)
    mud = "mud.outside" if "outside" in case.given.get("mud", {}) else "mud.density"
    before = _conditions(case.fluids, case, rod, mud)
    after = _conditions(then, case, rod, mud if given.outside is None else "packer.outside")
    after = Conditions(
        after.weight,
        after.inside,
        after.outside,
        after.inside_gradient,
        after.outside_gradient,
        given.temperature_change,
    )
    stops, landed = _stops(given), (given.pick_up or 0.0) - (given.slack_off or 0.0)
    up, down = (moved(tubing, before, after, stops, landed, rule) for rule in (LOADING, UNLOADING))
    return PackerAnswer(case, given, tubing, before, after, stops, up, down)


def _given(case: Case) -> schema.PackerInput:
    written = case.given.get("packer")
    if written is None:
        raise InputError(
            "packer", None, "is missing: write [packer] with bore and motion; `rodwell keys packer` has all"
        )
    if any("±" in str(value) or "+/-" in str(value) or "+-" in str(value) for value in written.values()):
        raise InputError("packer", None, "takes no uncertainties (±): give the values themselves, and vary them")
    if case.string is not None:
        what = "is not taken beside [packer]: the tubing has one section; give [rod] with its pipe or diameters"
        raise InputError("string", None, what)
    return schema.PackerInput.model_validate(written)


def _tubing(case: Case, given: schema.PackerInput, rod: PhysicalRod) -> Tubing:
    if rod.core_diameter is not None:
        what = "is that of a solid core, and tubing in a packer has a bore: leave it out, and give inner_diameter"
        raise InputError("rod.core_diameter", rod.core_diameter, what)
    if rod.outer_diameter is None or not rod.bore_known or rod.inner_diameter == 0.0:
        key = "rod.outer_diameter" if rod.outer_diameter is None else "rod.inner_diameter"
        raise InputError(key, None, "is missing: changes of length need both diameters of the tubing")
    assert case.scales is not None
    clearance = case.problem.clearance * case.scales.length
    around = rod.outer_diameter + 2.0 * clearance
    if given.bore >= around:
        raise InputError("packer.bore", given.bore, f"must be below the bore of {around:g} m around the tubing")
    if given.temperature_change != 0.0 and given.thermal_expansion is None:
        what = 'is missing: it is needed with temperature_change; steel has "6.9e-6 /°F", 12.4e-6 /K'
        raise InputError("packer.thermal_expansion", None, what)
    return Tubing(
        length=rod.length,
        angle=case.problem.alpha,
        modulus=rod.stiffness / rod.inertia,
        poisson=rod.poisson,
        expansion=given.thermal_expansion or 0.0,
        inertia=rod.inertia,
        area=rod.area,
        inner_area=rod.bore_area,
        outer_area=rod.outer_area,
        clearance=clearance,
        seal_area=math.pi / 4.0 * given.bore**2,
    )


def _afterwards(fluids: Fluids, given: schema.PackerInput) -> Fluids:
    """Fluids and pressures afterwards: what [packer] does not name stays."""
    return Fluids(
        fluids.inside if given.inside is None else given.inside,
        fluids.outside if given.outside is None else given.outside,
        fluids.inside_pressure if given.inside_pressure is None else given.inside_pressure,
        fluids.outside_pressure if given.outside_pressure is None else given.outside_pressure,
    )


def _conditions(fluids: Fluids, case: Case, rod: PhysicalRod, outside: str) -> Conditions:
    """The tubing's weight, pressures and gradients in fluids; ``outside`` is the key that gives the one around it."""
    weight = fluids.buoyed_weight(rod, case.gravity)
    if weight < 0.0:
        what = "lifts the tubing: a string that floats up is not treated; check it, and what fills the tubing then"
        raise InputError(outside, fluids.outside, what)
    gradients = (fluids.inside * case.gravity, fluids.outside * case.gravity)
    return Conditions(weight, fluids.inside_pressure, fluids.outside_pressure, *gradients)


def _stops(given: schema.PackerInput) -> Stops:
    """What the packer allows, and whether that goes with the force with which the tubing was landed."""
    strokes = {"up": given.up, "down": given.down}
    named = [name for name, value in strokes.items() if value is not None]
    if given.motion != "some" and named:
        what = f'contradicts motion = "{given.motion}": write motion = "some", or leave it out'
        raise InputError(f"packer.{named[0]}", strokes[named[0]], what)
    if given.motion == "some" and not named:
        raise InputError("packer.motion", "some", "needs up, down or both: how far the seals may move either way")
    if given.slack_off is not None and given.pick_up is not None:
        raise InputError("packer.pick_up", given.pick_up, "contradicts packer.slack_off: give only one of the two")
    stops = {
        "none": Stops(0.0, 0.0),
        "all": Stops(),
        "some": Stops(*(math.inf if value is None else value for value in strokes.values())),
    }[given.motion]
    for key, value, room, side in (
        ("slack_off", given.slack_off, stops.down, "down"),
        ("pick_up", given.pick_up, stops.up, "up"),
    ):
        if value is not None and room > 0.0:
            what = f'needs a packer that holds the tubing: motion = "none", or "some" with {side} = "0 m"'
            raise InputError(f"packer.{key}", value, what)
    return stops
