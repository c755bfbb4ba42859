"""Sections that taper: loads in closed form and by shooting; buckled states against strings of many small steps.

Closed forms of weightless columns whose stiffness is a power of 1 + cs: Bessel functions for the first power, powers
times sines of logarithms for the second, sines of the reciprocal for the fourth (S. P. Timoshenko and J. M. Gere,
Theory of Elastic Stability, 2nd ed., 1961, § 2.14; J. M. Gere and W. O. Carter, Critical buckling loads for tapered
columns, J. Struct. Div. ASCE 88 (1962) 1–11).
"""

from __future__ import annotations

import json
import math
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import jv, yv

from rodwell import Problem, critical_loads, follow, load_branch, loads_without_wall, save_branch, verify
from rodwell.analysis.branch.verifying.other_program import most_sections, takes
from rodwell.analysis.curves.critical import critical_curves
from rodwell.analysis.loads.sensitivity import sensitivities
from rodwell.answers.words.steps import held, steps_data, steps_note
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.problem.rod import Rod
from rodwell.problem.sections import checked_sections

C = 1.5


def power(n: int) -> tuple[float, ...]:
    """Values of (1 + Cs)ⁿ that make it a polynomial of this degree."""
    return tuple((1.0 + C * s) ** n for s in np.linspace(0.0, 1.0, n + 1))


def _bessel(load: float) -> float:
    a, b = (2.0 * math.sqrt(load * x) / C for x in (1.0, 1.0 + C))
    return float(jv(1, a) * yv(1, b) - jv(1, b) * yv(1, a))


def _cantilever(mu: float) -> float:
    angle = mu * math.log(1.0 + C)
    return math.sin(angle) - 2.0 * mu * math.cos(angle)


LOG = math.log(1.0 + C)
CANTILEVER = float(brentq(_cantilever, 0.5 * math.pi / LOG * 0.5, 1.0 * math.pi / LOG))
CLOSED = {
    "linear": ("pinned-pinned", 1, float(brentq(_bessel, math.pi**2, math.pi**2 * (1.0 + C)))),
    "square": ("pinned-pinned", 2, C**2 * (0.25 + (math.pi / LOG) ** 2)),
    "fourth": ("pinned-pinned", 4, math.pi**2 * (1.0 + C) ** 2),
    "square, clamped at the thin end": ("clamped-free", 2, C**2 * (0.25 + CANTILEVER**2)),
}


@pytest.mark.parametrize("case", CLOSED)
def test_columns_in_closed_form(case: str) -> None:
    ends, n, load = CLOSED[case]
    mode = critical_loads(Problem(0.0, ends=ends, sections=((1.0, power(n)),)), 1)[0]
    assert -mode.force == pytest.approx(load, rel=1e-10)
    assert abs(-mode.force - load) <= mode.error + 1e-12 * load
    first, last = ends.split("-")
    back = Problem(0.0, ends=f"{last}-{first}", sections=((1.0, power(n)[::-1]),))
    assert critical_loads(back, 1)[0].force == pytest.approx(mode.force, rel=1e-11)


TIP = ((0.6, 1.0, 1.0), (0.4, (1.0, 0.5, 0.2), (1.0, 0.6), 1.0, (1.0, 0.2)))
"""A rod with a tip that tapers; stiffness and weight continuous, torsion too."""
TWO = ((0.5, (2.0, 1.2, 0.4), (0.5, 2.0)), (0.5, (1.0, 0.3, 0.2, 0.4, 0.9), 1.5))
"""A step and a kink between two tapers."""


def _polynomials(sections: Any) -> list[tuple[float, list[np.ndarray]]]:
    """Length of each section, and coefficients of its ratios in x from 0 to 1 along it, highest power first."""
    return [
        (length, [np.polyfit(np.linspace(0.0, 1.0, np.size(r)), np.atleast_1d(r), np.size(r) - 1) for r in ratios])
        for length, *ratios in sections
    ]


def _misfit(problem: Problem, force: float) -> float:
    """Determinant that vanishes at a critical load, by integration of (b v″)″ − (N v′)′ + (wₗ/Δ) q v = 0."""
    lateral, whole = problem.foundation / problem.clearance, np.eye(4)
    polynomials = _polynomials(problem.sections)
    above = sum(length * np.polyval(np.polyint(fits[1]), 1.0) for length, fits in polynomials)

    def rates(x: float, y: np.ndarray, length: float, fits: list[np.ndarray], above: float) -> np.ndarray:
        v, slope, moment, shear = y.reshape(4, 4)
        b, q = np.polyval(fits[0], x), np.polyval(fits[1], x)
        axial = force - problem.axial_weight * (above - length * np.polyval(np.polyint(fits[1]), x))
        return length * np.concatenate([slope, moment / b, shear + axial * slope, -lateral * q * v])

    for length, fits in polynomials:
        found = solve_ivp(
            rates, (0.0, 1.0), whole.ravel(), method="DOP853", rtol=1e-13, atol=1e-13, args=(length, fits, above)
        )
        whole = found.y[:, -1].reshape(4, 4)
        above -= length * np.polyval(np.polyint(fits[1]), 1.0)
    return float(np.linalg.det(whole[np.ix_((0, 1), (2, 3))]))


@pytest.mark.parametrize("sections", [TIP, TWO], ids=["tip", "two"])
def test_loads_under_weight_are_those_of_shooting(sections: Any) -> None:
    problem = Problem(15.0, 60.0, sections=sections)
    for mode in critical_loads(problem, 2):
        width = max(2.0 * mode.error, 1e-10 * abs(mode.force))
        below, above = (_misfit(problem, mode.force + sign * width) for sign in (-1.0, 1.0))
        assert below * above < 0.0


def test_a_taper_that_is_hardly_one_changes_hardly_anything() -> None:
    near, plain = Problem(15.0, 60.0, sections=((1.0, (1.0, 1.0 + 1e-8)),)), Problem(15.0, 60.0)
    assert critical_loads(near, 2).forces == pytest.approx(critical_loads(plain, 2).forces, rel=1e-8)
    one, other = follow(plain).lift_off, follow(near).lift_off
    assert one is not None
    assert other is not None
    assert other.force == pytest.approx(one.force, rel=1e-7)
    alike = Problem(15.0, 60.0, sections=((0.4, (1.0, 1.0)), (0.6, [1, 1, 1], (1.0,))))
    assert alike == plain


@pytest.fixture(scope="module", params=["tip", "two, twisted", "free"])
def branch(request: Any) -> Any:
    problems = {
        "tip": Problem(15.0, 60.0, sections=TIP),
        "two, twisted": Problem(15.0, 75.0, ends="guided-pinned", twist=3.0, sections=TWO),
        "free": Problem(15.0, 75.0, ends="pinned-free", sections=TIP),
    }
    return follow(problems[request.param])


def test_lifted_states_solve_the_papers_equations(branch: Any) -> None:
    """With b′ and b″ where they enter: moments and forces by other routes than the energy from which states come."""
    assert branch.lift_off is not None
    state = branch.lift_off.solution
    assert state.certificate.passed, state.certificate
    assert state.highest_pressure[0] == pytest.approx(
        0.0, abs=1e-7 * abs(np.min(state.fields(101)["contact_pressure"]))
    )


def test_what_the_wall_exerts_at_kinks_is_what_the_rod_is_short_of(branch: Any) -> None:
    state = branch.lift_off.solution
    assert len(state.step_loads) == 1
    step = state.step_loads[0]
    f = state.fields(np.array([np.nextafter(step.s, 0.0), step.s]))
    jump = {name: float(np.diff(values)[0]) for name, values in f.items()}
    force = max(np.abs(f["rod_F3"]))
    assert jump["rod_M3"] == pytest.approx(-step.couple.value, rel=1e-9, abs=1e-12)
    assert jump["rod_F2"] == pytest.approx(-step.force.value, abs=1e-8 * force)
    for name in ("braid_F1", "braid_F2", "braid_M1", "braid_M2", "T2", "xi1", "z"):
        assert abs(jump[name]) < 1e-8 * max(1.0, np.max(np.abs(f[name]))), name


def test_another_program_finds_the_same_states_and_lift_off_of_tapers() -> None:
    """The paper's equations with b′ and b″ in them, each section in units of its own, by ``solve_bvp``."""
    found = verify(follow(Problem(15.0, 75.0, ends="pinned-free", sections=TIP)), rtol=1e-5)
    assert found.agrees
    assert found.lift_off is not None
    assert found.lift_off_difference < 1e-7


def _steps(sections: Any, count: int) -> list[tuple[float, ...]]:
    """Sections cut into so many pieces each, with the values in their middles."""
    return [
        (length / count, *(float(np.polyval(fit, (i + 0.5) / count)) for fit in fits))
        for length, fits in _polynomials(sections)
        for i in range(count)
    ]


def test_buckled_states_are_the_limit_of_many_steps() -> None:
    """Steps have other forces at single places than a taper, but their states and energies tend to its, like h²."""
    taper = Problem(15.0, 75.0, ends="guided-pinned", sections=TWO)
    force = 1.1 * critical_loads(taper, 1)[0].force

    def numbers(problem: Problem) -> np.ndarray:
        state = follow(problem, until=force)[-1]
        assert state.certificate.passed, state.certificate
        return np.array([abs(state.number(name).value) for name in ("energy", "angle_at_middle", "end_shortening")])

    few, many, limit = (numbers(one) for one in (*(taper.but(sections=_steps(TWO, n)) for n in (16, 24)), taper))
    assert limit == pytest.approx(many + (many - few) / (1.5**2 - 1.0), rel=1e-4)
    assert np.all(np.abs(limit - many) > 3e-4 * limit)


def test_without_a_wall_and_turned_round() -> None:
    load = CLOSED["fourth"][2]
    balls = loads_without_wall(Problem(0.0, 0.0, ends="ball-ball", sections=((1.0, power(4)),)))
    assert -balls.forces[0] == pytest.approx(load, rel=1e-9)
    there = Problem(5.0, 70.0, ends="clamped-pinned", sections=TWO)
    back = there.turned_round
    assert back.turned_round == there
    loads = critical_loads(there, 2).forces - there.hung_weight
    assert critical_loads(back, 2).forces == pytest.approx(loads, rel=1e-10)


def test_halves_of_a_symmetric_taper() -> None:
    problem = Problem(10.0, sections=((1.0, (0.4, 1.0, 0.4)),))
    assert {mode.parity for mode in critical_loads(problem, 2)} == {-1, 1}
    curve = critical_curves(problem, "weight", (9.5, 10.5), modes=1)[0]
    middle = min(curve.points, key=lambda point: abs(point.x - 10.0))
    load = critical_loads(problem.but(weight=middle.x), 1)[0]
    assert middle.value == pytest.approx(load.force, abs=middle.error + load.error)


def test_the_command_line_takes_tapers() -> None:
    given = ["--weight", "15", "--alpha", "60", "--sections", "0.6:1:1,0.4:1/0.5/0.2:1/0.6:1:1/0.2", "--json"]
    data = json.loads(CliRunner().invoke(cli, ["liftoff", *given]).output)
    lift = follow(Problem(15.0, 60.0, sections=TIP)).lift_off
    assert lift is not None
    assert data["lift_off"]["force"] == lift.force
    assert data["steps"] == steps_data(lift.solution.step_loads)
    assert "has a kink (s/L = 0.6) the wall would have to pull" in steps_note(lift.solution.step_loads)
    wrong = CliRunner().invoke(cli, ["critical", "--weight", "15", "--alpha", "60", "--sections", "1:1/x"])
    assert "a taper's parted by /" in str(wrong.exception)


def test_derivatives_by_factors_on_tapers() -> None:
    """Against differences; factors on everything are what a whole string knows."""
    h = 1e-4
    critical, lift = sensitivities(Problem(15.0, 60.0, sections=TIP))

    def change(load: Any, which: int) -> float:
        loads = []
        for times in (1.0 + h, 1.0 - h):
            tip = [tuple(times * one for one in ratio) if i == which else ratio for i, ratio in enumerate(TIP[1])]
            loads.append(load(Problem(15.0, 60.0, sections=(TIP[0], tip))))
        return float(loads[0] - loads[1]) / (2.0 * h)

    for which, name in ((1, "stiffness_factor"), (2, "weight_factor")):
        known = change(lambda problem: critical_loads(problem, 1, rtol=1e-11)[0].force, which)
        assert critical.sections[1][name].value == pytest.approx(known, rel=2e-6)
    lifted = change(lambda problem: follow(problem, rtol=1e-9).lift_off.force, 1)
    assert lift.sections[1]["stiffness_factor"].value == pytest.approx(lifted, rel=1e-5)
    for load in (critical, lift):
        weight = load.sections[0]["weight"].value + load.sections[1]["weight_factor"].value
        assert weight / 15.0 == pytest.approx(load.derivatives["weight"].value, rel=1e-8)
    assert not any("upper_end" in section for section in critical.sections)


def test_files_keep_branches_of_strings(tmp_path: Path, branch: Any) -> None:
    save_branch(branch, tmp_path / "branch.nc")
    back = load_branch(tmp_path / "branch.nc")
    assert back.problem == branch.problem
    assert back.lift_off.force == branch.lift_off.force


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ((1.0, (1.0, 0.0)), r"section 1, stiffness = 0.0: must be from 1e-06"),
        ((1.0, (1.0, 0.1, 1.0, 0.1, 1.0)), "polynomial through them is .* part the section"),
        ((1.0, (1.0,) * 5 + (2.0,)), "6 values"),
        ((1.0, 1.0, (1.0, "x")), "section 1, weight"),
        ((1.0, 1.0, 1.0, (1.0, "x")), "section 1, clearance"),
    ],
)
def test_what_is_no_taper_is_named(section: Any, words: str) -> None:
    with pytest.raises(InputError, match=words):
        Problem(15.0, sections=(section,))


@pytest.mark.parametrize(
    ("sections", "conditions"),
    [
        (((0.6, 1.0), (0.4, (1.0, 0.3))), ["held to the wall at kinks of its stiffness"]),  # begins to fall
        (((0.6, (0.3, 1.0)), (0.4, 1.0)), ["held to the wall at kinks of its stiffness"]),  # ceases to rise
        (((0.6, 1.0), (0.4, (1.0, 2.0))), []),  # begins to rise: [b'] ω₃ presses it to the wall
        (((0.5, (1.0, 2.0)), (0.5, (2.0, 3.0))), []),  # one taper in two parts
        (((0.6, 1.0), (0.4, 0.3)), ["its slope held at steps of its stiffness"]),
    ],
)
def test_where_a_wall_would_have_to_pull_the_words_say_what_is_held(sections: Any, conditions: list[str]) -> None:
    assert held(Rod(checked_sections(sections))) == conditions


@pytest.mark.parametrize("count", [1, 6, 7])
def test_the_other_program_is_advised_where_it_takes_the_problem(count: int) -> None:
    stiffness = [1.0 + i for i in range(count - 1)] + [(2.0, 1.0)]
    problem = Problem(15.0, sections=[(1.0 / count, ratio) for ratio in stiffness])
    with nullcontext() if takes(problem) else pytest.raises(InputError):
        most_sections(problem)
    assert takes(problem) is (count < 7)
