"""Bifurcation diagrams: Fig. 3, 9 and 12(a), and the secondary bifurcations quoted in the text."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.diagram import Diagram
from rodwell.analysis.branch.diagram import diagram as compute
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.errors import NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Value
from rodwell.studies.paper.claims import FORMULA, Claim, Known
from rodwell.studies.paper.work import Work, rod

STEP = 0.04
"""Longest step of the branches, short enough for smooth lines."""

BEYOND = 20.0
"""Compression beyond buckling, in B/L², at which the insets show the modes."""

FIG3 = ((0.0, 4, 400.0), (5.0, 4, 400.0), (15.0, 4, 400.0), (30.0, 5, 450.0))
"""Panels (a) to (d): γ, modes, compression −F up to which the panel goes."""

THIRD, FAR = 30.0, -3200.0
"""γ of Fig. 3(d); end force down to which its third mode is followed."""

PRINTED_THIRD = -2799.71


@dataclass(frozen=True)
class Panel:
    """A bifurcation diagram with the shapes in its insets.

    Attributes
    ----------
    label
        What tells the panel from the others.
    diagram
        The branches.
    shapes
        A state of each of the first four modes, on the arm ω₂(1) < 0.
    until
        Compression −F up to which the panel goes.
    """

    label: str
    diagram: Diagram
    shapes: tuple[Solution, ...]
    until: float


def panel(work: Work, label: str, problem: Problem, modes: int, until: float) -> Panel:
    """Compute one panel."""
    found = compute(problem, modes=modes, until=-1.02 * until, rtol=work.rtol, largest_step=STEP)
    return Panel(label, found, tuple(_beyond(branch) for branch in found.primary[:4]), until)


def _beyond(branch: Branch) -> Solution:
    return branch.at(max(float(branch.force[0]) - BEYOND, float(branch.force[-1])))


def fig3(work: Work) -> tuple[Panel, ...]:
    """Fig. 3(a) to (d)."""
    labels = ("(a)", "(b)", "(c)", "(d)")
    return tuple(
        panel(work, f"{label}  mg = {weight:g}", rod(weight), modes, until)
        for label, (weight, modes, until) in zip(labels, FIG3, strict=True)
    )


def fig9(work: Work) -> Panel:
    """Fig. 9, the vertical column at γ = 100."""
    return panel(work, "mg = 100", rod(100.0, 0.0), 4, 300.0)


def fig12a(work: Work) -> Panel:
    """Fig. 12(a), the rod on top at γ = 65."""
    return panel(work, "(a)  mg = 65", rod(65.0, on_top=True), 4, 350.0)


def claims_3() -> list[Claim]:
    """Secondary bifurcations of Fig. 3 and what is said of them."""
    first, second = (rod(15.0), 1, -400.0), (rod(15.0), 2, -200.0)

    def force(which: tuple[Problem, int, float]) -> Claim:
        printed = {1: "-362.63", 2: "-164.78"}[which[1]]
        return Claim(
            f"fig3c.secondary{which[1]}", "caption of Fig. 4, Fig. 3(c)",
            f"F of the secondary bifurcation on mode {which[1]}, γ = 15 [B/L²]", printed,
            lambda work: _load(work, *which),
        )  # fmt: skip

    third = Known(
        "-1899.765516",
        "Not reproduced: the third mode at γ = 30 does lose its symmetry well outside the plotted range, but at "
        "another load.",
        _third_mode,
    )
    return [
        force(first),
        force(second),
        Claim("fig3c.curvature", "section 4.1.2, Fig. 3(c)", "ω₂(1) at the intersection with mode 2, γ = 15 [1/L]", "0",
              lambda work: _curvature(work, *second), FORMULA, 0.0),
        Claim("fig3d.curvature", "section 4.1.2, Fig. 3(d)", "ω₂(1) at the intersection with mode 4, γ = 30 [1/L]", "0",
              lambda work: _curvature(work, rod(THIRD), 4, -400.0), FORMULA, 0.0),
        Claim("fig3d.secondary3", "section 4.1.2, Fig. 3(d)", "F of the secondary bifurcation on mode 3, γ = 30 [B/L²]",
              "-2799.71", lambda work: _load(work, rod(THIRD), 3, FAR), known=third),
    ]  # fmt: skip


def _load(work: Work, problem: Problem, mode: int, until: float) -> Value:
    return work.branch_point(problem, mode, until).load


def _curvature(work: Work, problem: Problem, mode: int, until: float) -> Value:
    """ω₂(1) at a branch point; its error: of the number itself, and from what the place is uncertain."""
    point = work.branch_point(problem, mode, until)
    value, error = point.solution.number(Measured.OMEGA2_1)
    branch = work.branch(problem, mode, until)
    near = branch.numbers(Measured.OMEGA2_1)[point.after : point.after + 2]
    rate = abs(float(np.diff(near)[0] / np.diff(branch.force[point.after : point.after + 2])[0]))
    return Value(value, error + rate * point.error)


def _third_mode(work: Work) -> str:
    """What the branch of the third mode does down to F = −3200."""
    branch = work.branch(rod(THIRD), 3, FAR)
    points = [p for p in branch.special_points if p.kind == "branch_point"]
    if len(points) != 1:
        raise NotConvergedError(f"mode 3 at γ = 30 has {len(points)} secondary bifurcations down to F = {FAR:g}")
    (point,) = points
    at = branch.at(PRINTED_THIRD)
    curvature, error = at.number(Measured.OMEGA2_1)
    return (
        f"Down to F = {FAR:g} this branch has one secondary bifurcation, at {point.force:.6f} ± {point.error:.0e}, "
        f"where the number of negative eigenvalues goes from {point.index_before} to {point.index_after}. At F = "
        f"{PRINTED_THIRD:g} it is {at.stability_index} on both sides and ω₂(1) = {curvature:.4f} ± {error:.0e}, so "
        f"neither kind of bifurcation is near; the paper's own equations hold there to {at.certificate.worst:.0e}. The "
        "same search gives −362.63 and −164.78 at γ = 15."
    )
