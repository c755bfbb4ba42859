"""The other program of ``verify``: the paper's system solved by ``scipy.integrate.solve_bvp``.

Of a string, each section has its own fifteen variables, with forces and moments in units of its stiffness (that in its
middle, if it tapers), on the same interval from 0 to 1. At a step everything is continuous but λ, since b ω₃ is not:
M₃ = λ + b ω₃ + … of (39) is.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from rodwell.analysis.state.certificate import AT_FIRST_END, LOADS, in_units, load_of, own_units
from rodwell.analysis.state.fields import GRID
from rodwell.errors import InputError
from rodwell.physics.on_wall import equations
from rodwell.physics.on_wall.equations import NAMES, Fifteen, Load
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

MOST_NODES = 50_000

MOST_SECTIONS = 6
"""Sections of a string that the other program is given: its cost grows with the square of their number."""

Guess = tuple[FloatArray, FloatArray]
"""Places (m,), and the fifteen variables there (15, m)."""

Dense = Callable[[FloatArray], FloatArray]
"""A solution as a function (15, m) of places (m,)."""

COUNT = len(NAMES)
FORCES = [name in LOADS for name in Fifteen._fields]
LAMBDA, OMEGA2, OMEGA3 = (Fifteen._fields.index(name) for name in ("lam", "omega2", "omega3"))


def takes(problem: Problem) -> bool:
    """Whether the other program solves states of a problem: in straight holes of one clearance, of few sections."""
    return problem.hole is None and not problem.ramps and len(problem.sections) <= MOST_SECTIONS


def most_sections(problem: Problem) -> None:
    """Raise where a string has more sections than the other program is given."""
    if len(problem.sections) > MOST_SECTIONS:
        raise InputError(
            "sections",
            len(problem.sections),
            f"a string is solved once more with at most {MOST_SECTIONS} sections; the certificate holds for any number",
        )


def solve_again(problem: Problem, force: float, start: Guess, rtol: float) -> tuple[int, float, Dense, str]:
    """Mesh points, largest relative residual, the solution as a function (15, m) of s, and the program's message."""
    load = load_of(problem, force)
    if problem.sections:
        return _Stacked(problem, load).solve(start, rtol)

    def conditions(first: FloatArray, last: FloatArray) -> FloatArray:
        ends = equations.end_conditions(Fifteen(*first), Fifteen(*last), load)
        return np.array([condition.residual for condition in ends.values()])

    result = _solved(lambda s, x: equations.rates(x, load), conditions, start, rtol)
    return result.x.size, float(np.max(result.rms_residuals)), result.sol, result.message


def _solved(rates: Any, conditions: Any, start: Guess, rtol: float) -> Any:
    from scipy.integrate import solve_bvp  # noqa: PLC0415 - slow to import

    # a loose solution first: the mesh then grows where the solution, not the start, needs it
    result = solve_bvp(rates, conditions, *start, tol=1e-4, max_nodes=MOST_NODES)
    if result.status == 0 and rtol < 1e-4:
        result = solve_bvp(rates, conditions, result.x, result.y, tol=rtol, max_nodes=MOST_NODES)
    return result


def _at_one_place(load: Load) -> Load:
    """A load with numbers in place of arrays of one."""
    varied = ("force", "twist", "axial_weight", "lateral_weight", "C", "stiffness_rate", "stiffness_bend")
    single: dict[str, Any] = {name: float(np.squeeze(getattr(load, name))) for name in varied}
    return load._replace(**single)


class _Stacked:
    """The sections of a string side by side: (15 n) variables on [0, 1], each section in its own units."""

    def __init__(self, problem: Problem, load: Load) -> None:
        self.problem, self.whole, self.rod = problem, load, problem.rod
        self.tapers = [any(isinstance(ratio, tuple) for ratio in section) for section in problem.sections]
        self.breaks, self.lengths = problem.rod.breaks, np.diff(problem.rod.breaks)
        middles = 0.5 * (self.breaks[1:] + self.breaks[:-1])
        each = [own_units(problem, load, middles[[i]]) for i in range(middles.size)]
        self.b = [float(np.squeeze(b)) for b, _ in each]
        self.loads = [_at_one_place(own) for _, own in each]
        self.scale = np.array([[b if is_load else 1.0 for is_load in FORCES] for b in self.b])[:, :, None]
        self.at_ends = [[self._own(i, np.array([t])) for i in range(len(self.b))] for t in (0.0, 1.0)]

    def _own(self, i: int, t: FloatArray) -> tuple[float | FloatArray, Load]:
        """Stiffness at places t (m,) of a section in units of the section's, and loads in units of that stiffness."""
        if not self.tapers[i]:
            return 1.0, self.loads[i]
        s = np.minimum(self.breaks[i] + self.lengths[i] * t, np.nextafter(self.breaks[i + 1], 0.0))
        b, load = own_units(self.problem, self.whole, s)
        return b / self.b[i], load

    def rates(self, t: FloatArray, x: FloatArray) -> FloatArray:
        parts, out = x.reshape(len(self.b), COUNT, -1), []
        for i, (part, length) in enumerate(zip(parts, self.lengths, strict=True)):
            b, load = self._own(i, t)
            unit = np.where(np.array(FORCES)[:, None], b, 1.0)
            out.append(length * unit * equations.rates(part / unit, load))
        return np.concatenate(out)

    def conditions(self, first: FloatArray, last: FloatArray) -> FloatArray:
        first, last = first.reshape(-1, COUNT), last.reshape(-1, COUNT)
        outer_ends = (first[0], *self.at_ends[0][0]), (last[-1], *self.at_ends[1][-1])
        ends = [in_units(Fifteen(*x), float(np.squeeze(b))) for x, b, _ in outer_ends]
        there = [equations.end_conditions(ends[0], ends[1], _at_one_place(load)) for _, _, load in outer_ends]
        outer = [there[0 if name in AT_FIRST_END else 1][name].residual for name in there[0]]
        above, below = self._continuous(first, 0), self._continuous(last, 1)
        return np.concatenate([outer, (above[1:] - below[:-1]).ravel()])

    def _continuous(self, x: FloatArray, end: int) -> FloatArray:
        """What is continuous at steps, (n, 15), at an end of each section: forces, moments, b ω₂, λ + b ω₃, others."""
        out = x * self.scale[:, :, 0]
        b = np.array([own * float(np.squeeze(part)) for own, (part, _) in zip(self.b, self.at_ends[end], strict=True)])
        out[:, LAMBDA] += b * x[:, OMEGA3]
        out[:, OMEGA2] *= b
        return np.asarray(out)

    def solve(self, start: Guess, rtol: float) -> tuple[int, float, Dense, str]:
        places, values = start
        t = np.linspace(0.0, 1.0, max(11, places.size // len(self.b)))
        guess = []
        for i, length in enumerate(self.lengths):
            s = self.breaks[i] + length * t
            guess.append(np.array([np.interp(s, places, row) for row in values]) / self.scale[i])
        result = _solved(self.rates, self.conditions, (t, np.concatenate(guess)), rtol)

        def dense(s: FloatArray) -> FloatArray:
            piece = self.rod.stiffness.piece_of(s)
            out = np.empty((COUNT, s.size))
            for i in np.unique(piece):
                here = piece == i
                x = result.sol((s[here] - self.breaks[i]) / self.lengths[i])
                out[:, here] = x[COUNT * i : COUNT * (i + 1)] * self.scale[i]
            return out

        return result.x.size * len(self.b), float(np.max(result.rms_residuals)), dense, result.message


def highest_pressure(problem: Problem, force: float, dense: Dense) -> float:
    """Largest p₂⁽¹⁾ over s (smallest, for a rod outside), by (55), refined between the places of a fine grid."""
    from scipy.optimize import minimize_scalar  # noqa: PLC0415

    side, whole, steps = -1.0 if problem.outside else 1.0, load_of(problem, force), problem.rod.breaks

    def pressure(s: FloatArray) -> FloatArray:
        b, load = own_units(problem, whole, s)
        return np.asarray(side * b * sum(equations.strands(in_units(Fifteen(*dense(s)), b), load).p))

    below = np.concatenate([np.nextafter(steps[1:-1], 0.0), [1.0]])
    s = np.union1d(np.linspace(0.0, 1.0, 10 * GRID), np.concatenate([steps, below[:-1]]))
    values = pressure(s)
    i = int(np.argmax(values))
    piece = int(problem.rod.stiffness.piece_of(s[[i]])[0])
    low, high = max(s[max(i - 1, 0)], steps[piece]), min(s[min(i + 1, s.size - 1)], below[piece])
    highest = minimize_scalar(
        lambda x: -float(pressure(np.array([x]))[0]), bounds=(low, high), method="bounded", options={"xatol": 1e-9}
    )
    return max(float(values[i]), -float(highest.fun))
