"""The gallery: every script of ``examples/gallery`` runs, and what its picture shows is true."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from gallery_holes import bent_vessel, build_section, surveyed_well, two_casings, well
from gallery_scripts import GALLERY, run
from scipy.integrate import cumulative_simpson, quad

import rodwell
from rodwell.analysis.endless.local import LIMITS, local_state

PI2 = np.pi**2


def drill_string() -> None:
    """Weight of (63); B/L² of a round bar; the load is a root of (77); an odd shape lifts off in the middle."""
    found = run("drill_string")
    assert found["weight"] == pytest.approx(16.5, abs=0.05)
    assert found["clearance"] == pytest.approx(0.01, rel=1e-12)
    unit = 200e9 * np.pi / 4.0 * 0.05**4 / 30.0**2 / 1e3
    assert found["critical_kN"] == pytest.approx(unit * found["critical"], rel=1e-12)
    b = found["weight"] / found["clearance"]

    def equation_77(force: float) -> float:
        root = np.sqrt(force**2 - 4.0 * b)
        k1, k3 = np.sqrt((-force - root) / 2.0), np.sqrt((-force + root) / 2.0)
        return float(2 * k1 * k3 * (1 - np.cos(k1) * np.cos(k3)) - (k1**2 + k3**2) * np.sin(k1) * np.sin(k3))

    assert equation_77(found["critical"] * (1 - 1e-9)) * equation_77(found["critical"] * (1 + 1e-9)) < 0.0
    assert found["lift_off_at"] == pytest.approx((0.5,), abs=1e-9)
    assert abs(found["push"]) < 1e-8


def heavy_weight() -> None:
    """At the step the moment is continuous, the curvature jumps with the stiffness; the wall bears that of M₃."""
    problem, lift, step, sides = run("heavy_weight")
    below, above = sides["omega2"]
    assert sides["rod_M2"][0] == pytest.approx(sides["rod_M2"][1], rel=1e-9)
    assert above / below == pytest.approx(1.0 / 0.534, rel=1e-9)
    assert sides["omega3"][0] == pytest.approx(sides["omega3"][1], rel=1e-9)
    assert step.couple.value == pytest.approx((1.0 - 0.534) * sides["omega3"][0], rel=1e-9)
    assert lift.s[0] > 0.5
    assert problem.sections


def tapered_guidewire() -> None:
    """Loads of ever more steps, each of one stiffness, tend to that of the taper like the square of their length."""
    loads = run("tapered_guidewire")
    assert loads[0] == pytest.approx(loads[16] + (loads[16] - loads[8]) / 3.0, rel=3e-5)
    assert loads[1] / loads[0] > 1.2


def bifurcation_diagram() -> None:
    """Section 4.1.2 of the paper: −362.63 on the first branch and −164.78 on the second."""
    found = run("bifurcation_diagram")
    assert [round(force, 2) for force in found["mode 1"]] == [-362.63]
    assert [round(force, 2) for force in found["mode 2"]] == [-164.78]


def broken_symmetry() -> None:
    """Fig. 4: the branch joins the same two loads, an odd shape with an even one; odd shapes need no torque."""
    found = run("broken_symmetry")
    assert (round(found["from"], 2), round(found["to"], 2)) == (-362.63, -164.78)
    assert found["symmetry"] == (-1, 1)
    assert abs(found["torque"][0]) < 1e-10
    assert np.all(np.diff(found["torque"]) < 0.0)


def lock_up() -> None:
    """L = (Λ/μ) √(B/wr): Λ in closed form by the correlation, by quadrature of the exact states."""
    found = run("lock_up")
    lengths = {key: value / found["unit"] for key, value in found["lock_up"].items()}
    closed = 2.0 * np.sqrt(2.0) + 2.0 * (0.5 * np.pi - np.arctan(np.sqrt(2.0)))
    assert lengths["correlation", "early"] == pytest.approx(closed, rel=1e-8)
    for rule, switch in (("early", LIMITS.helix_lift_off.value), ("late", LIMITS.sinusoidal_lift_off.value)):
        inverse = [lambda b: 1.0 / local_state(float(b), "sinusoidal").contact_mean,
                   lambda x: 1.0 / (x * x * local_state(1.0 / float(x), "helical").contact_mean)]  # fmt: skip
        exact = 2.0 + quad(inverse[0], 2.0, switch)[0] + quad(inverse[1], 1e-9, 1.0 / switch)[0]
        assert lengths["exact", rule] == pytest.approx(exact, rel=1e-8)


def coil() -> None:
    """Two turns are 4π; twist of the material lines is −T₁/C, C = 1/(1 + ν), (32)."""
    found = run("coil")
    assert found["stable"]
    assert found["angle"] == pytest.approx(4.0 * np.pi, rel=1e-12)
    assert found["pressure"] < 0.0
    assert found["material_rate"] == pytest.approx(-2.0 / found["torsional_stiffness"], rel=1e-12)


def snap_to_coil() -> None:
    """Energies found by an interior-point method that lets the rod leave the wall."""
    known = {-140.0: -0.043325, -160.0: -0.089700, -200.0: -0.185518}
    for force, (energy, error) in run("snap_to_coil").items():
        assert energy == pytest.approx(known[force], abs=1e-6)
        assert error < 1e-9


def load_path() -> None:
    """Two other programs: lift-off, limit point and snap, the helix lifts off, its limit point."""
    found = run("load_path")
    assert found["loading fold"] == pytest.approx(-147.1580802, abs=1e-7)
    assert found["loading snap"] == pytest.approx(-147.1580802, abs=1e-7)
    assert found["unloading lift_off"] == pytest.approx(-109.8311707, abs=2e-7)
    assert found["unloading fold"] == pytest.approx(-103.6731326, abs=1e-7)


def build_path() -> None:
    """The rod kept on the wall; the snap is to a helix, and the way back ends where the rod lies along the hole."""
    found, kept = run("build_path"), rodwell.follow(rodwell.Problem(15.0, build=0.2), until=-250.0)
    assert kept.lift_off is not None
    assert found["loading critical"] == pytest.approx(kept.force[0], rel=1e-9)
    assert found["loading lift_off"] == pytest.approx(kept.lift_off.force, rel=1e-8)
    assert found["loading snap"] == found["loading fold"]
    assert found["unloading critical"] == pytest.approx(found["loading critical"], rel=1e-9)


def helix() -> None:
    """F = −(2B/Δ²) sin²η cos η and p = −B sin⁴η/Δ³; the largest load is 4/(3√3) B/Δ²."""
    found = run("helix")
    eta = found["eta"]
    assert found["loads"] == pytest.approx(-2.0 * np.sin(eta) ** 2 * np.cos(eta), rel=1e-8)
    assert found["pushes"] == pytest.approx(np.sin(eta) ** 4, rel=1e-7)
    assert -found["loads"].min() < 4.0 / np.sqrt(27.0)


def guidewire() -> None:
    """Uniform helices: contact pressure from (52)–(55) by hand; a pinned weightless rod buckles at π² B/L²."""
    found = run("guidewire")
    assert found["computed"] == pytest.approx(found["exact"], rel=1e-7, abs=1e-6)
    assert found["critical"] == pytest.approx(-PI2, rel=1e-9)


def lift_off() -> None:
    """−123.1730743 for the horizontal rod, known from AUTO-07p; the rod buckles before it lifts off."""
    found = run("lift_off")
    assert found["horizontal"] == pytest.approx(-123.1730743, abs=1e-6)
    assert found["after_buckling"]


def lift_off_map() -> None:
    """The horizontal rod changes its mode at γ = 62.34181826, (77), (78); loads are those of single problems."""
    found = run("lift_off_map")
    assert found["counts"] == {"converged": 119}
    assert any(low <= 62.34181826 <= high for low, high in zip(found["low"], found["high"], strict=True))
    alone = rodwell.follow(rodwell.Problem(found["weights"][3], 90.0)).lift_off
    assert alone is not None
    assert found["values"][3, -1] == alone.force


def envelope() -> None:
    """4π² without weight; double points of (78): γ = n²m²π⁴Δ, F = −(n² + m²)π²."""
    found = run("envelope")
    assert list(found["weightless"].values()) == pytest.approx([-4.0 * PI2] * 4, rel=1e-9)
    known = [(n**2 * m**2 * PI2**2 * 0.01, -(n**2 + m**2) * PI2) for n, m in ((1, 3), (2, 4))]
    assert np.array(found["double"]) == pytest.approx(np.array(known), rel=1e-9)


def formulas() -> None:
    """At the double points of (78) the formula, 2nmπ², is 2nm/(n² + m²) of the exact load."""
    for n, m, ratio in run("formulas"):
        assert ratio == pytest.approx(2.0 * n * m / (n**2 + m**2), rel=1e-9)


def twist() -> None:
    """Reflection exchanges the arms and the sign of T₁; section 4.2: T₁ > 0 stabilises, up to a limit."""
    (below, force), (above, same) = run("twist")["again"]
    assert below == pytest.approx(-above, rel=1e-7)
    assert force == pytest.approx(same, rel=1e-9)
    assert above > 0.0


def wall_moments() -> None:
    """T₂' = Δ wₗ sin ξ₂ with T₂(1) = 0, (33), integrated here a second time."""
    found = run("wall_moments")
    rate = found["clearance"] * found["lateral_weight"] * np.sin(found["y"] / found["clearance"])
    twisting = cumulative_simpson(rate, x=found["s"], initial=0.0)
    assert found["T2"] == pytest.approx(twisting - twisting[-1], abs=1e-9 * np.max(np.abs(twisting)))


def column() -> None:
    """Fig. 9: the first mode of γ = 100 arises at F = 14.3626; (87): F = 0 is critical at γ = 74.628569."""
    found = run("column")
    assert round(found["critical"], 4) == 14.3626
    assert abs(found["self_weight"]) < 1e-6


def endless() -> None:
    """Mean contact forces at β = 3, known from two other programs; the least one vanishes at lift-off."""
    found = run("endless")
    assert found["sinusoidal_at_3"] == pytest.approx(1.38468435, abs=1e-8)
    assert found["helical_at_3"] == pytest.approx(2.24863072, abs=1e-8)
    for load, kind in zip(found["lifts_off"], ("sinusoidal", "helical"), strict=True):
        assert abs(rodwell.local_state(load, kind).contact_least) < 1e-9


CHECKS: dict[str, Callable[[], None]] = {
    check.__name__: check
    for check in (
        drill_string, bifurcation_diagram, broken_symmetry, coil, snap_to_coil, load_path, build_path, helix,
        guidewire, lift_off, lift_off_map, envelope, formulas, twist, wall_moments, heavy_weight, well,
        column, endless, lock_up,
        build_section, bent_vessel, surveyed_well, two_casings, tapered_guidewire,
    )
}  # fmt: skip


@pytest.mark.parametrize("name", CHECKS)
def test_picture(name: str) -> None:
    CHECKS[name]()


def test_no_script_is_left_out() -> None:
    assert set(CHECKS) == {script.stem for script in GALLERY.glob("*.py")}


def test_scripts_write_their_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(GALLERY / "column.py"), run_name="__main__")
    assert (tmp_path / "column.png").read_bytes().startswith(b"\x89PNG")
