"""The stiff string: against closed forms of a beam on a wall, limits, derivatives by differences, its own meshes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drag_wells import CLEARANCE, FRICTION, PIPE, RADIUS, STIFFNESS, WEIGHT, cutter, operation, well, well_a_survey
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import fsolve

from rodwell.errors import InputError
from rodwell.studies.drag import bending
from rodwell.studies.drag.bending import stiff_run
from rodwell.studies.drag.drag import drag
from rodwell.studies.drag.laws import STRAIGHT_LAW
from rodwell.studies.drag.plain import drag_dict
from rodwell.studies.drag.run import balance, run
from rodwell.studies.drag.stiff import Loads, _beam, _state, frame, lay, loads_at
from rodwell.survey.survey import Survey

B, Q, R = 1.2e6, 241.0, 0.0445


def elements(length: float, h: float, tension: float, bend_from: float, kappa: float) -> tuple[np.ndarray, Loads]:
    """A straight hole, from ``bend_from`` on an arc, a load Q to one side."""
    depth = np.linspace(0.0, length, round(length / h) + 1)
    middle = 0.5 * (depth[:-1] + depth[1:])
    k = np.zeros((len(middle), 2))
    k[middle > bend_from, 0] = kappa
    side = np.tile([Q, 0.0], (len(middle), 1))
    one = np.ones(len(middle))
    return depth, Loads(B * one, tension * one, k, side, R * one)


def test_a_string_lifts_off_where_the_curvature_jumps() -> None:
    """Between −a and b the gap g obeys B g⁗ = −q with g = g′ = g″ = 0 at both ends and g″ jumping by κ between."""
    kappa = 1e-3

    def conditions(v: np.ndarray) -> list[float]:
        a, b, force = v
        g = force * a**3 / (6 * B) - Q * a**4 / (24 * B)
        d, c = force * a**2 / (2 * B) - Q * a**3 / (6 * B), force * a / B - Q * a**2 / (2 * B) + kappa
        t = force / B - Q * a / B
        return [g + d * b + c * b**2 / 2 + t * b**3 / 6 - Q * b**4 / (24 * B),
                d + c * b + t * b**2 / 2 - Q * b**3 / (6 * B), c + t * b - Q * b**2 / (2 * B)]  # fmt: skip

    a, b, force = fsolve(conditions, [3.0, 1.0, 300.0])
    depth, loads = elements(200.0, 0.125, 0.0, 100.0, kappa)
    found = lay(depth, loads, np.tile([R, 0.0], (len(depth), 1)))
    assert found.settled
    gap = R - found.displacement[:, 0]
    inside = (depth > 100.0 - a) & (depth < 100.0 + b)
    s = np.linspace(0.0, a, 2000)
    highest = np.max(force * s**3 / (6 * B) - Q * s**4 / (24 * B))
    assert np.max(gap[inside]) == pytest.approx(highest, rel=2e-3)
    assert np.all(found.force[(depth > 100.3 - a) & (depth < 99.7 + b)] == 0.0)
    above = found.force[(depth > 90.0) & (depth <= 100.0)].sum()
    below = found.force[(depth > 100.0) & (depth < 110.0)].sum()
    assert above == pytest.approx(force + Q * (10.0 - a), abs=0.6 * Q * 0.125)
    assert below == pytest.approx(Q * (a + b) - force + Q * (10.0 - b), abs=0.6 * Q * 0.125)


def test_in_a_long_arc_the_contact_is_that_of_the_soft_string() -> None:
    """Constant curvature: bending adds nothing, q = F κ + the side load."""
    depth, loads = elements(400.0, 1.0, 2e5, -1.0, 2e-3)
    found = lay(depth, loads, np.tile([R, 0.0], (len(depth), 1)))
    middle = found.force[(depth > 100.0) & (depth < 300.0)]
    assert middle == pytest.approx(2e5 * 2e-3 + Q, rel=1e-6)
    assert found.curvature[200] == pytest.approx(2e-3, rel=1e-6)


def test_a_string_across_its_hole_is_a_beam() -> None:
    """Hinged in the middle at surface, laid down on the wall by its weight: it touches after L⁴ = 24 B r/q."""
    q, r = 5.0, 0.4
    depth = np.linspace(0.0, 300.0, 1201)
    one = np.ones(1200)
    loads = Loads(B * one, 0.0 * one, np.zeros((1200, 2)), np.tile([q, 0.0], (1200, 1)), r * one)
    found = lay(depth, loads, np.tile([r, 0.0], (1201, 1)))
    # u″ = 0 at the hinge and where it lies down: B u″ = −V x + q x²/2 with V = q L/2; u(L) = r, u′(L) = 0
    # gives u = (q/24B)(x⁴ − 2 L x³) + c x, c = q L³/12B, r = q L⁴/24B
    length = (24.0 * B * r / q) ** 0.25
    touching = depth[found.force > 0.0]
    assert touching[0] == pytest.approx(length, abs=1.0)  # the gap opens with the cube of the distance
    x = depth[depth < length]
    shape = q / (24.0 * B) * (x**4 - 2.0 * length * x**3 + 2.0 * length**3 * x)
    assert found.displacement[depth < length, 0] == pytest.approx(shape, abs=2e-4 * r)


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10**6))
def test_forces_are_the_derivative_of_the_energy(seed: int) -> None:
    draw = np.random.default_rng(seed)
    n = 6
    h = draw.uniform(0.5, 2.0, n)
    loads = Loads(draw.uniform(1e5, 1e6, n), draw.normal(0.0, 1e4, n), draw.normal(0.0, 1e-2, (n, 2)),
                  draw.normal(0.0, 100.0, (n, 2)), np.full(n, 0.05))  # fmt: skip
    band, load = _beam(h, loads)
    wall, clearance = np.full(n + 1, 1e6), np.full(n + 1, 0.05)
    x = draw.normal(0.0, 0.06, 4 * (n + 1))
    _, gradient, second = _state(x, band, load, wall, clearance)
    step = draw.normal(0.0, 1.0, len(x))
    e = 1e-6
    ahead, back = (_state(x + s * e * step, band, load, wall, clearance) for s in (1.0, -1.0))
    assert (ahead[0] - back[0]) / (2.0 * e) == pytest.approx(float(gradient @ step), rel=1e-6, abs=1e-4)
    product = second[0] * step
    for k in range(1, len(second)):
        product[k:] += second[k, :-k] * step[:-k]
        product[:-k] += second[k, :-k] * step[k:]
    size = np.max(np.abs(product))
    assert (ahead[1] - back[1]) / (2.0 * e) == pytest.approx(product, abs=1e-4 * size)


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10**6))
def test_the_frame_does_not_turn_and_loads_are_those_of_the_soft_string(seed: int) -> None:
    draw = np.random.default_rng(seed)
    md = np.concatenate([[0.0], np.cumsum(draw.uniform(20.0, 200.0, 6))])
    survey = Survey.of(md, np.clip(np.cumsum(draw.uniform(-5.0, 25.0, 7)), 0.0, 110.0), draw.uniform(-90.0, 90.0, 7))
    normals, tangents = frame(survey)
    assert np.einsum("nij,nj->ni", normals, tangents) == pytest.approx(0.0, abs=1e-12)
    assert np.einsum("ni,ni->n", normals[:, 0], normals[:, 1]) == pytest.approx(0.0, abs=1e-12)
    found = run(cutter(survey), operation("pull-out", survey), STRAIGHT_LAW)
    inside = np.linspace(1.0, float(survey.md[-1]) - 1.0, 40)
    curvature, down = loads_at(survey, inside, normals, tangents)
    forces = np.interp(inside, found.measured_depth[::-1], found.forces[::-1])
    q = np.linalg.norm(forces[:, None] * curvature + WEIGHT * down, axis=1)
    near = np.min(np.abs(inside[:, None] - survey.md), axis=1) > 12.0
    told = np.interp(inside, found.measured_depth[::-1], found.pressing[::-1])
    assert q[near] == pytest.approx(told[near], rel=2e-3, abs=0.5)


def test_in_a_smooth_well_it_is_close_to_the_soft_string_and_meshes_tell_the_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    survey = well_a_survey()
    cut = cutter(survey)
    out = operation("pull-out", survey)
    found = stiff_run(cut, out, STRAIGHT_LAW, "early")
    soft = run(cut, out, STRAIGHT_LAW)
    assert found.settled
    assert found.hook_load.value == pytest.approx(soft.force, rel=1e-3)
    assert balance(found.run, survey).value < 1e-8
    monkeypatch.setattr(bending, "ELEMENT", 0.5)
    finer = stiff_run(cut, out, STRAIGHT_LAW, "early")
    assert abs(finer.hook_load.value - found.hook_load.value) <= found.hook_load.error
    bend = found.curvature[np.argmin(np.abs(found.run.measured_depth - 1500.0))]
    assert bend == pytest.approx(math.radians(3.0) / 30.0, rel=1e-3)


def test_the_torque_of_a_rotating_stiff_string_is_that_of_all_its_contact_forces() -> None:
    """T = μ r Σ P, the forces of the string as it lies under the tension found."""
    md = np.arange(0.0, 601.0, 30.0)
    wander = np.random.default_rng(3).normal(0.0, 1.0, len(md))
    survey = Survey.of(md, np.abs(np.linspace(0.0, 50.0, len(md)) + wander), 2.0 * wander[::-1])
    cut = cutter(survey)
    found = stiff_run(cut, operation("rotate-off-bottom", survey), STRAIGHT_LAW, "early")
    one = found.run
    depth = bending._nodes(one, bending.SHORTEST * bending.ELEMENT)
    middle = 0.5 * (depth[:-1] + depth[1:])
    curvature, down = loads_at(survey, middle, *frame(survey))
    full = np.ones(len(middle))
    tension = np.interp(middle, one.measured_depth[::-1], one.forces[::-1])
    found_again = lay(depth, Loads(STIFFNESS * full, tension, curvature, WEIGHT * down, CLEARANCE * full),
                      np.zeros((len(depth), 2)))  # fmt: skip
    assert found.settled
    assert found_again.settled
    assert one.torque == pytest.approx(FRICTION * RADIUS * found_again.force.sum(), rel=1e-4)
    soft = run(cut, operation("rotate-off-bottom", survey), STRAIGHT_LAW)
    assert abs(one.torque - soft.torque) > 0.01 * soft.torque


def test_without_stiffness_and_clearance_it_is_the_soft_string(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bending, "ELEMENT", 0.25)
    survey = Survey.of([0.0, 200.0, 500.0, 800.0], [0.0, 0.0, 40.0, 40.0])
    limp = {**PIPE, "bending_stiffness": "10 N m^2", "outer_diameter": "8.499 in"}
    cut = cutter(survey, pipe=limp)
    out = operation("pull-out", survey)
    found = stiff_run(cut, out, STRAIGHT_LAW, "early")
    assert found.hook_load.value == pytest.approx(run(cut, out, STRAIGHT_LAW).force, rel=3e-5)


def test_a_well_with_a_stiff_string_says_what_it_leaves_out() -> None:
    survey = well_a_survey()
    found = drag(well(survey, {"kind": "run-in"}, string="stiff"))
    data = drag_dict(found)
    one = data["operations"][0]
    assert one["settled"]
    assert one["reach"] == {}
    assert abs(one["hook_load"]["value"] - one["compared"]["soft"]["hook_load"]["value"]) < 500.0
    assert any("how deep it can go, and whether it gets to its depth, is not searched" in line
               for line in data["assumptions"])  # fmt: skip
    assert "the way down is not looked at" in data["summary"][0]
    assert any("by a soft string" in line for line in data["summary"])
    with pytest.raises(InputError, match="for the soft string only"):
        drag(well(survey, {"kind": "run-in"}, string="stiff", road_map={"depths": 5}))


def rough_survey() -> Survey:
    """Down to 60° with stations 30 m apart whose inclination goes to and fro by 2°."""
    md = np.arange(0.0, 901.0, 30.0)
    return Survey.of(md, np.minimum(md / 10.0, 60.0) + 2.0 * (np.arange(len(md)) % 2))


@pytest.mark.parametrize("kind", ["pull-out", "run-in"])
def test_the_wall_never_pulls_at_a_stiff_string(kind: str) -> None:
    """Where stiffness lifts the string off the wall nothing is left of the soft string's contact; work balances."""
    survey = rough_survey()
    found = drag(well(survey, {"kind": kind}, string="stiff")).operations[0]
    contacts = found.run.contacts
    assert np.min(contacts) == 0.0
    assert np.mean(contacts == 0.0) > 0.02
    assert np.min(found.run.rows[:, 3]) > -1e-2 * np.max(contacts)  # what varies along a piece, no more
    assert found.balance is not None
    assert found.balance.value <= 1e-8


def test_a_stiff_string_that_locks_up_is_told_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """It locks up as a soft string: there are no forces that could bend it, and nothing that has to settle."""
    monkeypatch.setattr(bending, "lay", lambda *_: pytest.fail("bent by forces beyond bounds"))
    slide = {"kind": "slide", "bit_force": "-400 kN"}
    found = drag(well(well_a_survey(), slide, string="stiff"))
    assert found.operations[0].locked
    assert found.operations[0].settled
    assert not found.operations[0].possible
