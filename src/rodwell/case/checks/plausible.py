"""Plausibility of what a case holds: values that no rod has stop the run, with the range and the unit that was meant.

Ranges are generous: from fibres of a micrometre to legs of platforms, from silicone rubber to diamond. What they catch
are slips of units, by factors of a thousand and more. ``plausible = false`` at the top of a case file lets all pass.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from rodwell.case import schema
from rodwell.case.checks.fit import misfits
from rodwell.case.checks.said import in_written_units
from rodwell.case.physical import Physical
from rodwell.case.string.sections import called
from rodwell.case.string.tapers import AT_TOP
from rodwell.quantities.text import minus
from rodwell.quantities.units import KINDS, in_unit_of, to_si
from rodwell.quantities.written import direction, number_and_rest

Problem = tuple[str, object, str]
"""Key, what was written, what to say."""

INSTEAD = "if it is meant, write plausible = false at the top of the case"


@dataclass(frozen=True)
class Range:
    """Values that are plausible for a key, in SI units, the bounds included.

    Attributes
    ----------
    low, high
        Bounds for the size of a value, without its sign.
    kind
        Kind of quantity, see ``rodwell.quantities.units.KINDS``.
    what
        What the bounds are those of, with examples.
    typical
        Where most values lie: a unit is offered if it brings the number there.
    or_zero
        Whether 0 is plausible too.
    """

    low: float
    high: float
    kind: str
    what: str
    typical: tuple[float, float]
    or_zero: bool = False

    def holds(self, value: float) -> bool:
        """Whether a value is plausible."""
        return (self.or_zero and value == 0.0) or self.low * (1 - 1e-9) <= abs(value) <= self.high * (1 + 1e-9)


_THICK = (5e-5, 1.0)
_DIAMETER = Range(1e-7, 4.0, "length", "rods are from 0.1 µm (fibres) to 4 m (legs of platforms) thick", _THICK)
_BORE = Range(1e-8, 4.0, "length", "bores of rods are up to 4 m wide", _THICK, or_zero=True)
_HOLE = Range(1e-7, 8.0, "length", "holes are from 0.1 µm to 8 m (shafts) wide", (5e-4, 1.5))
_YIELD = Range(1e5, 2e10, "stress", "strengths are from 0.1 MPa (gels) to 20 GPa (whiskers)", (5e6, 3e9))
_FLUID = Range(0.05, 14000.0, "density", "fluids weigh from 0.05 kg/m³ (hydrogen) to 14,000 kg/m³ (mercury)",
               (600.0, 2600.0), or_zero=True)  # fmt: skip
_PRESSURE = Range(0.0, 4e8, "pressure", "pressures reach 400 MPa", (1e5, 2e8), or_zero=True)
_FORCE = Range(0.0, 3e8, "force", "loads reach 300 MN (legs of platforms)", (1e-3, 5e6), or_zero=True)
_MOMENT = Range(0.0, 1e8, "moment", "torques reach 100 MN m", (1e-6, 1e5), or_zero=True)

_BEND = Range(0.0, 1e4, "curvature", "holes bend by up to 1e4 rad/m (a radius of 0.1 mm)", (1e-6, 100.0), or_zero=True)
_STROKE = Range(0.0, 500.0, "length", "seals slide up to 500 m", (0.01, 100.0), or_zero=True)

_STIFFNESS = Range(
    1e-20, 1e13, "bending stiffness", "stiffnesses are from 1e-20 N m² (fibres) to 1e13 N m² (legs of platforms)",
    (1e-9, 1e9),
)  # fmt: skip

RANGES: dict[str, Range] = {
    "rod.length": Range(1e-6, 2e4, "length", "rods are from 1 µm to 20 km (drill strings) long", (5e-3, 1e4)),
    "rod.outer_diameter": _DIAMETER,
    "rod.inner_diameter": _BORE,
    "rod.core_diameter": _DIAMETER,
    "rod.youngs_modulus": Range(
        3e5, 1.5e12, "stress", "moduli are from 0.3 MPa (silicone rubber) to 1500 GPa (diamond, nanotubes)", (1e9, 5e11)
    ),
    "rod.bending_stiffness": _STIFFNESS,
    "rod.torsional_stiffness": _STIFFNESS,
    "rod.density": Range(
        10.0, 25000.0, "density", "materials weigh from 10 kg/m³ (foams) to 25,000 kg/m³ (osmium)", (1000.0, 2e4)
    ),
    "rod.weight_per_length": Range(
        1e-12, 1e5, "force per length", "rods weigh up to 100 kN/m (legs of platforms)", (1e-3, 1e4), or_zero=True
    ),
    "rod.yield_strength": _YIELD,
    "hole.diameter": _HOLE,
    "hole.clearance": Range(1e-9, 20.0, "length", "clearances are from 1 nm to 20 m", (1e-4, 0.5)),
    "hole.gravity": Range(
        0.5, 30.0, "acceleration", "gravity is from 0.5 m/s² (small moons) to 30 m/s² (Jupiter), or 0", (9.7, 9.9),
        or_zero=True,
    ),
    "hole.wall_stiffness": Range(
        1.0, 1e15, "stress", "stiffnesses of walls are from 1 Pa (gels) to 1e15 Pa", (1e3, 1e12),
    ),
    "hole.build": _BEND,
    "hole.walk": _BEND,
    "hole.tortuosity_step": Range(1e-6, 1e3, "length", "courses of a survey are up to 1 km long", (1e-3, 100.0)),
    "cylinder.outer_diameter": _HOLE,
    "cylinder.inner_diameter": _HOLE,
    "cylinder.yield_strength": _YIELD,
    "supports.force": _FORCE,
    "supports.moment": _MOMENT,
    "supports.torque": _MOMENT,
    "mud.density": _FLUID,
    "mud.inside": _FLUID,
    "mud.outside": _FLUID,
    "pressure.inside": _PRESSURE,
    "pressure.outside": _PRESSURE,
    "packer.bore": _HOLE,
    "packer.up": _STROKE,
    "packer.down": _STROKE,
    "packer.slack_off": _FORCE,
    "packer.pick_up": _FORCE,
    "packer.inside": _FLUID,
    "packer.outside": _FLUID,
    "packer.inside_pressure": _PRESSURE,
    "packer.outside_pressure": _PRESSURE,
    "packer.temperature_change": Range(
        0.0, 600.0, "temperature change", "tubing warms or cools by up to 600 K", (1.0, 300.0), or_zero=True
    ),
    "packer.thermal_expansion": Range(
        1e-7, 5e-4, "thermal expansion", "materials expand by 1e-7 /K (Invar, glass) to 5e-4 /K (rubber)", (5e-6, 3e-5)
    ),
    "load.until": _FORCE,
    "load.applied": _FORCE,
    "load.twist": _MOMENT,
}  # fmt: skip
"""What is plausible for each key of a case with dimensions. Angles and Poisson's ratio have bounds of their own.

Sources: Young's moduli, densities and strengths as collected by Ashby (Materials Selection in Mechanical Design);
pipes, muds and pressures of wells from the catalogue and API Spec 5DP, 5CT; the rest are sizes of what is built.
"""

UNITS: dict[str, tuple[str, ...]] = {
    "length": ("mm", "in", "cm", "m", "ft", "µm"),
    "force": ("N", "lbf", "kN", "klbf"),
    "moment": ("N m", "ft lbf", "kN m", "N mm"),
    "stress": ("psi", "MPa", "GPa", "Mpsi", "ksi", "Pa"),
    "pressure": ("psi", "bar", "MPa", "kPa", "Pa"),
    "density": ("kg/m^3", "g/cm^3", "lb/gal", "sg", "lb/in^3", "lb/ft^3"),
    "force per length": ("N/m", "lbf/ft", "mN/m", "N/mm"),
    "bending stiffness": ("N m^2", "N mm^2", "lbf in^2", "kN m^2", "N cm^2"),
    "acceleration": ("m/s^2", "ft/s^2", "cm/s^2"),
    "curvature": ("deg/30 m", "deg/100 ft", "rad/m", "deg/mm"),
    "temperature change": ("K", "°F", "°C"),
    "thermal expansion": ("/K", "/°F", "/°C"),
}
"""Units that may have been meant, the likeliest first."""

MOST_OFFERED = 3


def implausible(
    parsed: schema.CaseFile, load: schema.LoadInput, found: Physical | None, data: Mapping[str, Any]
) -> list[Problem]:
    """What is not plausible in a case with dimensions: key, what was written, what to say.

    Parameters
    ----------
    parsed, load
        The values, in SI units.
    found
        What became of them; None where they do not fit together: single values are looked at then.
    data
        The case as it was written.
    """
    out = [
        (key, text, _outside(RANGES[key], text))
        for key, value, text in _values(parsed, load, data)
        if not RANGES[key].holds(value)
    ]
    out += _sections(parsed, data)
    if out or found is None:
        return out
    out = [(key, _written(data, key), f"{what}; {INSTEAD}") for key, what in _from_catalogue(parsed, found)]
    if out:
        return out
    written = ((key, _written(data, key), what) for key, what in misfits(parsed, load, found))
    return [(key, value, f"{in_written_units(what, value)}; {INSTEAD}") for key, value, what in written]


def _sections(parsed: schema.CaseFile, data: Mapping[str, Any]) -> list[Problem]:
    """What is not plausible in the sections of a string."""
    out: list[Problem] = []
    for number, (one, written) in enumerate(zip(parsed.string or (), data.get("string", ()), strict=False), 1):
        for key, allowed in RANGES.items():
            section, _, plain = key.partition(".")
            for name in (plain, plain + AT_TOP) if section == "rod" else ():
                value = getattr(one, name, None) if name in one.model_fields_set else None
                if value is not None and not allowed.holds(value):
                    out.append(
                        (f"{called(number, one.name or '')}.{name}", written[name], _outside(allowed, written[name]))
                    )
    return out


def _values(
    parsed: schema.CaseFile, load: schema.LoadInput, data: Mapping[str, Any]
) -> Iterator[tuple[str, float, object]]:
    """Every value that is given and has a range: key, SI value, what was written."""
    for key in RANGES:
        section, _, name = key.partition(".")
        given = load if section == "load" else getattr(parsed, section)
        value = None if given is None or name not in given.model_fields_set else getattr(given, name)
        written = _written(data, key)
        values = value if isinstance(value, tuple) else () if value is None else (value,)
        texts = written if isinstance(written, list | tuple) else [written] * len(values)
        for one, text in zip(values, texts, strict=False):
            yield key, float(one), text


def _from_catalogue(parsed: schema.CaseFile, found: Physical) -> Iterator[tuple[str, str]]:
    """What a named pipe, material or grade has that is not plausible: its key, and what to say."""
    given, rod = parsed.rod, found.rod
    if given is None:  # sections of a string: from the catalogue of the package, or as they stand in the file
        return
    if given.pipe is None and given.material is None and given.grade is None:
        return
    modulus = rod.stiffness / rod.inertia if rod.inertia > 0.0 and given.bending_stiffness is None else None
    source = "rod.pipe" if given.pipe is not None else "rod.material"
    values = (
        ("outer_diameter", rod.outer_diameter, "rod.pipe", "an outer diameter", "m"),
        ("inner_diameter", rod.inner_diameter, "rod.pipe", "an inner diameter", "m"),
        ("weight_per_length", rod.weight_in_air, source, "a weight per length", "N/m"),
        ("youngs_modulus", modulus, source, "a modulus", "Pa"),
        ("density", rod.density, source, "a density", "kg/m³"),
        ("yield_strength", rod.yield_strength, "rod.grade", "a yield strength", "Pa"),
    )
    for name, value, key, what, unit in values:
        allowed = RANGES[f"rod.{name}"]
        if value is not None and name not in given.model_fields_set and not allowed.holds(value):
            yield key, f"has {what} of {value:.3g} {unit}, which is not plausible: {allowed.what}"


def _written(data: Mapping[str, Any], key: str) -> object:
    section, _, name = key.partition(".")
    values = data.get(section)
    return values.get(name) if isinstance(values, Mapping) else None


def _outside(allowed: Range, text: object) -> str:
    """Why a value is not plausible, in the unit that it has, and which unit would make it so."""
    found = number_and_rest(direction(str(text))[0])
    if found is None:
        return f"is not plausible: {allowed.what}; {INSTEAD}"
    low, high = (_in_unit(bound, allowed.kind, found[1]) for bound in (allowed.low, allowed.high))
    bounds = f"up to {high}" if allowed.or_zero else f"from {low} to {high}"
    reason = f"is not plausible: {allowed.what}, here {bounds} {found[1]}"
    written = str(text).strip().removesuffix(found[1]).strip()
    offered = [f'"{written} {unit}"' for unit in likely_units(allowed, *found)]
    if not offered:
        return f"{reason}; {INSTEAD}"
    return f"{reason}; did you mean {' or '.join(offered)}? {INSTEAD[:1].upper()}{INSTEAD[1:]}"


def _in_unit(value: float, kind: str, unit: str) -> str:
    try:
        return minus(f"{in_unit_of(value, KINDS[kind][0], unit):.3g}")
    except ValueError:
        return f"{value:.3g}"


def likely_units(allowed: Range, number: float, unit: str) -> list[str]:
    """Units that make the number a usual value: relatives of the unit given first, then others."""
    low, high = allowed.typical
    sizes = {
        other: abs(to_si(f"{number!r} {other}", allowed.kind))
        for other in UNITS[allowed.kind]
        if _reads(number, other, allowed.kind)
    }
    fits = [other for other, size in sizes.items() if low <= size <= high]
    fits.sort(key=lambda other: not _related(unit, other))
    return fits[:MOST_OFFERED]


def _reads(number: float, unit: str, kind: str) -> bool:
    try:
        to_si(f"{number!r} {unit}", kind)
    except ValueError:
        return False
    return True


def _related(unit: str, other: str) -> bool:
    """Whether two units belong to one family: psi and Mpsi, Pa and GPa."""
    families = ("psi", "Pa", "lbf", "N")
    return any(unit.endswith(family) and other.endswith(family) for family in families)
