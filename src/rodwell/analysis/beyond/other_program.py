"""The other program of ``verify`` off the wall: balance of forces and moments in space, by ``scipy``'s ``solve_bvp``.

With the tangent t, internal force n, N(s) = n·k known, weight wl i + wa k, and the torque −T₁ about the tangent (the
sign of T₁ is the paper's), of unit stiffness,

    t″ = −n + (t·n − |t′|²) t − T₁ t × t′,    n′ = wl i + wa k + p d₁,

p = 0 in a gap; in contact r = Δ takes the place of the equation across the wall, which then gives p. Each stretch is a
boundary-value problem of its own on [0, 1], all are solved side by side, and the ends of stretches are unknowns: at
each of them place, tangent and curvature are continuous, and so is the force around the hole; that across the wall
jumps by the concentrated force. It shares neither energy nor elements nor Newton's method with the engine.

Across the hole lengths are in Δ: a gap has (X, Y, X′, Y′, X″, Y″, ν_x, ν_y), ν = n/Δ; a stretch in contact
(φ, φ′, φ″, ν_u), φ the angle around the hole from its bottom and u = (sin φ, cos φ) the direction around it;
e = (−cos φ, sin φ) points to the wall.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.errors import InputError
from rodwell.numerics.stretches.carry import fields_at, sampler
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

FREE, TOUCHING = 8, 4
"""Variables of a gap, and of a stretch in contact."""

PLACES = 17
"""Places of each stretch at which the start is sampled."""

FIRST_NODES, MOST_NODES = 1_000, 20_000
"""Mesh points of each stretch for a first, loose solution, and at most."""

ENDS = ("clamped", "pinned")
"""Ends whose conditions it knows."""


class Again(NamedTuple):
    """A state by the other program: fields at places, ends of stretches, concentrated forces there, what it says."""

    fields: dict[str, FloatArray]
    breaks: FloatArray
    forces: FloatArray
    nodes: int
    residual: float
    message: str


def check_known(problem: Problem) -> None:
    """Raise if the other program does not know a problem off the wall."""
    if problem.sections:
        raise InputError("sections", f"{len(problem.sections)} of them", "must be left out: states off the wall are "
                         "solved once more of uniform rods")  # fmt: skip
    if any(end not in ENDS for end in problem.ends):
        raise InputError("ends", "-".join(problem.ends), "must be clamped or pinned: states off the wall are solved "
                         "once more between such ends")  # fmt: skip


def solved_again(start: PatternedState, force: float, rtol: float, places: FloatArray) -> Again:
    """Solve a state of a pattern at an end force from another one of the same pattern; fields at ``places`` (k,)."""
    from scipy.integrate import solve_bvp  # noqa: PLC0415 - slow to import

    chain = _Chain(start.problem, start.pattern.touching, force, start.pattern.turns)
    guess, breaks = chain.guess(start)
    t = np.linspace(0.0, 1.0, PLACES)
    found = solve_bvp(chain.rates, chain.conditions, t, guess, p=breaks, tol=1e-4, max_nodes=FIRST_NODES)
    if found.status == 0:
        more = {"p": found.p, "tol": rtol, "max_nodes": MOST_NODES}
        found = solve_bvp(chain.rates, chain.conditions, found.x, found.y, **more)
    nodes, residual = found.x.size * len(chain.touching), float(np.max(found.rms_residuals))
    return Again(
        chain.fields(found.sol, found.p, places), found.p, chain.jumps(found.sol, found.p), nodes, residual,
        found.message,
    )  # fmt: skip


class _Part(NamedTuple):
    """Vectors at places of a stretch, in (e, u, k) where in contact, else (x, y, k): place, t, t′, n, and p."""

    place: FloatArray
    tangent: FloatArray
    bend: FloatArray
    force: FloatArray
    pressure: FloatArray


@dataclass(frozen=True)
class _Chain:
    """Stretches of a state side by side."""

    problem: Problem
    touching: tuple[bool, ...]
    force: float
    turns: float

    @property
    def slices(self) -> list[slice]:
        """Where the variables of each stretch stand."""
        ends = np.cumsum([0, *(TOUCHING if on else FREE for on in self.touching)])
        return [slice(a, b) for a, b in pairwise(ends)]

    @property
    def torque(self) -> float:
        """What the rod carries about its tangent."""
        return -self.problem.twist

    def _tension(self, s: FloatArray) -> FloatArray:
        """N(s), in B/L²."""
        return self.force + self.problem.axial_weight * (s - 1.0)

    def rates(self, t: FloatArray, x: FloatArray, breaks: FloatArray) -> FloatArray:
        """Derivatives of all variables (m, k) by the places t (k,) in the stretches."""
        bounds, out = np.concatenate([[0.0], breaks, [1.0]]), np.empty_like(x)
        for i, (on, rows) in enumerate(zip(self.touching, self.slices, strict=True)):
            length = bounds[i + 1] - bounds[i]
            rate = self._in_contact if on else self._in_gap
            out[rows] = length * rate(x[rows], self._tension(bounds[i] + length * t))
        return out

    def _in_gap(self, v: FloatArray, n: FloatArray) -> FloatArray:
        d, torque = self.problem.clearance, self.torque
        _, _, x1, y1, x2, y2, fx, fy = v
        z1 = np.sqrt(1.0 - d**2 * (x1**2 + y1**2))
        z2 = -(d**2) * (x1 * x2 + y1 * y2) / z1
        along = d**2 * (x1 * fx + y1 * fy) + z1 * n - d**2 * (x2**2 + y2**2) - z2**2
        x3 = -fx + along * x1 + torque * (y1 * z2 - z1 * y2)
        y3 = -fy + along * y1 + torque * (z1 * x2 - x1 * z2)
        return np.array([x1, y1, x2, y2, x3, y3, 0.0 * fx + self.problem.lateral_weight / d, 0.0 * fy])

    def _in_contact(self, v: FloatArray, n: FloatArray) -> FloatArray:
        d = self.problem.clearance
        angle, rate, bend, _ = v
        z1, z2, third = self._third(v, n)
        outward = 3.0 * rate * bend + self.torque * (z1 * bend - rate * z2)
        return np.array([rate, bend, third, self.problem.lateral_weight / d * np.sin(angle) - rate * outward])

    def _third(self, v: FloatArray, n: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """z′, z″ and φ‴ in contact."""
        d = self.problem.clearance
        _, rate, bend, around = v
        z1 = np.sqrt(1.0 - d**2 * rate**2)
        z2 = -(d**2) * rate * bend / z1
        along = d**2 * rate * around + z1 * n - d**2 * (bend**2 + rate**4) - z2**2
        return z1, z2, rate**3 - around + along * rate + self.torque * z1 * rate**2

    def _part(self, on: bool, v: FloatArray, s: FloatArray) -> _Part:
        """Vectors at places s (k,) of a stretch."""
        d, n, none = self.problem.clearance, self._tension(s), np.zeros(s.size)
        if not on:
            x, y, x1, y1, x2, y2, fx, fy = v
            z1 = np.sqrt(1.0 - d**2 * (x1**2 + y1**2))
            z2 = -(d**2) * (x1 * x2 + y1 * y2) / z1
            place, force = np.array([x, y, none]), np.array([d * fx, d * fy, n])
            return _Part(place, np.array([d * x1, d * y1, z1]), np.array([d * x2, d * y2, z2]), force, none)
        angle, rate, curl, around = v
        z1, z2, third = self._third(v, n)
        torque = self.torque
        outward = 3.0 * rate * curl + torque * (z1 * curl - rate * z2)
        z3 = -(d**2 * (curl**2 + rate * third) + z2**2) / z1
        growth = 3.0 * (curl**2 + rate * third) + torque * (z1 * third - rate * z3)
        pressure = -(d * (growth - rate * around) + self.problem.lateral_weight * np.cos(angle))
        e, u = np.array([-np.cos(angle), np.sin(angle), none]), np.array([np.sin(angle), np.cos(angle), none])
        k = np.array([none, none, none + 1.0])
        return _Part(
            e, d * rate * u + z1 * k, d * curl * u - d * rate**2 * e + z2 * k,
            d * (outward * e + around * u) + n * k, pressure,
        )  # fmt: skip

    def conditions(self, first: FloatArray, last: FloatArray, breaks: FloatArray) -> FloatArray:
        """What must vanish: at both ends of the rod, and where stretches meet."""
        out = [*self._end(first[self.slices[0]], 0), *self._end(last[self.slices[-1]], 1)]
        for i, s in enumerate(breaks):
            place = np.array([s])
            sides = (last[self.slices[i]], i), (first[self.slices[i + 1]], i + 1)
            left, right = (self._part(self.touching[k], v[:, None], place) for v, k in sides)
            wall, around = self._directions(i, left, right)
            for one, other, size in ((left.place, right.place, 1.0), (left.tangent, right.tangent, self.d),
                                     (left.bend, right.bend, self.d)):  # fmt: skip
                out += [float(v @ (other - one)[:, 0]) / size for v in (wall, around)]
            out.append(float(around @ (right.force - left.force)[:, 0]) / self.d)
            if not (self.touching[i] or self.touching[i + 1]):  # a point of contact
                out += [float(np.hypot(*left.place[:2, 0])) - 1.0, float(wall @ left.tangent[:, 0]) / self.d]
        return np.array(out)

    @property
    def d(self) -> float:
        """The clearance."""
        return self.problem.clearance

    def _directions(self, i: int, left: _Part, right: _Part) -> tuple[FloatArray, FloatArray]:
        """To the wall and around the hole, at the place of a stretch in contact, or of a point."""
        x, y, _ = (left if self.touching[i] or not self.touching[i + 1] else right).place[:, 0]
        return np.array([x, y, 0.0]) / np.hypot(x, y), np.array([y, -x, 0.0]) / np.hypot(x, y)

    def _end(self, v: FloatArray, end: int) -> list[float]:
        clamped, angle = self.problem.ends[end] == "clamped", 2.0 * np.pi * self.turns * end
        if self.touching[-end]:
            return [float(v[0] - angle), float(v[1] if clamped else v[2])]
        return [float(v[0] + 1.0), float(v[1]), float(v[2]), float(v[3] if clamped else v[5])]

    def guess(self, start: PatternedState) -> tuple[FloatArray, FloatArray]:
        """The variables at even places of the stretches of a state, (m, PLACES), and the ends of stretches."""
        shape, bounds, parts = start.solved.shape, start.bounds, []
        continuous = sampler(shape)
        for i, on in enumerate(self.touching):
            s = np.linspace(bounds[i], bounds[i + 1], PLACES)
            s[0], s[-1] = np.nextafter(s[0], 1.0), np.nextafter(s[-1], 0.0)
            fields, angle = fields_at(shape, s, 4)
            n = self._tension(s)
            if on:
                whole = continuous(s)[1][0]
                parts.append(np.array([whole, angle[1], angle[2], n * angle[1] - angle[3]]))
            else:
                (x, x1, x2, x3), (y, y1, y2, y3) = fields
                parts.append(np.array([x, y, x1, y1, x2, y2, n * x1 - x3, n * y1 - y3]))
        return np.concatenate(parts), np.array(bounds[1:-1])

    def _at(self, dense: Any, breaks: FloatArray, i: int, s: FloatArray) -> _Part:
        bounds = np.concatenate([[0.0], breaks, [1.0]])
        t = (s - bounds[i]) / (bounds[i + 1] - bounds[i])
        return self._part(self.touching[i], dense(t)[self.slices[i]], s)

    def fields(self, dense: Any, breaks: FloatArray, places: FloatArray) -> dict[str, FloatArray]:
        """Fields at places (k,), by their names in states off the wall."""
        owner = np.searchsorted(breaks, places, side="right")
        names = ("x", "y", "curvature", "tension", "contact_pressure")
        out = {name: np.empty(places.size) for name in names}
        for i in np.unique(owner):
            here = owner == i
            part = self._at(dense, breaks, int(i), places[here])
            values = (
                self.d * part.place[0], self.d * part.place[1], np.linalg.norm(part.bend, axis=0),
                np.sum(part.force * part.tangent, axis=0), part.pressure,
            )  # fmt: skip
            for name, value in zip(names, values, strict=True):
                out[name][here] = value
        return out

    def jumps(self, dense: Any, breaks: FloatArray) -> FloatArray:
        """Concentrated forces of the wall on the rod where stretches meet, (breaks,): positive ones push."""
        out = np.empty(breaks.size)
        for i, s in enumerate(breaks):
            place = np.array([s])
            left, right = (self._at(dense, breaks, k, place) for k in (i, i + 1))
            wall, _ = self._directions(i, left, right)
            out[i] = wall @ (right.force - left.force)[:, 0]
        return out
