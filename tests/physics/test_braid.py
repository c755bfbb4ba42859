"""The reconstruction against the paper's own differential equations, and against the end conditions (B1)–(B15)."""

from __future__ import annotations

import numpy as np
import pytest

import rodwell
from rodwell.physics.on_wall.braid import _cylinder_force_around, _Frame
from rodwell.physics.on_wall.end_loads import EndForce
from rodwell.physics.on_wall.parameters import CLEARANCE, COUNT, TWIST
from rodwell.physics.on_wall.strand import strand_force
from rodwell.physics.on_wall.tapered import more_force

H = 2e-4
CASES = {
    "horizontal": (rodwell.Problem(15.0), -180.0),
    "inclined and twisted": (rodwell.Problem(40.0, alpha=60.0, twist=1.5), -190.0),
    "steep, wide": (rodwell.Problem(80.0, alpha=20.0, clearance=0.04, twist=-0.7), -120.0),
    "vertical": (rodwell.Problem(100.0, alpha=0.0), -60.0),
    "on top": (rodwell.Problem(5.0, on_top=True), -30.0),
}


@pytest.fixture(scope="module", params=CASES, ids=list(CASES))
def state(request: pytest.FixtureRequest) -> rodwell.Solution:
    problem, force = CASES[request.param]
    return rodwell.follow(problem, 1, until=force)[-1]


def rate(state: rodwell.Solution, s: np.ndarray) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Fields at ``s`` and their derivatives by fourth-order differences of the fields themselves."""
    offsets = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    places = (s[:, None] + H * offsets).ravel()
    order = np.argsort(places)
    values = {}
    for name, field in state.fields(places[order]).items():
        back = np.empty_like(field)
        back[order] = field
        values[name] = back.reshape(-1, 5)
    stencil = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / (12.0 * H)
    return {k: v[:, 2] for k, v in values.items()}, {k: v @ stencil for k, v in values.items()}


def test_paper_equations_hold_place_by_place(state: rodwell.Solution) -> None:
    """(22)–(27), (32)–(36), (40)–(44) and (46)–(49), each scaled by its largest term."""
    s = np.linspace(0.02, 0.98, 41)
    f, d = rate(state, s)
    problem, clearance = state.problem, state.problem.clearance
    axial, lateral, twist = problem.axial_weight, problem.lateral_weight, problem.twist
    sin, cos, tan = np.sin(f["eta"]), np.cos(f["eta"]), np.tan(f["eta"])
    w1, w2, w3, lam, mu, t2 = f["omega1"], f["omega2"], f["omega3"], f["lambda"], f["mu"], f["T2"]
    f1, f2, f3, m1, m2, m3 = (f[k] for k in ("braid_F1", "braid_F2", "braid_F3", "braid_M1", "braid_M2", "braid_M3"))
    equations = {
        "(22)": (d["braid_F1"], w2 * f3, -w3 * f2, -axial * cos),
        "(23)": (d["braid_F2"], w3 * f1, -w1 * f3),
        "(24)": (d["braid_F3"], w1 * f2, -w2 * f1, axial * sin),
        "(25)": (d["braid_M1"], w2 * m3, -w3 * m2),
        "(26)": (d["braid_M2"], w3 * m1, -w1 * m3, -f3),
        "(27)": (d["braid_M3"], w1 * m2, -w2 * m1, f2),
        "(32)": (d["xi1"], -twist / problem.torsional_stiffness * np.ones_like(s), -w1),
        "(33)": (d["T2"], -clearance * lateral * np.sin(f["xi2"])),
        "(34)": (d["eta"], w2),
        "(35)": (d["omega3"], -2.0 * w1 * w2),
        "(36)": (d["xi2"], -sin / clearance),
        "(38)": (m2, -w2, -mu),
        "(41)": (d["lambda"], f2, w2 * (twist + 3.0 * w1), tan * lam * w2, -tan * mu / clearance),
        "(42)": (d["mu"], -(cos / clearance) * (m1 + twist) * cos, (cos / clearance) * (m3 - w3 + lam) * sin,
                 (cos / clearance) * t2),
        "(43)": (d["omega2"], -f3, (m1 + twist * cos**2) / clearance, -w1 * (w3 - lam), -t2 * cos / clearance),
        "(44)": (d["z"], -cos),
        "(52)": (f["rod_F1"], -f1, -(m3 - w3) / clearance, -lam * (w3 - 1.0 / clearance), -t2 * sin / clearance),
        "(53)": (f["rod_F2"], w2 * (3.0 * w1 + twist)),
        "(54)": (f["rod_F3"], -f3, (m1 + twist) / clearance, lam * w1, -t2 * cos / clearance),
        "(58)": (clearance * f["cylinder_F3"], -(m1 + twist) * cos, (m3 - w3) * sin, t2),
    }  # fmt: skip
    for name, terms in equations.items():
        largest = max(float(np.max(np.abs(term))) for term in terms)
        residual = float(np.max(np.abs(sum(terms))))
        assert residual <= 2e-7 * largest + 1e-12, name


def test_contact_pressure_is_the_papers_55(state: rodwell.Solution) -> None:
    f = state.fields()
    problem, c = state.problem, state.problem.clearance
    twist, w1, w2, w3 = problem.twist, f["omega1"], f["omega2"], f["omega3"]
    m1, m3, t2, lam = f["braid_M1"], f["braid_M3"], f["T2"], f["lambda"]
    sin, cos = np.sin(f["eta"]), np.cos(f["eta"])
    pressure = (
        (twist + 3.0 * w1) * ((m1 + twist * cos**2) / c - f["braid_F3"] - w1 * (w3 - lam) - t2 * cos / c)
        + t2 * sin / c**2
        - 3.0 * np.cos(2.0 * f["eta"]) / c * w2**2
        + w1 * ((m1 + twist) / c - f["braid_F3"])
        + w3 * (f["braid_F1"] + m3 / c)
        - w3**2 / c
        - problem.lateral_weight * np.cos(f["xi2"])
    )
    assert f["contact_pressure"] == pytest.approx(pressure, abs=1e-7 * np.max(np.abs(pressure)))


def test_force_balance_along_d1_gives_the_pressure(state: rodwell.Solution) -> None:
    """(48) along t₁, d₁ and u₁: no contact load but the normal one."""
    s = np.linspace(0.02, 0.98, 41)
    f, d = rate(state, s)
    problem = state.problem
    axial, lateral = problem.axial_weight, problem.lateral_weight
    sin, cos, sin2, cos2 = np.sin(f["eta"]), np.cos(f["eta"]), np.sin(f["xi2"]), np.cos(f["xi2"])
    w1, w2, w3 = f["omega1"], f["omega2"], f["omega3"]
    f1, f2, f3 = f["rod_F1"], f["rod_F2"], f["rod_F3"]
    along_t1 = (d["rod_F1"], w2 * f3, -w3 * f2, -axial * cos, -lateral * sin * sin2)
    along_d1 = (d["rod_F2"], w3 * f1, -w1 * f3, -lateral * cos2, -f["contact_pressure"])
    along_u1 = (d["rod_F3"], w1 * f2, -w2 * f1, axial * sin, -lateral * cos * sin2)
    for terms in (along_t1, along_d1, along_u1):
        largest = max(float(np.max(np.abs(term))) for term in terms)
        assert np.max(np.abs(sum(terms))) <= 2e-7 * largest


def test_end_conditions(state: rodwell.Solution) -> None:
    f = state.fields(np.array([0.0, 1.0]))
    problem = state.problem
    bottom = np.pi if problem.on_top else 0.0
    first, last = ({k: v[i] for k, v in f.items()} for i in (0, 1))
    assert (first["xi1"], first["z"]) == (0.0, 0.0)
    for end in (first, last):
        assert end["xi2"] == pytest.approx(bottom, abs=1e-14)
        assert end["eta"] == pytest.approx(0.0, abs=1e-14)
    for name in ("T2", "lambda", "mu", "braid_F2"):  # (B9)–(B12)
        assert last[name] == pytest.approx(0.0, abs=1e-9)
    assert last["braid_M3"] == pytest.approx(last["omega3"], abs=1e-12)  # (B13)
    assert last["braid_M1"] == pytest.approx(-problem.twist, abs=1e-12)  # (B14)
    assert last["braid_F1"] == pytest.approx(state.force)  # (B15)
    assert first["braid_M2"] == pytest.approx(first["omega2"] + first["mu"])  # (B6)


def test_certificate_sees_a_wrong_state() -> None:
    good = rodwell.follow(rodwell.Problem(40.0, alpha=60.0), 1, until=-180.0)[-1]
    assert good.certificate.worst < 1e-7
    spoilt = rodwell.Solution(good.problem.but(weight=41.0), good.point, _reweighted(good))
    assert spoilt.certificate.worst > 1e-3


def _reweighted(state: rodwell.Solution) -> object:
    """Equations of a state with another weight: its fields then belong to no equilibrium."""
    import dataclasses

    from rodwell.analysis.discrete.family import path
    from rodwell.numerics.equilibria.two_meshes import TwoMeshes

    family = dataclasses.replace(state.meshes.coarse, path=path(state.problem.but(weight=41.0), "force"))
    return TwoMeshes(family, state.meshes.measure, state.meshes.rtol)


def test_end_reactions_by_virtual_work_agree_with_the_fields(state: rodwell.Solution) -> None:
    """Two routes to shear and moment at s = 1: work on the held unknowns, and derivatives of the spline."""
    f = state.fields(np.array([1.0]))
    reactions = state.end_reactions
    assert reactions["moment"].value == pytest.approx(f["omega2"][0], rel=1e-7)
    along = state.fields()
    assert reactions["shear"].value == pytest.approx(f["rod_F3"][0], abs=1e-6 * np.max(np.abs(along["rod_F3"])))


def test_force_towards_the_axis_at_an_end_that_turns_is_that_of_moment_balance() -> None:
    """Of a rod that tapers, at an end at ξ₂ = a: seen from a + π/2, all that it exerts around there is −F₂(1), (47)."""
    y1, y2, y3, clearance, twist, stiffness, rate, angle = 0.03, 0.4, -2.0, 0.02, 1.5, 0.8, 0.7, 0.6
    parameters = np.zeros(COUNT)
    parameters[CLEARANCE], parameters[TWIST] = clearance, twist
    moment = -stiffness * y2 / np.sqrt(1.0 - y1 * y1)
    end = EndForce(0.9, moment, angle, y1, stiffness, rate)
    frame = _Frame.along(np.array([angle + 0.5 * np.pi]), np.zeros(1))
    inward = strand_force(1.0, y1, y2, y3, parameters, stiffness)[1] + more_force(y1, y2, y3, clearance, rate)[1]
    assert _cylinder_force_around(frame, np.zeros((2, 1)), parameters, end) == pytest.approx(-inward, rel=1e-13)
