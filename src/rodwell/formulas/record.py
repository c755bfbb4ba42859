"""What is known about a formula of practice: what it takes and gives, where it comes from, where it holds."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from rodwell.quantities.text import plain

Value = Any
"""What formulas take and give: a float, or a quantity with units (pint)."""

Function = Callable[..., Any]

Kind = Literal["sinusoidal", "helical", "helix", "path", "pushing", "strength", "torque", "limit"]
"""What a formula gives: the load at which the straight rod buckles; the load of (or for) a helix; a measure of the
buckled rod; loads on the path of the pipe; how far it can be pushed; what it bears; torque; limits of length or
weight."""

Place = Literal["top", "middle", "bottom"]
"""Where the force of a formula is measured: s = 1, s = 1/2 and s = 0, the most compressed place."""

SYMBOLS: dict[str, tuple[int, int, str]] = {
    "B": (1, 2, "bending stiffness EI"),
    "w": (1, -1, "weight per length of the pipe in its fluid"),
    "alpha": (0, 0, "inclination from the vertical in degrees"),
    "r": (0, 1, "radial clearance: distance of the axes of pipe and hole, the paper's Δ"),
    "L": (0, 1, "length"),
    "F": (1, 0, "effective compression, positive (rodwell's tension-positive force with its sign changed)"),
    "F_1": (1, 0, "compression at the end that is farther from the push"),
    "F_2": (1, 0, "compression at the end that is nearer to the push"),
    "F_p": (1, 0, "Paslay load: the sinusoidal load of a long pipe"),
    "x": (0, 1, "distance along the pipe"),
    "n": (0, 0, "number of half waves"),
    "m": (0, 0, "number of turns"),
    "p": (0, 1, "axial length of one wave or turn"),
    "beta_0": (0, 0, "amplitude of the angle around the hole in radians"),
    "mu": (0, 0, "coefficient of friction"),
    "build": (0, -1, "dα/ds in radians per length, positive where inclination grows downwards"),
    "turn": (0, -1, "sin α dφ/ds in radians per length, φ azimuth"),
    "T": (1, 1, "torque"),
    "D": (0, 1, "outer diameter of the pipe"),
    "I": (0, 4, "second moment of area"),
    "A": (0, 2, "area of the steel"),
    "A_i": (0, 2, "area of the bore"),
    "A_o": (0, 2, "area of the outer circle"),
    "p_i": (1, -2, "pressure inside"),
    "p_o": (1, -2, "pressure outside"),
    "gamma_i": (1, -3, "weight per volume of the fluid inside"),
    "gamma_o": (1, -3, "weight per volume of the fluid outside"),
    "w_air": (1, -1, "weight per length in air"),
    "F_real": (1, 0, "real compression in the wall of the pipe, positive"),
    "mud": (0, 0, "density of the mud in lb/gal, inside and outside"),
    "sigma_y": (1, -2, "yield stress"),
}
"""Every quantity that a formula takes: powers of force and of length in its unit, and meaning."""

NAMES = {(1, 0): "force", (1, -1): "force per length", (0, 1): "length", (0, -1): "1/length", (1, 1): "moment",
         (1, -2): "stress", (0, 0): "number", (1, 2): "bending stiffness"}  # fmt: skip

NOMENCLATURE = {(1, 0): "force", (1, -1): "force_per_length", (0, 1): "length", (0, -1): "curvature", (1, 1): "moment",
                (1, -2): "stress", (0, 0): "1", (1, 2): "stiffness"}  # fmt: skip
"""The dimensions as the nomenclature and the units of output know them."""


@dataclass(frozen=True)
class FormulaInputs:
    """A rod in a hole in coherent units, and what else was given: what validity is judged on.

    ``ends`` are those at s = 0 (bottom) and s = 1; ``pressed`` tells whether weight presses the straight rod on the
    wall. ``more`` holds further quantities by symbol, such as "mu".
    """

    B: float
    w: float
    alpha: float
    r: float
    L: float
    ends: tuple[str, str] = ("clamped", "clamped")
    pressed: bool = True
    more: tuple[tuple[str, float], ...] = ()

    @property
    def lateral(self) -> float:
        """Lateral weight per length, w sin α."""
        return self.w * math.sin(math.radians(self.alpha))

    @property
    def axial(self) -> float:
        """Axial weight of the whole rod, w L cos α."""
        return 0.0 if self.alpha == 90.0 else self.w * self.L * math.cos(math.radians(self.alpha))

    def known(self) -> dict[str, float]:
        """Return quantities by symbol."""
        return {"B": self.B, "w": self.w, "alpha": self.alpha, "r": self.r, "L": self.L, **dict(self.more)}


Check = Callable[[FormulaInputs], list[str]]


@dataclass(frozen=True)
class Formula:
    """A formula of practice.

    Attributes
    ----------
    key
        Its name in code.
    name
        As the field knows it.
    text
        The formula itself.
    kind
        What it gives; see :data:`Kind`.
    place
        Where its force is measured, for a critical load; None for other kinds.
    dimension
        Powers of force and length of what it gives.
    source, evidence
        Where it was found, and how it was verified.
    holds
        Where it holds, in words.
    assumes
        What it assumes.
    function
        Callable with keyword arguments named as in :data:`SYMBOLS`, in any coherent units.
    violations
        Function from a rod to the reasons why the rod is outside that range.
    defect
        Power of length by which its dimension fails (Dellinger's fit); else 0.
    """

    key: str
    name: str
    text: str
    kind: Kind
    place: Place | None
    dimension: tuple[int, int]
    source: str
    evidence: str
    holds: str
    assumes: str
    function: Function
    violations: Check
    defect: float = 0.0

    @property
    def takes(self) -> tuple[str, ...]:
        """Symbols of the quantities that it takes."""
        return tuple(inspect.signature(self.function).parameters)

    def missing(self, rod: FormulaInputs) -> tuple[str, ...]:
        """Return symbols of what it takes and the rod does not tell."""
        return tuple(name for name in self.takes if name not in rod.known())

    def of(self, rod: FormulaInputs, **more: float) -> float:
        """Return its value for a rod; ``more`` are quantities that the rod does not hold."""
        known = {**rod.known(), **more}
        return float(self.function(**{name: known[name] for name in self.takes}))


FORMULAS: dict[str, Formula] = {}
"""Every formula by key, in the order of definition."""


def formula(
    text: str,
    *,
    kind: Kind,
    source: str,
    evidence: str,
    holds: str,
    assumes: str = "",
    place: Place | None = None,
    dimension: tuple[int, int] = (1, 0),
    checks: tuple[Check, ...] = (),
    defect: float = 0.0,
) -> Callable[[Function], Function]:
    """Register a function as a formula; its docstring's first line is the formula's name. See :class:`Formula`."""

    def register(function: Function) -> Function:
        name = (function.__doc__ or "").partition("\n")[0].rstrip(".")
        key = function.__name__

        def violations(rod: FormulaInputs) -> list[str]:
            return [reason for check in checks for reason in check(rod)]

        FORMULAS[key] = Formula(
            key, name, text, kind, place, dimension, source, evidence, holds, assumes, function, violations, defect
        )
        arguments = "\n".join(
            f"    {symbol}: {SYMBOLS[symbol][2]}" for symbol in inspect.signature(function).parameters
        )
        notes = f"{name}.\n\n    {text}\n\nHolds: {holds}.\nAssumes: {assumes or 'nothing further'}.\n"
        notes += f"Source: {source}.\nEvidence: {evidence}.\n"
        if place:
            notes += f"Compression positive, measured at the {place}.\n"
        function.__doc__ = f"{notes}\nCoherent units; arguments:\n\n{arguments}\n"
        return function

    return register


def inclined(rod: FormulaInputs) -> list[str]:
    """A lateral weight is needed."""
    return [] if rod.lateral > 0.0 else ["no lateral weight (vertical or weightless): the formula gives nothing"]


def pressed(rod: FormulaInputs) -> list[str]:
    """Weight must press the rod to the wall."""
    return [] if rod.pressed or rod.lateral == 0.0 else ["weight does not press the rod to the wall"]


LONG = 37.2


def long(rod: FormulaInputs) -> list[str]:
    """The criterion for a long pipe, with the lateral weight for w."""
    if rod.lateral == 0.0:
        return []
    least = LONG * (rod.B * rod.r / rod.lateral) ** 0.25
    return [f"not long: L is {plain(rod.L / least, 2)} of 37.2 ∜(B r/(w sin α))"] if least > rod.L else []


AXIAL_PART = 0.1
"""Axial weight above this part of the sinusoidal load is not "ignored": our reading of "axial weight ignored"."""


def light(rod: FormulaInputs) -> list[str]:
    """Axial weight must be small against the load."""
    load = 2.0 * math.sqrt(rod.B * rod.lateral / rod.r)
    if rod.axial <= AXIAL_PART * load:
        return []
    size = f"{plain(rod.axial / load, 2)} times the sinusoidal load" if load > 0.0 else "all there is"
    return [f"axial weight, which the formula ignores, is {size}"]


def vertical(rod: FormulaInputs) -> list[str]:
    """The hole must be vertical."""
    return [] if rod.alpha == 0.0 else [f"for a vertical hole, α is {plain(rod.alpha)}°"]


def horizontal(rod: FormulaInputs) -> list[str]:
    """The hole must be horizontal."""
    return [] if rod.alpha == 90.0 else [f"for a horizontal hole, α is {plain(rod.alpha)}°"]


def ends_are(first: str, last: str) -> Check:
    """Return a check of the end conditions at s = 0 and s = 1."""

    def check(rod: FormulaInputs) -> list[str]:
        if rod.ends == (first, last):
            return []
        return [f"for ends {first}–{last}, the rod's are {'–'.join(rod.ends)}"]

    return check


def sine(alpha: Value) -> float:
    """Sine of an angle in degrees, exactly 1 at 90; angles with units (pint) in their own."""
    degrees = alpha.to("degree").magnitude if hasattr(alpha, "magnitude") else alpha
    return math.sin(math.radians(degrees))
