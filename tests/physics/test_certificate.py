"""The certificate: it passes true states of every kind, and no single wrong field slips through."""

from __future__ import annotations

import numpy as np
import pytest

import rodwell
from rodwell import Problem
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.state import certificate
from rodwell.physics.on_wall import braid, end_loads, equations
from rodwell.physics.on_wall.equations import NAMES, Fifteen, Load
from rodwell.physics.on_wall.parameters import SIDE

T2, H, WORK = "T₂ by two routes", "h by two routes", "work and energy"

STATES = {
    "5": (Problem(5.0), -120.0),
    "15": (Problem(15.0), -180.0),
    "40": (Problem(40.0), -260.0),
    "inclined, twisted": (Problem(40.0, alpha=60.0, twist=1.5), -190.0),
    "steep, wide": (Problem(80.0, alpha=20.0, clearance=0.04, twist=-0.7), -120.0),
    "vertical": (Problem(100.0, alpha=0.0), -60.0),
    "weightless": (Problem(0.0, twist=1.0), -100.0),
    "on top": (Problem(5.0, on_top=True), -30.0),
    "outside": (Problem(5.0, on_top=True, outside=True), -30.0),
    "pinned": (Problem(15.0, twist=1.0, ends="pinned-pinned"), -120.0),
    "guided, clamped": (Problem(15.0, alpha=50.0, ends="guided-clamped"), -120.0),
    "clamped, free": (Problem(15.0, alpha=70.0, ends="clamped-free"), -100.0),
    "free, pinned": (Problem(15.0, alpha=70.0, ends="free-pinned"), -100.0),
    "pinned, guided": (Problem(15.0, alpha=50.0, twist=0.5, ends="pinned-guided"), -120.0),
}


@pytest.fixture(scope="module")
def buckled() -> rodwell.Solution:
    return rodwell.follow(Problem(40.0, alpha=60.0, twist=1.5), until=-190.0)[-1]


@pytest.mark.parametrize("name", STATES)
def test_states_of_every_kind_solve_the_papers_system(name: str) -> None:
    problem, force = STATES[name]
    branch = rodwell.follow(problem, until=force)
    for state in (branch[0], branch[1], branch[-1]):
        residuals = state.certificate.residuals
        assert state.certificate.worst < 1e-7, state.certificate
        assert residuals[T2] < 1e-9
        assert residuals[H] < 1e-9
        assert residuals[WORK] < 1e-9
    assert branch.converged


def test_coiled_state_solves_the_papers_system() -> None:
    state = rodwell.equilibrium(Problem(15.0, turns=1), -150.0)
    assert state.certificate.passed
    assert state.fields(np.array([1.0]))["xi2"] == pytest.approx(2.0 * np.pi)


def test_it_names_every_equation_of_the_paper(buckled: rodwell.Solution) -> None:
    equations = [*range(22, 28), *range(32, 40), 41, 42, 43, 44, *range(52, 59)]
    expected = {f"({n})" for n in equations} | {f"(B{n})" for n in range(1, 16)}
    assert expected <= set(buckled.certificate.residuals)


CHECKED = [*NAMES, "rod_F1", "rod_F2", "rod_F3", "contact_pressure", "cylinder_F2", "cylinder_F3"]


@pytest.mark.parametrize("name", CHECKED)
def test_a_field_that_is_wrong_by_a_part_in_ten_thousand_is_seen(
    name: str, buckled: rodwell.Solution, monkeypatch: pytest.MonkeyPatch
) -> None:
    original = certificate.element_fields

    def spoilt(*arguments):
        half, fields = original(*arguments)
        source = "y" if name == "xi2" else name
        fields[source] = fields[source] * (1.0 + 1e-4)
        return half, fields

    monkeypatch.setattr(certificate, "element_fields", spoilt)
    assert not certificate.certificate_of(buckled).passed


def test_wrong_energy_balance_is_seen(buckled: rodwell.Solution, monkeypatch: pytest.MonkeyPatch) -> None:
    load = certificate.load_of(buckled.problem, buckled.force)
    for name, factor in (("force", 1.001), ("twist", 1.1), ("axial_weight", 1.01), ("lateral_weight", 1.001)):
        spoilt = load._replace(**{name: factor * getattr(load, name)})
        monkeypatch.setattr(certificate, "load_of", lambda *_given, spoilt=spoilt: spoilt)
        assert certificate.certificate_of(buckled).residuals[WORK] > 1e-6


def test_state_that_fails_it_does_not_count_as_converged(
    buckled: rodwell.Solution, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(certificate, "LIMIT", 1e-20)
    monkeypatch.setattr(certificate, "SLACK", 0.0)
    state = rodwell.Solution(buckled.problem, buckled.point, buckled.meshes)
    assert state.accurate
    assert not state.converged


def random_cases(count: int) -> list[tuple[Problem, float]]:
    """Problems with any ends, weight 0.1 … 1000, α, Δ, twist; and how far past buckling, in squared wavenumbers."""
    rng = np.random.default_rng(77)
    out = []
    while len(out) < count:
        ends = tuple(str(end) for end in rng.choice(["clamped", "pinned", "guided", "free"], 2))
        twist = 0.0 if "free" in ends else float(rng.uniform(-3.0, 3.0))
        weight, clearance = float(10.0 ** rng.uniform(-1.0, 3.0)), float(10.0 ** rng.uniform(-4.0, -1.3))
        problem = Problem(weight, alpha=float(rng.uniform(0.0, 90.0)), clearance=clearance, twist=twist, ends=ends)
        out.append((problem, float(rng.uniform(0.1, 1.0))))
    return out


def test_random_states_solve_the_papers_system() -> None:
    checked = 0
    for problem, share in random_cases(40):
        mode = rodwell.critical_loads(problem, 1)[0]
        try:
            branch = rodwell.follow(problem, mode, until=mode.force - share * mode.wavenumber**2)
        except rodwell.NotConvergedError:
            continue
        for state in branch:
            if state.accurate:
                assert state.certificate.worst < 1e-7, (problem, state)
                checked += 1
    assert checked > 500


def test_weightless_rod_and_cylinder_exchange_normal_pressure_only() -> None:
    """The paper, end of section 3.3: without weight p₂⁽¹⁾ and p₂⁽²⁾ are the only contact loads that are not zero."""
    data = rodwell.follow(Problem(0.0, twist=1.0), until=-100.0)[-1].dataset()
    zero = ("rod_p1", "rod_p3", "rod_m1", "rod_m2", "rod_m3", "T2")
    for name in (*zero, "cylinder_p1", "cylinder_p3", "cylinder_m1", "cylinder_m2", "cylinder_m3"):
        assert np.all(data[name] == 0.0), name
    assert np.max(np.abs(data.contact_pressure)) > 1.0
    np.testing.assert_allclose(data.cylinder_p2 * np.cos(data.eta), -data.contact_pressure, rtol=1e-14)


@pytest.mark.parametrize("eta", [0.05, 0.3, 0.9])
def test_exact_weightless_helix(eta: float) -> None:
    """F = (2B/r²) sin²η cos η in compression, contact force B sin⁴η/r³ per length; the cylinder bears nothing else."""
    r = 0.03
    force = -2.0 * np.sin(eta) ** 2 * np.cos(eta) / r**2
    parameters = np.array([force, 0.0, 0.0, r, 0.0, 1.0])
    assert parameters[SIDE] == 1.0
    s = np.linspace(0.0, 1.0, 7)
    u = np.array([s * np.sin(eta), np.full(7, np.sin(eta)), np.zeros(7), np.zeros(7)])
    end = end_loads.end_force(0.0, 0.0, float(u[0, -1]), float(u[1, -1]), parameters)

    def rates(places: np.ndarray) -> np.ndarray:
        values = np.array([places * np.sin(eta), *np.ones((3, places.size)) * [[np.sin(eta)], [0.0], [0.0]]])
        return braid.rates(places, values, parameters, 1.0 / 1.3, end)

    x, w = np.polynomial.legendre.leggauss(80)
    left = np.array([(rates(0.5 * b * (x + 1.0)) * w).sum(axis=1) * 0.5 * b for b in s]).T
    f = braid.reconstruct(s, u, left, left[:, -1:] - left, parameters, 1.0 / 1.3, end)
    np.testing.assert_allclose(f["contact_pressure"], -(np.sin(eta) ** 4) / r**3, rtol=1e-10)
    np.testing.assert_allclose(f["rod_F1"], force * np.cos(eta) - np.sin(eta) ** 4 / r**2, rtol=1e-10)
    for name in ("rod_F2", "T2", "cylinder_F1"):
        assert np.max(np.abs(f[name])) < 1e-10 * abs(force)
    # free of twisting and of force around the cylinder: the condition that singles out this force
    around = f["rod_F1"] * np.sin(eta) + f["rod_F3"] * np.cos(eta) + f["omega3"] * np.sin(eta) / r
    assert np.max(np.abs(around)) < 1e-10 * abs(force)


@pytest.mark.parametrize(("clearance", "turns"), [(0.02, 2), (0.05, 1), (0.01, 5)])
def test_engine_finds_the_helix(clearance: float, turns: int) -> None:
    """Between pinned ends the helix is an exact state, and free of force around the cylinder at this load."""
    sine = 2.0 * np.pi * turns * clearance
    force = -2.0 * sine**2 * np.sqrt(1.0 - sine**2) / clearance**2
    state = rodwell.equilibrium(Problem(0.0, ends="pinned-pinned", clearance=clearance, turns=turns), force)
    f = state.fields()
    assert state.converged
    assert state.certificate.worst < 1e-10
    np.testing.assert_allclose(np.sin(f["eta"]), sine, rtol=1e-13)
    np.testing.assert_allclose(f["contact_pressure"], -(sine**4) / clearance**3, rtol=1e-12)
    assert abs(state.end_reactions["shear"].value) < 1e-10 * abs(force)


def test_paper_system_has_fifteen_of_everything() -> None:
    x = Fifteen(*np.random.default_rng(1).normal(size=(15, 4)))
    load = Load(-50.0, 0.3, 5.0, 8.0, 0.01, 1.0 / 1.3)
    assert len(equations.right_hand_sides(x, load)) == len(NAMES) == 15
    assert equations.rates(np.array(x), load).shape == (15, 4)
    ends = equations.end_conditions(Fifteen(*np.array(x)[:, 0]), Fifteen(*np.array(x)[:, -1]), load)
    assert list(ends) == [f"(B{i})" for i in range(1, 16)]


@pytest.mark.parametrize("ends", [("clamped", "clamped"), ("pinned", "free"), ("guided", "guided")])
def test_a_straight_rod_under_twist_meets_all_end_conditions(ends: tuple[str, str]) -> None:
    """Of its fifteen variables the axial force is F at s = 1, the torque −T₁, and all others vanish at the ends."""
    load = Load(-50.0, 1.5, 5.0, 8.0, 0.01, 1.0 / 1.3, ends=ends)
    first, last = (Fifteen(*np.zeros(15))._replace(F1=force, M1=-load.twist) for force in (-55.0, -50.0))
    last = last._replace(xi1=load.twist / load.C, z=1.0)
    conditions = equations.end_conditions(first, last, load)
    assert {name: float(one.residual) for name, one in conditions.items() if one.residual != 0.0} == {}
    bent = equations.end_conditions(first, last._replace(M3=0.3, omega3=0.3), load)["(B13)"].residual
    assert bent == (0.0 if ends[1] in ("clamped", "guided") else 0.3)  # M₃ = b ω₃ where a fitting holds the slope


def test_where_the_odd_coil_is_unstable_another_shape_of_less_energy_is_found() -> None:
    """One turn, w = 15, F = −140: the odd coil loses stability near T₁ = 4.87, where an unsymmetric one takes over."""
    odd = rodwell.equilibrium(Problem(15.0, turns=1, twist=4.0), -140.0)
    further = rodwell.follow(odd.problem, start=odd, parameter="twist", until=6.0)[-1]
    assert further.stability_index == 1
    found = rodwell.equilibrium(Problem(15.0, turns=1, twist=6.0), -140.0)
    assert found.stable
    assert found.certificate.passed
    assert found.point.fine.symmetry == 0
    assert found.number(Measured.ENERGY).value < further.number(Measured.ENERGY).value - 1e-4
