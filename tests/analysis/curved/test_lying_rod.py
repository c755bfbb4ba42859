"""The rod that lies along a curved hole: contact, critical loads of both signs, and what has none.

Loads at Δ = 0.01, clamped, horizontal at the undeformed rod's middle, are those of the project's notes on curved holes
(checked there against a polyline on a torus). The other truths: closed forms of the weightless arc with pinned ends,
limits, and symmetries.
"""

from __future__ import annotations

import numpy as np
import pytest

from rodwell import InputError, NotConvergedError, Problem, critical_loads
from rodwell.analysis.discrete.curved import along_rod
from rodwell.analysis.discrete.curved_meshes import linear_space
from rodwell.analysis.straight.critical import tensile_loads
from rodwell.analysis.straight.lying import least_contact, lies_between, lying_contact, lying_fields
from rodwell.analysis.straight.lying_pencil import Pencil

D = 0.01


@pytest.mark.parametrize(
    ("build", "weight", "loads"),
    [(0.2, 15.0, (-177.320540182, -186.614565944)), (0.5, 0.0, (-260.399015064, -284.053630192))],
)
def test_loads_in_a_build(build: float, weight: float, loads: tuple[float, float]) -> None:
    found = critical_loads(Problem(weight, build=build), 2)
    np.testing.assert_allclose(found.forces, loads, rtol=1e-9)
    assert np.all(found.errors < 1e-9)


@pytest.mark.parametrize("build", [0.5, -0.5])
def test_pinned_weightless_arc_has_closed_forms(build: float) -> None:
    """(nπ)⁴ + (N − 2κᵣ²)(nπ)² − κᵣ(N − κᵣ²)/Δ = 0, from the constant coefficients of the second variation."""
    kr = build / (1.0 + build * D)
    squares = (np.arange(1, 9) * np.pi) ** 2
    loads = -(squares**2 - 2.0 * kr**2 * squares + kr**3 / D) / (squares - kr / D)
    problem = Problem(0.0, build=build, ends="pinned-pinned")
    below, above = -np.sort(-loads[loads < 0.0])[:3], np.sort(loads[loads > 0.0])
    np.testing.assert_allclose(critical_loads(problem, 3).forces, below, rtol=1e-10)
    np.testing.assert_allclose(tensile_loads(problem, 5).forces, above, rtol=1e-10)
    assert above.size == (2 if build > 0.0 else 0)


def test_without_curvature_loads_are_those_of_the_straight_hole() -> None:
    straight = critical_loads(Problem(15.0, 70.0, ends="clamped-free"), 3).forces
    gaps = [
        np.max(np.abs(critical_loads(Problem(15.0, 70.0, build=k, ends="clamped-free"), 3).forces - straight))
        for k in (1e-3, 1e-5, 1e-9)
    ]
    assert gaps[1] == pytest.approx(1e-2 * gaps[0], rel=0.05)  # linear in the curvature
    assert gaps[2] < 1e-6
    assert critical_loads(Problem(15.0, 70.0, build=0.0), 1)[0].force == critical_loads(Problem(15.0, 70.0), 1)[0].force


def test_upside_down_is_the_opposite_wall_of_the_opposite_curve() -> None:
    """κ → −κ with gravity reversed and the rod on the opposite wall: the kernels are given the same, −w for w."""
    places = np.linspace(0.0, 1.0, 50)
    below = along_rod(Problem(9.0, 70.0, build=0.4))(places)
    up = along_rod(Problem(9.0, 110.0, build=-0.4, on_top=True))(places)  # upside down T·k changes its sign: 180° − α
    k, g, lift, offset = (slice(2 + 7 * a, 2 + 7 * b) for a, b in ((0, 2), (2, 4), (4, 5), (5, 6)))
    np.testing.assert_allclose(below[:, k], up[:, k], atol=1e-14)
    np.testing.assert_allclose(below[:, g], -up[:, g], atol=1e-12)
    np.testing.assert_allclose(below[:, lift], -up[:, lift], atol=1e-12)
    np.testing.assert_allclose(below[:, offset], up[:, offset], atol=1e-14)
    pair = Problem(0.0, build=0.4), Problem(0.0, build=-0.4, on_top=True)
    weightless = [critical_loads(problem, 2).forces for problem in pair]
    np.testing.assert_allclose(weightless[0], weightless[1], rtol=1e-11)


def test_where_the_rod_leaves_the_wall_in_closed_form() -> None:
    """P = w cos ψ − κᵣ(N − κᵣ²) with N = F − w[h(1) − h(s)], least at the ends of a build under tension."""
    kr = 0.2 / (1.0 + 0.2 * D)
    low, high = lies_between(Problem(15.0, build=0.2))
    assert low is None
    assert high is not None
    assert high.value == pytest.approx(15.0 * np.cos(0.5 * kr) / kr + kr**2, rel=1e-12)
    assert high.s in (0.0, 1.0)
    kr = -0.2 / (1.0 - 0.2 * D)
    low, high = lies_between(Problem(15.0, build=-0.2))
    assert high is None
    assert low is not None
    assert low.value == pytest.approx(15.0 * np.cos(0.5 * kr) / kr + kr**2, rel=1e-12)


def test_contact_is_weight_across_and_force_around_the_curve() -> None:
    problem, force, s = Problem(15.0, 60.0, build=0.3), -50.0, np.linspace(0.0, 1.0, 11)
    kr = 0.3 / (1.0 + 0.3 * D)
    slope = np.radians(30.0) + kr * (s - 0.5)  # from the horizontal
    height = -np.cos(slope) / kr
    driving = force - 15.0 * (height[-1] - height)
    known = 15.0 * np.cos(slope) - kr * (driving - kr**2)
    np.testing.assert_allclose(lying_contact(problem, force, s), known, rtol=1e-12)
    least = least_contact(problem, force)
    assert least.value <= np.min(known) + 1e-12


def test_long_rods_approach_the_load_of_the_endless_one() -> None:
    """Least −N over all wavenumbers q of q⁴ + (N − 2κᵣ²)q² − κᵣ(N − κᵣ²)/Δ = 0, −N = 4κᵣ/Δ for small Δκᵣ.

    That is He and Kyllingstad (1995) with the contact of a weightless string in constant curvature, 2√(B P/Δ).
    """
    gaps = []
    for length in (8.0, 16.0, 32.0):  # κ and Δ in units of 1/L and L
        k, d = 0.05 * length, 0.02 / length
        kr = k / (1.0 + k * d)
        square = kr / d + np.sqrt((kr / d) ** 2 - 2.0 * kr**3 / d + kr**3 / d)
        load = 2.0 * square - 2.0 * kr**2
        assert load == pytest.approx(4.0 * kr / d, rel=2e-3)
        gaps.append(-critical_loads(Problem(0.0, clearance=d, build=k), 1)[0].force / load - 1.0)
    assert 0.0 < gaps[2] < gaps[1] < gaps[0] < 0.2
    assert gaps[1] / gaps[2] == pytest.approx(4.0, rel=0.3)  # like 1/L², as in a straight hole


def test_what_has_no_critical_load_is_refused_or_explained() -> None:
    with pytest.raises(InputError, match="sideways"):
        critical_loads(Problem(15.0, build=0.2, walk=0.1))
    with pytest.raises(InputError, match="must be clamped-clamped"):
        critical_loads(Problem(15.0, build=0.2, twist=1.0, ends="pinned-pinned"))
    with pytest.raises(NotConvergedError, match="unstable on the wall at every end force"):
        critical_loads(Problem(3000.0, build=-0.5, on_top=True))
    assert len(tensile_loads(Problem(15.0))) == 0


@pytest.mark.parametrize(
    ("problem", "mesh", "within"),
    [
        (Problem(2.981725097342834, 38.023273027103876, 0.0025673391772026524, ends="pinned-pinned",
                 build=0.10956359363642365), 2e3, 1e-9),
        (Problem(135.757938, 70.134872, 0.0067438764, ends="clamped-pinned", build=0.2672838), 2e5, 1e-7),
    ],
)  # fmt: skip
def test_a_load_in_tension_behind_many_others_or_far_from_the_first_is_found(
    problem: Problem, mesh: float, within: float
) -> None:
    """Number 6 of the campaign of random holes, and loads apart by a factor of 2000; counts of unstable directions
    on other meshes confirm both."""
    found = tensile_loads(problem, 3)
    assert len(found) == 2
    pencil = Pencil(problem, linear_space(problem, (-mesh, mesh)).refined())
    for number, mode in enumerate(found):
        counts = [pencil.unstable(mode.force * factor) for factor in (1.0 - within, 1.0 + within)]
        assert counts == [number, number + 1]


def test_a_torque_pushes_the_rod_sideways_where_the_curvature_changes() -> None:
    """The shear T₁κᵣ around the hole, which the torque asks for in a bend, then has a rate; a plane arc has none."""
    s = np.linspace(0.0, 1.0, 9)
    bend = Problem(15.0, axis=np.stack([s, 0.0 * s, 0.1 * s**3], axis=1).tolist(), twist=3.0)
    arc = Problem(15.0, build=0.2, twist=3.0)
    for problem, steady in ((bend, False), (arc, True)):
        shear = lying_fields(problem, -50.0, np.array([0.2, 0.8]))["rod_F3"]
        assert (abs(shear[1] - shear[0]) < 1e-9) == steady
    with pytest.raises(InputError, match="pushes the rod sideways"):
        critical_loads(bend)
    assert critical_loads(arc, 1)[0].force == critical_loads(arc.but(twist=0.0), 1)[0].force
