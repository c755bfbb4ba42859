"""Sections of [[string]] that taper: what goes in a straight line from the lower end (s = 0) of a section to its upper.

Where diameters do, the stiffness is a quartic and the weight a quadratic along the section. They are the polynomials
through what the section is at evenly spaced places, so a taper is made of the same rods as a section of one diameter.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.case import schema
from rodwell.case.facts import Fact
from rodwell.case.fluids import Fluids
from rodwell.case.pipe import PhysicalRod
from rodwell.case.string.tool_joints import KEYS as OF_TOOL_JOINTS
from rodwell.errors import InputError
from rodwell.problem.profile import powers
from rodwell.quantities.arrays import FloatArray

AT_TOP = "_at_top"
"""What follows a key for its value at the upper end; without it the key is the value at the lower one."""

DIAMETERS = ("outer_diameter", "inner_diameter", "core_diameter")
MEASURED = {
    "bending_stiffness": "stiffness", "torsional_stiffness": "stiffness", "weight_per_length": "force_per_length",
}  # fmt: skip
KEYS = (*DIAMETERS, *MEASURED)
"""Keys of a section that may go to another value."""

STATIONS = 5
"""Places that a quartic goes through."""

Made = tuple[PhysicalRod, Fluids, float]


@dataclass(frozen=True)
class Taper:
    """The rods that a section is at five evenly spaced places, from its lower end, and its weight in N/m at three."""

    rods: tuple[PhysicalRod, ...]
    weights: tuple[float, ...]

    @property
    def mean_weight(self) -> float:
        """In N/m; of a quadratic, exactly."""
        first, middle, last = self.weights
        return (first + 4.0 * middle + last) / 6.0

    def line(self, of: Callable[[PhysicalRod], float], part: FloatArray) -> FloatArray:
        """What goes in a straight line, at parts (m,) of the section's length from its lower end."""
        return np.asarray(np.interp(part, (0.0, 1.0), (of(self.rods[0]), of(self.rods[-1]))))

    def stiffness(self, part: FloatArray) -> FloatArray:
        """B in N m² at parts (m,) of the section's length from its lower end."""
        return np.asarray(np.polynomial.polynomial.polyval(part, powers(tuple(rod.stiffness for rod in self.rods))))


def taper_of(one: schema.StringInput, make: Callable[[schema.StringInput], Made]) -> tuple[Taper, Fluids] | None:
    """The taper that a section is, and the fluids in and around it; None where nothing goes to another value.

    ``make`` makes the rod of a section of one value of everything.

    Raises
    ------
    InputError
        Naming the key that is missing, contradicts another, or does not fit.
    """
    keys = [key for key in KEYS if getattr(one, key + AT_TOP) is not None]
    if not keys:
        return None
    _check(one, keys)
    top = _at(one, keys, 1.0)
    lower, fluids, first = make(_at(one, keys, 0.0))
    try:
        upper, _, last = make(top)
    except InputError as error:
        key = error.field.removeprefix("rod.")
        raise InputError(error.field + AT_TOP * (key in keys), error.value, error.reason) from None
    between = [make(_at(one, keys, i / (STATIONS - 1))) for i in range(1, STATIONS - 1)]
    facts = [
        Fact(f"{_words(key)} at the upper end", getattr(one, key + AT_TOP), MEASURED.get(key, "length"),
             "in a straight line from that at the lower end") for key in keys
    ]  # fmt: skip
    lower = replace(lower, facts=(*lower.facts, *facts))
    rods = (lower, *(rod for rod, _, _ in between), upper)
    return Taper(rods, (first, between[STATIONS // 2 - 1][2], last)), fluids


def _check(one: schema.StringInput, keys: list[str]) -> None:
    """Refuse what leaves open how a section tapers."""
    for key in keys:
        value = getattr(one, key + AT_TOP)
        if one.pipe is not None and key in DIAMETERS[:2]:
            what = "contradicts pipe, which has one diameter: give outer_diameter, inner_diameter and material instead"
            raise InputError(f"rod.{key}{AT_TOP}", value, what)
        if getattr(one, key) is None:
            raise InputError(f"rod.{key}", None, f"is missing: {key}{AT_TOP} needs it, as the value at the lower end")
    for other in ("joints", *OF_TOOL_JOINTS):
        if getattr(one, other) is not None:
            what = f"cannot stand beside {keys[0]}{AT_TOP}: a taper is one piece; give its length, and joints as "
            raise InputError(f"rod.{other}", getattr(one, other), what + "sections of their own")
    for key, of in {"bending_stiffness": DIAMETERS, "weight_per_length": DIAMETERS[:2]}.items():
        bent = [name for name in of if name in keys]
        if bent and getattr(one, key) is not None and key not in keys:
            less = "material, or youngs_modulus and density" if key == "weight_per_length" else "material"
            what = f"has one value, but {bent[0]}{AT_TOP} makes a taper: give {key}{AT_TOP} too, or {less} instead"
            raise InputError(f"rod.{key}", getattr(one, key), what)


def _at(one: schema.StringInput, keys: list[str], part: float) -> schema.StringInput:
    """The section as it is at a part of its length, as one of these values all along."""
    ends = {key: (getattr(one, key), getattr(one, key + AT_TOP)) for key in keys}
    return one.model_copy(update={key: (1.0 - part) * low + part * high for key, (low, high) in ends.items()})


def _words(key: str) -> str:
    return key.replace("_", " ")
