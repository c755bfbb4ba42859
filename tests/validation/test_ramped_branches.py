"""Buckled states where the clearance varies: by shooting, with the wall where the rod lies and where it gets to."""

from __future__ import annotations

import cmath
import json
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp

from rodwell import (
    Problem,
    critical_loads,
    follow,
    lift_off_curve,
    load_branch,
    ramp,
    save_branch,
    sensitivities,
    verify,
)
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.ramped import along_ramps
from rodwell.analysis.straight.ramps import axial_contact
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.physics.on_wall.ramps import axial_resultant, wall_at

H = 1e-30
WIDENS = Problem(60.0, 60.0, sections=((0.2,), *ramp(0.5, 1.0, 1.1), (0.3, 1.0, 1.0, 1.1)))
TAPERED = Problem(
    60.0, 80.0, ends=("pinned", "clamped"),
    sections=((0.3, 2.0, 1.5, 1.2), *ramp(0.5, 1.2, 1.0, stiffness=(2.0, 0.8), weight=(1.5, 0.6)), (0.2, 0.8, 0.6)),
)  # fmt: skip


class Rod:
    """The rod as a system of first order in s: θ, θ′, m = ∂e/∂θ″, q = ∂e/∂θ′ − m′, and σ, μ.

    σ is how far along the wall's generator a cross-section is, σ′ = S(σ, θ′) = √(1 − Δ²θ′²), with the multiplier μ of
    that constraint. ``own``: each cross-section is at its own place σ. Else it is where the rod that lies has it,
    σ = s, and −N(s) z′ stands in the energy e in its place. Derivatives of e are by complex steps.
    """

    def __init__(self, problem: Problem, own: bool, force: float) -> None:
        self.problem, self.own, rod = problem, own, problem.rod
        nodes = np.polynomial.chebyshev.chebpts1(18)
        self.sections = []
        for number, (low, high) in enumerate(pairwise(rod.breaks)):
            places, piece = 0.5 * (low + high) + 0.5 * (high - low) * nodes, np.full(18, number)
            b, q, d = (one.in_pieces(places, piece) for one in (rod.stiffness, rod.weight, rod.clearance))
            given = along_ramps(problem)(places).T
            loads = np.array([force, problem.axial_weight, problem.foundation, problem.clearance, 0.0, 1.0, 0.0])
            resultant = axial_resultant(places, given, wall_at(places, given), loads)
            few = [
                Polynomial.fit(places - low, values, order).convert()
                for values, order in ((b, 4), (q, 4), (problem.clearance * d, 4), (resultant, 17))
            ]
            jets = [few[2].deriv(k) if k else few[2] for k in range(4)]
            self.sections.append((float(low), float(high), *(list(map(float, one.coef)) for one in (
                few[0], few[1], few[3], *jets))))  # fmt: skip

    def energy(self, u: list, d: list, b: float, lateral: float, resultant: float, mu: float) -> complex:
        """E − μS of θ, θ′, θ″ where the wall has Δ and derivatives by σ; without what depends on z alone."""
        angle, a1, a2 = u
        turn = d[0] * a1
        if not self.own:
            z1 = (1.0 - d[1] ** 2 - turn**2) ** 0.5
            r2, t2 = d[2] - turn * a1, 2.0 * d[1] * a1 + d[0] * a2
            z2 = -(d[1] * d[2] + turn * (d[1] * a1 + d[0] * a2)) / z1
            return b * (r2**2 + t2**2 + z2**2) / 2.0 - lateral * d[0] * cmath.cos(angle) - resultant * z1
        s1 = (1.0 - turn**2) ** 0.5
        s2 = -turn * (d[0] * a2 + d[1] * a1 * s1) / s1
        lying = (1.0 - d[1] ** 2) ** 0.5
        r2 = s2 * d[1] + s1**2 * d[2] - turn * a1
        t2 = 2.0 * s1 * d[1] * a1 + d[0] * a2
        z2 = s2 * lying - s1**2 * d[1] * d[2] / lying
        return b * (r2**2 + t2**2 + z2**2) / 2.0 - lateral * d[0] * cmath.cos(angle) - mu * s1

    def rates(self, s: float, y: np.ndarray, force: float, section: tuple) -> np.ndarray:
        angle, a1, m, q, sigma, mu = map(float, y)
        low, _, *along, d0, d1, d2, d3 = section
        b, weight, resultant = (_horner(one, s - low) for one in along)
        lateral, axial = self.problem.foundation * weight, self.problem.axial_weight * weight
        # beyond the end of a section, where σ may be, Δ goes on to the third derivative
        d = [_horner(one, (sigma if self.own else s) - low) for one in (d0, d1, d2, d3)]

        def slope(which: int, a2: float) -> float:
            u, moved = [angle, a1, a2], list(d)
            if which < 3:
                u[which] += 1j * H
            else:
                moved = [d[k] + 1j * H * d[k + 1] for k in range(3)]
            return self.energy(u, moved, b, lateral, resultant, mu).imag / H

        at_rest = slope(2, 0.0)
        a2 = (m - at_rest) / (slope(2, 1.0) - at_rest)  # e is of the second degree in θ″
        ahead = (1.0 - (d[0] * a1) ** 2) ** 0.5
        rise = slope(3, a2) + axial * (1.0 - d[1] ** 2) ** 0.5 if self.own else 0.0
        return np.array([a1, a2, slope(1, a2) - q, slope(0, a2), ahead, rise])

    def end(self, first: np.ndarray, force: float, rtol: float) -> np.ndarray:
        y = first
        for section in self.sections:
            found = solve_ivp(self.rates, section[:2], y, method="DOP853", rtol=rtol, atol=1e-2 * rtol,
                              args=(force, section))  # fmt: skip
            y = found.y[:, -1]
        return np.asarray(y)


def _horner(coefficients: list[float], x: float) -> float:
    value = 0.0
    for one in coefficients[::-1]:
        value = value * x + one
    return value


def _solved(function: Callable[[np.ndarray], np.ndarray], x: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Newton's method with differences."""
    for _ in range(6):
        f = function(x)
        slopes = np.array([(function(x + h * e) - f) / h for h, e in zip(sizes, np.eye(x.size), strict=True)]).T
        step = np.linalg.solve(slopes, f)
        x = x - step
        if np.all(np.abs(step) < 1e-3 * sizes):
            return x
    raise AssertionError("no convergence")


def _start(state: Solution) -> np.ndarray:
    """θ′ and m at s = 0 by the engine, and q from the force around the hole."""
    fine = state.point.fine
    y = fine.space.evaluate(fine.c, np.zeros(1), 4)[:, 0] / state.problem.clearance
    b = float(state.problem.rod.stiffness(np.zeros(1))[0])
    d = state.problem.clearance * float(state.problem.rod.clearance(np.zeros(1))[0])
    return np.array([y[1], b * d**2 * y[2], -b * d**2 * y[3]])


@pytest.mark.parametrize("problem", [WIDENS, TAPERED])
def test_states_are_those_of_shooting(problem: Problem) -> None:
    branch = follow(problem)
    state = branch[len(branch) // 2]
    rod, which, first = Rod(problem, False, state.force), 1 if problem.ends[0] == "clamped" else 0, _start(state)

    def misses(x: np.ndarray) -> np.ndarray:
        slope, moment = (0.0, x[0]) if which else (x[0], 0.0)
        return rod.end(np.array([0.0, slope, moment, x[1], 0.0, 0.0]), state.force, 1e-11)[:2]

    q = _solved(misses, np.array([first[which], first[2]]), 1e-4 * np.abs(np.array([first[which], first[2]])))
    assert q[0] == pytest.approx(first[which], rel=1e-8)


def test_a_rod_each_cross_section_of_which_is_at_its_own_place() -> None:
    """At the same moment at s = 0 its load is the branch's to within what is said of the wall's push along the hole."""
    branch = follow(WIDENS)
    for state, part in ((branch[1], 0.5), (branch[-1], 0.6)):
        first, rod = _start(state), Rod(WIDENS, True, state.force)

        def misses(x: np.ndarray, moment: float = first[1], rod: Rod = rod) -> np.ndarray:
            force, q, mu = x
            end = rod.end(np.array([0.0, 0.0, moment, q, 0.0, mu]), force, 1e-9)
            return np.array([end[0], end[1], end[5] - force])

        guess = np.array([state.force, first[2], state.force - WIDENS.hung_weight])
        force, *_ = _solved(misses, guess, np.array([1e-3, 1e-4 * abs(first[2]), 1e-3]))
        assert part * state.axial_contact_error < abs(force - state.force) < state.axial_contact_error


def test_certificate_energies_and_reactions() -> None:
    for problem in (WIDENS, TAPERED):
        state = follow(problem)[-1]
        assert state.converged
        assert state.stable
        certificate = state.certificate
        assert certificate.passed
        assert {"force balance", "moment balance", "t′ = M × t"} <= set(certificate.residuals)
        energies = {name: value.value for name, value in state.energies.items()}
        whole = sum(energies.values()) - 2.0 * energies["end_work"]
        assert whole == pytest.approx(state.number("energy").value, rel=1e-11)
        assert energies["end_work"] == pytest.approx(-state.force * state.number("end_shortening").value, rel=1e-11)
        above, below = (follow(problem, start=state, until=state.force + h)[-1] for h in (0.01, -0.01))
        rate = (above.number("energy").value - below.number("energy").value) / 0.02
        assert rate == pytest.approx(state.number("end_shortening").value, rel=1e-5)
        first = next(one for one in state.reactions if one.s == 0.0)
        resultant = state.force - problem.hung_weight + axial_contact(problem, state.force)
        assert first.force[2] == pytest.approx(-resultant, rel=1e-11)
        fields = state.fields(np.array([0.0, 1.0]))
        assert fields["z"][1] < 1.0 - state.number("end_shortening").value * 0.999
        assert state.wall.cylinder is None


def test_a_string_is_the_same_seen_from_its_other_end() -> None:
    back = WIDENS.turned_round
    lift, other = follow(WIDENS).lift_off, follow(back).lift_off
    assert lift is not None
    assert other is not None
    force = lift.force - WIDENS.hung_weight + axial_contact(WIDENS, lift.force)
    assert other.force == pytest.approx(force, rel=1e-9)
    assert other.s[0] == pytest.approx(1.0 - lift.s[0], abs=1e-6)


def test_without_a_slope_it_is_the_uniform_rod() -> None:
    near = WIDENS.but(sections=((0.2,), *ramp(0.5, 1.0, 1.0 + 1e-8), (0.3, 1.0, 1.0, 1.0 + 1e-8)))
    plain, lift = (follow(problem, rtol=1e-6).lift_off for problem in (WIDENS.but(sections=()), near))
    assert lift is not None
    assert plain is not None
    assert lift.force == pytest.approx(plain.force, rel=1e-6)
    assert lift.s == pytest.approx(plain.s, abs=1e-3)


def test_derivatives_are_those_of_differences() -> None:
    of_critical, of_lift_off = sensitivities(WIDENS)
    assert of_critical.sections == of_lift_off.sections == ()

    def loads(**changes: float) -> np.ndarray:
        lift = follow(WIDENS.but(**changes)).lift_off
        assert lift is not None
        return np.array([critical_loads(WIDENS.but(**changes), 1)[0].force, lift.force])

    for name, step in (("weight", 0.06), ("alpha", 0.06), ("clearance", 1e-5)):
        here = getattr(WIDENS, name)
        rates = (loads(**{name: here + step}) - loads(**{name: here - step})) / (2.0 * step)
        for rate, known in zip(rates, (of_critical, of_lift_off), strict=True):
            value = known.derivatives[name]
            assert value.value == pytest.approx(rate, rel=2e-6)
            assert value.error < 1e-7 * abs(value.value)


def test_branches_are_kept_and_curves_followed(tmp_path: Path) -> None:
    branch = follow(WIDENS)
    save_branch(branch, tmp_path / "branch.nc")
    again = load_branch(tmp_path / "branch.nc")
    assert again[-1].number("largest_pressure").value == branch[-1].number("largest_pressure").value
    assert again[-1].meshes.fine.space.smooth.tolist() == [3] * 5
    assert branch.lift_off is not None
    lighter = follow(WIDENS, start=branch[3], parameter="weight", until=59.0)[-1]
    assert lighter.certificate.passed
    again = follow(lighter.problem, start=lighter, until=lighter.force - 5.0)
    assert follow(WIDENS.but(weight=59.0)).lift_off.force < again[-1].force  # type: ignore[union-attr]
    curve = lift_off_curve(WIDENS, "clearance", (0.01, 0.0101), rtol=1e-6)
    assert curve.points[0].value == pytest.approx(branch.lift_off.force, rel=1e-6)
    there = follow(WIDENS.but(clearance=0.0101), rtol=1e-6).lift_off
    assert there is not None
    assert curve.points[-1].value == pytest.approx(there.force, rel=1e-6)


REFUSED: list[tuple[Callable[[], object], str]] = [
    (partial(follow, WIDENS, until=-200.0, off_wall=True), "branches that go on off the wall are computed in"),
    (lambda: follow(WIDENS)[-1].geometry(11), "pictures and shapes in space are computed"),
    (lambda: verify(follow(WIDENS)), "branches held against the other program are computed"),
    (partial(follow, WIDENS.but(twist=1.0)), "twist = 1.0: must be 0 where the clearance varies"),
    (lambda: lift_off_curve(WIDENS, "twist", (0.0, 1.0)), "must leave the twist at 0"),
    (lambda: follow(WIDENS, start=follow(WIDENS)[-1], parameter="clearance", until=0.011), "must be one of force, we"),
]


@pytest.mark.parametrize(("what", "said"), REFUSED)
def test_what_is_not_computed_is_refused(what: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        what()


def test_told_by_commands(tmp_path: Path) -> None:
    line = ["--weight", "60", "--alpha", "60", "--sections", "0.2:1,0.5:1:1:1~1.1,0.3:1:1:1.1"]
    shown = CliRunner().invoke(cli, ["liftoff", *line])
    assert shown.exit_code == 0, shown.output
    assert "would change the axial force along it by 0.013 B/L² at most" in " ".join(shown.output.split())
    told = json.loads(CliRunner().invoke(cli, ["liftoff", *line, "--json"]).output)
    lift = follow(WIDENS).lift_off
    assert lift is not None
    assert told["lift_off"]["force"] == pytest.approx(lift.force, rel=1e-12)
    assert told["axial_contact_error"] == pytest.approx(lift.solution.axial_contact_error)
    out = ["diagram", *line, "--modes", "1", "--until", "-200", "--json", "--out", str(tmp_path / "d")]
    found = json.loads(CliRunner().invoke(cli, out).output)
    assert found["axial_contact_errors_at_the_ends"]["mode 1"] > 0.0
