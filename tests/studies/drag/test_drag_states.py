"""Buckled intervals: exact local states, rules where several are stable, lock-up, what was on the way."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drag_wells import CLEARANCE, FRICTION, STIFFNESS, WEIGHT, cutter, horizontal, operation, well, well_a_survey
from scipy.integrate import quad, solve_ivp
from scipy.optimize import minimize_scalar

from rodwell.analysis.endless.local import LIMITS, local_state
from rodwell.studies.drag.contact import HELICAL, SINUSOIDAL
from rodwell.studies.drag.drag import drag
from rodwell.studies.drag.history import History, run_with_history, states_differ
from rodwell.studies.drag.laws import CHEN, STRAIGHT_LAW, correlation, exact
from rodwell.studies.drag.lock_up import reach, transfer
from rodwell.studies.drag.plain import drag_dict
from rodwell.studies.drag.run import balance, run
from rodwell.studies.drag.strength import load_of
from rodwell.survey.survey import Survey

UNIT = math.sqrt(STIFFNESS * WEIGHT / CLEARANCE)
"""√(Bw/r) in a horizontal hole: P is β times it."""


@pytest.mark.parametrize(("kind", "force", "hook"), [("run-in", 0.0, 222668.1804), ("slide", -50e3, 146042.6008)])
def test_well_a_with_exact_local_states(kind: str, force: float, hook: float) -> None:
    """Theory notes: two programs, helix from equal energy on."""
    survey = well_a_survey()
    found = run(cutter(survey), operation(kind, survey, force), exact(), "equal-energy")
    assert found.force == pytest.approx(hook, rel=1e-9)
    assert [state for _, _, state in found.buckled] == [HELICAL]
    assert balance(found, survey).value < 1e-10


@pytest.mark.parametrize("rule", ["early", "equal-energy", "late"])
def test_a_horizontal_string_takes_the_length_that_its_contact_force_says(rule: str) -> None:
    """x = (1/μ) √(B/(wr)) ∫ dβ/n̄(β), by quadrature of the states of the endless rod."""
    law = exact()
    switch = {
        "early": LIMITS.helix_lift_off.value,
        "equal-energy": LIMITS.sinusoidal_helix_equal_energy.value,
        "late": LIMITS.sinusoidal_lift_off.value,
    }[rule]

    def inverse(name: str):
        return lambda beta: 1.0 / local_state(float(beta), name).contact_mean

    first, last = 1.5, 6.0
    length = 2.0 - first
    length += quad(inverse("sinusoidal"), 2.0, switch, epsabs=0.0, epsrel=1e-11)[0]
    length += quad(inverse("helical"), switch, last, epsabs=0.0, epsrel=1e-11)[0]
    length *= UNIT / (FRICTION * WEIGHT)
    survey = horizontal(length)
    found = run(cutter(survey), operation("slide", survey, -first * UNIT), law, rule)
    assert -found.force / UNIT == pytest.approx(last, rel=1e-8)
    states = [state for _, _, state in found.buckled]
    assert states == [SINUSOIDAL, HELICAL]


def test_lock_up_of_a_horizontal_string_is_an_integral_over_all_loads() -> None:
    """L = (Λ/μ) √(B/wr), Λ = ∫ dβ/n̄, from β = 0."""
    switch = LIMITS.sinusoidal_helix_equal_energy.value
    total = 2.0 + quad(lambda b: 1.0 / local_state(float(b), "sinusoidal").contact_mean, 2.0, switch)[0]
    total += quad(lambda x: 1.0 / (x * x * local_state(1.0 / float(x), "helical").contact_mean), 1e-9, 1.0 / switch)[0]
    length = total * UNIT / (FRICTION * WEIGHT)
    survey = horizontal(2.0 * length)
    found = reach(cutter(survey), operation("run-in", survey), exact(), "equal-energy", float(survey.md[-1]))
    assert found.lock_up is not None
    assert found.lock_up.value == pytest.approx(length, rel=1e-8)
    bare = 3.0 * math.sqrt(2.0)  # n = r P²/4B alone, from Chen's load on
    assert total == pytest.approx(bare, rel=0.05)


def test_correlation_adds_the_whole_weight_to_the_helix() -> None:
    """Λ = 2√2 + 2(π/2 − atan √2) where n = w + rP²/4B from Chen's load on."""
    total = CHEN + 2.0 * (0.5 * math.pi - math.atan(math.sqrt(2.0)))
    length = total * UNIT / (FRICTION * WEIGHT)
    survey = horizontal(1.5 * length)
    found = reach(cutter(survey), operation("run-in", survey), correlation(), "early", float(survey.md[-1]))
    assert found.lock_up is not None
    assert found.lock_up.value == pytest.approx(length, rel=1e-8)


def test_where_the_push_ends_the_force_at_surface_is_the_push() -> None:
    survey = horizontal(3000.0)
    cut = cutter(survey, push="40 kN", block_weight="10 kN")
    found = reach(cut, operation("run-in", survey), STRAIGHT_LAW, "early", 3000.0)
    assert found.lock_up is None
    assert found.push_ends is not None
    assert found.push_ends.value == pytest.approx(50e3 / (FRICTION * WEIGHT), rel=1e-9)


def stairs() -> Survey:
    """Vertical to 200 m, level from 400 to 2400 m, 20° from 2700 to 4000 m: below, the string pulls itself on."""
    return Survey.of([0.0, 200.0, 400.0, 2400.0, 2700.0, 4000.0], [0.0, 0.0, 90.0, 90.0, 20.0, 20.0])


def test_what_stops_on_the_way_is_not_possible_below() -> None:
    """At 4000 m the string hangs in the drop, but it comes no deeper than in the same hole without one."""
    free = {"kind": "run-in", "bit_depth": "4000 m"}
    found = drag(well(stairs(), free, {"kind": "slide", "bit_force": "-20 kN"}, friction=0.35))
    run_in, slide = found.operations
    assert run_in.possible_at_depth
    assert slide.possible_at_depth
    assert not run_in.possible
    assert not slide.possible
    level = Survey.of([0.0, 200.0, 400.0, 2400.0], [0.0, 0.0, 90.0, 90.0])
    alone = reach(cutter(level, friction=0.35), operation("run-in", level), exact(), "early", 2400.0)
    assert alone.push_ends is not None
    data = drag_dict(found)
    assert data["verdict"] == "fails"
    for one in data["operations"]:
        assert one["push_ends_depth"]["value"] == pytest.approx(alone.push_ends.value, rel=1e-9)
    assert "cannot get to 4000 m" in data["summary"][0]
    assert data["summary"][0].endswith("2 of 2 operations fail.")
    assert any(line.startswith("Slide cannot get to") for line in data["summary"])
    assert [one["verdict"] for one in data["operations"]] == ["fails", "fails"]
    assert data["operations"][1]["why"] in " ".join(data["summary"])
    assert not any("push enough" in line for line in data["summary"])


def test_a_dip_between_the_depths_looked_at_is_found() -> None:
    """The force at surface is least within the drop: a push that is 5 N short of it ends for a metre or two."""
    survey = stairs()
    cut = cutter(survey, friction=0.35)

    def force(depth: float) -> float:
        return run(cut, operation("run-in", survey), STRAIGHT_LAW, depth=depth, coarse=True, record=False).force

    least = minimize_scalar(force, bounds=(2400.0, 2700.0), method="bounded")
    cut = cutter(survey, friction=0.35, push=f"{-least.fun - 5.0} N")
    found = reach(cut, operation("run-in", survey), STRAIGHT_LAW, "early", 4000.0)
    assert found.on_the_way
    assert found.push_ends is not None
    assert 0.0 < least.x - found.push_ends.value < 3.0


def test_transfer_is_the_derivative_of_the_forces_at_both_ends() -> None:
    """In a horizontal helix of the correlation P_top follows the tangent of P_bit: dP_bit/dP_top in closed form."""
    survey = horizontal(800.0)
    law = correlation(helix_from=0.0)
    scale, rate = math.sqrt(4.0) * UNIT, FRICTION * math.sqrt(WEIGHT * CLEARANCE / (4.0 * STIFFNESS))
    start = 1e5
    top = scale * math.tan(math.atan(start / scale) + rate * 800.0)
    derivative = (1.0 + (start / scale) ** 2) / (1.0 + (top / scale) ** 2)
    found = transfer(cutter(survey), operation("slide", survey, -start), law, "early")
    assert found == pytest.approx(1.0 / (1.0 / derivative), rel=1e-4)


def test_exact_states_in_a_bend_match_another_integrator() -> None:
    """A build section under compression, with curvature in q: SciPy's integrator on the exact states."""
    radius = 400.0
    survey = Survey.of([0.0, radius * math.radians(70.0)], [15.0, 85.0])
    start = 4.0 * UNIT
    found = run(cutter(survey), operation("slide", survey, -start), exact(), "equal-energy")
    switch = LIMITS.sinusoidal_helix_equal_energy.value

    def rate(x: float, p: np.ndarray) -> list[float]:
        alpha = math.radians(85.0) - x / radius
        q = WEIGHT * math.sin(alpha) + p[0] / radius
        beta = p[0] / math.sqrt(STIFFNESS * q / CLEARANCE)
        factor = 1.0
        if beta > 2.0:
            name = "helical" if beta >= switch else "sinusoidal"
            factor = local_state(float(beta), name).contact_mean
        return [-WEIGHT * math.cos(alpha) + FRICTION * q * factor]

    solved = solve_ivp(rate, (0.0, float(survey.md[-1])), [start], method="DOP853", rtol=1e-11, atol=1e-5, max_step=2.0)
    assert found.force == pytest.approx(-solved.y[0, -1], rel=1e-7)


def test_bounds_hold_the_history_between_them() -> None:
    """A horizontal string under 3.1 √(Bw/r): both states are stable, and how it was loaded decides."""
    survey = horizontal(900.0)
    law = exact()
    history = History(cutter(survey), law)
    slide = operation("slide", survey, -2.6 * UNIT)
    assert states_differ(history, slide)
    early, late = (run_with_history(history, slide, rule).force for rule in ("early", "late"))
    remembered = run_with_history(history, slide, "history").force
    assert early < late
    assert early - 1e-6 <= remembered <= late + 1e-6
    assert remembered == pytest.approx(late, rel=1e-12)  # only ever loaded: the sinusoidal state lasts


def test_a_helix_stays_when_it_is_unloaded() -> None:
    """Helical under β = 4, then unloaded to β = 3: the helix has not ceased, a string never loaded so is sinusoidal."""
    survey = horizontal(50.0)
    law = exact()
    slide = operation("slide", survey, -3.0 * UNIT)
    cut = cutter(survey)
    never = run(cut, slide, law, "history")
    before = run(cut, operation("slide", survey, -4.0 * UNIT), law, "history")
    after = run(cut, slide, law, "history", remembered=before.intervals(HELICAL))
    assert {state for _, _, state in never.buckled} == {SINUSOIDAL}
    assert {state for _, _, state in after.buckled} == {HELICAL}
    assert after.force < never.force


def test_the_verdict_takes_the_worse_of_the_bounds() -> None:
    survey = horizontal(900.0)
    found = drag(well(survey, {"kind": "slide", "bit_force": f"{-2.6 * UNIT} N"}, push="400 kN"))
    one = found.operations[0]
    loads = [one.bounds[name].hook_load for name in ("early", "late")]
    assert all(load is not None for load in loads)
    assert one.margin is not None
    assert one.margin.value == pytest.approx(min(load.value for load in loads if load) + 400e3)
    data = drag_dict(found)["operations"][0]
    assert data["bounds"]["early"]["hook_load"]["value"] < data["bounds"]["late"]["hook_load"]["value"]
    assert data["buckled"][0]["state"] == "sinusoidal"


def test_a_string_that_locks_up_says_so_and_keeps_what_was_computed() -> None:
    survey = horizontal(6000.0)
    found = drag(well(survey, {"kind": "run-in"}))
    one, data = found.operations[0], drag_dict(found)
    assert one.locked
    assert data["verdict"] == "fails"
    assert data["operations"][0]["hook_load"] is None
    assert "locks up" in data["summary"][0]
    assert 0.0 < data["operations"][0]["locks_at"] < 6000.0
    assert data["operations"][0]["largest_von_mises"] is None  # it has no bound
    assert len(data["operations"][0]["along"]["measured_depth"]) > 100
    assert data["operations"][0]["lock_up_depth"]["value"] < 6000.0


def test_a_string_that_was_run_in_as_a_helix_stays_one_while_it_is_reamed() -> None:
    """Running in loads the upper end beyond lift-off; reaming, the force is less, but the helix lasts."""
    survey = horizontal(5200.0)
    history = History(cutter(survey), exact())
    into = run_with_history(history, operation("run-in", survey), "late")
    assert load_of(into)[-1] > LIMITS.sinusoidal_lift_off.value
    around = 0.06 * math.sqrt(1.0 / 0.8**2 - 1.0) / 0.0635  # so that 0.8 of the friction acts along the hole
    ream = operation("ream", survey, speed=0.06, turning=around)
    never = run_with_history(history, ream, "late")
    kept = run_with_history(history, ream, "history")
    top = load_of(never)[-1]
    assert LIMITS.helix_lift_off.value < top < LIMITS.sinusoidal_lift_off.value
    assert never.states[-1] == SINUSOIDAL
    assert kept.states[-1] == HELICAL
    assert kept.force < never.force
