"""Whether the theory's assumptions hold at the loads shown: small strain, a slender rod, moderate slope and shortening.

The rod of the theory is inextensible and unshearable and stays elastic; it lies on the wall exactly, without
assumptions of small slope. Strains of one per cent change loads by about as much, and so does shear in a rod whose half
wave is 25 radii of gyration long; the limits below are where that begins.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from rodwell.case.case import Case
from rodwell.case.pipe import PhysicalRod
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.text import amount, percent
from rodwell.quantities.value import Value
from rodwell.strength.loaded import Fields, LoadedRod

WITHIN, LEFT, UNJUDGED = "within", "left", "not judged"
"""Whether a limit is kept, exceeded, or cannot be judged."""


@dataclass(frozen=True)
class Measure:
    """One measure of how far a state is from what the theory assumes.

    Attributes
    ----------
    name, label
        Its key, and what it is.
    number
        The value with its error: parts of 1, radians for the slope, plain numbers for slenderness; None: not known.
    limit
        The largest value that the theory covers; the smallest for slenderness.
    where
        The state in which it is largest, or why it is not known.
    """

    name: str
    label: str
    number: Value | None
    limit: float
    where: str = ""

    @property
    def status(self) -> str:
        """WITHIN, LEFT or UNJUDGED."""
        if self.number is None:
            return UNJUDGED
        if self.name.startswith("slenderness"):
            return WITHIN if self.number.value >= self.limit else LEFT
        return WITHIN if self.number.value <= self.limit else LEFT

    @property
    def text(self) -> str:
        """The value as it is read: percent, degrees or a plain number."""
        return "not known" if self.number is None else self._shown(self.number)

    @property
    def limit_text(self) -> str:
        """The limit as it is read."""
        word = "at least" if self.name.startswith("slenderness") else "at most"
        return f"{word} {self._shown(Value(self.limit))}"

    def _shown(self, number: Value) -> str:
        if self.name.startswith("slenderness"):
            return amount(number, 3)
        if self.name == "slope":
            return f"{amount(number.times(180.0 / math.pi), 3)}°"
        return percent(number, 3)

    def as_dict(self) -> dict[str, Any]:
        """Everything about it, for JSON."""
        number = None if self.number is None else self.number.as_dict()
        return {"label": self.label, "number": number, "limit": self.limit, "status": self.status, "where": self.where}


LIMITS = {
    "axial_strain": ("axial strain F/EA", 0.01),
    "bending_strain": ("strain in bending", 0.02),
    "slenderness": ("slenderness L/r", 50.0),
    "slenderness_of_half_wave": ("slenderness of a half wave", 25.0),
    "slope": ("slope |η|", math.pi / 3.0),
    "shortening": ("shortening by buckling", 0.2),
}
"""What is looked at: label and limit. r is the radius of gyration √(I/A). Errors of loads are of the size of the strain
and 2(1 + ν)/κ (π/λ)² at the slenderness λ of a half wave: 4.6 % at 25 with ν = 0.3, κ = 0.9."""


@dataclass(frozen=True)
class Validity:
    """All measures of a case at the loads shown."""

    measures: tuple[Measure, ...]

    @property
    def left(self) -> tuple[Measure, ...]:
        """Measures beyond their limits."""
        return tuple(measure for measure in self.measures if measure.status == LEFT)

    @property
    def unjudged(self) -> tuple[Measure, ...]:
        """Measures that are not known."""
        return tuple(measure for measure in self.measures if measure.status == UNJUDGED)

    @property
    def status(self) -> str:
        """The worst of all."""
        return LEFT if self.left else UNJUDGED if self.unjudged else WITHIN

    @property
    def why(self) -> str:
        """The measures beyond their limits in words; nothing where there are none."""
        return "; ".join(
            f"{m.label} {m.text}{f' {m.where}' if m.where else ''}, {m.limit_text}" for m in self.left
        )  # fmt: skip

    @property
    def sentence(self) -> str:
        """What is assumed and how far it holds."""
        if self.left:
            return (
                f"Small strain: the theory's assumptions are left ({self.why}): take the loads as a rough guide only."
            )
        known = ", ".join(f"{m.label} {m.text}" for m in self.measures if m.number is not None)
        text = f"Small strain: {known}: within what the theory assumes." if known else "Small strain:"
        if self.unjudged:
            named = ", ".join(m.label for m in self.unjudged)
            text += f" {named[:1].upper()}{named[1:]}: cannot be judged, {self.unjudged[0].where}."
        return text

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain data, for JSON."""
        measures = {measure.name: measure.as_dict() for measure in self.measures}
        return {"status": self.status, "sentence": self.sentence, "measures": measures}


def validity(
    case: Case, states: Iterable[LoadedRod], forces: Iterable[tuple[str, float]], wavenumber: float
) -> Validity:
    """How far a case is from what the theory assumes.

    Parameters
    ----------
    case
        The case.
    states
        The states shown: straight and buckled.
    forces
        Further end forces at s = 1 in B/L², tension positive, with their names: loads that act without a state shown.
    wavenumber
        √(∫y''²/∫y'²) of the first mode, in 1/L: π times the number of half waves.
    """
    states = tuple(states)
    out = [*_strains(case, states, tuple(forces)), *_slenderness(case, wavenumber)]
    slope = max(((state.largest(_slope), state.name) for state in states), key=lambda one: one[0].value, default=None)
    short = max(((state.shortening, state.name) for state in states), key=lambda one: one[0].value, default=None)
    for name, peak in (("slope", slope), ("shortening", short)):
        number = None if peak is None else Value(peak[0].value, peak[0].error)
        where = "no state is known" if peak is None else peak[1] if peak[0].value > 0.0 else ""
        out.append(_measure(name, number, where))
    return Validity(tuple(out))


def _measure(name: str, number: Value | None, where: str = "") -> Measure:
    label, limit = LIMITS[name]
    return Measure(name, label, number, limit, where)


def _slope(f: Fields) -> FloatArray:
    return np.abs(f["eta"])


def _strains(case: Case, states: tuple[LoadedRod, ...], forces: tuple[tuple[str, float], ...]) -> list[Measure]:
    """Largest axial strain and strain in bending; both need the section."""
    if case.rod is None or case.scales is None or not all(rod.area > 0.0 for rod, _ in _ends_of_parts(case)):
        why = "the case has no dimensions" if case.scales is None else "rod.outer_diameter is not given"
        return [_measure(name, None, why) for name in ("axial_strain", "bending_strain")]
    acting = [(name, force, 0.0) for name, force in forces] + [(s.name, s.force, s.error) for s in states]
    strains = [_largest_axial(case, rod, span, acting) for rod, span in _ends_of_parts(case)]
    where, strain = max(strains, key=lambda one: one[1].value, default=("", Value(0.0)))
    bends = [state for state in states if not state.straight or state.problem.hole is not None]
    bent = [(state.largest(lambda f: _bending(case, f)), state.name) for state in bends]
    most, at = max(bent, key=lambda one: one[0].value, default=(None, ""))
    bending = Value(0.0) if most is None else Value(most.value, most.error)
    return [_measure("axial_strain", strain, where), _measure("bending_strain", bending, at)]


def _ends_of_parts(case: Case) -> list[tuple[PhysicalRod, tuple[float, float]]]:
    """The rod, or the sections of its string, with where each begins and ends, s/L; a taper as both of its ends."""
    assert case.rod is not None
    if case.string is None:
        return [(case.rod, (0.0, 1.0))]
    parts = zip(case.string.members, case.string.ends, strict=True)
    return [(rod, span) for one, span in parts for rod in dict.fromkeys((one.rods[0], one.rods[-1]))]


def _largest_axial(
    case: Case, rod: PhysicalRod, span: tuple[float, float], acting: list[tuple[str, float, float]]
) -> tuple[str, Value]:
    """Largest strain F/EA in a part of the rod, and in which state: forces are largest at either of its ends.

    Of a taper, whose thinner end need not be that of the larger force, a bound.
    """
    assert case.scales is not None
    problem, scales = case.problem, case.scales
    per_force = scales.factor("force") * rod.inertia / (rod.stiffness * rod.area)
    levers = problem.rod.lever(np.array(span))
    weights = [problem.axial_weight * float(lever) for lever in levers]
    ends = [(name, abs(force + weight), error) for name, force, error in acting for weight in weights]
    where, largest, error = max(ends, key=lambda one: one[1], default=("", 0.0, 0.0))
    return where, Value(largest * per_force, error * per_force)


def _bending(case: Case, f: Fields) -> FloatArray:
    """Strain of the outermost fibre in bending, κ r, along the rod (m,)."""
    assert case.scales is not None
    moment, out = np.hypot(f["rod_M2"], f["rod_M3"]) * case.scales.factor("moment"), np.zeros(f["s"].shape)
    string = case.string
    if string is None:
        assert case.rod is not None
        return np.asarray(moment * 0.5 * case.rod.bearing_diameter / case.rod.stiffness)
    for one, (start, end) in zip(string.members, string.ends, strict=True):
        inside = (f["s"] >= start) & (f["s"] <= end)
        softness: float | FloatArray = 0.5 * one.rod.bearing_diameter / one.rod.stiffness
        if one.taper is not None:
            part = string.part_of(one, f["s"][inside])
            softness = 0.5 * one.taper.line(lambda rod: rod.bearing_diameter, part) / one.taper.stiffness(part)
        out[inside] = np.maximum(out[inside], moment[inside] * softness)
    return out


def _slenderness(case: Case, wavenumber: float) -> list[Measure]:
    """Length, and half a wave of the first mode, in radii of gyration."""
    names, rod = ("slenderness", "slenderness_of_half_wave"), case.rod
    if rod is None or not rod.area > 0.0:
        why = "the case has no dimensions" if rod is None else "rod.outer_diameter is not given"
        return [_measure(name, None, why) for name in names]
    gyration = max(math.sqrt(one.inertia / one.area) for one, _ in _ends_of_parts(case) if one.area > 0.0)
    slender = rod.length / gyration
    parts = (1.0, math.pi / wavenumber if wavenumber > math.pi else 1.0)
    return [_measure(name, Value(slender * part)) for name, part in zip(names, parts, strict=True)]
