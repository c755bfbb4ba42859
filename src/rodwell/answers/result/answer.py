"""The answer to a case: what was computed, what it means for strength, and its faces."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any

from rodwell.analysis.branch.exploring import Progress
from rodwell.answers.result.assessment import Assessment
from rodwell.answers.result.assessment_numbers import assessment_numbers
from rodwell.answers.result.computed import Computed, compute
from rodwell.answers.result.key_number import KeyNumber, force_scale
from rodwell.answers.result.key_numbers import (
    critical_length,
    critical_number,
    first_met,
    in_curved_hole,
    not_held,
    real_force,
    rotations,
    state_numbers,
    stress_number,
    without_wall,
)
from rodwell.answers.result.lying import lying_numbers
from rodwell.case.case import Case
from rodwell.faces import Shown, drawn, plain

if TYPE_CHECKING:
    from rodwell.analysis.branch.functionals import Number
    from rodwell.answers.result.beyond import Beyond
    from rodwell.faces import Axes


ARMS = "twist makes the arms differ: the rod may take either"


@dataclass(frozen=True)
class Answer(Computed, Shown):
    """The answer to a case: a record of what was computed, see :class:`Computed` for its fields, and what follows."""

    @cached_property
    def converged(self) -> bool:
        """Whether every reported number meets the tolerance: branches, special points and key numbers."""
        rtol = self.case.rtol
        return (
            all(branch.converged for branch in self.branches)
            and all(key.number.within(rtol, key.scale) for key in self.key_numbers.values())
            and self.assessment.converged
        )

    @cached_property
    def assessment(self) -> Assessment:
        """Stress and safety, the safe window and its limits, the loads that act, formulas beside the exact loads."""
        return Assessment(self)

    @cached_property
    def beyond(self) -> Beyond:
        """What happens beyond lift-off, and as the load is taken off again: computed when first asked for, seconds."""
        from rodwell.answers.result.beyond import beyond  # noqa: PLC0415 - what is on the wall does not wait for it

        return beyond(self)

    @cached_property
    def key_numbers(self) -> dict[str, KeyNumber]:
        """The key numbers by name."""
        out = [critical_number(mode, kept=self.untouched) for mode in self.critical]
        if self.lying is not None:
            out += lying_numbers(self.lying)
        out += [first_met(self.first_met)] if self.untouched else []
        met = out[-1:] if self.untouched else out[:1]
        out += [] if self.without_wall is None else [without_wall(self.without_wall)]
        out += [real for key in met for real in real_force(key, self.case)]
        out += [] if self.untouched else critical_length(self.case.problem)
        load = self.lift_off_load
        if load is not None:
            note, places, label = "", self.lift_off_places, "Lift-off load, end force at s = 1"
            if self.left_before is not None:
                note = "before it buckles: compression presses it away from this side of the hole"
                note = note if self.lying is None else "of the rod as it lies, which does not buckle before"
            elif self.off_at_once:
                note, places = "coincides with buckling: no lateral weight presses the rod to the wall", ()
            out.append(KeyNumber("lift_off_load", label, load, "force", force_scale(load.value), note, places))
            out += real_force(out[-1], self.case)
        other = None if self.other_arm is None else self.other_arm.lift_off
        if other is not None:
            label = "Lift-off load of the other arm, end force at s = 1"
            out.append(KeyNumber("lift_off_load_other_arm", label, other.load, "force", force_scale(other.force), ARMS))
        state = self.shown if self.lying is not None else self.at_lift_off
        if state is not None:
            out += [*state_numbers(state), *rotations(state)]
        out += assessment_numbers(self.assessment)
        if self.case.problem.hole is not None:
            lying = self.assessment.at_rest or self.assessment.at_buckling
            out += in_curved_hole(lying, self.lift_off_at_own_places, self.left_in_tension)
            out += not_held(self.not_held_at_steps)
        elif self.at_lift_off is not None and self.case.cylinder is not None and self.case.scales is not None:
            out.append(stress_number(self.at_lift_off, self.case.cylinder, self.case.scales))
        return {key.name: key for key in out}

    @property
    def figures(self) -> dict[str, KeyNumber]:
        """The old name of :attr:`key_numbers`: a figure is a picture."""
        warnings.warn("Answer.figures is now Answer.key_numbers", DeprecationWarning, stacklevel=2)
        return self.key_numbers

    def plot(self, ax: Axes | None = None, *, ordinate: Number | None = None) -> Axes:
        """Draw the bifurcation diagram in the case's units: see :meth:`rodwell.Branch.plot`; return the axes."""
        return drawn(self, ax, ordinate=ordinate)

    def as_dict(self) -> dict[str, Any]:
        """Return the answer as plain data, for JSON."""
        return plain(self)


def answer(case: Case, progress: Progress | None = None) -> Answer:
    """Compute a case: critical loads, the branch of each mode, lift-off of the first.

    Parameters
    ----------
    case
        The case.
    progress
        Called with what is being done and how much is done.

    Raises
    ------
    NotConvergedError
        If the critical loads cannot be computed, or the first branch cannot be started.
    """
    computed = compute(case, progress)
    return Answer(**{field.name: getattr(computed, field.name) for field in fields(computed)})
