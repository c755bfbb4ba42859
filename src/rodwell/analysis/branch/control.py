"""A branch as it is under another control: the approach of the ends or the rotation of an end in place of the load.

The states are the same whatever is controlled; which of them are stable is not, nor where the controlled quantity turns
back. With E = U + λ A(c), a dead load λ works on A. Where A is held instead, disturbances keep A: the second
variation counts on a subspace of one dimension less, so one negative eigenvalue less if dA/dλ > 0 along the branch, and
as many if dA/dλ < 0 (the inertia of the bordered Hessian, Haynsworth 1968).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.analysis.branch.functionals import Functional, changes_sign, number_of, value_of, value_on
from rodwell.analysis.branch.record import BranchRecord
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import FOLD, SpecialPoint
from rodwell.errors import InputError, checked_number, unknown_name
from rodwell.numerics.equilibria.conjugate import conjugate_rate
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

CONTROLS = {"shortening": "force", "rotation": "twist"}
"""What can be controlled, and the parameter in place of which it is."""


@dataclass(frozen=True)
class Controlled:
    """A branch under a controlled end shortening or end rotation.

    Attributes
    ----------
    branch
        The branch, in the end force (for "shortening") or in the twist (for "rotation").
    control
        "shortening": the approach of the ends 1 − z(1) in L is held, not the end force. "rotation": the rotation of the
        end s = 1 about its axis in rad, positive as T₁ turns it, is held, not the torque.
    """

    branch: BranchRecord
    control: str

    def __post_init__(self) -> None:
        if self.control not in CONTROLS:
            raise unknown_name("control", self.control, CONTROLS)
        if self.branch.parameter != CONTROLS[self.control]:
            needs = CONTROLS[self.control]
            raise InputError("control", self.control, f"needs a branch in {needs}, not in {self.branch.parameter}")

    def __repr__(self) -> str:
        first, last = self.values[0], self.values[-1]
        return f"<Controlled {self.branch.name}: {self.control} = {first:.6g} … {last:.6g}>"

    @cached_property
    def values(self) -> FloatArray:
        """What is controlled at each point, (n,)."""
        return np.array([number.value for number in self._numbers])

    @cached_property
    def errors(self) -> FloatArray:
        """Error estimates of :attr:`values`, (n,)."""
        return np.array([number.error for number in self._numbers])

    @cached_property
    def stability_index(self) -> FloatArray:
        """Negative eigenvalues of the second variation for disturbances that keep what is controlled, (n,)."""
        senses = np.array([point.fine.tangent_lam for point in self.branch.trace.points])
        index = self.branch.stability_index - (self._rates * senses > 0.0)
        if self.branch.origin.switched and len(index) > 1:
            index[0] = index[1]
        return np.asarray(index)

    @cached_property
    def folds(self) -> tuple[SpecialPoint, ...]:
        """Where what is controlled turns back, in order of travel: there the rod snaps under this control."""
        rates = self._rates
        start = 1 if self.branch.origin.switched else 0
        steps = [i for i in range(start, len(rates) - 1) if changes_sign(float(rates[i]), float(rates[i + 1]))]
        return tuple(self._fold(i) for i in steps)

    def states_at(self, value: float) -> tuple[Solution, ...]:
        """Return all states at which what is controlled has a value, in order of travel; none if there are none.

        Raises
        ------
        NotConvergedError
            If a state could not be computed.
        """
        value = checked_number(self.control, value, -1e6, 1e6, "a finite number")
        gaps = self.values - value
        found = []
        for i, gap in enumerate(gaps):
            if gap == 0.0:
                found.append(self.branch[i])
            elif i + 1 < len(gaps) and gap * gaps[i + 1] < 0.0:
                found.append(self._state_within(i, value))
        return tuple(found)

    def _state_within(self, i: int, value: float) -> Solution:
        """The state between points i and i+1 at which what is controlled has a value."""
        branch, number = self.branch, self._number

        def gap(state: Solution) -> float:
            return value_of(state, number) - value

        return branch.zero_between(i, value_on(branch.problem, branch.parameter, branch.trace.meshes[i + 1], gap))[0]

    @cached_property
    def _numbers(self) -> tuple[Value, ...]:
        """What is controlled at each point, with its error."""
        return tuple(number_of(state, self._number) for state in self.branch)

    @cached_property
    def _rates(self) -> FloatArray:
        """Its rate along the branch at each point, (n,): see :meth:`_rate`."""
        return np.array([self._rate(*state.levels[1]) for state in self.branch])

    @property
    def _number(self) -> Functional:
        return _shortening if self.control == "shortening" else _rotation

    def _rate(self, family: Family, state: State) -> float:
        """Rate of A along the tangent: A is the shortening, or minus the rotation, of which T₁ L/C is the rod's own."""
        rate = conjugate_rate(family, state)
        if self.control == "rotation":
            rate -= state.tangent_lam / self.branch.problem.torsional_stiffness
        return rate

    def _fold(self, i: int) -> SpecialPoint:
        solution, error = self.branch.zero_between(i, lambda f, state: self._rate(f.with_exact_tangent(), state))
        index = int(self.stability_index[i]), int(self.stability_index[i + 1])
        reached = Value(solution.point.lam, error)
        return SpecialPoint(FOLD, solution.force, reached, (), *index, solution, i, self.branch.parameter)


def _shortening(state: Solution) -> Value:
    return state.number("end_shortening")


def _rotation(state: Solution) -> Value:
    return state.end_rotation
