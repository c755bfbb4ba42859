"""The soft string against closed forms and the numbers of well A."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drag_wells import (
    CLEARANCE,
    FRICTION,
    PIPE,
    RADIUS,
    STIFFNESS,
    WEIGHT,
    cutter,
    operation,
    well,
    well_a_survey,
)
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from rodwell.studies.drag.laws import STRAIGHT_LAW, correlation
from rodwell.studies.drag.lock_up import reach
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.run import balance, error_of, run
from rodwell.survey.survey import Survey

WELL_A = {
    "pull-out": (0.0, 502594.800142, 0.0),
    "run-in": (0.0, 222687.670017, 0.0),
    "rotate-off-bottom": (0.0, 379205.932788, 7802.988904),
    "slide": (-50e3, 148639.036493, 0.0),
}
"""Force at the bit, hook load and torque of a string without buckling: theory notes, two programs."""


@pytest.mark.parametrize("kind", WELL_A)
def test_well_a_without_buckling(kind: str) -> None:
    survey = well_a_survey()
    force, hook, torque = WELL_A[kind]
    found = run(cutter(survey), operation(kind, survey, force), STRAIGHT_LAW)
    assert found.force == pytest.approx(hook, rel=1e-10)
    assert found.torque == pytest.approx(torque, rel=1e-9, abs=1e-6)


def test_largest_contact_and_neutral_point_of_well_a() -> None:
    survey = well_a_survey()
    out = run(cutter(survey), operation("pull-out", survey), STRAIGHT_LAW)
    assert out.contacts.max() == pytest.approx(456.432462, abs=1e-6)
    assert out.measured_depth[np.argmax(out.contacts)] == pytest.approx(1000.0, abs=1e-9)
    into = run(cutter(survey), operation("run-in", survey), STRAIGHT_LAW)
    assert into.neutral_points == pytest.approx([923.715259], abs=1e-6)


def arc(radius: float, first: float, last: float, stations: int = 7, turn: float = 0.0) -> Survey:
    """An arc between two inclinations in rad in a vertical plane, or a turn in the horizontal one."""
    angles = np.linspace(first, last, stations)
    md = radius * (abs(last - first) + abs(turn)) * np.linspace(0.0, 1.0, stations)
    azimuth = np.degrees(np.linspace(0.0, turn, stations))
    return Survey.of(md, np.degrees(angles), azimuth)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_constant_build_has_a_closed_form(direction: float) -> None:
    """F = C e^{mα} + wR [2m cos α − (1 − m²) sin α]/(1 + m²), m = ±μ σ, patched where F = wR sin α."""
    radius = 500.0
    survey = arc(radius, math.radians(10.0), math.radians(85.0))
    kind = "pull-out" if direction > 0.0 else "run-in"
    found = run(cutter(survey), operation(kind, survey), STRAIGHT_LAW, bit_force=0.6 * WEIGHT * radius)

    def particular(m: float, alpha: float) -> float:
        return WEIGHT * radius * (2.0 * m * math.cos(alpha) - (1.0 - m * m) * math.sin(alpha)) / (1.0 + m * m)

    def patch(force: float, alpha: float, side: float) -> tuple[float, float]:
        """C and m on a side of the hole; going up, α falls, so dF/dα = −R dF/dx."""
        m = direction * FRICTION * side
        return (force - particular(m, alpha)) * math.exp(-m * alpha), m

    from scipy.optimize import brentq

    alpha, end, force, side = math.radians(85.0), math.radians(10.0), 0.6 * WEIGHT * radius, 1.0
    c, m = patch(force, alpha, side)

    def lateral(a: float) -> float:
        return WEIGHT * radius * math.sin(a) - c * math.exp(m * a) - particular(m, a)

    middle = brentq(lateral, end, alpha)
    c, m = patch(WEIGHT * radius * math.sin(middle), middle, -1.0)
    assert found.force == pytest.approx(c * math.exp(m * end) + particular(m, end), rel=1e-10)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_horizontal_turn_follows_the_inverse_hyperbolic_sine(direction: float) -> None:
    """asinh(F k/w) = asinh(F_b k/w) + ε μ k x."""
    survey = arc(400.0, math.pi / 2, math.pi / 2, turn=1.2)
    kind = "pull-out" if direction > 0.0 else "run-in"
    found = run(cutter(survey), operation(kind, survey), STRAIGHT_LAW, bit_force=3e5)
    k = 1.0 / 400.0
    exact = math.sinh(math.asinh(3e5 * k / WEIGHT) + direction * FRICTION * 1.2) * WEIGHT / k
    assert found.force == pytest.approx(exact, rel=1e-10)


def test_rotating_in_an_arc() -> None:
    """F = F₀ + wR(1 − sin α) and n = |2w sin α − w − F₀/R|, from horizontal up."""
    radius, start = 600.0, 2e4
    survey = arc(radius, 0.0, math.pi / 2)
    found = run(cutter(survey), operation("drill", survey), STRAIGHT_LAW, bit_force=start)
    alpha = found.measured_depth / radius
    assert found.forces == pytest.approx(start + WEIGHT * radius * (1.0 - np.sin(alpha)), rel=1e-10)
    contact = np.abs(2.0 * WEIGHT * np.sin(alpha) - WEIGHT - start / radius)
    assert found.contacts == pytest.approx(contact, rel=1e-9, abs=1e-7)
    crossing = math.asin(0.5 * (1.0 + start / (WEIGHT * radius)))

    def summed(a: float) -> float:
        return -2.0 * WEIGHT * radius * math.cos(a) - (WEIGHT * radius + start) * a

    torque = (summed(math.pi / 2) - summed(crossing)) - (summed(crossing) - summed(0.0))
    assert found.torque == pytest.approx(FRICTION * RADIUS * torque, rel=1e-9)


def test_weightless_string_round_a_bend_is_a_capstan() -> None:
    survey = arc(300.0, 0.3, 1.4)
    light = {**PIPE, "weight_per_length": "1e-9 N/m"}
    found = run(cutter(survey, pipe=light), operation("pull-out", survey), STRAIGHT_LAW, bit_force=1e5)
    assert found.force == pytest.approx(1e5 * math.exp(FRICTION * 1.1), rel=1e-10)


def test_helix_of_the_correlation_follows_the_tangent_and_locks_up() -> None:
    """P = √(4Bw/r) tan(μ x √(wr/4B)); B = 1.188378 MN m², w = 241 N/m, r = 44.45 mm, μ = 0.3: lock-up 3,487.88 m."""
    pipe = {**PIPE, "bending_stiffness": "1.188378e6 N m^2", "weight_per_length": "241 N/m"}
    survey = Survey.of([0.0, 4000.0], [90.0, 90.0])
    law = correlation(helix_from=0.0)
    cut = cutter(survey, pipe=pipe, friction=0.3)
    scale = math.sqrt(4.0 * 1.188378e6 * 241.0 / CLEARANCE)
    rate = 0.3 * math.sqrt(241.0 * CLEARANCE / (4.0 * 1.188378e6))
    assert scale == pytest.approx(160.539e3, rel=1e-5)
    found = run(cut, operation("run-in", survey), law, depth=3000.0)
    assert -found.force == pytest.approx(scale * math.tan(rate * 3000.0), rel=1e-9)
    locked = run(cut, operation("run-in", survey), law)
    assert locked.locked_at is not None
    assert 4000.0 - locked.locked_at == pytest.approx(0.5 * math.pi / rate, rel=1e-10)
    assert 4000.0 - locked.locked_at == pytest.approx(3487.88, abs=0.005)
    deepest = reach(cut, operation("run-in", survey), law, "early", 4000.0)
    assert deepest.lock_up is not None
    assert deepest.lock_up.value == pytest.approx(0.5 * math.pi / rate, rel=1e-8)


def test_weightless_helix() -> None:
    """1/P(x) = 1/P₀ − μ r x/4B."""
    light = {**PIPE, "weight_per_length": "0 N/m"}
    survey = Survey.of([0.0, 500.0], [90.0, 90.0])
    found = run(cutter(survey, pipe=light), operation("slide", survey, -2e5), correlation())
    assert -1.0 / found.force == pytest.approx(1.0 / 2e5 - FRICTION * CLEARANCE * 500.0 / (4.0 * STIFFNESS), rel=1e-9)


def test_vertical_compression_saturates() -> None:
    """Pushed down a vertical hole from below, P tends to √(4Bw/μr)."""
    survey = Survey.of([0.0, 30000.0], [0.0, 0.0])
    limit = math.sqrt(4.0 * STIFFNESS * WEIGHT / (FRICTION * CLEARANCE))
    below = run(cutter(survey), operation("slide", survey, -0.999 * limit), correlation())
    assert below.arrived
    above = run(cutter(survey), operation("slide", survey, -1.001 * limit), correlation())
    assert not above.arrived


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_random_wells_match_another_integrator_balance_and_do_not_depend_on_stations(seed: int) -> None:
    """Against DOP853 of SciPy on the path of the survey, by unit vectors; stations added on the arcs change nothing."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(2, 8))
    md = np.concatenate([[0.0], np.cumsum(draw.uniform(50.0, 600.0, count))])
    inclination = np.clip(np.cumsum(draw.uniform(-10.0, 35.0, count + 1)), 0.5, 100.0)
    azimuth = np.cumsum(draw.normal(0.0, 15.0, count + 1))
    survey = Survey.of(md, inclination, azimuth)
    kind = str(draw.choice(["run-in", "pull-out"]))
    cut = cutter(survey)
    found = run(cut, operation(kind, survey), STRAIGHT_LAW)
    assert balance(found, survey).value < 1e-8
    coarse = run(cut, operation(kind, survey), STRAIGHT_LAW, coarse=True)
    error = error_of(found, coarse)[0]
    assert (
        abs(found.force - by_vectors(survey, 1.0 if kind == "pull-out" else -1.0))
        < 5e-11 * WEIGHT * survey.md[-1] + error
    )
    finer = refined(survey)
    again = run(cutter(finer), operation(kind, finer), STRAIGHT_LAW)
    assert abs(again.force - found.force) <= 10.0 * error + 1e-5


def tangents(survey: Survey) -> np.ndarray:
    a, b = np.radians(survey.inclination), np.radians(survey.azimuth)
    return np.stack([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)], axis=1)


def slerp(first: np.ndarray, last: np.ndarray, part: float) -> tuple[np.ndarray, np.ndarray]:
    """Tangent on the arc and its derivative by the part."""
    angle = math.acos(np.clip(first @ last, -1.0, 1.0))
    if angle < 1e-9:
        return first, last - first
    s = math.sin(angle)
    t = math.sin((1.0 - part) * angle) / s * first + math.sin(part * angle) / s * last
    d = angle * (-math.cos((1.0 - part) * angle) / s * first + math.cos(part * angle) / s * last)
    return t, d


def by_vectors(survey: Survey, direction: float) -> float:
    """Hook load by vectors: n = |F t' + w(g − (g·t) t)|."""
    down, t = np.array([0.0, 0.0, 1.0]), tangents(survey)
    force = 0.0
    for i in range(len(survey) - 2, -1, -1):
        length = survey.md[i + 1] - survey.md[i]

        def rate(x: float, f: np.ndarray, i: int = i, length: float = length) -> list[float]:
            tangent, bend = slerp(t[i], t[i + 1], 1.0 - x / length)
            lateral = f[0] * bend / length + WEIGHT * (down - tangent[2] * tangent)
            return [WEIGHT * tangent[2] + direction * FRICTION * float(np.linalg.norm(lateral))]

        solved = solve_ivp(rate, (0.0, length), [force], method="DOP853", rtol=1e-11, atol=1e-6, max_step=20.0)
        force = float(solved.y[0, -1])
    return force


def refined(survey: Survey) -> Survey:
    """A station added at the middle of every arc."""
    t = tangents(survey)
    md, inc, azi = [float(survey.md[0])], [float(survey.inclination[0])], [float(survey.azimuth[0])]
    for i in range(len(survey) - 1):
        middle, _ = slerp(t[i], t[i + 1], 0.5)
        md += [0.5 * float(survey.md[i] + survey.md[i + 1]), float(survey.md[i + 1])]
        turned = math.degrees(math.atan2(middle[1], middle[0]))
        inc += [math.degrees(math.acos(middle[2])), float(survey.inclination[i + 1])]
        azi += [turned + 360.0 * round((survey.azimuth[i] - turned) / 360.0), float(survey.azimuth[i + 1])]
    return Survey.of(md, inc, azi)


def test_friction_acts_along_the_resultant_of_both_speeds() -> None:
    survey = Survey.of([0.0, 1000.0], [90.0, 90.0])
    speed, rpm = 0.1, 60.0
    around = 2.0 * math.pi * rpm / 60.0 * RADIUS
    cut = Cutter(well(survey, {"kind": "ream", "speed": "0.1 m/s", "rpm": rpm}))
    found = run(cut, cut.well.operations[0], STRAIGHT_LAW)
    whole = FRICTION * WEIGHT * 1000.0
    assert -found.force == pytest.approx(whole * speed / math.hypot(speed, around), rel=1e-10)
    assert found.torque == pytest.approx(whole * RADIUS * around / math.hypot(speed, around), rel=1e-10)
