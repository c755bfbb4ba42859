"""Mud and pressures: buoyed weight and effective force.

A rod in fluids buckles as one in air does whose weight is the buoyed weight w = w_air + ρᵢ g Aᵢ − ρₒ g Aₒ and whose
axial force is the effective one, N = N_real − pᵢ Aᵢ + pₒ Aₒ (tension positive; N_real in the wall of the pipe).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from rodwell.case import schema
from rodwell.case.facts import Fact
from rodwell.case.pipe import PhysicalRod
from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray

Drop = TypeVar("Drop", float, FloatArray)
"""A height in m, or heights (m,)."""

NEUTRAL = 1e-12
"""A weight in the fluid below this part of that in air is round-off: the fluid carries the rod."""


@dataclass(frozen=True)
class Fluids:
    """Densities in kg/m³ and pressures at s = 1 in Pa, inside and outside."""

    inside: float = 0.0
    outside: float = 0.0
    inside_pressure: float = 0.0
    outside_pressure: float = 0.0

    def buoyed_weight(self, rod: PhysicalRod, gravity: float) -> float:
        """Weight per length in the fluids in N/m.

        Where the density of the material is known, what the rod displaces outside is its bore and its material,
        Aᵢ + w_air/(ρ g): that of tool joints counts, and the same mud on both sides gives w_air (1 − ρ_mud/ρ).
        Elsewhere it is the outer circle.
        """
        displaced = rod.outer_area
        if rod.density is not None and gravity > 0.0:
            displaced = rod.bore_area + rod.weight_in_air / (rod.density * gravity)
        return rod.weight_in_air + gravity * (self.inside * rod.bore_area - self.outside * displaced)

    def pressures(self, gravity: float, drop: Drop) -> tuple[Drop, Drop]:
        """Pressures in Pa inside and outside, at places ``drop`` metres of height below s = 1."""
        inside = self.inside_pressure + self.inside * gravity * drop
        outside = self.outside_pressure + self.outside * gravity * drop
        return inside, outside

    def effective_minus_real(self, rod: PhysicalRod, gravity: float, drop: float = 0.0) -> float:
        """−pᵢ Aᵢ + pₒ Aₒ in N, at a place ``drop`` metres of height below s = 1."""
        inside, outside = self.pressures(gravity, drop)
        return outside * rod.outer_area - inside * rod.bore_area


NO_FLUIDS = Fluids()


def fluids_of(mud: schema.Mud | None, pressure: schema.PressureAtEnd | None, rod: PhysicalRod) -> Fluids:
    """Return the fluids of a case.

    Raises
    ------
    InputError
        For keys that contradict each other, or what the rod's section does not allow.
    """
    mud, pressure = mud or schema.Mud(), pressure or schema.PressureAtEnd()
    for key in ("inside", "outside"):
        if mud.density is not None and getattr(mud, key) is not None:
            what = "contradicts mud.density, which stands for both sides: give mud.inside and mud.outside, or it alone"
            raise InputError(f"mud.{key}", getattr(mud, key), what)
    for name, side in (("mud", mud), ("pressure", pressure)):
        if not rod.bore_known and (side.inside or (name == "mud" and mud.density)):
            key = "density" if name == "mud" and mud.density else "inside"
            what = f"fills a bore that is not known: give rod.inner_diameter, or {name}.outside alone"
            raise InputError(f"{name}.{key}", getattr(side, key), what)
        if side.inside and rod.outer_diameter is not None and rod.inner_diameter == 0.0:
            what = "cannot be: the rod is solid; give rod.inner_diameter, or leave this out"
            raise InputError(f"{name}.inside", side.inside, what)
    densities = [mud.density if one is None else one for one in (mud.inside, mud.outside)]
    fluids = Fluids(densities[0] or 0.0, densities[1] or 0.0, pressure.inside, pressure.outside)
    if fluids != NO_FLUIDS and rod.outer_diameter is None:
        reason = "with [mud]" if fluids.inside or fluids.outside else "with [pressure]"
        raise InputError("rod.outer_diameter", None, f"is missing: it is needed {reason}")
    return fluids


def weight_in(fluids: Fluids, rod: PhysicalRod, gravity: float) -> float:
    """Buoyed weight per length in N/m; negative of a rod that floats, and 0 of one that the fluid carries."""
    weight = fluids.buoyed_weight(rod, gravity)
    return 0.0 if abs(weight) < NEUTRAL * rod.weight_in_air else weight


def fluid_facts(fluids: Fluids, rod: PhysicalRod, gravity: float) -> list[Fact]:
    """What fluids do to weight and force."""
    if fluids == NO_FLUIDS:
        return [Fact("weight per length mg", rod.weight_in_air, "force_per_length", "no fluids given")]
    how = "w = w_air + ρᵢ g Aᵢ − ρₒ g Aₒ"
    if rod.density is not None:
        how += "; Aₒ is Aᵢ and the metal that the weight in air stands for"
    if weight_in(fluids, rod, gravity) < 0.0:
        how += "; negative: the rod floats, and presses on the upper side of the hole"
    return [
        Fact("weight per length in air", rod.weight_in_air, "force_per_length"),
        Fact("buoyed weight per length mg", fluids.buoyed_weight(rod, gravity), "force_per_length", how),
        Fact(
            "effective less real force at s = 1", fluids.effective_minus_real(rod, gravity), "force",
            "−pᵢ Aᵢ + pₒ Aₒ, tension positive; all forces of this report are effective ones",
        ),
    ]  # fmt: skip
