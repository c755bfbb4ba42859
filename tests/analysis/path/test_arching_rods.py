"""Load paths of rods that nothing presses to the wall: weightless, or vertical with their weight along the hole.

Weightless, clamped at the wall (theory of the rod in a hole): it arches as an elastica of modulus k, F = −16K², rise
k/K, to the opposite wall; leaves the plane later, supercritically, and goes over into the helix without a jump. With
small slopes it leaves the plane at −4μ², tan μ = μ, the load of two clamped half rods whose joint may turn.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve
from scipy.special import ellipk

import rodwell
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath
from rodwell.errors import InputError


def modulus(condition) -> float:
    """The modulus k at which a condition on k and K(k) is met."""
    return float(brentq(lambda k: condition(k, ellipk(k * k)), 1e-6, 0.9, xtol=1e-15))


def kinds(path: LoadPath, leg: str) -> list[str]:
    return [event.kind for event in path.events if event.leg == leg]


@pytest.fixture(scope="module")
def there() -> LoadPath:
    return load_path(rodwell.Problem(weight=0.0), until=-162.0, seeds=1)


@pytest.fixture(scope="module")
def back() -> LoadPath:
    return load_path(rodwell.Problem(weight=0.0), until=-82.0, unload_to=-30.0, seeds=1)


def test_from_the_straight_rod_to_the_helix_without_a_jump(there: LoadPath) -> None:
    assert there.reached
    assert not there.missed
    assert kinds(there, "loading") == [
        "critical", "lift_off", "touches", "branch_point", "contact_splits", "touches", "contact_line", "gap_closes",
        "contact_line", "touch_down",
    ]  # fmt: skip
    assert there.events[0].force.value == pytest.approx(-4.0 * np.pi**2, rel=1e-10)
    touches = there.first("touches")
    assert touches.force.value == pytest.approx(-39.4979222900122, rel=1e-12)
    assert touches.s == pytest.approx((0.5,), abs=1e-9)
    assert all(event.state.certificate.passed for event in there.events[2:])


def test_the_helix_is_the_coil_of_one_turn(there: LoadPath) -> None:
    """By the model of the rod that is kept on the wall: its energy, and the load at which contact begins to pull."""
    state = there.at(-162.0)[0].state
    assert (state.kind, abs(state.turns), state.stability_index) == ("helix", 1, 0)
    coil = rodwell.equilibrium(rodwell.Problem(weight=0.0, turns=1), -162.0)
    energy = coil.energies["bending_energy"].value - coil.energies["end_work"].value
    assert state.energy.value == pytest.approx(energy, rel=1e-9)
    complete = there.first("touch_down").force.value
    below, above = (
        rodwell.equilibrium(rodwell.Problem(weight=0.0, turns=1), complete + h).number("largest_pressure").value
        for h in (-1e-3, 1e-3)
    )
    assert below < 0.0 < above


def test_it_comes_back_the_same_way(back: LoadPath) -> None:
    up, down = kinds(back, "loading"), kinds(back, "unloading")
    assert up == ["critical", "lift_off", "touches", "branch_point", "contact_splits"]
    assert down == ["contacts_merge", "branch_point", "contact_lost", "critical"]
    loads = np.array([event.force.value for event in back.events if event.kind != "lift_off"])
    assert loads[:4] == pytest.approx(loads[:3:-1], rel=1e-10)


@pytest.mark.parametrize("force", [-39.481, -39.49])
def test_the_arch_is_an_elastica(back: LoadPath, force: float) -> None:
    """Any plane is as good as another: that counts as no instability."""
    for state in (one.state for one in back.at(force)):
        k = modulus(lambda k, whole: 16.0 * whole**2 + force)
        fields = state.fields(3)
        assert (fields["x"][1] + 0.01, fields["y"][1]) == pytest.approx((k / ellipk(k * k), 0.0), rel=1e-7)
        assert (state.stability_index, state.contact_total.value) == (0, 0.0)
        assert state.certificate.passed


def test_where_it_leaves_the_plane_with_small_slopes() -> None:
    mu = brentq(lambda z: np.sin(z) - z * np.cos(z), 4.4, 4.6)
    path = load_path(rodwell.Problem(weight=0.0, clearance=1e-4), until=-80.8, seeds=1)
    assert path.first("branch_point").force.value == pytest.approx(-4.0 * mu**2, abs=2e-5)  # of order Δ²


def heavy_arch(weight: float, clearance: float) -> tuple[float, float]:
    """Load and place at which a clamped vertical elastica touches the opposite wall, by shooting.

    θ″ = N sin θ − H cos θ with the tension N = F + w(s − 1) along the hole and a lateral force H.
    """

    def shot(moment: float, lateral: float, force: float):
        def rates(s, u):
            theta, rate, _ = u
            tension = force + weight * (s - 1.0)
            return [rate, tension * np.sin(theta) - lateral * np.cos(theta), np.sin(theta)]

        return solve_ivp(rates, (0.0, 1.0), [0.0, moment, 0.0], rtol=1e-12, atol=1e-14, dense_output=True)

    def missed(unknowns) -> list[float]:
        found = shot(*unknowns[:3])
        theta, _, x = found.sol(unknowns[3])
        return [found.y[0, -1], 1e2 * found.y[2, -1], theta, 1e2 * (x - 2.0 * clearance)]

    start = [clearance * 39.5, 0.0, -39.5 + 0.5 * weight, 0.5]
    moment, lateral, force, s = fsolve(missed, start, xtol=1e-13)
    assert missed([moment, lateral, force, s]) == pytest.approx([0.0] * 4, abs=1e-10)
    return force, s


def test_a_vertical_rod_under_its_own_weight() -> None:
    path = load_path(rodwell.Problem(weight=20.0, alpha=0.0), until=-40.0, unload_to=-25.0, seeds=1)
    assert path.reached
    assert kinds(path, "loading") == ["critical", "lift_off", "touches"]
    assert kinds(path, "unloading") == ["contact_lost", "critical"]
    force, s = heavy_arch(20.0, 0.01)
    for kind in ("touches", "contact_lost"):
        event = path.first(kind)
        assert event.force.value == pytest.approx(force, rel=1e-10)
        assert event.s == pytest.approx((s,), abs=1e-6)
    state = path.at(-40.0)[0].state
    assert state.certificate.passed
    h = 1e-3
    low, high = (path.at(-39.0 + t)[0].state.energy.value for t in (-h, h))
    assert (high - low) / (2 * h) == pytest.approx(path.at(-39.0)[0].state.shortening.value, rel=1e-6)


def test_with_ball_joints_too() -> None:
    """F = −4K², rise k/K; a point of contact grows to a line where a span is half a wave: −4π² for small slopes."""
    path = load_path(rodwell.Problem(weight=0.0, ends="ball-ball"), until=-41.0, seeds=1)
    k = modulus(lambda k, whole: k / whole - 0.02)
    assert path.first("touches").force.value == pytest.approx(-4.0 * ellipk(k * k) ** 2, rel=1e-10)
    assert path.first("contact_line").force.value == pytest.approx(-4.0 * np.pi**2, rel=1e-3)
    assert kinds(path, "loading") == ["critical", "lift_off", "touches", "contact_line"]


def test_radially_held_ends_keep_it_at_the_wall() -> None:
    """Pinned radially, it can turn around the hole only: the wall is in its way at once, and carries it from there."""
    path = load_path(rodwell.Problem(weight=0.0, ends="pinned-pinned"), until=-12.0, unload_to=-9.0, seeds=1)
    assert [event.kind for event in path.events] == ["critical", "lift_off", "critical"]
    assert path.events[0].force.value == path.events[-1].force.value == pytest.approx(-(np.pi**2), rel=1e-10)
    state = path.at(-11.0)[0].state
    assert state.fine.pattern.text() == "-=-"
    assert state.certificate.passed


def test_twist_is_refused_with_the_reason() -> None:
    with pytest.raises(InputError, match="may turn as a whole") as caught:
        load_path(rodwell.Problem(weight=0.0, twist=1.0), until=-60.0)
    assert caught.value.field == "twist"
