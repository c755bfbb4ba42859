"""A wall that gives way, ½k(r − Δ)₊² per length: the hard wall is its limit, at a rate that depends on the contact.

Derived with a beam on a bed of springs, β = (k/4B)^¼, B = 1. What the soft wall takes off the energy is, to leading
order,

* where contact is complete ½∫p²/k, p the contact force per length; a clamped end holds the rod up over a length 1/β,
  so that p²/(2kβ) less is taken off there: p²/2k ∫(1 − u k/p) with u = (p/k)(1 − e^{−βs}(cos βs + sin βs));
* at a point of contact with the gap's curvature κ, where the rod is a parabola pressed in by d: P = ⁴⁄₃kd√(2d/κ), and
  ∫ d dP = ⅗Pd, as k^(−2/3);
* at an end of a stretch in contact, with the concentrated force P there: on the wall's side u = b e^{βs} sin βs, b =
  −P/(2β³), since u = 0 where contact ends and u‴ = −P beyond; seen from far away the wall's edge has moved outwards by
  P/(6β³), and the energy taken off is P²/(12β³), as k^(−3/4).
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipk

import rodwell
from rodwell.analysis.off_wall.arrange import solved
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.analysis.off_wall.soft import aligned, sunk
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath
from rodwell.errors import InputError
from rodwell.numerics.stretches.carry import angle_of, sampler

WEIGHT, LOAD = 15.0, -118.0

WALLS = 1e6, 1e8


def taken_off_by_bed(stiffness: float) -> float:
    """What a bed of springs takes off the energy of a clamped beam under uniform load, without end force."""
    rate = (0.25 * stiffness) ** 0.25
    return 0.5 * WEIGHT**2 / stiffness * (1.0 - 2.0 / rate)


@pytest.fixture(scope="module")
def soft() -> LoadPath:
    return load_path(rodwell.Problem(weight=WEIGHT), until=-127.0, wall_stiffness=1e6, seeds=1)


@pytest.fixture(scope="module")
def hard() -> ContactState:
    return load_path(rodwell.Problem(weight=WEIGHT), until=LOAD - 1.0, seeds=1).at(LOAD)[0].state


def test_the_straight_rod_is_a_beam_on_springs() -> None:
    state = sunk(RodInHole(rodwell.Problem(weight=WEIGHT), 1e8), 0.0)
    assert state is not None
    found = contact_state(state)
    assert found.energy.value == pytest.approx(-taken_off_by_bed(1e8), rel=1e-5)
    assert found.largest_pressure.value == pytest.approx(WEIGHT * (1.0 + np.exp(-np.pi)), rel=1e-4)
    assert found.certificate.passed
    assert (found.kind, found.stability_index) == ("straight", 0)


def test_events_and_states(soft: LoadPath) -> None:
    """All close to those behind the hard wall: −111.23344016, −123.173074, −124.1911865."""
    assert soft.reached
    assert not soft.missed
    assert [event.kind for event in soft.events] == ["critical", "lift_off", "gap_opens"]
    loads = [event.force.value for event in soft.events]
    assert loads == pytest.approx([-111.23344016, -123.173074, -124.1911865], rel=0.02)
    assert "wall of stiffness 1e+06 B/L⁴" in soft.assumptions
    state = soft.at(-127.0)[0].state
    assert state.certificate.passed
    assert [len(state.gaps), len(state.contacts)] == [3, 4]
    h = 1e-3
    low, high = (soft.at(-126.0 + t)[0].state.energy.value for t in (-h, h))
    assert (high - low) / (2 * h) == pytest.approx(soft.at(-126.0)[0].state.shortening.value, rel=1e-6)


def stiffer(start: ContactState, *stiffnesses: float) -> list[ContactState]:
    """The state at the same load behind stiffer and stiffer walls, each beginning from the one before."""
    out, shape = [], start.fine.solved.shape
    for stiffness in stiffnesses:
        model = RodInHole(start.problem, stiffness)
        found = solved(model, Pattern((False,)), np.zeros(0), start.force, sampler(shape))
        assert found is not None
        shape = found.solved.shape
        out.append(contact_state(found))
        assert out[-1].certificate.passed
        assert out[-1].stability_index == 0
    return out


def test_the_hard_wall_is_the_limit_in_full_contact(soft: LoadPath, hard: ContactState) -> None:
    """As 1/k: buckled on the wall, with ∫p² and the pressures at the ends of the state behind the hard one."""
    p = hard.fields(2001)["contact_pressure"]
    square = float(np.trapezoid(p**2, dx=1.0 / 2000))
    for found in stiffer(soft.at(LOAD)[0].state, *WALLS):
        stiffness, taken = found.fine.model.stiffness, hard.energy.value - found.energy.value
        rate = (0.25 * stiffness) ** 0.25
        derived = 0.5 / stiffness * (square - (p[0] ** 2 + p[-1] ** 2) / rate)
        assert taken == pytest.approx(derived, rel=0.6 / rate)


def weightless(force: float, pattern: Pattern, breaks: list[float]) -> PatternedState:
    """A weightless rod, held in a plane, that touches the opposite wall: nothing but concentrated forces."""
    model = RodInHole(rodwell.Problem(weight=0.0))
    state = solved(model, pattern, np.array(breaks), force, arch(2.0))
    assert state is not None
    assert state.everywhere is False
    return state


def arch(rise: float):
    """A cosine from the wall, of this height in clearances, without its flat top."""

    def sample(s):
        wave, fields = 2.0 * np.pi, np.zeros((2, 3, s.size))
        fields[0] = 0.5 * rise * np.stack((1.0 - np.cos(wave * s), wave * np.sin(wave * s), wave**2 * np.cos(wave * s)))
        fields[0, 0] -= 1.0
        return fields, angle_of(fields)

    return sample


def behind_soft(hard: PatternedState, stiffness: float, depth: float) -> float:
    """What a soft wall takes off the energy of such a rod, in BΔ²/L³; it starts with about this depth in Δ."""
    sample = sampler(hard.solved.shape)

    def pressed(s):
        fields, angle = sample(s)
        fields = fields.copy()
        fields[0] *= 1.0 + 0.5 * depth
        fields[0, 0] += 0.5 * depth
        return fields, angle

    model = RodInHole(hard.model.problem, stiffness)
    found = solved(model, Pattern((False,), planar=True), np.zeros(0), hard.load, pressed)
    assert found is not None
    found = aligned(found)
    assert found is not None
    assert not found.touching[0]
    assert any(found.touching)
    return hard.solved.out.energy - found.solved.out.energy


def test_where_a_stretch_in_contact_ends() -> None:
    """P²/(12β³) at either end, up to the end force's part in bending on the length 1/β, |F|/β².

    And up to a part e^{−2π}: nothing presses the stretch to the wall, which leaves it π/β from its ends.
    """
    force, stiffness = -200.0, 1e8
    half = 2.0 * np.pi / np.sqrt(-force)
    hard = weightless(force, Pattern((False, True, False), planar=True), [half, 1.0 - half])
    rate = (0.25 * stiffness) ** 0.25
    depth = float(hard.solved.forces[0]) / (6.0 * rate**3)
    derived = float(np.sum(hard.solved.forces**2)) / (12.0 * rate**3)
    assert behind_soft(hard, stiffness, depth) == pytest.approx(derived, rel=-force / rate**2 + np.exp(-2.0 * np.pi))


@pytest.mark.parametrize("stiffness", [1e8, 1e9])
def test_a_point_of_contact(stiffness: float) -> None:
    """⅗Pd, P = ⁴⁄₃ k d √(2d/κ), up to what bends the rod on the length a = √(2d/κ) in contact, ka⁴."""
    hard = weightless(-60.0, Pattern((False, False), planar=True), [0.5])
    push, bend = float(hard.solved.forces[0]), float(hard.solved.openings[0])
    depth = (9.0 * bend * push**2 / (32.0 * stiffness**2)) ** (1.0 / 3.0)
    derived, bending = 0.6 * push * depth, stiffness * (2.0 * depth / bend) ** 2
    assert bending < 0.1
    assert behind_soft(hard, stiffness, depth) == pytest.approx(derived, rel=bending)


def test_a_weightless_rod_comes_to_the_opposite_wall_and_back() -> None:
    """At the load of the elastica of rise 2Δ, F = −16K² with k/K = 2Δ: what is soft about the wall is not met before.

    Beyond, the wall gives way by the depth d of a parabola of the gap's curvature: P = ⁴⁄₃kd√(2d/κ). The path turns a
    corner there, which it must not pass over on its way back either.
    """
    k = brentq(lambda k: k / ellipk(k * k) - 0.02, 1e-6, 0.5, xtol=1e-15)
    stiffness, at = 1e6, -16.0 * ellipk(k * k) ** 2
    path = load_path(rodwell.Problem(weight=0.0), until=-40.0, unload_to=-39.0, wall_stiffness=stiffness, seeds=1)
    assert path.reached
    assert not path.missed
    up, down = ["critical", "lift_off", "touches"], ["contact_lost", "critical"]
    assert [(event.leg, event.kind) for event in path.events] == [
        *(("loading", kind) for kind in up), *(("unloading", kind) for kind in down)
    ]  # fmt: skip
    for event in path.events[2:4]:
        assert event.force.value == pytest.approx(at, rel=1e-11)
        assert event.s == pytest.approx((0.5,), abs=1e-9)
        assert event.state.certificate.passed
    assert path.at(-39.2)[1].state.kind == "straight"
    state = path.at(-39.9)[0].state
    assert (state.stability_index, len(state.contacts)) == (0, 1)
    assert state.certificate.passed
    middle = {name: value[0] for name, value in state.fields(np.array([0.5])).items()}
    depth, bend = -middle["gap"] * 0.01, abs(middle["curvature"])
    push = 4.0 / 3.0 * stiffness * depth * np.sqrt(2.0 * depth / bend)
    assert state.contacts[0].force.value == pytest.approx(push, rel=0.02)


def test_what_is_refused() -> None:
    """A wall that does not hold the rod, 2w/Δ = 3000 here; and ends that prefer a plane, without weight."""
    for stiffness in (0.0, float("nan"), 1e30, 5.0, 2999.0):
        with pytest.raises(InputError, match="from 3000 to") as caught:
            load_path(rodwell.Problem(weight=15.0), until=-60.0, wall_stiffness=stiffness)
        assert caught.value.field == "wall_stiffness"
    with pytest.raises(InputError, match="no weight presses to a soft wall") as caught:
        load_path(rodwell.Problem(weight=0.0, ends="pinned-pinned"), until=-60.0, wall_stiffness=1e6)
    assert (caught.value.field, caught.value.value) == ("ends", "pinned-pinned")
