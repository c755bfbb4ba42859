"""Two nested meshes: every state is solved on both, and the difference tells the error.

A :class:`TwoMeshes` pairs a family on a coarse mesh, which carries the continuation steps, with the same family
on the mesh with each element halved, which gives the values reported. The difference of the two, divided by
:data:`CLAIMED_GAIN`, is the error estimate of the finer one: cautious, since the order of the method promises
more. Where a measured number is not known to the tolerance, the meshes are refined where they resolve least;
where that no longer helps (round-off), the point says so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rodwell.compiling.kernels import kernel
from rodwell.numerics.equilibria.error import CLAIMED_GAIN, NUMBER_NOISE, estimated_error, larger
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.outcome import Outcome
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.held import Ends
from rodwell.numerics.splines.spaces import Prolongation, SplineSpace
from rodwell.quantities.arrays import FloatArray

IntArray = NDArray[np.int64]

Measure = Callable[[Family, State], FloatArray]
"""Rows of (3, k): numbers to report of a state, the scales against which their errors are judged, and the errors that
round-off in the coefficients leaves in them, which grow with finer meshes."""


COARSE_TOLERANCE = 1e-2
"""Newton step, over the root of the tolerance, with which the coarse solve of a point may end: what is left is about
its square, and counts as error, since the finer solve does not share it."""


STALLED = 0.25
"""A mesh on which more than this part of the error of the one before is left gains nothing. Where two in a row do,
that is round-off; one alone may have refined elements that were not the ones that mattered."""

KIN = 1.0 / 1024.0
"""Part of the error of a number of the same kind at any place that an error may be below it. At places that the problem
singles out, such as ends, numbers converge to more digits than elsewhere."""


@kernel
def _judged(fine, coarse, groups, links):
    """Errors (k,) of what was measured on two meshes, see :data:`Measure`, and the largest in units of its scale.

    ``groups`` (g, 2) and ``links`` (l, 2) are arrays, not tuples: their type is the same for any number, and for none.
    """
    error = np.empty(fine.shape[1])
    for i in range(error.size):
        scale = fine[1, i]
        known = NUMBER_NOISE * scale if np.isfinite(scale) else 0.0
        error[i] = estimated_error(fine[0, i], coarse[0, i]) + known + fine[2, i]
    for link in range(links.shape[0]):
        i, j = links[link, 0], links[link, 1]
        error[i] = larger(error[i], KIN * error[j])
    for group in range(groups.shape[0]):
        first, last = groups[group, 0], groups[group, 1]
        for i in range(first, last + 1):
            error[first] = larger(error[first], error[i])
        for i in range(first, last + 1):
            error[i] = error[first]
    worst = 0.0
    for i in range(error.size):
        worst = larger(worst, error[i] / fine[1, i])
    return error, worst


@dataclass(frozen=True)
class MeshedState:
    """One equilibrium on both meshes, with the measured numbers and their errors.

    ``excess`` is the largest error in units of what the tolerance allows: at most 1 if the point is
    converged to the tolerance.
    """

    coarse: State
    fine: State
    values: FloatArray
    error: FloatArray
    excess: float

    def __repr__(self) -> str:
        sizes = f"{self.coarse.space.elements} and {self.fine.space.elements} elements"
        return f"<MeshedState at {self.lam:.10g} on {sizes}, index {self.fine.index}>"

    @property
    def lam(self) -> float:
        """Parameter λ, from the finer mesh."""
        return self.fine.lam

    def at(self, lam: float) -> bool:
        """Whether both meshes are solved at exactly this λ."""
        return self.coarse.lam == lam == self.fine.lam

    @property
    def lam_gap(self) -> float:
        """Error estimate of a λ that was located on both meshes."""
        return abs(self.fine.lam - self.coarse.lam) / CLAIMED_GAIN

    @property
    def accurate(self) -> bool:
        """Whether every measured number meets the tolerance."""
        return self.excess <= 1.0


class TwoMeshes:
    """A family on a coarse mesh and on the mesh with each of its elements halved.

    Parameters
    ----------
    family
        The family, on the coarse mesh.
    measure
        What is reported of a state, and must meet the tolerance.
    rtol
        Relative tolerance.
    most_elements
        Limit to the elements of the finer mesh.
    groups
        First and last of groups of measured numbers of one kind, which share the largest error of the group: a single
        number may agree on both meshes by chance.
    links
        Pairs of measured numbers: the error of the first is at least a part of that of the second, of the same kind.
    """

    def __init__(
        self,
        family: Family,
        measure: Measure,
        rtol: float,
        most_elements: int = 20_000,
        groups: Sequence[tuple[int, int]] | IntArray = (),
        links: Sequence[tuple[int, int]] | IntArray = (),
    ) -> None:
        self.floor = 1.0  # excess below which refinement was found not to help (round-off)
        self.groups = np.array(groups, dtype=np.int64).reshape(-1, 2)  # first and last number of each group
        self.links = np.array(links, dtype=np.int64).reshape(-1, 2)
        self.coarse = family
        self.fine = family.on(family.space.refined())
        self.up = Prolongation(self.coarse.space, self.fine.space)
        self.measure, self.rtol, self.most_elements = measure, rtol, most_elements
        self.coarse_tolerance = max(family.tolerance, COARSE_TOLERANCE * np.sqrt(rtol))

    def on_path(self, path: FloatArray, ends: Ends, parity: int) -> TwoMeshes:
        """Return the same meshes for another path in the parameters and a parity to keep."""
        return self.changed(lambda family: _along(family, path, ends, parity))

    def changed(self, change: Callable[[Family], Family]) -> TwoMeshes:
        """Return the same meshes with the equations on each changed."""
        other = copy(self)
        other.coarse, other.fine = change(self.coarse), change(self.fine)
        return other

    def lift(self, coarse: State, *, exact: bool = False) -> tuple[Outcome, State | None]:
        """Solve on the finer mesh, on the hyperplane through ``coarse`` normal to its tangent.

        ``exact``: with tangent and index taken at the solution itself.
        """
        return _carry(coarse, self.up, self.fine.with_exact_tangent() if exact else self.fine)

    def point(self, coarse: State, fine: State) -> MeshedState:
        """Measure a pair of states."""
        measured = self.measure(self.fine, fine)
        error, worst = _judged(measured, self.measure(self.coarse, coarse), self.groups, self.links)
        return MeshedState(coarse, fine, measured[0], error, worst / self.rtol)

    def _without_gain(self, point: MeshedState) -> MeshedState:
        """Return a point of which refinement is known not to help: no gain is claimed for its errors."""
        return replace(point, error=CLAIMED_GAIN * point.error, excess=CLAIMED_GAIN * point.excess)

    def at(self, point: MeshedState, lam: float) -> MeshedState | None:
        """Solve both meshes at exactly λ = ``lam``, from a point close to it; None if that fails."""
        _, coarse, _ = self.coarse.at(point.coarse.c, lam)
        _, fine, _ = self.fine.at(point.fine.c, lam)
        return None if coarse is None or fine is None else self.point(coarse, fine)

    def resolve(self, coarse: State, *, exact: bool = False) -> tuple[Outcome, TwoMeshes, MeshedState | None]:
        """Complete a coarse state to a point within the tolerance, refining as often as that takes.

        Returns the outcome, the meshes on which the point stands, and the point (None if a solve failed).
        """
        outcome, fine = self.lift(coarse, exact=exact)
        if fine is None:
            return outcome, self, None
        meshes, point = self, self.point(coarse, fine)
        tried, last, stalled = meshes, point, False
        while last.excess > tried.floor:
            finer = tried.refined(last)
            if finer is None:
                break
            outcome, better = finer.adopt(tried, last)
            if better is None and stalled:
                break
            if better is None:
                return outcome, meshes, None
            gains = better.excess <= max(tried.floor, STALLED * last.excess)
            tried, last = finer, better
            if gains:
                meshes, point = tried, last
            elif stalled:
                # round-off: finer meshes do not help, and no gain may be claimed
                meshes.floor = 10.0 * point.excess
                break
            stalled = not gains
        if 1.0 < point.excess <= meshes.floor:
            point = self._without_gain(point)
        return Outcome.CONVERGED, meshes, point

    def adopt(self, other: TwoMeshes, point: MeshedState) -> tuple[Outcome, MeshedState | None]:
        """Solve a point of ``other``, coarser nested meshes, on these."""
        outcome, coarse = _carry(point.coarse, Prolongation(other.coarse.space, self.coarse.space), self.coarse)
        if coarse is None:
            return outcome, None
        outcome, fine = self.lift(coarse)
        return outcome, None if fine is None else self.point(coarse, fine)

    def refined(self, point: MeshedState) -> TwoMeshes | None:
        """Return meshes with smaller elements where ``point`` is least resolved, or None at the limit."""
        marked = _least_resolved(self.coarse.space, point.coarse, self.fine.space, point.fine)
        if self.coarse.space.symmetric:  # keeping a symmetry, or seeing one, takes a symmetric mesh
            marked |= marked[::-1]
        space = self.coarse.space.refined(marked)
        if 2 * space.elements > self.most_elements:
            return None
        kinds = self.groups, self.links
        finer = TwoMeshes(self.coarse.on(space), self.measure, self.rtol, self.most_elements, *kinds)
        finer.floor = self.floor
        return finer


def _along(family: Family, path: FloatArray, ends: Ends, parity: int) -> Family:
    """The same family along another path in the parameters, with ends and a parity to keep."""
    if (ends, parity) != (family.ends, family.parity):
        return replace(family, path=path, ends=ends, parity=parity)
    # with the record of its mesh, and not by ``replace``: each point of a curve takes dozens of families
    other: Family = object.__new__(Family)
    other.__dict__.update(family.__dict__, path=path)
    other.__dict__.pop("_with_extra_steps", None)
    return other


def _carry(state: State, up: Prolongation, family: Family) -> tuple[Outcome, State | None]:
    """Solve on a finer space, on the hyperplane through ``state`` normal to its tangent."""
    c, tangent = up(state.c), up(state.tangent)
    if not c.any():  # the trivial solution, known exactly; its Hessian may be singular
        return Outcome.CONVERGED, family.state(c, state.lam, tangent, state.tangent_lam, state.index)
    row, row_lam, _, _ = family.covector(tangent, state.tangent_lam)
    outcome, solved, _ = family.correct(c, state.lam, row, row_lam, float(row @ c) + row_lam * state.lam)
    return outcome, solved


def _least_resolved(coarse: SplineSpace, state: State, fine: SplineSpace, better: State) -> np.ndarray:
    """Mark the coarse elements in which the third derivatives of the two states differ most, (elements,)."""
    grid, _ = coarse.samples
    gap = np.abs(fine.evaluate(better.c, grid, 4)[3] - coarse.evaluate(state.c, grid, 4)[3])
    largest = gap[:-1].reshape(coarse.elements, -1).max(axis=1)
    marked = largest > largest.max() * 0.5 ** (coarse.degree - 2)
    if marked.mean() > 0.5:
        marked[:] = True
    return np.asarray(marked)
