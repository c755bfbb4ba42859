"""Critical loads and buckling modes of the straight rod."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rodwell.analysis.straight.kept import factors_of, loads_on_mesh, starting_space
from rodwell.analysis.straight.lying_loads import loads_of_lying_rod, value_of
from rodwell.analysis.straight.multiple import close_to_last, equal_to, told_apart
from rodwell.analysis.straight.ramps import axial_contact, loads_on_ramps
from rodwell.analysis.straight.refining import refined_loads
from rodwell.analysis.straight.without_wall import LoadsWithoutWall, WallTouch, loads_without_wall
from rodwell.errors import InputError, checked_whole
from rodwell.faces import Shown, drawn
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.clearances import refuse_bridging
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL, checked_rtol
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.faces import Axes
    from rodwell.quantities.scales import Scales

MOST_MODES = 200

RIGID = 1e-3
"""Wavenumber in rad/L below which a mode does not bend but by round-off."""


@dataclass(frozen=True)
class Mode:
    """A buckling mode of the straight rod.

    Attributes
    ----------
    problem
        The problem that it belongs to.
    number
        1 for the mode met first as compression grows.
    load
        Critical end force F at s = 1 in B/L², tension positive, with the estimate of its error: the difference between
        two nested meshes, plus round-off. Also as ``force`` and ``error``.
    parity
        1 if y(1−s) = y(s), −1 if y(1−s) = −y(s), 0 if the mode has no symmetry (inclined cylinder).
    wavenumber
        √(∫y''²/∫y'²), in rad/L.
    coarse
        Space and coefficients on the coarser of the two meshes, for error estimates of what is derived from the mode.
    space, coefficients
        The mode as a spline; y''(1) > 0, so ω₂(1) < 0: the paper's "downward" branch. At an end that can turn, where
        y''(1) = 0: y'(1) < 0 if it is pinned, y(1) < 0 if it is free.
    together
        Numbers of the modes whose loads cannot be told from this one, which is among them.
    mixed
        Whether this is a direction in which a branch leaves along all of those at once; ``number`` is that of the
        first.
    """

    problem: Problem
    number: int
    load: Value
    parity: int
    wavenumber: float
    space: SplineSpace
    coefficients: FloatArray
    coarse: tuple[SplineSpace, FloatArray]
    together: tuple[int, ...]
    mixed: bool = False

    def __repr__(self) -> str:
        return f"<{self.name.capitalize()} at F = {self.force:.10g} B/L², {self.wavenumber / np.pi:.3g} half waves>"

    @property
    def name(self) -> str:
        """In words: "mode 1", or "modes 1 and 2" of a mixed one."""
        return "modes " + " and ".join(map(str, self.together)) if self.mixed else f"mode {self.number}"

    @property
    def force(self) -> float:
        """Critical end force F at s = 1 in B/L², tension positive."""
        return self.load.value

    @property
    def error(self) -> float:
        """Estimate of its error, in B/L²."""
        return self.load.error

    @property
    def rigid(self) -> bool:
        """Whether the rod turns as a whole, without bending: then the load is 0 exactly; any compression moves it."""
        return self.problem.weight == self.force == 0.0

    def shape(self, s: FloatArray) -> FloatArray:
        """Mode y(s) at ``s`` (m,), scaled to a largest deflection of 1."""
        y = self.space.evaluate(self.coefficients, np.asarray(s, dtype=float), 1)[0]
        fine = self.space.evaluate(self.coefficients, np.linspace(0.0, 1.0, 2001), 1)[0]
        return np.asarray(y / np.max(np.abs(fine)))


class CriticalLoads(tuple[Mode, ...], Shown):
    """Modes of the rod kept on the wall, in the order in which they are met as compression grows."""

    __slots__ = ()

    @property
    def forces(self) -> FloatArray:
        """Critical end forces, (n,), falling (tension positive)."""
        return np.array([mode.force for mode in self])

    @property
    def errors(self) -> FloatArray:
        """Error estimates, (n,)."""
        return np.array([mode.error for mode in self])

    @property
    def without_wall(self) -> LoadsWithoutWall:
        """The first load without the wall's help: :func:`rodwell.loads_without_wall`, computed when asked for."""
        return loads_without_wall(self[0].problem)

    @property
    def first_met(self) -> Mode | WallTouch:
        """The mode that the straight rod at the wall meets first: the load with the wall's help.

        It is the first of these where lateral weight presses the rod to the wall, or where no twist acts. A twisted rod
        that nothing presses is free to move inwards, and does so at less compression.
        """
        problem = self[0].problem
        if problem.lateral_weight > 0.0 or problem.twist == 0.0 or problem.hole is not None:
            return self[0]
        touch = self.without_wall.at_wall
        assert touch is not None
        return touch

    @property
    def axial_contact(self) -> float:
        """How much the wall pushes the rod along the hole at the first load, towards s = 1 negative, in B/L².

        0 where the clearance is constant: see :func:`rodwell.analysis.straight.ramps.axial_contact`.
        """
        return axial_contact(self[0].problem, self[0].force) if self[0].problem.ramps else 0.0

    def plot(self, ax: Axes | None = None, *, scales: Scales | None = None, most: int = 4) -> Axes:
        """Draw the first ``most`` modes y(s), each scaled to a largest deflection of 1; return the axes.

        ``ax`` and ``scales`` as in :meth:`rodwell.Branch.plot`.
        """
        return drawn(self, ax, scales=scales, most=most)


def critical_loads(problem: Problem, count: int = 5, *, rtol: float = RTOL) -> CriticalLoads:
    """Critical end forces of the straight rod and its buckling modes, from (64) and its ends, (65) if clamped.

    Parameters
    ----------
    problem
        The rod. It is kept on the wall, so ``twist`` does not enter (paper, section 4.2). Where no lateral weight
        presses it to the wall it does: see :attr:`CriticalLoads.first_met` and :attr:`CriticalLoads.without_wall`.
    count
        How many, 1 to 200.
    rtol
        Relative tolerance; the error is judged against abs(F) + γ cos α + 4π² (of sections: their axial weight, and
        4π² over the mean of 1/B(s)).

    Returns
    -------
    CriticalLoads
        Modes in the order in which they are met as compression grows: force falling, tension positive. Where the
        clearance varies, those at which the wall presses the rod everywhere.

    Raises
    ------
    InputError
        If ``count`` or ``rtol`` is out of range, ``problem.turns`` is not 0 (a coiled rod is not straight), or the wall
        would have to pull the rod where the clearance varies.
    NotConvergedError
        If the tolerance cannot be met.
    """
    rtol, count = checked_rtol(rtol), checked_whole("modes", count, 1, MOST_MODES)
    refuse_bridging(problem, "critical loads of the straight rod")
    if problem.turns != 0:
        raise InputError("turns", problem.turns, "critical loads are those of the straight rod: turns must be 0")
    if problem.hole is not None or problem.ramps:
        return CriticalLoads(_lying(problem, count, rtol))
    found = refined_loads(
        problem,
        starting_space(problem, count),
        count,
        rtol,
        lambda space, start: loads_on_mesh(problem, space, count, start),
    )
    finer, space, factors = found.space, found.coarse_space, factors_of(problem, found.space)
    few = close_to_last(found.loads, count)
    better, shapes = told_apart(finer, factors, found.loads[:few], found.vectors, symmetric=problem.symmetric)
    _, vectors = told_apart(
        space, factors_of(problem, space), found.coarse_loads[:few], found.coarse_vectors, symmetric=problem.symmetric
    )
    error = np.append(found.errors, np.full(few - count, found.errors[-1]))
    return CriticalLoads(
        _mode(problem, finer, equal_to(better, error, i), i + 1, Value(-float(better[i]), float(error[i])), shapes[i],
              (space, vectors[i]))
        for i in range(int(count))
    )  # fmt: skip


def tensile_loads(problem: Problem, count: int = 5, *, rtol: float = RTOL) -> CriticalLoads:
    """Critical end forces at which a rod that lies along a curved hole is lost in tension; none in a straight hole.

    Tension presses the rod to the inside of the curve: one that lies on the outside would have to be pulled to the wall
    there, see :func:`rodwell.analysis.straight.lying.least_contact`; it has left the wall before. Loads beyond
    a million times the scale of loads count as none.

    Parameters
    ----------
    problem, count, rtol
        As for :func:`critical_loads`.

    Returns
    -------
    CriticalLoads
        At most ``count`` modes in the order in which they are met as tension grows: force rising, tension positive.

    Raises
    ------
    InputError, NotConvergedError
        As :func:`critical_loads` does.
    """
    refuse_bridging(problem, "critical loads of the straight rod")
    rtol, count = checked_rtol(rtol), checked_whole("modes", count, 1, MOST_MODES)
    return CriticalLoads(() if problem.hole is None else _lying(problem, count, rtol, tension=True))


def _lying(problem: Problem, count: int, rtol: float, tension: bool = False) -> list[Mode]:
    """Modes of a rod that lies along a curved hole, or on a wall whose clearance varies."""
    found = loads_on_ramps(problem, count, rtol) if problem.ramps else loads_of_lying_rod(problem, count, rtol, tension)
    if found is None:
        return []
    loads = [value_of(found, i) for i in range(len(found.vectors))]
    forces, errors = np.array([load.value for load in loads]), np.array([load.error for load in loads])
    return [
        _mode(problem, found.space, equal_to(forces, errors, i), i + 1, loads[i], shape,
              (found.coarse_space, found.coarse_vectors[i]))
        for i, shape in enumerate(found.vectors)
    ]  # fmt: skip


def _sense(problem: Problem, space: SplineSpace, vector: FloatArray) -> float:
    """What tells the arms of a mode apart: y''(1), or, where that vanishes, −y'(1) if pinned, −y(1) if free."""
    y, slope, bend = space.evaluate(vector, np.array([1.0]), 3)[:, 0]
    return float({"pinned": -slope, "ball": -slope, "free": -y, "loose": -y}.get(problem.ends[1], bend))


def _mode(
    problem: Problem,
    space: SplineSpace,
    together: tuple[int, ...],
    number: int,
    load: Value,
    vector: FloatArray,
    coarse: tuple[SplineSpace, FloatArray],
) -> Mode:
    parity = 0
    if problem.symmetric:
        parity = 1 if vector @ vector[::-1] > 0.0 else -1
        vector = 0.5 * (vector + parity * vector[::-1])
    if _sense(problem, space, vector) < 0.0:
        vector = -vector
    wavenumber = space.wavenumber(vector)
    load = Value(0.0, load.error) if problem.weight == 0.0 and wavenumber < RIGID else load
    return Mode(problem, number, load, parity, wavenumber, space, vector, coarse, together)
