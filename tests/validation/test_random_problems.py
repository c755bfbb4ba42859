"""A thousand random problems: critical loads and branches against a second method, and the claims that branches make.

Source of truth: the energy of the rod on the cylinder (docs/theory.md), discretised here a second time and in a
different way. Hierarchical functions, double integrals of Legendre polynomials (Szabó and Babuška, *Finite Element
Analysis*, 1991, chapter 6), have orthonormal second derivatives; with the four cubic Hermite functions, which carry the
end conditions, they give a dense, well-conditioned Rayleigh–Ritz method. No code of the package is used for it.
"""

from __future__ import annotations

import functools
import itertools
import math

import numpy as np
import pytest
import scipy.linalg
from numpy.polynomial import legendre

from rodwell import Branch, NotConvergedError, Problem, Solution, critical_loads, follow
from rodwell.analysis.branch.diagram import diagram
from rodwell.analysis.branch.special import OUT_OF_RANGE
from rodwell.analysis.discrete.measures import Measured

SEED = 20_240_601
PROBLEMS = 1000
BRANCHES = 96
DIAGRAMS = 24
COMPARED = 12
EULER = 4.0 * math.pi**2
RIGID = 0.1
"""Wavenumber below which a mode is the rod turning as a rigid whole."""

FREE = {"clamped": (False, False), "pinned": (False, True), "guided": (True, False), "free": (True, True)}
"""Whether y and y′ are free at an end."""


def line_loads(problem: Problem) -> tuple[float, float]:
    """Weight per length along the cylinder, w cos α, and across it, w sin α; negative for a rod on top (paper, 4.3)."""
    angle = math.radians(problem.alpha)
    across = problem.weight * math.sin(angle)
    return problem.weight * math.cos(angle), -across if problem.on_top else across


def random_problem(rng: np.random.Generator) -> Problem:
    """Weight 0 or 1e-2 … 1e4, α 0 … 90 with both ends of the range, Δ 1e-4 … 0.05, any ends, sometimes on top."""
    weight = 0.0 if rng.random() < 0.05 else 10.0 ** rng.uniform(-2.0, 4.0)
    which = rng.random()
    alpha = 0.0 if which < 0.1 else 90.0 if which < 0.4 else rng.uniform(0.0, 90.0)
    first, last = (str(end) for end in rng.choice(list(FREE), 2))
    problem = Problem(weight, alpha=alpha, clearance=10.0 ** rng.uniform(-4.0, math.log10(0.05)), ends=(first, last))
    allowed = problem.holds_angle or problem.lateral_weight == 0.0
    return problem.but(on_top=True) if allowed and rng.random() < 0.15 else problem


def in_reach(problem: Problem) -> bool:
    """Whether the second method keeps its digits: on top, dense matrices lose those of loads far below the first."""
    foundation = problem.foundation / problem.clearance
    return -1e4 < foundation < 3e8


def random_problems(seed: int, count: int) -> list[Problem]:
    rng = np.random.default_rng(seed)
    drawn = (random_problem(rng) for _ in itertools.count())
    return list(itertools.islice(filter(in_reach, drawn), count))


@functools.cache
def shapes(degree: int) -> tuple[np.ndarray, ...]:
    """y, y′, y″ of the trial functions as Legendre coefficients on [0, 1], (degree + 1, degree + 1) each, by rows.

    The first four functions carry y(0), y′(0), y(1), y′(1); the others vanish there with their slopes.
    """
    n = degree + 1
    bend = np.zeros((n, n))
    bend[range(4, n), range(2, n - 2)] = np.sqrt(2.0 * np.arange(2, n - 2) + 1.0)
    slope = 0.5 * legendre.legint(bend[:, :-2], lbnd=-1, axis=1)
    out = [0.5 * legendre.legint(slope, lbnd=-1, axis=1), np.pad(slope, ((0, 0), (0, 1))), bend]
    for row, powers in enumerate(([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])):
        cubic = np.polynomial.Polynomial(powers)
        for d, target in enumerate(out):
            target[row, : 4 - d] = cubic.deriv(d).convert(kind=np.polynomial.Legendre, domain=[0.0, 1.0]).coef
    return tuple(out)


@functools.cache
def grams(degree: int) -> tuple[np.ndarray, ...]:
    """∫φ″φ″, ∫φ′φ′, ∫s φ′φ′, ∫φφ, exact."""
    y, slope, bend = shapes(degree)
    k = np.arange(degree + 1)
    unit = np.diag(1.0 / (2.0 * k + 1.0))
    beside = 0.5 * (k[:-1] + 1.0) / ((2.0 * k[:-1] + 1.0) * (2.0 * k[:-1] + 3.0))
    ramp = 0.5 * unit + np.diag(beside, 1) + np.diag(beside, -1)  # (k+1) P_k+1 + k P_k−1 = (2k+1) x P_k
    return bend @ unit @ bend.T, slope @ unit @ slope.T, slope @ ramp @ slope.T, y @ unit @ y.T


def unknowns(problem: Problem, degree: int) -> np.ndarray:
    """Numbers of the trial functions that the ends allow; a rod that can turn as a whole has y(0) = 0."""
    free = [*FREE[problem.ends[0]], *FREE[problem.ends[1]]]
    if problem.lateral_weight == 0.0 and not (free[0] is False or free[2] is False):
        free[0] = False
    return np.array([i for i in range(degree + 1) if i >= 4 or free[i]])


def second_method(problem: Problem, degree: int, count: int) -> np.ndarray:
    """Critical loads, falling: G v = μ (K + τG) v with K + τG positive definite, F = τ − 1/μ."""
    bends, slopes, ramps, squares = grams(degree)
    keep = np.ix_(*2 * (unknowns(problem, degree),))
    axial, lateral = line_loads(problem)
    foundation = lateral / problem.clearance
    tau = 1.0 + axial + 4.0 * max(-foundation, 0.0) / math.pi**2
    stiffness = bends + axial * (ramps - slopes) + foundation * squares
    n = len(keep[0])
    shifted = (stiffness + tau * slopes)[keep]
    mu = scipy.linalg.eigh(slopes[keep], shifted, eigvals_only=True, subset_by_index=[n - count, n - 1])
    return np.asarray(tau - 1.0 / mu[::-1])


def enough(problem: Problem, forces: np.ndarray) -> int:
    """Degree that resolves the modes: half waves by the largest load, layers under tension by its root."""
    largest = float(np.max(np.abs(forces))) + problem.weight
    foundation = problem.weight / problem.clearance
    compression = max(-float(forces[-1]), 0.0) + problem.axial_weight
    return 20 * math.ceil((40.0 + 0.9 * math.sqrt(compression) + 3.0 * (largest**0.25 + foundation**0.125)) / 20.0)


@pytest.mark.parametrize("part", range(10))
def test_critical_loads_of_a_thousand_random_problems(part: int) -> None:
    """The first three agree to 1e-8 and to the errors claimed, up to round-off of either method."""
    for problem in random_problems(SEED, PROBLEMS)[part::10]:
        loads = critical_loads(problem, 3)
        expected = second_method(problem, enough(problem, loads.forces), 3)
        size = np.abs(expected) + problem.axial_weight + EULER
        gap, doubt = np.abs(loads.forces - expected), 1e-10 * size
        assert np.all(gap <= 1e-8 * size), problem
        assert np.all(gap <= loads.errors + doubt), problem
        assert np.all(np.diff(loads.forces) <= 0.0), problem


def test_the_second_method_has_converged() -> None:
    """Its own error is below the 1e-10 taken for it above: forty more functions change nothing."""
    for problem in random_problems(SEED, PROBLEMS)[::100]:
        degree = enough(problem, second_method(problem, 200, 3))
        rough, sharp = (second_method(problem, n, 3) for n in (degree, degree + 40))
        assert np.all(np.abs(rough - sharp) <= 1e-10 * (np.abs(sharp) + problem.axial_weight + EULER)), problem


def buckled(problem: Problem, rtol: float = 1e-8) -> Branch | None:
    """The first branch, a little beyond buckling; None if the package says that it did not converge.

    A rod that turns as a rigid whole (wavenumber near zero) has no scale of its own, and is left out too.
    """
    mode = critical_loads(problem, 1)[0]
    if mode.wavenumber < RIGID:
        return None
    until = mode.force - 0.3 * mode.wavenumber**2 - 0.01 * abs(mode.force)
    try:
        return follow(problem, 1, until=until, rtol=rtol)
    except NotConvergedError:
        return None


def check_index(branch: Branch) -> None:
    """Every change of the stability index is a special point, and special points follow on from each other."""
    first, *rest = branch.special_points
    chain = [first.index_after]
    for point in rest:
        assert point.index_before == chain[-1], (branch.problem, point.kind, point.value)
        chain.append(point.index_after)
    seen = [int(i) for i in branch.stability_index]
    assert seen[0] == chain[0], branch.problem
    steps = iter(chain)
    changes = [seen[0], *(b for a, b in itertools.pairwise(seen) if a != b)]
    assert all(index in steps for index in changes), (branch.problem, changes, chain)
    if branch.reached_end:
        assert chain[-1] == branch.special_points[-1].index_after, branch.problem


def check_claims(branch: Branch) -> None:
    """A branch that claims convergence has no point that does not; one that claims its end reached is there."""
    special = branch.special_points
    if branch.converged:
        assert all(point.converged for point in branch), branch.problem
        assert all(point.solution.converged for point in special), branch.problem
    assert all(point.error >= 0.0 and math.isfinite(point.value) for point in special), branch.problem
    assert special[-1].value == branch.values[-1], branch.problem


def equilibrium_and_index(state: Solution, degree: int) -> tuple[float, int, float]:
    """Weak residual of the energy's first variation, index of the second, and its eigenvalue nearest to zero.

    e = ½ y″²/(1 − y′²) + ½ y′⁴/Δ² − Δ wₗ cos(y/Δ) − N √(1 − y′²), for all trial functions that the ends allow: natural
    conditions included. Eigenvalues relative to ∫φ″φ″ + ∫φ′φ′ + ∫φφ.
    """
    problem = state.problem
    nodes, weights = legendre.leggauss(2 * degree)
    s, w = 0.5 * (nodes + 1.0), 0.5 * weights
    f = state.fields(s)
    y, y1, y2 = f["y"], np.sin(f["eta"]), -f["omega2"] * np.cos(f["eta"])
    d, c2 = problem.clearance, 1.0 - y1**2
    along, lateral = line_loads(problem)
    axial = state.force + along * (s - 1.0)
    phi = [table[unknowns(problem, degree)] @ legendre.legvander(nodes, degree).T for table in shapes(degree)]
    first = (
        lateral * np.sin(y / d),
        y2**2 * y1 / c2**2 + 2.0 * y1**3 / d**2 + axial * y1 / c2**0.5,
        y2 / c2,
    )
    work = sum((p * w) @ g for p, g in zip(phi, first, strict=True))
    effort = sum(np.abs(p * w) @ np.abs(g) for p, g in zip(phi, first, strict=True))
    slope = y2**2 * (1.0 + 3.0 * y1**2) / c2**3 + 6.0 * y1**2 / d**2 + axial / c2**1.5
    second = (phi[2] * w / c2) @ phi[2].T + (phi[1] * w * slope) @ phi[1].T
    mixed = (phi[2] * w * 2.0 * y1 * y2 / c2**2) @ phi[1].T
    second += mixed + mixed.T + (phi[0] * w * lateral * np.cos(y / d) / d) @ phi[0].T
    values = scipy.linalg.eigvalsh(second, phi[2] * w @ phi[2].T + phi[1] * w @ phi[1].T + phi[0] * w @ phi[0].T)
    return float(np.max(np.abs(work)) / np.max(effort)), int(np.sum(values < 0.0)), float(np.min(np.abs(values)))


@pytest.mark.parametrize("part", range(8))
def test_first_branches_of_random_problems(part: int) -> None:
    """Equilibrium and stability index at the end by the second method, and the claims of the branch."""
    followed = 0
    problems = random_problems(SEED + 1, BRANCHES)[part::8]
    for problem in problems:
        branch = buckled(problem)
        if branch is None:
            continue
        followed += 1
        check_index(branch)
        check_claims(branch)
        if branch.ended_because == OUT_OF_RANGE:  # |η| = 90°: beyond the theory
            continue
        assert branch.reached_end, (problem, branch.ended_because)
        residual, index, nearest = equilibrium_and_index(branch[-1], 20 + enough(problem, branch.values[-1:]))
        assert residual < 1e-9, problem
        assert nearest < 1e-7 or index == branch[-1].stability_index, problem
    assert followed > 0.8 * len(problems)


@pytest.mark.parametrize("part", range(4))
def test_diagrams_of_random_problems(part: int) -> None:
    """Two primary branches and what leaves them, somewhat beyond the second critical load."""
    for problem in random_problems(SEED + 2, DIAGRAMS)[part::4]:
        if problem.weight == 0.0 or abs(problem.foundation) / problem.clearance > 3e5:
            continue
        first, second = critical_loads(problem, 2)
        if first.wavenumber < RIGID:
            continue
        found = diagram(problem, modes=2, until=second.force - 0.5 * first.wavenumber**2)
        for branch in found:
            check_index(branch)
            check_claims(branch)
            if branch.ended_because == OUT_OF_RANGE:
                continue
            degree = 20 + enough(problem, branch.values[-1:])
            residual, index, nearest = equilibrium_and_index(branch[-1], degree)
            assert residual < 1e-8, problem
            assert nearest < 1e-7 or index == branch[-1].stability_index, (problem, branch.name)
        assert {joint.child for joint in found.joints} >= {branch.name for branch in found.secondary}


SIZES = {
    Measured.P_MAX: "contact_pressure",
    Measured.OMEGA2_0: "omega2",
    Measured.OMEGA2_1: "omega2",
    Measured.ANGLE_MID: "eta",
    Measured.TORQUE_0: "T2",
}
"""Fields whose largest values are what round-off in a measured number is relative to; others, to the number."""


def test_claimed_errors_cover_what_a_finer_run_finds() -> None:
    """rtol = 1e-6 against 1e-8: numbers of states and loads of special points within the sum of the errors claimed.

    At ends where y″ = 0 the choice of one of two mirror images is arbitrary, so the last end holds y′ here.
    """
    compared = 0
    for problem in random_problems(SEED + 3, 400):
        if compared == COMPARED:
            break
        if problem.ends[1] not in ("clamped", "guided") or problem.lateral_weight == 0.0:
            continue
        rough, fine = buckled(problem, 1e-6), buckled(problem)
        if rough is None or fine is None or not (rough.converged and fine.converged):
            continue
        compared += 1
        for value in (0.4 * rough.values[0] + 0.6 * rough.values[-1], rough.values[-1]):
            a, b = rough.at(value), fine.at(value)
            fields = b.fields()
            for which in Measured:
                (x, x_error), (y, y_error) = a.number(which), b.number(which)
                size = float(np.max(np.abs(fields[SIZES[which]]))) if which in SIZES else abs(y)
                if which == Measured.ANGLE_MID:
                    size /= problem.clearance
                assert abs(x - y) <= x_error + y_error + 1e-9 * size, (problem, which.name, x, y, x_error, y_error)
        for p, q in zip(rough.special_points, fine.special_points, strict=True):
            assert p.kind == q.kind, problem
            assert abs(p.value - q.value) <= p.error + q.error + 1e-12 * abs(q.value), (problem, p, q)
    assert compared == COMPARED
