"""Reflections of the problem, and what they make of a branch: its images need no computation."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.analysis.discrete.measures import Measured
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter, throughout
from rodwell.quantities.arrays import FloatArray


@dataclass(frozen=True)
class Reflection:
    """y(s) → ±y(s) or ±y(1 − s).

    Attributes
    ----------
    sign
        1, or −1 for the mirror image on the other side of the cylinder.
    turned
        Whether the rod is seen from its other end.
    """

    sign: int
    turned: bool

    @property
    def name(self) -> str:
        """The image in symbols."""
        return ("−" if self.sign < 0 else "") + ("y(1−s)" if self.turned else "y(s)")

    def parity(self) -> int:
        """Parity of the states that it leaves as they are: 1 even, −1 odd, 0 none (the mirror image)."""
        return self.sign if self.turned else 0

    def numbers(self, values: dict[Measured, FloatArray]) -> dict[Measured, FloatArray]:
        """Measured numbers of the image of states, from those of the states."""
        out = dict(values)
        if self.turned:
            out[Measured.OMEGA2_0], out[Measured.OMEGA2_1] = values[Measured.OMEGA2_1], values[Measured.OMEGA2_0]
        for which in ODD:
            out[which] = self.sign * out[which]
        return out


ODD = (Measured.OMEGA2_0, Measured.OMEGA2_1, Measured.ANGLE_MID, Measured.TORQUE_0)
"""Measured numbers that change sign with y."""

IDENTITY = Reflection(1, turned=False)
MIRROR = Reflection(-1, turned=False)
TURNED = Reflection(1, turned=True)
TURNED_MIRROR = Reflection(-1, turned=True)


def reflections(problem: Problem) -> tuple[Reflection, ...]:
    """Reflections under which the problem stays the same, the identity first.

    The twisting moment forbids all but y(s) → −y(1 − s); axial weight or unequal ends forbid to turn the rod round;
    a coil forbids to change one sign alone, and a hole that leaves the vertical plane to change any.
    """
    turnable = problem.symmetric
    plain = problem.twist == 0.0 and problem.turns == 0
    found = [IDENTITY]
    if problem.in_space:
        return (IDENTITY, TURNED) if plain and turnable else (IDENTITY,)
    if plain:
        found.append(MIRROR)
    if plain and turnable:
        found.append(TURNED)
    if turnable:
        found.append(TURNED_MIRROR)
    return tuple(found)


def kept_parity(problem: Problem, parity: int, *parameters: Parameter) -> int:
    """Parity of a state that all of its branch has: a reflection that the problem has, for any value of parameters.

    Equal ends without axial weight: y(s) → ±y(1 − s); with twist the lower sign only, in a hole that leaves the
    vertical plane the upper one.
    """
    along = throughout(problem, *parameters)
    if not all(one.symmetric for one in along):
        return 0
    if parity < 0 and any(one.in_space for one in along):
        return 0
    return 0 if parity > 0 and any(one.twist != 0.0 for one in along) else parity


def arms_alike(problem: Problem, parity: int) -> bool:
    """Whether a reflection makes one arm of a branch that leaves the straight rod of the other.

    ``parity`` is that of its states, 0 if they have none.
    """
    return any(r.sign * (parity if r.turned else 1) < 0 for r in reflections(problem))


def arms_differ(problem: Problem, parity: int) -> bool:
    """Whether the two arms of a mode of this parity are no images of each other, of a rod pressed to the wall.

    Where nothing presses it to the wall it leaves the wall as it buckles, whichever arm it takes.
    """
    return not problem.untouched and not arms_alike(problem, parity)


def images(problem: Problem, parity: int) -> tuple[Reflection, ...]:
    """Reflections that give different branches from one whose states have a parity (0: none), the identity first."""
    out: list[Reflection] = []
    seen: set[tuple[int, int]] = set()
    for r in reflections(problem):
        # a state of parity π is the same under (sign, turned) and (π sign, not turned)
        key = (r.sign * parity, 0) if r.turned and parity != 0 else (r.sign, int(r.turned))
        if key not in seen:
            seen.add(key)
            out.append(r)
    return tuple(out)
