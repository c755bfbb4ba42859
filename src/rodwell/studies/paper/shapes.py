"""Shapes along the rod: Fig. 4, 7 and 8."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.diagram import diagram
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.errors import NotConvergedError
from rodwell.quantities.value import Value
from rodwell.studies.paper.claims import FORMULA, Claim
from rodwell.studies.paper.work import Work, rod

BETWEEN = 9
"""States drawn between the two modes of Fig. 4."""

FIG7 = ((40.0, -200.0), (140.0, -300.0))
"""γ and F of the rows of Fig. 7."""

FIG7_ALPHAS = (90.0, 60.0, 30.0, 0.0)

FIG8 = ((60.0, None), (30.0, None), (0.0, -2400.0))
"""α and F of Fig. 8, None for lift-off; γ = 140."""


@dataclass(frozen=True)
class Shape:
    """A state and what it is called in the figure."""

    label: str
    state: Solution


def fig4(work: Work) -> tuple[Solution, ...]:
    """States along the non-symmetric branch of Fig. 3(c), from the first mode's bifurcation to the second mode's.

    Of the images of the branch, the one that starts on the arm ω₂(1) < 0 of mode 1 ("the lower branch").
    """
    whole = diagram(rod(15.0), modes=2, until=-400.0, rtol=work.rtol, largest_step=0.03)
    branch = whole["secondary 1"]
    if branch.numbers(Measured.OMEGA2_1)[0] > 0.0:
        raise NotConvergedError("the branch without symmetry leaves the other arm of mode 1")
    return tuple(branch[i] for i in _evenly(branch, BETWEEN + 2))


def _evenly(branch: Branch, count: int) -> list[int]:
    """Points about evenly spaced in ω₂(1), which goes to 0 along the branch; the first and the last among them."""
    curvature = branch.numbers(Measured.OMEGA2_1)
    wanted = np.linspace(curvature[0], curvature[-1], count)
    chosen = {int(np.argmin(np.abs(curvature - value))) for value in wanted}
    return sorted({0, *chosen, len(branch) - 1})


def fig7(work: Work) -> tuple[tuple[Shape, ...], ...]:
    """First-mode states at four inclinations, two weights at constant compression."""
    return tuple(
        tuple(
            Shape(f"{alpha:g}", work.branch(rod(weight, alpha), 1, force)[-1]) for alpha in FIG7_ALPHAS
        )
        for weight, force in FIG7
    )  # fmt: skip


def fig8(work: Work) -> tuple[Shape, ...]:
    """States at γ = 140: at lift-off at α = π/3 and π/6, at F = −2400 at α = 0."""
    out = []
    for alpha, force in FIG8:
        branch = work.branch(rod(140.0, alpha), 1, force)
        lift = branch.lift_off
        if force is None and lift is None:
            raise NotConvergedError(f"α = {alpha:g}: no lift-off")
        state = branch[-1] if force is not None or lift is None else lift.solution
        out.append(Shape(f"{alpha:g}", state))
    return tuple(out)


def claims_4() -> list[Claim]:
    """Twisting moments at the ends of the cylinder, for modes of both symmetries."""
    place = "section 4.1.2, Fig. 4"
    return [
        Claim("fig4.torque", place, "T₂(0) of an antisymmetric mode (first at γ = 15) at lift-off [B/L]", "0",
              lambda work: _torque(work, 1), FORMULA, 0.0),
    ]  # fmt: skip


def _torque(work: Work, mode: int) -> Value:
    lift = work.branch(rod(15.0), mode).lift_off
    if lift is None:
        raise NotConvergedError(f"mode {mode} has no lift-off")
    return lift.solution.number(Measured.TORQUE_0)
