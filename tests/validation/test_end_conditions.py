"""All sixteen pairs of end conditions: critical loads, buckled states, and what natural conditions demand of them.

Sources of truth: closed forms for columns (S. P. Timoshenko and J. M. Gere, *Theory of Elastic Stability*, 2nd ed.,
1961, chapter 2; on an elastic foundation section 2.10), and the differential equation (64) of the paper by Chebyshev
collocation (L. N. Trefethen, *Spectral Methods in MATLAB*, 2000, chapter 6): the strong form with explicit natural
conditions, where the package has the weak form with splines.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import scipy.linalg

from rodwell import Branch, Problem, critical_loads, follow
from rodwell.analysis.discrete.measures import Measured
from rodwell.problem.ends import ENDS

PI2 = math.pi**2
PAIRS = list(itertools.product(ENDS, ENDS))
HOLDS_Y = ("clamped", "pinned")
HOLDS_SLOPE = ("clamped", "guided")

COLUMNS = {
    ("clamped", "clamped"): [4 * PI2, 80.76291423, 16 * PI2],  # tan(k/2) = k/2 for the second
    ("clamped", "pinned"): [20.19072856, 59.67951594],  # tan k = k
    ("clamped", "guided"): [PI2, 4 * PI2, 9 * PI2],
    ("clamped", "free"): [PI2 / 4, 9 * PI2 / 4, 25 * PI2 / 4],
    ("pinned", "pinned"): [PI2, 4 * PI2, 9 * PI2],
    ("pinned", "guided"): [PI2 / 4, 9 * PI2 / 4, 25 * PI2 / 4],
    ("pinned", "free"): [0.0, PI2, 4 * PI2],  # first the rigid rod, which nothing holds upright
    ("guided", "guided"): [PI2, 4 * PI2, 9 * PI2],
    ("guided", "free"): [PI2 / 4, 9 * PI2 / 4, 25 * PI2 / 4],
    ("free", "free"): [0.0, PI2, 4 * PI2],
}
"""−F of the weightless rod: Timoshenko and Gere, section 2.2. Where no end holds y, turning as a whole is left out; of
the shear nothing remains then, so y‴ = F y′ all along."""


def line_loads(problem: Problem) -> tuple[float, float]:
    """Weight per length along the cylinder, w cos α, and across it, w sin α; negative for a rod on top (paper, 4.3)."""
    angle = math.radians(problem.alpha)
    across = problem.weight * math.sin(angle)
    return problem.weight * math.cos(angle), -across if problem.on_top else across


def chebyshev(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points on [0, 1], rising, and the differentiation matrix (Trefethen, program cheb), rows of sum zero."""
    k = np.arange(n + 1)
    x = np.cos(math.pi * k / n)
    c = np.where((k == 0) | (k == n), 2.0, 1.0) * (-1.0) ** k
    gap = np.sin(0.5 * math.pi * (k[None, :] - k[:, None]) / n) * np.sin(0.5 * math.pi * (k[None, :] + k[:, None]) / n)
    d = np.outer(c, 1.0 / c) / (2.0 * gap + np.eye(n + 1))
    d -= np.diag(d.sum(axis=1))
    return 0.5 * (1.0 - x), -2.0 * d


def collocation_loads(problem: Problem, n: int, count: int) -> np.ndarray:
    """Eigenvalues F of y⁗ − (N y′)′ + (wₗ/Δ) y = 0, N = F + wₐ(s − 1), falling.

    Ends: y = 0 or shear N y′ − y‴ = 0; y′ = 0 or moment y″ = 0. A rod that can turn as a whole has y(0) = 0 instead of
    the first shear condition, which follows from the other then.
    """
    s, d1 = chebyshev(n)
    d2 = d1 @ d1
    d3 = d2 @ d1
    axial, lateral = line_loads(problem)
    weight = np.diag(axial * (s - 1.0))
    k = d2 @ d2 - d1 @ weight @ d1 + lateral / problem.clearance * np.eye(n + 1)
    g = -d2.copy()  # K y = λ G y, λ = −F
    for end, rows in zip(problem.ends, ((0, 1), (n, n - 1)), strict=True):
        at = 0 if rows[0] == 0 else n
        turns = problem.lateral_weight == 0.0 and not problem.holds_angle and at == 0
        if end in HOLDS_Y or turns:
            k[rows[0]], g[rows[0]] = np.eye(n + 1)[at], 0.0
        else:
            k[rows[0]], g[rows[0]] = (weight @ d1 - d3)[at], d1[at]
        k[rows[1]], g[rows[1]] = (d1 if end in HOLDS_SLOPE else d2)[at], 0.0
    size = np.abs(k).max(axis=1, keepdims=True)
    values = scipy.linalg.eig(k / size, g / size, right=False, homogeneous_eigvals=True)
    finite = np.abs(values[1]) > 1e-14 * np.abs(values[1]).max()
    loads = -(values[0][finite] / values[1][finite])
    real = loads.real[np.abs(loads.imag) <= 1e-6 * (np.abs(loads.real) + 1.0)]
    return np.sort(real[np.abs(real) < 1e7])[::-1][:count]


@pytest.mark.parametrize("ends", PAIRS)
def test_weightless_columns(ends: tuple[str, str]) -> None:
    """Closed forms, to the digits known; ends may be exchanged."""
    expected = np.array(COLUMNS.get(ends) or COLUMNS[ends[1], ends[0]])
    loads = critical_loads(Problem(0.0, ends=ends), len(expected)).forces
    assert loads == pytest.approx(-expected, rel=5e-10, abs=1e-9)


@pytest.mark.parametrize("top", [False, True])
@pytest.mark.parametrize("weight", [0.3, 15.0, 300.0])
def test_pinned_rod_on_a_foundation(weight: float, top: bool) -> None:
    """F = −(n²π² + (wₗ/Δ)/(n²π²)) with y = sin nπs (Timoshenko and Gere, section 2.10), in falling order of F."""
    problem = Problem(weight, clearance=0.02, on_top=top, ends=("pinned", "pinned"))
    n2 = PI2 * np.arange(1, 30) ** 2
    expected = np.sort(-(n2 + (-weight if top else weight) / 0.02 / n2))[::-1][:4]
    assert critical_loads(problem, 4).forces == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize(("weight", "alpha", "top"), [(15.0, 90.0, False), (60.0, 35.0, False), (40.0, 0.0, False),
                                                      (8.0, 70.0, True)])  # fmt: skip
@pytest.mark.parametrize("ends", PAIRS)
def test_critical_loads_by_collocation(ends: tuple[str, str], weight: float, alpha: float, top: bool) -> None:
    """Four loads, against the strong form; its own accuracy is about 1e-7 (fourth derivatives)."""
    problem = Problem(weight, alpha=alpha, clearance=0.02, ends=ends)
    problem = problem.but(on_top=top and problem.holds_angle)
    loads = critical_loads(problem, 4).forces
    expected = collocation_loads(problem, 36, 4)
    size = np.abs(expected) + weight + 4.0 * PI2
    assert np.max(np.abs(loads - expected) / size) < 1e-7


@pytest.mark.parametrize("ends", PAIRS)
def test_loads_of_a_horizontal_rod_do_not_know_which_end_is_first(ends: tuple[str, str]) -> None:
    there, back = (critical_loads(Problem(25.0, ends=pair), 4).forces for pair in (ends, ends[::-1]))
    assert there == pytest.approx(back, rel=1e-10)


@pytest.fixture(scope="module", params=PAIRS, ids="-".join)
def branch(request: pytest.FixtureRequest) -> Branch:
    """Buckled states of an inclined rod, to well beyond lift-off."""
    problem = Problem(15.0, alpha=75.0, ends=request.param)
    first = critical_loads(problem, 1)[0]
    return follow(problem, first, until=1.85 * first.force)


def test_branches_converge_and_lift_off(branch: Branch) -> None:
    """Lift-off is found, where the largest contact pressure is zero, and is the first sign change of the points."""
    assert branch.reached_end
    assert branch.converged
    lift_off = branch.lift_off
    assert lift_off is not None
    top, _, places = lift_off.solution.highest_pressure
    pressure = lift_off.solution.fields(401)["contact_pressure"]
    assert abs(top) < 1e-6 * np.max(np.abs(pressure))
    assert pressure.max() <= top + 1e-6 * np.max(np.abs(pressure))
    assert all(0.0 <= s <= 1.0 for s in places)
    off = branch.numbers(Measured.P_MAX)[:-1] > 0.0
    assert np.all(branch.force[:-1][off] <= lift_off.force)
    assert np.all(branch.force[:-1][~off] >= lift_off.force)


def test_contact_pressure_balances_the_rod(branch: Branch) -> None:
    """(48) along d₁: p = dF₂/ds + ω₃ F₁ − ω₁ F₃ − wₗ cos ξ₂, the derivative by fourth-order differences of F₂."""
    s = np.linspace(0.0, 1.0, 2001)
    f = branch[-1].fields(s)
    rate = (f["rod_F2"][:-4] - 8.0 * f["rod_F2"][1:-3] + 8.0 * f["rod_F2"][3:-1] - f["rod_F2"][4:]) / (12.0 * s[1])
    _, lateral = line_loads(branch.problem)
    p = f["omega3"] * f["rod_F1"] - f["omega1"] * f["rod_F3"] - lateral * np.cos(f["xi2"])
    gap = np.abs(f["contact_pressure"][2:-2] - p[2:-2] - rate)
    assert np.max(gap) < 1e-6 * np.max(np.abs(f["contact_pressure"]))


def test_natural_conditions_and_certificate(branch: Branch) -> None:
    """ω₂ = 0 where y′ is free, no circumferential force where y is; y and y′ are zero where they are held.

    The circumferential force on an end is that of the rod's section, F₁ sin η + F₃ cos η, and of the pair of radial
    wall forces that bears its moment ω₃ u₁ where the end can turn: these lie ω₃ apart along t₁, so around the
    cylinder by sin η/Δ, and leave ω₃ sin η/Δ. At s = 1 it is also known by virtual work (``end_reactions``).
    """
    state = branch[-1]
    f, clearance = state.fields(), branch.problem.clearance
    bend = np.max(np.abs(f["omega2"]))
    force = np.max(np.abs(f["rod_F3"]))
    reactions = state.end_reactions
    around = (
        f["rod_F1"] * np.sin(f["eta"]) + f["rod_F3"] * np.cos(f["eta"]) + f["omega3"] * np.sin(f["eta"]) / clearance
    )
    for i, end in ((0, branch.problem.ends[0]), (-1, branch.problem.ends[1])):
        held_angle, held_slope = end in HOLDS_Y, end in HOLDS_SLOPE
        assert (abs(f["y"][i]) < 1e-12 * clearance) == held_angle
        assert (abs(f["eta"][i]) < 1e-12) == held_slope
        assert (abs(f["omega2"][i]) > 1e-6 * bend) == held_slope
        assert held_angle or abs(around[i]) < 1e-6 * force
    assert held_angle or abs(reactions["shear"].value) < 1e-9 * force
    assert held_slope or abs(reactions["moment"].value) < 1e-9 * bend
    if held_angle:
        assert reactions["shear"].value == pytest.approx(around[-1], abs=1e-5 * force)
    if held_slope:
        assert reactions["moment"].value == pytest.approx(f["omega2"][-1], abs=1e-7 * bend)
    assert state.certificate.passed


def test_work_of_the_end_force(branch: Branch) -> None:
    """dE/dF = ∂E/∂F = 1 − z(1): by fourth-order central differences of the energy along the branch."""
    middle, step = branch.at(0.5 * (branch.force[0] + branch.force[-1])), 0.01 * abs(np.ptp(branch.force))
    energy = {k: branch.at(middle.force + k * step).number(Measured.ENERGY).value for k in (-2, -1, 1, 2)}
    slope = (energy[-2] - 8.0 * energy[-1] + 8.0 * energy[1] - energy[2]) / (12.0 * step)
    shortening = middle.number(Measured.SHORTENING).value
    assert slope == pytest.approx(shortening, rel=1e-4)
    assert shortening == pytest.approx(1.0 - middle.fields()["z"][-1], rel=1e-9)


@pytest.mark.parametrize("ends", [("clamped", "pinned"), ("clamped", "guided"), ("clamped", "free"),
                                  ("pinned", "guided"), ("pinned", "free"), ("guided", "free")])  # fmt: skip
def test_turned_round(ends: tuple[str, str]) -> None:
    """A horizontal rod seen from its other end: the same lift-off load, at s → 1 − s, with the same shape, y → ±y."""
    there, back = (follow(Problem(15.0, ends=pair), 1) for pair in (ends, ends[::-1]))
    a, b = there.lift_off, back.lift_off
    assert a is not None
    assert b is not None
    assert a.force == pytest.approx(b.force, rel=1e-8)
    assert a.s == pytest.approx(sorted(1.0 - s for s in b.s), abs=1e-5)
    y, z = a.solution.fields()["y"], b.solution.fields()["y"][::-1]
    assert min(np.max(np.abs(y - z)), np.max(np.abs(y + z))) < 1e-7 * np.max(np.abs(y))


@pytest.mark.parametrize(
    ("weight", "clearance", "ends"),
    [
        (63.273270035833676, 0.00013822808914166674, "guided-pinned"),
        (1e3, 1e-4, "pinned-guided"),
        (1e4, 1e-3, "pinned-guided"),
    ],
)
def test_loads_far_apart_on_top(weight: float, clearance: float, ends: str) -> None:
    """y = sin kπs with k = n − ½ solves (64): F = −(k²π² − |wₗ|/(Δ k²π²)); the first loads lie far from the others."""
    problem = Problem(weight, clearance=clearance, on_top=True, ends=ends)  # type: ignore[arg-type]
    loads = critical_loads(problem, 3)
    k = (np.arange(1, 4) - 0.5) * np.pi
    exact = -(k**2 + problem.foundation / clearance / k**2)
    assert np.all(np.abs(loads.forces - exact) <= loads.errors + 1e-14 * np.abs(exact))


@pytest.mark.parametrize("ends", ["clamped-free", "free-free", "free-guided"])
def test_loads_of_a_free_end_come_before_a_cluster(ends: str) -> None:
    """A free end of a long rod buckles at −√(wₗ/Δ), half of the −2√(wₗ/Δ) inside.

    M. Hetényi, *Beams on Elastic Foundation* (1946), chapter 7.
    """
    loads = critical_loads(Problem(1e6, clearance=1e-4, ends=ends), 3).forces  # type: ignore[arg-type]
    free = ends.split("-").count("free")
    assert loads[:free] == pytest.approx([-1e5] * free, rel=1e-9)
    assert loads[free:] == pytest.approx([-2e5] * (3 - free), rel=1e-3)
