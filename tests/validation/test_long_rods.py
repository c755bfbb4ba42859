"""Long and heavy rods: closed forms, limits, certified counts, and the same rod with its idle upper part cut off."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rodwell import Problem, critical_loads, follow
from rodwell.physics.exact.horizontal import horizontal_loads

AIRY = {"clamped": 2.338107410459767, "pinned": 1.018792971647471}
"""−a₁ and −a'₁, the first zeros of Ai and of Ai′."""


@pytest.mark.parametrize("ends", [("clamped", "clamped"), ("pinned", "pinned"), ("clamped", "pinned")])
@pytest.mark.parametrize("foundation", [1e6, 1e8, 1e10, 1e12])
def test_horizontal_loads_to_1e12(foundation: float, ends: tuple[str, str]) -> None:
    """(77) and its kin; neighbours differ by 1e-8 of the load at w/Δ = 1e12."""
    found = critical_loads(Problem(1e-3 * foundation, clearance=1e-3, ends=ends), 6)
    exact = horizontal_loads(foundation, 6, ends)
    assert found.forces == pytest.approx(exact, rel=1e-10)
    assert np.all(np.abs(found.forces - exact) <= found.errors)


def test_crowded_modes_are_all_there() -> None:
    """A hundred modes of a rod with a hundred half waves: none is skipped, though pairs nearly coincide."""
    found = critical_loads(Problem(1e7, clearance=1e-3), 100).forces
    assert found == pytest.approx(horizontal_loads(1e10, 100), rel=1e-10)


@pytest.mark.parametrize("weight", [1e4, 1e6, 1e7])
def test_vertical_string_against_scorer_functions(weight: float) -> None:
    """(86): a string hanging in its own weight, buckled at its lower end only."""
    from flint import arb, ctx

    from rodwell.physics.exact.vertical import scorer_determinant

    mode = critical_loads(Problem(weight, alpha=0.0), 1)[0]
    before = ctx.prec
    ctx.prec = 400 + 3 * math.isqrt(int(weight))
    try:
        width = max(mode.error, 1e-12 * weight)
        values = [scorer_determinant(arb(mode.force + d), arb(weight)) for d in (-width, width)]
        signs = [1 if value > 0 else -1 if value < 0 else 0 for value in values]
    finally:
        ctx.prec = before
    assert sorted(signs) == [-1, 1]


@pytest.mark.parametrize("end", ["clamped", "pinned"])
@pytest.mark.parametrize("alpha", [89.0, 89.9])
def test_first_correction_of_the_long_inclined_rod(alpha: float, end: str) -> None:
    """Compression at the lower end tends to 2√(B wₗ/Δ) + c (4 B wₐ²)^⅓: the envelope of the wave is an Airy function.

    The local wave Re(A exp iks) has A″ + ¼ (P(s) − 2√b) A = 0, and P falls by wₐ per length. A clamped end asks for
    A = 0, a pinned one for Re A = 0 and Im A′ = 0, so that the first mode has A′ = 0 there. The next terms are smaller
    by wₐ^⅓/b^¼, the half wave against the length of the envelope.
    """
    rod = Problem(1e6, alpha=alpha, clearance=1e-6, ends=(end, "clamped"))
    b = rod.lateral_weight / rod.clearance
    excess = rod.axial_weight - critical_loads(rod, 1)[0].force - 2.0 * math.sqrt(b)
    expected = AIRY[end] * (4.0 * rod.axial_weight**2) ** (1.0 / 3.0)
    assert excess / expected == pytest.approx(1.0, abs=0.25 * rod.axial_weight ** (1.0 / 3.0) / b**0.25)


@pytest.mark.parametrize(("weight", "clearance"), [(30.0, 0.01), (1570.0, 2.2225e-4)])
def test_states_of_a_symmetric_branch_are_symmetric_and_balance(weight: float, clearance: float) -> None:
    """Odd modes of 2 and of 14 half waves: y(s) = −y(1 − s), and F₃(1) by virtual work of the whole rod.

    F₃(1) is the variation of the energy for δy = s²(3 − 2s), which leaves the fittings in peace but for y(1).
    An even rest of an odd state shows in this balance first: even and odd shapes of a long rod cost nearly the same.
    """
    mode = next(mode for mode in critical_loads(Problem(weight, clearance=clearance), 2) if mode.parity < 0)
    state = follow(mode.problem, mode, until=1.3 * mode.force)[-1]
    nodes, weights = np.polynomial.legendre.leggauss(10)
    edges = np.linspace(0.0, 1.0, 201)
    s = (edges[:-1, None] + 0.0025 * (nodes + 1.0)).ravel()
    f = state.fields(s)
    largest = np.max(np.abs(f["y"]))
    assert np.max(np.abs(f["y"] + f["y"][::-1])) < 1e-12 * largest
    sin, cos, omega2 = np.sin(f["eta"]), np.cos(f["eta"]), f["omega2"]
    by_y = weight * np.sin(f["y"] / clearance)
    by_slope = sin * (omega2**2 / cos**2 + 2.0 * sin**2 / clearance**2 + state.force / cos)
    work = by_y * s**2 * (3.0 - 2.0 * s) + by_slope * 6.0 * s * (1.0 - s) - omega2 / cos * (6.0 - 12.0 * s)
    shear, _ = state.end_reactions["shear"]
    assert shear == pytest.approx(float(np.tile(0.0025 * weights, 200) @ work), rel=1e-10)


def scaled(rod: Problem, part: float) -> Problem:
    """The lowest part of a rod, by itself, in its own units: γ goes with L³, Δ with 1/L."""
    return rod.but(weight=rod.weight * part**3, clearance=rod.clearance / part)


STRING = Problem(5.3e6, alpha=60.0, clearance=3.069e-5)
"""About that of examples/long-string.toml."""


@pytest.mark.parametrize("weight", [1e6, 1e8, 1e9])
def test_loads_do_not_know_of_the_idle_upper_part(weight: float) -> None:
    rod, part = STRING.but(weight=weight), 0.4
    short = scaled(rod, part)
    whole, cut = (critical_loads(p, 3).forces - p.axial_weight for p in (rod, short))
    assert whole == pytest.approx(cut / part**2, rel=1e-9)


def test_lift_off_does_not_know_of_it_either() -> None:
    part = 0.3
    short = scaled(STRING, part)
    whole, cut = follow(STRING).lift_off, follow(short).lift_off
    assert whole is not None
    assert cut is not None
    assert whole.force - STRING.axial_weight == pytest.approx((cut.force - short.axial_weight) / part**2, rel=1e-8)
    assert whole.s[0] == pytest.approx(part * cut.s[0], rel=1e-5)


@pytest.mark.parametrize(("weight", "alpha"), [(1e4, 60.0), (1e6, 85.0), (3e6, 90.0), (1e5, 0.0)])
def test_certified_counts_find_no_mode_skipped(weight: float, alpha: float) -> None:
    """Exactly k − ½ ± ½ critical loads lie above a load just before and just beyond the k-th, by Wittrick–Williams."""
    from flint import arb, ctx

    from rodwell.analysis.proof.inertia import EnclosedRod, inertia

    problem = Problem(weight, alpha=alpha)
    modes = critical_loads(problem, 8)
    forces, before = modes.forces, ctx.prec
    between = [*(0.5 * (forces[1:] + forces[:-1])), forces[0] + 10.0 * modes[0].error]
    ctx.prec = 600
    try:
        axial, foundation = arb(problem.axial_weight), arb(problem.foundation / problem.clearance)
        counts = [inertia(EnclosedRod(arb(f), axial, foundation, problem.ends)).negative for f in between]
    finally:
        ctx.prec = before
    assert counts == [1, 2, 3, 4, 5, 6, 7, 0]


def test_largest_contact_force_is_not_passed_over() -> None:
    """The largest of many maxima, from a grid far finer than the half waves."""
    state = follow(STRING).lift_off.solution  # type: ignore[union-attr]
    pressure = state.fields(np.linspace(0.0, 0.1, 20001))["contact_pressure"]
    assert state.wall.contact.value == pytest.approx(-pressure.min(), rel=2e-5)
    assert state.wall.contact.value >= -pressure.min()
