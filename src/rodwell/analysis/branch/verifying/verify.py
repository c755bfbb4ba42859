"""A second opinion: the paper's fifteen-dimensional boundary-value problem by another method and another program.

SciPy's ``solve_bvp`` (collocation with cubic polynomials on an adaptive mesh, residual control) solves (22)–(27),
(32)–(36), (41)–(44) with (B1)–(B15) as stated in :mod:`rodwell.physics.on_wall.equations`. It shares neither energy nor
spline nor Newton's method with the engine, and it does not start from the engine's answer but from the state at another
load, sampled coarsely: what agrees afterwards was found twice. States off the wall are solved once more by
:mod:`rodwell.analysis.beyond.other_program`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.tracing import Progress
from rodwell.analysis.branch.verifying.off_wall import compared
from rodwell.analysis.branch.verifying.other_program import Dense, Guess, highest_pressure, most_sections, solve_again
from rodwell.analysis.state.fields import GRID
from rodwell.errors import InputError, NotConvergedError, checked_number
from rodwell.physics.on_wall.equations import NAMES
from rodwell.problem.clearances import refuse_ramps
from rodwell.quantities.arrays import FloatArray

RTOL = 1e-8
"""Relative residual that ``solve_bvp`` is asked for, and the tolerance of agreement."""

FINEST, COARSEST = 1e-10, 1e-3

START_NODES = 41
"""Places at which the start is sampled."""

ELSEWHERE = 0.05
"""The start is the state at a load this part of the way back to the critical load."""

SMALL = 1e-3
"""A field smaller than this part of its kind (forces, moments, angles, curvatures) is compared with that."""

SECANT_STEPS = 12
AWAY, PART = 0.01, 0.2
"""The search for lift-off starts this part of the load away from the engine's answer, or this part of the way back to
the start of the branch, if that is less."""

_KINDS = {
    "braid_F1": ("braid_F2", "braid_F3"),
    "braid_M2": ("braid_M1", "braid_M3", "T2", "lambda", "mu"),
    "xi2": ("xi1", "eta"),
    "omega2": ("omega3",),
}
"""The leading field of each kind, and the others of it."""


@dataclass(frozen=True)
class Verified:
    """One state by both programs.

    Attributes
    ----------
    force
        End force F at s = 1 in B/L², tension positive.
    differences
        Largest difference of each field over s, relative to the field's largest value (of what it is the difference
        of, where it vanishes), by name.
    tolerance
        Up to which differences count as agreement: the residual that the other program was asked for, and found.
    nodes
        Mesh points that the other program needed.
    residual
        Its largest relative residual.
    message
        What it says about its convergence.
    off_wall
        Whether the rod has left the wall: then "ends of stretches" (in L) and "concentrated forces" are compared too.
    known
        Errors that the engine itself gives fields off the wall, relative like the differences: where one is larger than
        the tolerance, differences up to it count as agreement.
    """

    force: float
    differences: dict[str, float]
    tolerance: float
    nodes: int
    residual: float
    message: str
    off_wall: bool = False
    known: dict[str, float] = field(default_factory=dict)

    @property
    def worst(self) -> str:
        """Name of the field that agrees least."""
        return max(self.differences, key=lambda name: self.differences[name])

    @property
    def agrees(self) -> bool:
        """Whether the other program converged, and every field agrees within the tolerance."""
        allowed = {name: max(self.tolerance, self.known.get(name, 0.0)) for name in self.differences}
        near = all(size <= allowed[name] for name, size in self.differences.items())
        return self.residual <= 2.0 * self.tolerance and near


@dataclass(frozen=True)
class Verification:
    """Engine against ``solve_bvp``: states along a branch, and the lift-off load.

    Attributes
    ----------
    branch
        The branch that was verified.
    states
        States on it by both programs.
    rtol
        Tolerance of agreement.
    lift_off
        End force at lift-off by engine and by the other program, in B/L²; None without lift-off on the branch.
    """

    branch: Branch
    states: tuple[Verified, ...]
    rtol: float
    lift_off: tuple[float, float] | None = None

    @property
    def lift_off_difference(self) -> float:
        """Relative difference of the lift-off loads; 0 without."""
        if self.lift_off is None:
            return 0.0
        return abs(self.lift_off[1] - self.lift_off[0]) / abs(self.lift_off[0])

    @property
    def agrees(self) -> bool:
        """Whether all states and the lift-off load agree."""
        return all(state.agrees for state in self.states) and self.lift_off_difference <= self.rtol

    def as_dict(self) -> dict[str, Any]:
        """Everything about it, for JSON."""
        return {
            "agrees": self.agrees,
            "rtol": self.rtol,
            "unit": "B/L^2",
            "convention": "end force at s = 1, tension positive",
            "states": [
                {
                    "force": s.force, "agrees": s.agrees, "tolerance": s.tolerance, "message": s.message,
                    "nodes": s.nodes, "residual": s.residual, "differences": s.differences, "off_wall": s.off_wall,
                    "known": s.known,
                }
                for s in self.states
            ],
            "lift_off": None
            if self.lift_off is None
            else {
                "engine": self.lift_off[0],
                "other": self.lift_off[1],
                "relative_difference": self.lift_off_difference,
                "agrees": self.lift_off_difference <= self.rtol,
            },
        }  # fmt: skip


def verify(
    branch: Branch,
    forces: Sequence[float] | None = None,
    *,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> Verification:
    """Solve states of a branch, and its lift-off load, once more with ``scipy.integrate.solve_bvp``.

    Parameters
    ----------
    branch
        A branch in the end force, as from :func:`rodwell.follow`.
    forces
        End forces at s = 1 in B/L², tension positive, at which to compare; by default half way from the start of the
        branch to lift-off (or its end), and its end; of one that goes on off the wall half way on from lift-off.
    rtol
        Relative residual asked of the other program, and the largest relative difference that counts as agreement.
    progress
        Called with the force of each state before it is solved. A state takes some seconds.

    Raises
    ------
    InputError
        If the branch does not run in the end force or does not pass one of the forces.
    NotConvergedError
        If the other program does not converge where lift-off is looked for.
    """
    branch.problem.refuse_curved("branches are held against the other program")
    refuse_ramps(branch.problem, "branches held against the other program")
    if not isinstance(branch, Branch):
        how = "must be a branch, as from follow; of a state, the branch that it is on, with forces=[its end force]"
        raise InputError("branch", branch, how)
    rtol = checked_number("rtol", rtol, FINEST, COARSEST, f"must be between {FINEST:g} and {COARSEST:g}")
    if branch.parameter != "force":
        raise InputError("branch", branch.parameter, "must be a branch in the end force")
    most_sections(branch.problem)
    tell = progress or (lambda _force: None)
    lift = None if branch.lift_off_at_buckling else branch.lift_off
    if forces is None:
        nearest = branch.force[-1] if lift is None else lift.force
        last = float(branch.force[-1])
        if branch.beyond is not None:
            last = 0.5 * (last + float(branch.beyond.force.min()))
        forces = sorted({0.5 * float(branch.force[0] + nearest), last}, reverse=True)
    states = []
    for force in forces:
        tell(force)
        states.append(_state(branch, force, rtol))
    loads = None
    if lift is not None:
        tell(lift.force)
        loads = (lift.force, _lift_off(branch, lift.force, rtol))
    return Verification(branch, tuple(states), rtol, loads)


def _state(branch: Branch, force: float, rtol: float) -> Verified:
    on_wall = bool(branch.force.min() <= force <= branch.force.max())
    if branch.beyond is not None and not on_wall:
        found = compared(branch.beyond, force, rtol)
        again = found.again
        return Verified(
            force, found.differences, rtol, again.nodes, again.residual, again.message, off_wall=True, known=found.known
        )
    state = branch.at(force)
    nodes, residual, dense, message = solve_again(branch.problem, force, _start(branch, force), rtol)
    return Verified(force, _differences(state, dense), rtol, nodes, residual, message)


def _start(branch: Branch, force: float) -> Guess:
    """The engine's state at a load nearer to the start of the branch, coarsely sampled: places and variables there."""
    other = branch.at(force + ELSEWHERE * (float(branch.force[0]) - force))
    s = np.linspace(0.0, 1.0, START_NODES)
    fields = _fields(other, s)
    return s, np.array([fields[name] for name in NAMES])


def _fields(state: Solution, s: FloatArray) -> dict[str, FloatArray]:
    """Fields with ξ₂ counted from where the straight rod lies."""
    fields = state.fields(s)
    fields["xi2"] = fields["y"] / state.problem.clearance
    return fields


def _differences(state: Solution, dense: Dense) -> dict[str, float]:
    """Largest differences over s, relative to the largest value of the field (of its kind, where it is far smaller)."""
    s = np.linspace(0.0, 1.0, GRID)
    fields, other = _fields(state, s), dense(s)
    size = {name: float(np.max(np.abs(fields[name]))) for name in NAMES}
    for leading, rest in _KINDS.items():
        for name in rest:
            size[name] = max(size[name], SMALL * size[leading])
    return {name: float(np.max(np.abs(other[i] - fields[name]))) / (size[name] or 1.0) for i, name in enumerate(NAMES)}


def _lift_off(branch: Branch, near: float, rtol: float) -> float:
    """Load at which the largest contact pressure vanishes, (55) on the other program's states, by the secant method."""
    problem = branch.problem
    guess = _start(branch, near)

    def highest(force: float) -> float:
        nonlocal guess
        nodes, residual, dense, message = solve_again(problem, force, guess, rtol)
        if residual > 2.0 * rtol:
            raise NotConvergedError(f"solve_bvp did not converge near lift-off, at F = {force:.8g} B/L²: {message}")
        s = np.linspace(0.0, 1.0, nodes)
        guess = s, dense(s)
        return highest_pressure(problem, force, dense)

    back = float(branch.force[0]) - near  # not as far as the start of the branch, where there is the straight rod only
    away = float(np.sign(back)) * min(AWAY * abs(near), PART * abs(back))
    forces = [near + away, near + 0.5 * away]
    values = [highest(force) for force in forces]
    for _ in range(SECANT_STEPS):
        step = -values[-1] * (forces[-1] - forces[-2]) / (values[-1] - values[-2])
        forces.append(forces[-1] + step)
        if abs(step) <= 0.1 * rtol * abs(near):
            return forces[-1]
        values.append(highest(forces[-1]))
    raise NotConvergedError(f"the lift-off load did not settle with solve_bvp: last {forces[-1]:.10g} B/L²")
