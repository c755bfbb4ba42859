"""[rod] of a case file with the catalogue: section, stiffness, weight in air and strength of the rod."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rodwell.case import schema
from rodwell.case.catalogue import Catalogue, key_of
from rodwell.case.entries import Entry, Material, Pipe
from rodwell.case.facts import Fact
from rodwell.errors import InputError


@dataclass(frozen=True)
class PhysicalRod:
    """A rod in SI units.

    Attributes
    ----------
    length
        In m.
    outer_diameter, inner_diameter
        In m; the outer one is None where it is not known, the inner one 0 for a solid rod.
    stiffness
        Bending stiffness B in N m².
    weight_in_air
        N/m.
    density
        Of the material in kg/m³, None where it is not known.
    poisson
        Poisson's ratio ν.
    torsion
        Torsional stiffness C/B where it was given; None: it follows from ν.
    yield_strength
        In Pa, None where it is not known.
    facts
        Where the numbers come from.
    bore_known
        False for a hollow rod whose bore is not known, which needs stiffness and weight as measured.
    core_diameter
        In m, of the solid core that bears load where it is within something that does not; None: all of it does.
    """

    length: float
    outer_diameter: float | None
    inner_diameter: float
    stiffness: float
    weight_in_air: float
    density: float | None
    poisson: float
    yield_strength: float | None
    facts: tuple[Fact, ...]
    torsion: float | None = None
    bore_known: bool = True
    core_diameter: float | None = None

    @property
    def bearing_diameter(self) -> float:
        """Outer diameter in m of what bears load; 0 where it is not known."""
        return (self.outer_diameter or 0.0) if self.core_diameter is None else self.core_diameter

    @property
    def torsional_stiffness(self) -> float:
        """C in N m²."""
        return self.stiffness * (1.0 / (1.0 + self.poisson) if self.torsion is None else self.torsion)

    @property
    def bore_area(self) -> float:
        """Area of the bore A_i in m²."""
        return math.pi / 4.0 * self.inner_diameter**2

    @property
    def outer_area(self) -> float:
        """Area of the outer circle A_o in m²; 0 where the diameter is not known."""
        return math.pi / 4.0 * (self.outer_diameter or 0.0) ** 2

    @property
    def area(self) -> float:
        """Area of the section that bears load, A in m²."""
        return math.pi / 4.0 * (self.bearing_diameter**2 - self.inner_diameter**2)

    @property
    def inertia(self) -> float:
        """Second moment of that area in m⁴."""
        return math.pi / 64.0 * (self.bearing_diameter**4 - self.inner_diameter**4)


def physical_rod(given: schema.PipeInput, gravity: float, catalogue: Catalogue, length: float) -> PhysicalRod:
    """Return the rod of a length in m that [rod], or a section of [[string]], describes.

    Raises
    ------
    InputError
        Naming the key that is missing, contradicts another, or is not in the catalogue.
    """
    pipe = None if given.pipe is None else catalogue.pipe(given.pipe)
    outer, inner, bore_known = _diameters(given, pipe)
    material = _material(given, pipe, catalogue)
    facts = [Fact("pipe", entry.name, note=_why(entry)) for entry in (pipe,) if entry]
    facts += [Fact("material", entry.name, note=_why(entry)) for entry in (material,) if entry]
    core = _core(given, outer, inner)
    stiffness = _stiffness(given, pipe, material, (outer if core is None else core, inner))
    density = None if core is not None else given.density if material is None else material.density
    weight = _weight(given, pipe, density, (outer, inner), gravity)
    strength, why = _strength(given, material, catalogue)
    if strength is not None:
        facts.append(Fact("yield strength", strength, "stress", why))
    poisson = given.poisson if material is None or "poisson" in given.model_fields_set else material.poisson
    torsion = _torsion(given, stiffness)
    if torsion is not None:
        assert given.torsional_stiffness is not None
        facts.append(
            Fact("torsional stiffness C", given.torsional_stiffness, "stiffness", f"as given, C/B = {torsion:.4g}")
        )
    return PhysicalRod(length, outer, inner, stiffness, weight, density, poisson, strength, tuple(facts), torsion,
                       bore_known, core)  # fmt: skip


def _why(entry: Entry) -> str:
    return "; ".join(part for part in (entry.source, entry.note) if part)


def _only_one(key: str, value: object, other: str) -> InputError:
    return InputError(key, value, f"contradicts {other}: give only one of the two")


def _torsion(rod: schema.PipeInput, stiffness: float) -> float | None:
    """C/B where the torsional stiffness is given instead of Poisson's ratio."""
    if rod.torsional_stiffness is None:
        return None
    if "poisson" in rod.model_fields_set:
        raise _only_one("rod.torsional_stiffness", None, "rod.poisson")
    return rod.torsional_stiffness / stiffness


def _diameters(rod: schema.PipeInput, pipe: Pipe | None) -> tuple[float | None, float, bool]:
    """Outer diameter, if known, inner one, and whether the bore is known."""
    outer, inner, bore_known = rod.outer_diameter, rod.inner_diameter, True
    if pipe is not None:
        if outer is not None:
            raise InputError(
                "rod.outer_diameter", outer, "contradicts rod.pipe, whose diameter is in the catalogue: leave it out"
            )
        if inner is not None and pipe.bore is not None:
            raise InputError(
                "rod.inner_diameter", inner, "contradicts rod.pipe, whose bore is in the catalogue: leave it out"
            )
        bore_known = not (pipe.hollow and inner is None and pipe.bore is None)
        if not bore_known:
            _check_without_bore(rod, pipe)
        outer, inner = pipe.outer_diameter, pipe.bore if inner is None else inner
    if outer is not None and inner is not None and inner >= outer:
        raise InputError("rod.inner_diameter", inner, f"must be below the outer diameter of {outer:g} m")
    return outer, inner or 0.0, bore_known


def _core(rod: schema.PipeInput, outer: float | None, inner: float) -> float | None:
    """Diameter of the core that alone bears load, if there is one."""
    core = rod.core_diameter
    if core is None:
        return None
    if outer is None:
        raise InputError("rod.outer_diameter", None, "is missing: core_diameter is that of a core within it")
    if core > outer:
        raise InputError("rod.core_diameter", core, f"must be at most the outer diameter of {outer:g} m")
    if inner > 0.0:
        raise InputError("rod.core_diameter", core, "contradicts the bore: a core is solid; leave one of the two out")
    if rod.density is not None:
        what = "contradicts rod.core_diameter, beside which the weight of all is needed: give weight_per_length instead"
        raise InputError("rod.density", rod.density, what)
    if rod.weight_per_length is None:
        what = "is missing: beside core_diameter give the weight of the core and what is around it (may be 0 N/m)"
        raise InputError("rod.weight_per_length", None, what)
    return core


def _check_without_bore(rod: schema.PipeInput, pipe: Pipe) -> None:
    """Ask for the bore of a hollow rod where something is worked out from it."""
    needs = {
        "to work out the stiffness from material or modulus": rod.bending_stiffness is None,
        "to work out the weight": rod.weight_per_length is None,
        "for stresses, with rod.grade or rod.yield_strength": rod.grade is not None or rod.yield_strength is not None,
    }
    for why, needed in needs.items():
        if needed:
            what = f"is missing: no bore is standard for {pipe.name!r}; it is needed {why}. Give it"
            more = ", or rod.bending_stiffness and rod.weight_per_length as measured" if "work" in why else ""
            raise InputError("rod.inner_diameter", None, what + more)


def _material(rod: schema.PipeInput, pipe: Pipe | None, catalogue: Catalogue) -> Material | None:
    """Material of [rod] or of its pipe."""
    own = None if pipe is None else pipe.material
    if rod.material is None:
        if own is None:
            return None
        for key in ("youngs_modulus", "density"):
            if getattr(rod, key) is not None:
                what = f"contradicts rod.pipe, which is of {own}: leave it out, or give diameters instead of rod.pipe"
                raise InputError(f"rod.{key}", getattr(rod, key), what)
        return catalogue.material(own, "rod.pipe")
    material = catalogue.material(rod.material)
    if own is not None and not _is(material, own):
        what = f"contradicts rod.pipe, which is of {own}: leave it out, or give diameters instead of rod.pipe"
        raise InputError("rod.material", rod.material, what)
    for key in ("youngs_modulus", "density"):
        if getattr(rod, key) is not None:
            raise _only_one(f"rod.{key}", getattr(rod, key), "rod.material")
    return material


def _is(material: Material, name: str) -> bool:
    return key_of(name) in map(key_of, (material.name, *material.aliases))


def _stiffness(
    rod: schema.PipeInput,
    pipe: Pipe | None,
    material: Material | None,
    diameters: tuple[float | None, float],
) -> float:
    """Bending stiffness: as given, or E I."""
    given, modulus = rod.bending_stiffness, rod.youngs_modulus
    if given is not None:
        if modulus is not None:
            raise _only_one("rod.bending_stiffness", None, "rod.youngs_modulus")
        if pipe is not None and (pipe.material is not None or pipe.bending_stiffness is not None):
            raise InputError(
                "rod.bending_stiffness",
                given,
                "contradicts rod.pipe, whose stiffness is in the catalogue: leave it out",
            )
        return given
    if pipe is not None and pipe.bending_stiffness is not None:
        return pipe.bending_stiffness
    if material is not None:
        return material.youngs_modulus * _section(diameters, "with rod.material")[1]
    if modulus is not None:
        return modulus * _section(diameters, "with rod.youngs_modulus")[1]
    if pipe is not None:
        what = f"is missing: no stiffness is standard for {pipe.name!r}; give it as measured, or rod.material"
        raise InputError("rod.bending_stiffness", None, what)
    raise InputError("rod.youngs_modulus", None, "is missing: give it, rod.material, or rod.bending_stiffness")


def _weight(
    rod: schema.PipeInput,
    pipe: Pipe | None,
    density: float | None,
    diameters: tuple[float | None, float],
    gravity: float,
) -> float:
    """Weight per length in air: as given, as in the catalogue, or from the density."""
    if rod.weight_per_length is not None:
        if rod.density is not None:
            raise _only_one("rod.weight_per_length", None, "rod.density")
        return rod.weight_per_length
    if pipe is not None and pipe.weight_per_length is not None:
        if rod.density is not None:
            raise InputError("rod.density", rod.density, "contradicts rod.pipe, whose weight is in the catalogue: "
                             "leave it out")  # fmt: skip
        return pipe.weight_per_length
    if density is None:
        if pipe is not None:
            what = f"is missing: no weight is standard for {pipe.name!r}; give it (may be 0 N/m), or rod.material"
            raise InputError("rod.weight_per_length", None, what)
        what = "is missing: give it, rod.material, or rod.weight_per_length (may be 0 N/m)"
        raise InputError("rod.density", None, what)
    reason = "with rod.density" if rod.material is None else "with rod.material"
    return density * _section(diameters, reason)[0] * gravity


def _section(diameters: tuple[float | None, float], reason: str) -> tuple[float, float]:
    """Area and second moment of area."""
    outer, inner = diameters
    if outer is None:
        raise InputError("rod.outer_diameter", None, f"is missing: it is needed {reason}")
    return math.pi / 4.0 * (outer**2 - inner**2), math.pi / 64.0 * (outer**4 - inner**4)


def _strength(rod: schema.PipeInput, material: Material | None, catalogue: Catalogue) -> tuple[float | None, str]:
    """Yield strength and where it is from."""
    if rod.grade is None:
        return rod.yield_strength, "as given"
    if rod.yield_strength is not None:
        raise _only_one("rod.yield_strength", rod.yield_strength, "rod.grade")
    grade = catalogue.grade(rod.grade)
    if grade.material is not None and material is not None and not _is(material, grade.material):
        what = f"is a grade of {grade.material}, but the rod is of {material.name}: give the right grade, or "
        raise InputError("rod.grade", rod.grade, what + "rod.yield_strength")
    return grade.yield_strength, f"{grade.name}: {_why(grade)}"
