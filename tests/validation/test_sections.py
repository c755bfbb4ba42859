"""A string of sections: loads in closed form, by transfer matrices and by shooting; buckled states by another program.

Euler loads of two equal halves, and the two-section case at γ = 15, α = 60° (40-digit shooting), are those of the
project's notes on the theory of strings. The other truths: matrix exponentials of the linear equation, section by
section; `solve_bvp` on the paper's fifteen equations; balances; symmetries; limits.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from rodwell import Problem, critical_loads, follow, loads_without_wall
from rodwell.analysis.branch.verifying.verify import verify
from rodwell.analysis.curves.critical import critical_curves
from rodwell.analysis.loads.sensitivity import sensitivities
from rodwell.analysis.proof.certify import certify
from rodwell.errors import InputError

HALVES = ((0.5, 1.0), (0.5, 0.5))
TWO = ((0.6, 1.0, 1.0), (0.4, 0.3, 0.5))
THREE = ((0.2, 1.0, 1.0, 1.0, 2.0), (0.4, 0.3, 0.5), (0.4, 5.0, 2.0))


@pytest.mark.parametrize(
    ("ends", "ratio", "load"),
    [
        ("clamped-clamped", 0.5, 25.809137165),
        ("clamped-free", 0.5, 2.067232897),
        ("pinned-pinned", 0.2, 2.994652033),
    ],
)
def test_euler_loads_of_two_halves(ends: str, ratio: float, load: float) -> None:
    mode = critical_loads(Problem(0.0, ends=ends, sections=((0.5, 1.0), (0.5, ratio))), 1)[0]
    assert -mode.force == pytest.approx(load, rel=3e-10)
    assert mode.error < 1e-8


def test_two_sections_against_shooting() -> None:
    loads = critical_loads(Problem(15.0, 60.0, sections=TWO), 3)
    known = [-54.290445115953, -73.536263059112, -131.937687248667]
    assert loads.forces == pytest.approx(known, rel=1e-12)
    assert np.all(np.abs(loads.forces - known) <= loads.errors + 1e-11)


def _transfer(problem: Problem, force: float) -> np.ndarray:
    """Of (v, v′, b v″, b v‴ − N v′) over a horizontal string: (b v″)″ − (N v′)′ + (wₗ/Δ) q v = 0, exactly."""
    whole = np.eye(4)
    for length, b, q, *_ in problem.sections:
        foundation = q * problem.foundation / problem.clearance
        rates = np.array([[0, 1, 0, 0], [0, 0, 1 / b, 0], [0, force, 0, 1], [-foundation, 0, 0, 0]], dtype=float)
        whole = expm(length * rates) @ whole
    return whole


HELD = {"clamped": (0, 1), "pinned": (0, 2), "guided": (1, 3), "free": (2, 3)}
"""Which of the four vanish at an end."""


def _misfit(problem: Problem, force: float) -> float:
    """Determinant whose zeros are the critical loads, from the transfer matrix."""
    first, last = (HELD[end] for end in problem.ends)
    free = [i for i in range(4) if i not in first]
    return float(np.linalg.det(_transfer(problem, force)[np.ix_(last, free)]))


RATIO = st.floats(-1.0, 1.0).map(lambda x: 10.0**x)
SECTIONS = st.lists(st.tuples(st.floats(0.1, 1.0), RATIO, RATIO), min_size=2, max_size=5)


def _string(drawn: list[tuple[float, float, float]]) -> tuple[tuple[float, ...], ...]:
    total = sum(length for length, _, _ in drawn)
    return tuple((length / total, b, q) for length, b, q in drawn)


@given(SECTIONS, st.sampled_from(["clamped-clamped", "pinned-clamped", "guided-pinned", "pinned-free"]))
@settings(max_examples=25, deadline=None)
def test_loads_are_zeros_of_the_transfer_matrix(drawn: list[tuple[float, float, float]], ends: str) -> None:
    problem = Problem(2.0, 90.0, ends=ends, sections=_string(drawn))
    for mode in critical_loads(problem, 2):
        width = max(2.0 * mode.error, 1e-9 * abs(mode.force))
        below, above = (_misfit(problem, mode.force + sign * width) for sign in (-1.0, 1.0))
        assert below * above <= 0.0


@given(SECTIONS)
@settings(max_examples=10, deadline=None)
def test_a_string_turned_round_has_the_same_loads(drawn: list[tuple[float, float, float]]) -> None:
    string = _string(drawn)
    there = critical_loads(Problem(5.0, ends="clamped-pinned", sections=string), 2)
    back = critical_loads(Problem(5.0, ends="pinned-clamped", sections=string[::-1]), 2)
    assert np.all(np.abs(there.forces - back.forces) <= there.errors + back.errors)


@given(SECTIONS, st.floats(0.5, 4.0))
@settings(max_examples=10, deadline=None)
def test_loads_are_measured_in_stiffness(drawn: list[tuple[float, float, float]], times: float) -> None:
    """With all stiffnesses and weights so many times as large, so are the loads."""
    string = _string(drawn)
    more = tuple((length, times * b, times * q) for length, b, q in string)
    one, other = (critical_loads(Problem(5.0, 70.0, sections=s), 2) for s in (string, more))
    assert np.all(np.abs(times * one.forces - other.forces) <= times * one.errors + other.errors)


def test_constants_are_the_uniform_rod() -> None:
    plain, even = Problem(15.0, 60.0), Problem(15.0, 60.0, sections=((0.25,), (0.75, 1, 1, 1, 1)))
    assert plain == even
    assert plain.sections == ()


def test_one_section_is_a_uniform_rod_with_other_data() -> None:
    one = critical_loads(Problem(10.0, 60.0, sections=((1.0, 2.0, 3.0),)), 2)
    other = critical_loads(Problem(15.0, 60.0), 2)
    assert one.forces == pytest.approx(2.0 * other.forces, rel=1e-11)


def test_splitting_a_section_changes_nothing() -> None:
    split = Problem(15.0, 60.0, sections=((0.2, 1, 1), (0.4, 1, 1), (0.1, 0.3, 0.5), (0.3, 0.3, 0.5)))
    assert critical_loads(split, 3).forces == pytest.approx(
        critical_loads(Problem(15, 60, sections=TWO), 3).forces, rel=1e-12
    )


def test_a_step_that_is_hardly_one_changes_hardly_anything() -> None:
    near = Problem(15.0, 60.0, sections=((0.6, 1.0), (0.4, 1.0 + 1e-7)))
    one, other = follow(Problem(15.0, 60.0)).lift_off, follow(near).lift_off
    assert one is not None
    assert other is not None
    assert other.force == pytest.approx(one.force, rel=1e-6)
    assert other.force != one.force


def test_without_a_wall() -> None:
    clamped = loads_without_wall(Problem(0.0, 0.0, sections=HALVES))
    assert -clamped.forces[0] == pytest.approx(25.809137165, rel=1e-10)
    balls = loads_without_wall(Problem(0.0, 0.0, ends="ball-ball", sections=((0.5, 1.0), (0.5, 0.2))))
    assert -balls.forces[0] == pytest.approx(2.994652033, rel=1e-9)
    nearly = Problem(3.0, 0.0, twist=4.0, sections=((0.3, 1.0), (0.7, 1.0 + 1e-9)))
    assert loads_without_wall(nearly, 2).forces == pytest.approx(
        loads_without_wall(Problem(3.0, 0.0, twist=4.0), 2).forces, rel=1e-7
    )


PROBLEMS = {
    "two": Problem(15.0, 60.0, sections=TWO),
    "three, twisted": Problem(15.0, 75.0, ends="guided-pinned", twist=3.0, sections=THREE),
    "three, free": Problem(15.0, 75.0, ends="pinned-free", sections=THREE),
    "outside": Problem(15.0, 60.0, on_top=True, outside=True, sections=TWO),
}


@pytest.fixture(scope="module", params=PROBLEMS, ids=str)
def branch(request: Any) -> Any:
    return follow(PROBLEMS[request.param])


def test_lifted_states_solve_the_papers_equations(branch: Any) -> None:
    assert branch.lift_off is not None
    state = branch.lift_off.solution
    assert state.certificate.passed, state.certificate
    assert state.certificate.residuals["moment at steps"] < 1e-9
    assert state.certificate.residuals["T₂ by two routes"] < 1e-8


def test_what_the_wall_exerts_at_steps_is_what_the_rod_is_short_of(branch: Any) -> None:
    """Couple and forces against the jumps of M₃ and of the rod's force in the fields, from both sides of each step."""
    state = branch.lift_off.solution
    clearance = state.problem.clearance
    for step in state.step_loads:
        f = state.fields(np.array([np.nextafter(step.s, 0.0), step.s]))
        jump = {name: float(np.diff(values)[0]) for name, values in f.items()}
        force, sin, cos = max(np.abs(f["rod_F3"])), np.sin(f["eta"][0]), np.cos(f["eta"][0])
        assert jump["rod_M3"] == pytest.approx(-step.couple.value, rel=1e-9)
        assert jump["rod_M2"] == pytest.approx(0.0, abs=1e-9 * max(np.abs(f["rod_M2"])))
        assert jump["rod_F2"] == pytest.approx(-step.force.value, abs=1e-8 * force)
        around = sin * jump["rod_F1"] + cos * jump["rod_F3"]  # along u₂; what the turned couple leaves
        assert around == pytest.approx(step.couple.value * sin / clearance, abs=1e-7 * force)
        for name in ("braid_F1", "braid_F2", "braid_F3", "braid_M1", "braid_M2", "braid_M3", "T2", "mu", "xi1", "z"):
            assert abs(jump[name]) < 1e-8 * max(1.0, np.max(np.abs(f[name]))), name
        assert step.lifts


def test_energies_add_up_to_the_one_that_is_stationary(branch: Any) -> None:
    state, e = branch.lift_off.solution, branch.lift_off.solution.energies
    total = e["bending_energy"].value + e["lateral_energy"].value + e["axial_energy"].value - e["end_work"].value
    assert total == pytest.approx(state.point.fine.energy, rel=1e-8)


def test_another_program_finds_the_same_states_and_lift_off() -> None:
    found = verify(follow(PROBLEMS["two"]))
    assert found.agrees
    assert found.lift_off_difference < 1e-9


def test_too_many_sections_for_the_other_program_are_refused() -> None:
    many = tuple((0.125, 1.0 + 0.1 * (i % 2)) for i in range(8))
    with pytest.raises(InputError, match="at most 6 sections"):
        verify(follow(Problem(15.0, sections=many)))


def test_symmetric_strings_keep_their_symmetry() -> None:
    problem = Problem(15.0, sections=((0.3, 1.0), (0.4, 0.4, 0.6), (0.3, 1.0)))
    loads = critical_loads(problem, 4)
    assert sorted(mode.parity for mode in loads) == [-1, -1, 1, 1]
    lift = follow(problem, loads[0]).lift_off
    assert lift is not None
    assert lift.solution.point.fine.symmetry == loads[0].parity


def test_lift_off_of_a_string_turned_round() -> None:
    there, back = (follow(Problem(15.0, sections=s)).lift_off for s in (TWO, TWO[::-1]))
    assert there is not None
    assert back is not None
    assert there.force == pytest.approx(back.force, abs=there.error + back.error)
    assert there.s[0] == pytest.approx(1.0 - back.s[0], abs=1e-7)


def test_the_highest_pressure_is_seen_on_both_sides_of_a_step() -> None:
    state = follow(Problem(15.0, 60.0, sections=((0.35, 1.0), (0.25, 0.3, 0.5), (0.4, 2.0, 3.0)))).lift_off.solution
    steps = state.problem.rod.breaks[1:-1]
    s = np.union1d(np.linspace(0.0, 1.0, 20_001), np.concatenate([steps, np.nextafter(steps, 0.0)]))
    sampled = np.max(state.fields(s)["contact_pressure"])
    assert state.highest_pressure[0] == pytest.approx(
        sampled, abs=1e-5 * np.max(np.abs(state.fields(s)["contact_pressure"]))
    )


def test_derivatives_by_the_data_of_each_section() -> None:
    string, h = [list(section) for section in ((0.35, 1.0, 1.0), (0.25, 0.3, 0.5), (0.4, 2.0, 3.0))], 1e-4
    critical, lift = sensitivities(Problem(15.0, 60.0, sections=string))

    def change(quantity: Any, *changes: tuple[int, int, float]) -> float:
        loads = []
        for sign in (1.0, -1.0):
            sections = [list(section) for section in string]
            for section, which, share in changes:
                sections[section][which] += sign * h * share
            loads.append(quantity(Problem(15.0, 60.0, sections=sections)))
        return float(loads[0] - loads[1]) / (2.0 * h)

    def load(problem: Problem) -> float:
        return critical_loads(problem, 1, rtol=1e-11)[0].force

    def lifted(problem: Problem) -> float:
        found = follow(problem, rtol=1e-9).lift_off
        assert found is not None
        return found.force

    for i, which, name in ((0, 1, "stiffness"), (1, 1, "stiffness"), (2, 2, "weight"), (1, 2, "weight")):
        assert critical.sections[i][name].value == pytest.approx(change(load, (i, which, 1.0)), rel=2e-6)
    for i, which, name in ((1, 1, "stiffness"), (2, 2, "weight")):
        assert lift.sections[i][name].value == pytest.approx(change(lifted, (i, which, 1.0)), rel=1e-5)
    for i in (0, 1):
        moved = change(load, (i, 0, 1.0), (i + 1, 0, -1.0))
        assert critical.sections[i]["upper_end"].value == pytest.approx(moved, rel=1e-6)
    total = sum(section["weight"].value * row[2] for section, row in zip(lift.sections, string, strict=True))
    assert total / 15.0 == pytest.approx(lift.derivatives["weight"].value, rel=1e-8)


def test_a_curve_of_a_symmetric_string_goes_by_halves() -> None:
    problem = Problem(10.0, sections=((0.25, 1.0), (0.5, 0.5, 2.0), (0.25, 1.0)))
    curve = critical_curves(problem, "weight", (8.0, 12.0), modes=1)[0]
    middle = min(curve.points, key=lambda point: abs(point.x - 10.0))
    load = critical_loads(problem.but(weight=middle.x), 1)[0]
    assert middle.value == pytest.approx(load.force, abs=middle.error + load.error)


def test_loads_with_proof_are_refused() -> None:
    with pytest.raises(InputError, match="uniform rod"):
        certify(Problem(15.0, sections=TWO), 1)


@pytest.mark.parametrize(
    ("sections", "words"),
    [
        ("0.5:1", "sequence"),
        (((0.5, 1.0), (0.4, 1.0)), "add up to 1, not to 0.9"),
        (((0.5, 0.0), (0.5, 1.0)), "section 1, stiffness"),
        (((0.5, 1.0, -2e6), (0.5, 1.0)), "section 1, weight"),
        (((0.5, 1.0, -1.0), (0.5, 1.0, -0.5)), "are all negative: for a rod that floats as a whole give floats"),
        (((0.5, 1.0), (0.5, 1.0, 1.0, 200.0)), "section 2, clearance = 200.0: makes its clearance 2 L"),
        (((0.5, 1.0), (0.5, 1.0, 1.0, 1.0, 0.0)), "section 2, torsion"),
        (((0.5, float("nan")), (0.5, 1.0)), "section 1, stiffness"),
        (((0.0, 1.0), (1.0, 1.0)), "section 1, length"),
        (((1.0, 1, 1, 1, 1, 1),), "section 1"),
        ((0.5, 0.5), "section 1"),
        (3, "sequence"),
    ],
)
def test_what_is_no_string_is_named(sections: Any, words: str) -> None:
    with pytest.raises(InputError, match=words):
        Problem(15.0, sections=sections)
