"""Values of a case that are plausible each, but not together: slips that a single range cannot see."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from rodwell.case import schema
from rodwell.case.hole.schema import Hole
from rodwell.case.physical import Physical
from rodwell.case.string.tool_joints import TOOL_JOINT
from rodwell.quantities.text import minus, plain

Misfit = tuple[str, str]
"""Key of the case file, and what is wrong with it."""

METAL, STIFF = 6500.0, 5e9
"""Above this density in kg/m³ a material is a metal (or nearly), and its modulus in Pa is above this one."""

FASTEST = 3e4
"""Speed of sound √(E/ρ) in m/s that no material exceeds; diamond has 18,000, nanotubes some 25,000."""

WIDEST = 400.0
"""Largest ratio of the hole's diameter to the rod's."""

HEAVIEST = 6e4
"""Weight of a rod over its section as density in kg/m³, heavy joints on thin walls included."""

MOST_JOINTS = 3.0
"""Weight of a rod over that of its material in its section: more is a slip, or the weight on another planet."""

SOFTEST, STIFFEST = 1e4, 1.5e12
"""Bending stiffness over the outer circle's second moment of area in Pa."""

TWISTS = (1e-5, 1e3)
"""Torsional over bending stiffness C/B: 0.77 for steel, 13 for a colonoscope; cables and coils are soft in torsion."""

MOST_STRAIN = 0.05
"""Axial strain F/EA that no load puts on a stiff material (above 5 GPa); on a soft one, 1 is the bound."""

LEAST_YIELD = 2e-5
"""Strain at which the softest of metals yield."""


def misfits(parsed: schema.CaseFile, load: schema.LoadInput, found: Physical) -> Iterator[Misfit]:
    """Key and what is wrong with it, for values that do not go together."""
    assert parsed.hole is not None
    if found.string is not None:
        for member in {one.key: one for one in found.string.members}.values():
            one = (parsed.string or ())[member.number - 1]
            if member.name.endswith(TOOL_JOINT):
                continue  # of the body's material, with diameters that have been checked
            for key, what in _of_rod(one, parsed.hole, replace(found, rod=member.rod)):
                mine = key.startswith("rod.")
                yield (
                    f"{member.key}.{key.removeprefix('rod.')}" if mine else key,
                    what.replace("rod.", "") if mine else f"{what} (of {member.key})",
                )
    elif parsed.rod is not None:
        yield from _of_rod(parsed.rod, parsed.hole, found)
    yield from _seals(parsed.packer, found)
    yield from _loads(load, found)


def _of_rod(rod: schema.PipeInput, hole: Hole, found: Physical) -> Iterator[Misfit]:
    """What does not go together in a rod, or in a section of a string."""
    yield from _weight(rod, hole, found)
    yield from _material(rod, found)
    yield from _sizes(rod, hole, found)
    yield from _torsion(rod, found)


def _weight(rod: schema.PipeInput, hole: Hole, found: Physical) -> Iterator[Misfit]:
    """Weight, gravity, density and section."""
    one, gravity = found.rod, found.gravity
    key = "rod.weight_per_length" if rod.weight_per_length is not None else "rod.pipe"
    if gravity == 0.0 and one.weight_in_air > 0.0:
        what = f"is 0, but {key} gives the rod its weight all the same: for a weightless rod give "
        yield "hole.gravity", what + 'rod.weight_per_length = "0 N/m"; else leave gravity out'
    if one.core_diameter is not None:
        return  # the weight is that of what is around the core too
    if not (gravity > 0.0 and one.area > 0.0) or (rod.weight_per_length is None and rod.pipe is None):
        return
    density = one.weight_in_air / (one.area * gravity)
    if one.density is not None and density > MOST_JOINTS * one.density:
        blamed = "hole.gravity" if "gravity" in hole.model_fields_set else key
        what = (
            f"makes the rod {_text(density / one.density)} times as heavy as its section of {_text(one.density)} kg/m³"
        )
        yield blamed, f"{what}: {key} has the weight on Earth; check it, the diameters and their units"
    elif density > HEAVIEST:
        what = f"would take a material of {_text(density)} kg/m³ in this section, above {HEAVIEST:g} kg/m³"
        yield key, f"{what}: check its unit and the diameters"


def _material(rod: schema.PipeInput, found: Physical) -> Iterator[Misfit]:
    """Modulus, density and strength of one material."""
    modulus, density, inertia = rod.youngs_modulus, found.rod.density, found.rod.inertia
    if modulus is not None and density is not None:
        if density > METAL and modulus < STIFF:
            what = (
                f"of {_text(modulus / 1e9)} GPa does not go with a density of {_text(density)} kg/m³, that of a metal"
            )
            yield "rod.youngs_modulus", f"{what}: metals have {STIFF / 1e9:g} GPa and more; check the unit"
        if modulus > density * FASTEST**2:
            speed = f"√(E/ρ) = {_text(math.sqrt(modulus / density))} m/s, above {FASTEST:g} m/s"
            what = f"of {_text(density)} kg/m³ is too small for a modulus of {_text(modulus / 1e9)} GPa"
            yield "rod.density", f"{what}: {speed}; check both units"
    stiff = modulus if modulus is not None else found.rod.stiffness / inertia if inertia > 0.0 else math.nan
    strength = rod.yield_strength
    if strength is not None and strength < LEAST_YIELD * stiff:
        what = f"of {_text(strength / 1e6)} MPa is {_text(strength / stiff)} of the modulus of {_text(stiff / 1e9)} GPa"
        yield "rod.yield_strength", f"{what}: materials bear {LEAST_YIELD:g} of it and more; check the unit"


def _sizes(rod: schema.PipeInput, hole: Hole, found: Physical) -> Iterator[Misfit]:
    """Diameters and stiffness."""
    outer = found.rod.outer_diameter
    if outer is None:
        return
    for key, size in (("diameter", hole.diameter), ("clearance", hole.clearance)):
        most = WIDEST if key == "diameter" else 0.5 * WIDEST
        if size is not None and size > most * outer:
            what = f"is {_text(size / outer)} times the rod's outer diameter, above {most:g} times"
            yield f"hole.{key}", f"{what}: check its unit and the rod's"
    if rod.bending_stiffness is not None:
        modulus = rod.bending_stiffness / (math.pi / 64.0 * outer**4)
        if not SOFTEST <= modulus <= STIFFEST:
            what = f"would take a modulus of {_text(modulus / 1e9)} GPa in a solid rod of this outer diameter"
            what += f", outside {_text(SOFTEST / 1e9)} to {_text(STIFFEST / 1e9)} GPa"
            yield "rod.bending_stiffness", f"{what}: check its unit (N m² or N mm²?) and the diameter's"


def _torsion(rod: schema.PipeInput, found: Physical) -> Iterator[Misfit]:
    """Torsional beside bending stiffness."""
    if rod.torsional_stiffness is None:
        return
    ratio = rod.torsional_stiffness / found.rod.stiffness
    if not TWISTS[0] <= ratio <= TWISTS[1]:
        what = f"is {_text(ratio)} times the bending stiffness, outside {TWISTS[0]:g} to {TWISTS[1]:g}"
        yield "rod.torsional_stiffness", f"{what}: check its unit (N m² or N mm²?)"


def _seals(packer: schema.PackerInput | None, found: Physical) -> Iterator[Misfit]:
    """A packer whose bore does not go with the tubing in it."""
    inner = found.rod.inner_diameter
    if packer is not None and inner is not None and packer.bore < inner:
        yield "packer.bore", f"is below the tubing's inner diameter of {inner:.6g} m, which the seals would narrow"


def _loads(load: schema.LoadInput, found: Physical) -> Iterator[Misfit]:
    """Loads that strain the rod beyond all that is a rod."""
    rod = found.rod
    if not rod.area > 0.0:
        return
    axial = rod.stiffness * rod.area / rod.inertia
    for key, forces in (("applied", load.applied or ()), ("until", () if load.until is None else (load.until,))):
        strain = max((abs(force) for force in forces), default=0.0) / axial
        if strain > (MOST_STRAIN if axial > STIFF * rod.area else 1.0):
            what = f"is {_text(100.0 * strain)} % of EA = {_text(axial)} N: no such rod bears it"
            yield f"load.{key}", f"{what}; check the unit"
    shear = abs(load.twist) * (1.0 + rod.poisson) * 0.5 * (rod.outer_diameter or 0.0) / rod.stiffness
    if shear > 1.0:
        yield "load.twist", f"would shear the rod's surface by {_text(100.0 * shear)} %; check the unit"


def _text(value: float) -> str:
    return minus(plain(value, 3))
