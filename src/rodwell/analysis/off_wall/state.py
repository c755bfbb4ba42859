"""A state of partial contact as users hold it: numbers with errors, fields along the rod, certificate."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.analysis.off_wall.arrange import refined, turns_of
from rodwell.analysis.off_wall.certificate import LIMIT, ContactCertificate, contact_certificate
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.curved.own_places import with_own_places
from rodwell.analysis.off_wall.measured import Numbers, fields_of, left_out, measured
from rodwell.analysis.off_wall.pattern import FINER
from rodwell.analysis.off_wall.soft import aligned
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.stretches.carry import sampler
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Peak, Value

STRAIGHT, SINUSOIDAL, HELIX, PARTIAL = "straight", "sinusoidal", "helix", "partial contact"
BRIDGED, OTHER_SIDE, ON_WALL = "bridged", "along the other side", "on the wall"

MOST_DEGREES = 8
"""By how much the degree of the elements may be raised for a certificate that passes."""

FLAT = 1e-6
"""A rod that lies within this angle, in radians, of the bottom everywhere, in contact, is straight."""


def kind_of(state: PatternedState, turns: int) -> str:
    """What a state is that winds so many times around the hole: see :attr:`ContactState.kind`."""
    if turns:
        return HELIX
    if state.pattern.planar and state.problem.leaves_wall:
        return BRIDGED
    if not state.everywhere or state.problem.in_space:  # there at angles that vary along it, buckled or not
        return ON_WALL if state.everywhere else PARTIAL
    angles = state.solved.shape.nodes[:, 1]
    if state.problem.hole is not None and float(np.ptp(angles)) < FLAT <= float(np.max(np.abs(angles))):
        return OTHER_SIDE
    return STRAIGHT if float(np.max(np.abs(angles))) < FLAT else SINUSOIDAL


@dataclass(frozen=True)
class Gap:
    """A free stretch: from where to where in L, the largest gap in Δ and where."""

    start: Value
    end: Value
    largest: Value
    at: float


@dataclass(frozen=True)
class Contact:
    """A stretch in contact: from where to where in L, and its contact force ∫|p| ds in B/L², without its ends."""

    start: Value
    end: Value
    force: Value


@dataclass(frozen=True)
class PointForce:
    """A concentrated contact force, from the wall on the rod, in B/L², at a place in L.

    ``kind``: "point", a point of contact with gaps on both sides, "end", an end of a stretch in contact, "edge", the
    edge of a narrower part of the hole, "tip", a loose end of the rod that touches the wall, or "kink", one of the
    stiffness within a stretch in contact; there a force below 0 stands for a gap that is too short to count:
    :mod:`rodwell.physics.off_wall.kinks`. ``angle``: of the place around the hole from its bottom, in rad, between −π
    and π (of a rod that floats from its top).
    """

    s: Value
    force: Value
    kind: str
    angle: float = 0.0


@dataclass(frozen=True, eq=False)
class ContactState:
    """An equilibrium of a rod that may leave the wall; all numbers are in units B = L = 1.

    Attributes
    ----------
    problem
        The problem.
    coarse, fine
        The state on elements of two degrees: their difference tells the errors.
    """

    problem: Problem
    coarse: PatternedState
    fine: PatternedState

    def __repr__(self) -> str:
        return f"<ContactState {self.fine.pattern.text()} at F = {self.force:.10g} B/L², {self.kind}>"

    @property
    def force(self) -> float:
        """End force F at s = 1 in B/L², tension positive."""
        return float(self.fine.load)

    @property
    def stability_index(self) -> int:
        """Negative eigenvalues of the second variation under dead loads, with contacts that push kept closed.

        Disturbances of every symmetry count; contacts without force would make it one-sided.
        """
        return self.fine.solved.index

    @property
    def converged(self) -> bool:
        """Whether it passes its certificate."""
        return self.certificate.passed

    @cached_property
    def turns(self) -> int:
        """Whole turns of the end s = 1 around the hole."""
        return turns_of(self.fine.model, sampler(self.fine.solved.shape))

    @cached_property
    def kind(self) -> str:
        """What the state is: "straight", "sinusoidal", "helix" (around the hole), "partial contact" or "bridged".

        Bridged is one in the vertical plane, over steps of the clearance. Of a curved hole "straight" is the rod that
        lies along it, "along the other side" one that does so elsewhere; where that leaves the vertical plane any in
        contact everywhere without a turn is "on the wall".
        """
        return kind_of(self.fine, self.turns)

    @cached_property
    def _numbers(self) -> tuple[Numbers, Numbers]:
        return measured(self.coarse), measured(self.fine)

    def _value(self, name: str, i: int | None = None) -> Value:
        coarse, fine = (getattr(numbers, name) for numbers in self._numbers)
        if i is not None:
            coarse, fine = coarse[i], fine[i]
        return Value(float(fine), float(estimated_error(fine, coarse)))

    @cached_property
    def energy(self) -> Value:
        """Energy relative to the straight rod, in curved holes the undeformed one at the bottom; in B/L."""
        return self._value("energy")

    @cached_property
    def shortening(self) -> Value:
        """Approach of the ends ∫(1 − z′) ds in L: the derivative of the energy by F."""
        return self._value("shortening")

    @cached_property
    def gaps(self) -> tuple[Gap, ...]:
        """Free stretches from s = 0."""
        places = self._numbers[1].gap_places
        return tuple(
            Gap(self._value("bounds", i), self._value("bounds", i + 1), self._value("gaps", i), float(places[i]))
            for i, on in enumerate(self.fine.touching) if not on
        )  # fmt: skip

    @cached_property
    def contacts(self) -> tuple[Contact, ...]:
        """Stretches in contact from s = 0."""
        return tuple(
            Contact(self._value("bounds", i), self._value("bounds", i + 1), self._value("stretches", i))
            for i, on in enumerate(self.fine.touching) if on
        )  # fmt: skip

    @cached_property
    def point_forces(self) -> tuple[PointForce, ...]:
        """Concentrated contact forces from s = 0: at points of contact, edges, both ends of stretches in contact."""
        return tuple(
            PointForce(self._value("point_places", i), self._value("points", i), kind, angle)
            for i, ((_, _, kind), angle) in enumerate(zip(self.fine.point_forces, self._angles, strict=True))
        )

    @cached_property
    def _angles(self) -> list[float]:
        """Angle around the hole at each concentrated force."""
        places = [s for s, _, _ in self.fine.point_forces]
        return [float(one) for one in self.fields(np.array(places))["angle"]] if places else []

    @cached_property
    def contact_total(self) -> Value:
        """All contact forces, distributed and concentrated, added without regard to direction, in B/L²."""
        coarse, fine = (float(np.sum(n.stretches) + np.sum(np.abs(n.points))) for n in self._numbers)
        return Value(fine, float(estimated_error(fine, coarse)))

    @cached_property
    def largest_pressure(self) -> Peak:
        """Largest contact force per length in B/L³, and where; 0 without a stretch in contact."""
        value = self._value("largest_pressure")
        return Peak(value.value, value.error, self._numbers[1].largest_pressure_at)

    @cached_property
    def own_places(self) -> ContactState:
        """The state in a curved hole with every cross-section at its own place along it.

        Paths take the hole where the undeformed rod is: see :mod:`rodwell.analysis.off_wall.curved.own_places`.

        Raises
        ------
        InputError
            If the hole is straight.
        NotConvergedError
            If it could not be solved.
        """
        if self.problem.hole is None:
            raise InputError("build", 0.0, "must not be 0: along a straight hole every place is like another")
        coarse, fine = with_own_places(self.coarse), with_own_places(self.fine)
        if coarse is None or fine is None:
            what = "a limit point is near, or the curvature is too large for this shortening"
            raise NotConvergedError(f"no state with its own places was found at F = {self.force:.8g} B/L²: {what}")
        return ContactState(self.problem, coarse, fine)

    @property
    def place_errors(self) -> dict[str, float]:
        """By how much numbers are off, with the hole where the undeformed rod is, by name; none if it is straight."""
        if self.problem.hole is None:
            return {}
        own, names = self.own_places, ("energy", "shortening", "contact_total")
        return {name: abs(getattr(own, name).value - getattr(self, name).value) for name in names}

    @cached_property
    def left_out(self) -> dict[str, float]:
        """What is left out where the clearance varies: :func:`rodwell.analysis.off_wall.measured.left_out`."""
        return left_out(self.fine) if self.problem.ramps else {}

    @cached_property
    def certificate(self) -> ContactCertificate:
        """Balance of forces, signs of contact, and reactions by two routes."""
        return contact_certificate(self.fine)

    def fields(self, s: FloatArray | int = 201) -> dict[str, FloatArray]:
        """Fields along the rod at ``s`` (k,), or at that many evenly spaced places.

        ``s``; ``x``, ``y`` across the hole in L, the bottom at x = −Δ; ``z`` along it; ``gap`` between rod and wall in
        Δ; ``angle`` around the hole from the bottom in rad, between −π and π; ``curvature`` in 1/L and
        ``bending_moment`` in B/L (equal for a uniform rod); ``tension`` along the rod in B/L²; ``contact_pressure`` p
        in B/L³, negative in contact, without point forces.
        """
        places = np.linspace(0.0, 1.0, s) if isinstance(s, int) else np.asarray(s, dtype=float)
        return {"s": places} | fields_of(self.fine, places)

    def field_errors(self, s: FloatArray) -> dict[str, float]:
        """Error estimates of the fields, the largest at places ``s`` (k,)."""
        coarse, fine = fields_of(self.coarse, s), fields_of(self.fine, s)
        turned = 2.0 * np.pi * np.round((fine["angle"] - coarse["angle"]) / (2.0 * np.pi))
        coarse["angle"] += turned  # π and −π are the same place
        return {name: float(np.max(estimated_error(fine[name], coarse[name]))) for name in fine}

    def as_dict(self) -> dict[str, Any]:
        """Plain data, for JSON."""
        return {
            "force": self.force, "kind": self.kind, "turns": self.turns,
            "energy": self.energy.as_dict(), "stability_index": self.stability_index,
            "gaps": [
                {"from": g.start.as_dict(), "to": g.end.as_dict(), "largest": g.largest.as_dict(), "at": g.at}
                for g in self.gaps
            ],
            "contacts": [
                {"from": c.start.as_dict(), "to": c.end.as_dict(), "force": c.force.as_dict()} for c in self.contacts
            ],
            "point_contacts": [
                {"s": p.s.as_dict(), "force": p.force.as_dict(), "kind": p.kind, "angle": p.angle}
                for p in self.point_forces
            ],
            "contact_total": self.contact_total.as_dict(), "shortening": self.shortening.as_dict(),
            "certificate": self.certificate.as_dict(), **({"left_out": self.left_out} if self.left_out else {}),
        }  # fmt: skip


def contact_state(state: PatternedState) -> ContactState:
    """A state with the same on elements of a higher degree: as high as its certificate needs.

    Raises
    ------
    NotConvergedError
        If Newton's method fails there.
    """
    found: ContactState | None = None
    if state.model.soft:
        state = aligned(state) or state
    for more in range(FINER, MOST_DEGREES + 1, FINER):
        fine = refined(state, more)
        if fine is None:
            break
        finer = ContactState(state.model.problem, state, fine)
        if found is None or finer.certificate.worst < found.certificate.worst:
            found = finer  # in very short stretches round-off grows with the degree
        if found.certificate.worst <= 0.5 * LIMIT:
            break
    if found is None:
        raise NotConvergedError(f"the state at F = {state.load:.8g} B/L² was not found on finer elements")
    return found
