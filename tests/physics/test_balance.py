"""Energies, reactions and frames: global equilibrium, work against energy, and the rotation sequence of the paper."""

from __future__ import annotations

import numpy as np
import pytest

import rodwell
from rodwell import Problem
from rodwell.analysis.discrete.measures import Measured
from rodwell.physics.on_wall.frames import frames

PROBLEMS = {
    "horizontal": (Problem(15.0), -180.0),
    "inclined, twisted": (Problem(40.0, alpha=60.0, twist=1.5), -190.0),
    "on top": (Problem(5.0, alpha=70.0, on_top=True), -30.0),
    "pinned, guided": (Problem(15.0, alpha=50.0, twist=0.5, ends="pinned-guided"), -120.0),
    "free end": (Problem(15.0, alpha=70.0, ends="clamped-free"), -100.0),
}


@pytest.fixture(scope="module", params=PROBLEMS, ids=list(PROBLEMS))
def branch(request: pytest.FixtureRequest) -> rodwell.Branch:
    problem, force = PROBLEMS[request.param]
    return rodwell.follow(problem, until=force, largest_step=0.02)


def test_energies_add_up_to_the_stationary_one(branch: rodwell.Branch) -> None:
    e = {name: value for name, (value, _) in branch[-1].energies.items()}
    total = e["bending_energy"] + e["lateral_energy"] + e["axial_energy"] - e["end_work"]
    assert total == pytest.approx(branch[-1].number(Measured.ENERGY).value, rel=1e-11)
    twist = branch.problem.twist
    assert e["twist_energy"] == pytest.approx(0.5 * twist**2 * (1.0 + branch.problem.poisson))


def test_work_of_the_end_force_is_stored(branch: rodwell.Branch) -> None:
    """Along a branch the stored energy changes by ∫ F dz(1) + T₁ ΔΘ, Θ = (ξ₁ + ξ₂)(1): Simpson's rule over 8 states."""
    first, last = 0.7 * branch.force[0] + 0.3 * branch.force[-1], branch.force[-1]
    x, w = np.polynomial.legendre.leggauss(8)
    middle, half = 0.5 * (first + last), 0.5 * (last - first)
    states = [branch.at(float(middle + half * x_i)) for x_i in x]
    ends = [branch.at(float(first)), branch.at(float(last))]
    stored = [sum(s.energies[k].value for k in ("bending_energy", "lateral_energy", "axial_energy")) for s in ends]
    z = [1.0 - s.number(Measured.SHORTENING).value for s in (*ends, *states)]
    twist = branch.problem.twist
    turn = [float((s.fields(np.array([1.0]))["xi1"] + s.fields(np.array([1.0]))["xi2"])[0]) for s in ends]
    along = half * float(w @ np.array(z[2:]))  # ∫ z(1) dF
    work = last * z[1] - first * z[0] - along + twist * (turn[1] - turn[0])  # ∫ F dz = [F z] − ∫ z dF
    assert stored[1] - stored[0] == pytest.approx(work, abs=1e-6 * abs(stored[1]))


def test_reactions_balance_the_axial_weight(branch: rodwell.Branch) -> None:
    """Forces of all supports add up to mg cos α along k: the lateral weight is taken up along the cylinder."""
    total = np.sum([r.force for r in branch[-1].reactions], axis=0)
    np.testing.assert_allclose(total, [0.0, 0.0, branch.problem.axial_weight], atol=1e-8 * abs(branch[-1].force))


def test_reactions_balance_in_moment(branch: rodwell.Branch) -> None:
    """Moments about the origin: supports, axial weight along the rod, and the take-up of the lateral weight cancel."""
    state, problem = branch[-1], branch.problem
    x, w = np.polynomial.legendre.leggauss(200)
    s, w = 0.5 * (x + 1.0), 0.5 * w
    f = state.fields(s)
    place = np.array([-problem.clearance * np.cos(f["xi2"]), problem.clearance * np.sin(f["xi2"]), f["z"]])
    axial = np.array([np.zeros_like(s), np.zeros_like(s), np.full_like(s, -problem.axial_weight)])
    total = np.cross(place.T, axial.T).T @ w
    at_ends = state.fields(np.array([0.0, 1.0]))
    for r in state.reactions:
        i = int(r.s)
        axis = np.array([0.0, 0.0, at_ends["z"][i]])
        angle = at_ends["xi2"][i]
        off = problem.clearance * np.array([-np.cos(angle), np.sin(angle), 0.0])
        total += r.moment + np.cross(axis + off if r.on == "rod" else axis, r.force)
    if problem.ends[1] in ("clamped", "guided"):
        size = max(np.max(np.abs(r.moment)) for r in state.reactions)
        np.testing.assert_allclose(total, 0.0, atol=1e-7 * size)


def test_frames_are_the_papers_rotation_sequence() -> None:
    """(1) with R₁, R₂ as printed; d₁ and t₁ as in theory.md: t₁ = cos η t₂ + sin η u₂."""
    rng = np.random.default_rng(5)
    xi1, eta, xi2 = rng.uniform(-1.2, 1.2, (3, 20))
    f = frames(xi1, eta, xi2)

    def about_first(a: float) -> np.ndarray:
        return np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])

    def about_second(a: float) -> np.ndarray:
        return np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])

    for i in range(20):
        np.testing.assert_allclose(f["R11"][i], f["R01"][i] @ about_first(xi1[i]), atol=1e-15)
        np.testing.assert_allclose(f["R12"][i], f["R11"][i] @ about_second(eta[i]), atol=1e-15)
        np.testing.assert_allclose(f["R22"][i], f["R12"][i] @ about_first(xi2[i]), atol=1e-15)
        np.testing.assert_allclose(f["R22"][i], [[0, 1, 0], [0, 0, 1], [1, 0, 0]], atol=1e-15)
        d1, u2 = f["R12"][i][:, 1], f["R12"][i][:, 2]
        np.testing.assert_allclose(d1, [np.cos(xi2[i]), -np.sin(xi2[i]), 0.0], atol=1e-15)
        np.testing.assert_allclose(u2, [np.sin(xi2[i]), np.cos(xi2[i]), 0.0], atol=1e-15)
        np.testing.assert_allclose(f["R11"][i][:, 0], [*(np.sin(eta[i]) * u2[:2]), np.cos(eta[i])], atol=1e-15)


def test_frames_turn_along_the_rod_as_the_curvatures_say(branch: rodwell.Branch) -> None:
    """(2): RᵀR′ of braid and material frame of the rod has the axial vectors ω and ω̃."""
    h = 1e-4
    middle = np.linspace(0.1, 0.9, 9)
    around = [branch[-1].fields(middle + k * h) for k in (-2, -1, 0, 1, 2)]
    for name, symbols in (("R11", "omega"), ("R01", "material_omega")):
        m2, m1, now, p1, p2 = (frames(f["xi1"], f["eta"], f["xi2"])[name] for f in around)
        rate = (m2 - 8.0 * m1 + 8.0 * p1 - p2) / (12.0 * h)
        spin = np.transpose(now, (0, 2, 1)) @ rate
        for i, (row, column) in enumerate(((2, 1), (0, 2), (1, 0)), start=1):
            np.testing.assert_allclose(spin[:, row, column], around[2][f"{symbols}{i}"], atol=1e-6)


def test_dataset_in_physical_units(branch: rodwell.Branch) -> None:
    state, length, stiffness = branch[-1], 30.0, 1.2e6
    plain, physical = state.dataset(11), state.dataset(11, length=length, stiffness=stiffness)
    for name, factor, unit in (
        ("rod_F1", stiffness / length**2, "N"),
        ("contact_pressure", stiffness / length**3, "N/m"),
        ("T2", stiffness / length, "N m"),
        ("omega2", 1.0 / length, "1/m"),
        ("z", length, "m"),
        ("cylinder_m1", stiffness / length**2, "N"),
        ("bending_energy", stiffness / length, "J"),
    ):
        np.testing.assert_allclose(physical[name], plain[name] * factor, rtol=1e-14)
        assert physical[name].attrs["units"] == unit
        assert physical[name].attrs["error"] == pytest.approx(plain[name].attrs["error"] * factor)
    with pytest.raises(rodwell.InputError, match="stiffness"):
        state.dataset(length=30.0)
    with pytest.raises(rodwell.InputError, match="must be positive"):
        state.dataset(length=-30.0, stiffness=1.0)


def test_cylinder_balances_its_loads(branch: rodwell.Branch) -> None:
    """(48), (49) of the cylinder: F⁽²⁾′ = p⁽²⁾ σ′ and M⁽²⁾′ + t₂ × F⁽²⁾ σ′ = m⁽²⁾ σ′, with σ′ = cos η, (60), (61)."""
    h = 2e-4
    middle = np.linspace(0.05, 0.95, 19)

    def vectors(s: np.ndarray) -> tuple[np.ndarray, ...]:
        f = branch[-1].fields(s)
        axes = frames(f["xi1"], f["eta"], f["xi2"])["R12"]
        zero = np.zeros_like(s)
        parts = (
            ("cylinder_F1", "cylinder_F2", "cylinder_F3"),
            ("T2", "mu", "cylinder_M3"),
            (None, "cylinder_p2", "cylinder_p3"),
            ("cylinder_m1", None, None),
        )
        columns = [np.array([zero if name is None else f[name] for name in names]) for names in parts]
        return *(np.einsum("mij,jm->mi", axes, c) for c in columns), np.cos(f["eta"])[:, None]

    around = [vectors(middle + k * h) for k in (-2, -1, 0, 1, 2)]
    force_rate, moment_rate = (
        (around[0][i] - 8.0 * around[1][i] + 8.0 * around[3][i] - around[4][i]) / (12.0 * h) for i in (0, 1)
    )
    force, _, load, moment, cos = around[2]
    shear = np.cross(np.array([0.0, 0.0, 1.0]), force)
    np.testing.assert_allclose(force_rate, load * cos, atol=1e-6 * np.max(np.abs(load)))
    size = np.max(np.abs(shear)) + np.max(np.abs(moment))
    np.testing.assert_allclose(moment_rate + shear * cos, moment * cos, atol=1e-6 * size)
