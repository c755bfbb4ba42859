"""Units at the boundary: text such as "30 m" or "19.5 lbf/ft" in, SI numbers inside, readable numbers out."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache
from typing import Any

from rodwell.quantities.known import FOOT, GALLON, INCH, LBF, POUND, in_si
from rodwell.quantities.text import certain, plain, prefix_for, readable, supported
from rodwell.quantities.value import Value
from rodwell.quantities.written import (
    DEFINITIONS,
    NUMBER,
    AmbiguousUnitError,
    as_typed,
    direction,
    number_and_rest,
    plain_unit,
    remedy,
    with_other_capitals,
)

KINDS: dict[str, tuple[str, str]] = {
    "length": ("m", '"30 m", "5 cm", "8.5 in"'),
    "angle": ("rad", '"15 deg"'),
    "curvature": ("rad/m", '"3 deg/30 m", "2 deg/100 ft", "0.05 rad/mm"'),
    "force": ("N", '"-20 kN", "-5000 lbf"'),
    "moment": ("N*m", '"1.2 kN m", "800 ft lbf"'),
    "stress": ("Pa", '"200 GPa", "30e6 psi"'),
    "pressure": ("Pa", '"20 MPa", "3000 psi"'),
    "wall stiffness": ("N/m^2", '"5e6 N/m^2", "20 MPa"'),
    "density": ("kg/m^3", '"7800 kg/m^3", "65.5 lb/gal", "1.2 sg"'),
    "force per length": ("N/m", '"315 N/m", "19.5 lbf/ft"'),
    "bending stiffness": ("N*m^2", '"9.8e5 N m^2"'),
    "torsional stiffness": ("N*m^2", '"7.5e5 N m^2", "1800 N·mm²"'),
    "acceleration": ("m/s^2", '"9.80665 m/s^2"'),
    "speed": ("m/s", '"20 m/h", "60 ft/h", "0.3 m/s"'),
    "temperature change": ("K", '"-20 °F", "35 K"'),
    "thermal expansion": ("1/K", '"6.9e-6 /°F", "12.4e-6 /K"'),
}
"""Kinds of quantity that case files hold: SI unit, and examples for messages."""

SMALLEST, LARGEST = 1e-20, 1e20
"""Sizes in SI units that no quantity of a case reaches."""

LONGEST_TEXT = 60

_QUANTITY = re.compile(
    rf"\s*({NUMBER}|[+-]?(?:nan|inf(?:inity)?))"
    r"((?:\s*+[*/·⋅.-]?\s*+(?:[A-Za-zµμ°Ω%_]++|\(|\)|\^-?[1-9]|\*\*-?[1-9]|[²³⁴]|(?<=[A-Za-z])[234]|[\"″′']"
    r"|(?<=/)\s*\d{1,4}(?=\s*(?:ft|m)\b)))*\.?)\s*",  # units, products, small powers, deg/100 ft
    re.IGNORECASE,
)
"""Possessive (``++``) where two parts could share what they match: without, the time doubles with each letter."""

_COSTLY = re.compile(
    r"(?:\d|\^|\*\*|[²³])\s*(?:\^|\*\*|[²³])"  # powers of numbers and of powers
    r"|(?:\^|\*\*)(?!\s*-?\s*\d(?![\d.]))"  # powers of more than one digit
    r"|\)\s*(?:\^|\*\*|[²³]).*\)\s*(?:\^|\*\*|[²³])"  # powers within powers
)
"""Units that may take as long as they please: 9**9**9 m, ((m^9)^9)^9. No quantity has one."""


@cache
def _registry() -> Any:
    import pint  # noqa: PLC0415 - slow to import

    registry: Any
    try:
        registry = pint.UnitRegistry(cache_folder=":auto:")  # parsed definitions kept on disk: halves the start
    except OSError:  # no folder of the user's to write to
        registry = pint.UnitRegistry()
    for definition in DEFINITIONS:
        registry.define(definition)
    return registry


def to_si(text: object, kind: str) -> float:
    """Return the SI value of ``text`` as a quantity of ``kind``.

    A force may say how it acts: "20 kN compression" is −20 kN, "20 kN tension" 20 kN.

    Raises
    ------
    ValueError
        With what is wrong and what to write instead.
    """
    unit, examples = KINDS[kind]
    if isinstance(text, (int, float)) and not isinstance(text, bool):
        raise ValueError(f"needs a unit: write it as text, for example {examples}")
    if not isinstance(text, str):
        raise ValueError(f"must be text with a number and a unit, for example {examples}")
    text, sign = direction(text) if kind == "force" else (text, 0)
    number, unit_text = _split(text, examples)
    if sign > 0 > number:
        raise ValueError("is negative, which is compression: write it without the sign, or without the word")
    try:
        written = plain_unit(unit_text, kind)
    except AmbiguousUnitError as error:
        raise ValueError(f"{error}; for example {examples}") from None
    value = in_si(number, written, unit)
    if value is None:
        value = _by_registry(number, written, unit_text, kind)
    if not math.isfinite(value):
        raise ValueError("must be finite")
    if value != 0.0 and not SMALLEST <= abs(value) <= LARGEST:
        raise ValueError(f"is beyond sense: {value:g} {unit}; check the unit")
    return sign * abs(value) if sign else value


def _by_registry(number: float, written: str, unit_text: str, kind: str) -> float:
    """The SI value of a number of a unit that only the registry knows; or what is wrong with its text."""
    import pint  # noqa: PLC0415 - slow to import

    unit, examples = KINDS[kind]
    try:
        quantity = _registry().Quantity(number, written or "dimensionless")
    except pint.UndefinedUnitError:
        meant = _meant(unit_text, unit, kind)
        raise ValueError(f"unknown unit {unit_text!r}{meant}; write for example {examples}") from None
    except Exception:  # pint raises many kinds for text that is no unit
        raise ValueError(f"is not a number with a unit; write for example {examples}") from None
    if kind == "angle" and quantity.dimensionless and quantity.unitless:
        raise ValueError(f"needs a unit: write for example {examples}")
    try:
        return float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        what = f"has the dimension {quantity.dimensionality}" if not quantity.dimensionless else "has no unit"
        hint = _hint(quantity, kind) or _meant(unit_text, unit, kind)
        raise ValueError(
            f"must be {_article(kind)} {kind}, but it {what}; write for example {examples}{hint}"
        ) from None
    except Exception:
        raise ValueError(f"is not a single number with a unit; write for example {examples}") from None


def _article(noun: str) -> str:
    return "an" if noun[0] in "aeio" else "a"


def in_unit_of(number: float, unit: str, other: str) -> float:
    """Return ``number`` in ``unit`` as a number in the unit ``other``.

    Raises
    ------
    ValueError
        If one of them is no unit, or they do not go together.
    """
    try:
        if not (is_quick(unit) and is_quick(other)):
            raise ValueError
        return float(_registry().Quantity(number, plain_unit(unit)).to(plain_unit(other)).magnitude)
    except Exception:  # pint raises many kinds for text that is no unit
        raise ValueError(f"has units {unit!r} and {other!r}, which do not go together") from None


def is_quick(unit: str) -> bool:
    """Whether the text of a unit can be parsed in a moment, whatever it means."""
    return len(unit) <= LONGEST_TEXT and _COSTLY.search(unit) is None


def _split(text: str, examples: str) -> tuple[float, str]:
    """Number and unit; nothing else may stand in the text, and nothing is evaluated."""
    found = _QUANTITY.fullmatch(as_typed(text)) if len(text) <= LONGEST_TEXT else None
    if found is None or not is_quick(found[2]):
        how = remedy(text) if len(text) <= LONGEST_TEXT else ""
        raise ValueError(f"is not a number with a unit; write {how}for example {examples}")
    read = number_and_rest(found[1])
    return float(found[1]) if read is None else read[0], found[2].strip()


def _meant(written: str, unit: str, kind: str) -> str:
    """The unit that differs from what is written by capitals only and is one of this kind."""
    fits = []
    for other in with_other_capitals(written):
        try:
            if _registry().Quantity(1.0, plain_unit(other, kind)).is_compatible_with(unit):
                fits.append(repr(other))
        except Exception:  # no unit either
            continue
    return f" (did you mean {' or '.join(fits)}?)" if fits else ""


def _hint(quantity: Any, kind: str) -> str:
    """Extra help for mistakes that are common: pounds of mass where pounds of force are meant, gradients of mud."""
    if kind in ("force", "force per length", "moment") and "[mass]" in str(quantity.dimensionality):
        return " (a weight is a force: lbf, not lb; N, not kg)"
    if kind == "density" and quantity.is_compatible_with("Pa/m"):
        density = float(quantity.to("Pa/m").magnitude) / 9.80665
        return f" (a gradient of pressure: a density of {density:.4g} kg/m^3 makes it)"
    return ""


_PREFIXED = ("N", "N/m", "N·m", "J", "Pa", "m")


def _below(unit: str, value: float) -> tuple[tuple[str, float], ...]:
    """The unit with the prefixes of small numbers."""
    return tuple((f"{prefix}{unit}", value * size) for prefix, size in (("m", 1e-3), ("µ", 1e-6), ("n", 1e-9)))


_UNITS: dict[str, dict[str, tuple[tuple[str, float], ...]]] = {
    "si": {
        "1": (("1", 1.0),), "angle": (("rad", 1.0),), "length": (("m", 1.0),), "curvature": (("1/m", 1.0),),
        "force": (("N", 1.0),), "force_per_length": (("N/m", 1.0),), "moment": (("N·m", 1.0),),
        "energy": (("J", 1.0),), "stress": (("Pa", 1.0),), "density": (("kg/m³", 1.0),),
        "stiffness": (("N·m²", 1.0),), "temperature": (("K", 1.0),),
    },
    "field": {
        "1": (("1", 1.0),), "angle": (("rad", 1.0),), "length": (("ft", FOOT), ("in", INCH)),
        "curvature": (("1/ft", 1.0 / FOOT),), "force": (("lbf", LBF),), "force_per_length": (("lbf/ft", LBF / FOOT),),
        "moment": (("ft·lbf", LBF * FOOT),), "energy": (("ft·lbf", LBF * FOOT),), "stress": (("psi", LBF / INCH**2),),
        "density": (("lb/gal", POUND / GALLON),), "stiffness": (("lbf·in²", LBF * INCH**2),),
        "temperature": (("°F", 5.0 / 9.0),),
    },
    "mm": {
        "1": (("1", 1.0),), "angle": (("rad", 1.0),), "length": (("mm", 1e-3), ("µm", 1e-6)),
        "curvature": (("1/mm", 1e3),), "force": (("N", 1.0), *_below("N", 1.0)),
        "force_per_length": (("N/mm", 1e3), *_below("N/mm", 1e3)), "moment": (("N·mm", 1e-3), *_below("N·mm", 1e-3)),
        "energy": (("N·mm", 1e-3), *_below("N·mm", 1e-3)), "stress": (("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.0)),
        "density": (("kg/m³", 1.0),),
        "stiffness": (("N·mm²", 1e-6),),
        "temperature": (("K", 1.0),),
    },
}  # fmt: skip
"""Units by system and dimension: text and SI value. The first is that of tables; those after it for small values."""

SYSTEMS = tuple(_UNITS)
"""Systems of units in which results can be had."""

SMALL = {"ft": 3.0}
"""Below this many of a unit the next is used: a rod has feet, its clearance inches."""

SMALL_ELSE = 0.1


@dataclass(frozen=True)
class System:
    """Units in which results are shown: "si" (with prefixes), "field" (lbf, ft, in, psi) or "mm" (N, mm, MPa)."""

    name: str = "si"

    def unit(self, dimension: str, size: float | None = None) -> tuple[float, str]:
        """Return SI value and text of the unit for a dimension of the nomenclature.

        ``size`` in SI units says for which numbers: the unit then suits them. Without it, the unit is that of tables.
        """
        text, value = _UNITS[self.name][dimension][0]
        if size is None:
            return value, text
        if self.name == "si":
            scale, prefix = prefix_for(size) if text in _PREFIXED else (1.0, "")
            return scale, prefix + text
        for text, value in _UNITS[self.name][dimension]:
            if abs(size) >= SMALL.get(text, SMALL_ELSE) * value or size == 0.0:
                break
        return value, text

    def text(self, value: float, dimension: str, digits: int = 4, *, zeros: bool = False) -> str:
        """Return an SI ``value`` as text in the unit that suits it: "−12.35 kN", "−2776 lbf"."""
        if self.name == "si" and (text := _UNITS["si"][dimension][0][0]) in _PREFIXED:
            return readable(value, text, digits, zeros=zeros)
        unit, text = self.unit(dimension, value)
        return f"{plain(value / unit, digits, zeros=zeros)} {text if text != '1' else ''}".rstrip()

    def amount(self, number: Value, dimension: str, digits: int = 4) -> str:
        """Return a :class:`Value` in SI as text with the digits that its error allows, for a sentence."""
        count = certain(number, digits)
        text = self.text(number.value, dimension, count or 1, zeros=count > 0 and number.error > 0.0)
        return text if count else f"{text} ± {self.text(number.error, dimension, 1)}"

    def beside_error(self, number: Value, dimension: str, digits: int = 6) -> str:
        """Return a :class:`Value` in SI as text for a table that has its error: with the digits that this supports."""
        count = supported(number, digits)
        return self.text(number.value if count else 0.0, dimension, max(count, 1), zeros=number.error > 0.0)


SI = System()
