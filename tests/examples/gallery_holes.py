"""What pictures of the gallery show of rods in wells, casings and bent holes is true."""

from __future__ import annotations

import numpy as np
import pytest
from gallery_scripts import GALLERY, run


def surveyed_well() -> None:
    """At rest the pipe bends with the hole: by the angle between the directions of two stations, by hand."""
    found = run("surveyed_well")
    stations = np.loadtxt(GALLERY.parent / "well-survey.csv", delimiter=",", skiprows=2)
    upper, lower = (stations[np.isclose(stations[:, 0], depth)][0] for depth in (1026.0, 1054.5))
    directions = []
    for _, inclination, azimuth in np.radians([upper, lower]):
        directions.append(
            [np.sin(inclination) * np.cos(azimuth), np.sin(inclination) * np.sin(azimuth), np.cos(inclination)]
        )
    bend = np.arccos(np.dot(*directions)) / 28.5
    between = (found["depth"] > 1038.0) & (found["depth"] < 1054.5)
    assert np.mean(found["bending"][between]) == pytest.approx(found["case"].scales.stiffness * bend, rel=0.01)
    assert found["rod"].end.kind == "lift_off"
    swing = [np.ptp(angles) for angles in found["angles"]]
    assert np.all(np.diff(swing) > 0.0)


def two_casings() -> None:
    """Lengths a and (√3 − 1)a beside the edge, a⁴ = 24δ/((2√3 − 3)w), whose force is what is left of the weight."""
    problem, alone, buckling = run("two_casings")
    a = (24.0 * 0.8 * problem.clearance / ((2.0 * np.sqrt(3.0) - 3.0) * problem.weight)) ** 0.25
    c = (np.sqrt(3.0) - 1.0) * a
    assert [point.s.value for point in alone.point_forces] == pytest.approx([0.5 - c, 0.5, 0.5 + a], rel=1e-5)
    assert alone.point_forces[1].force.value == pytest.approx(problem.weight * (a + 0.25 * c), rel=1e-5)
    assert buckling.state.stability_index <= 1
    assert buckling.met


def build_section() -> None:
    """E r κ/(1 + κΔ), and the stress of the lying pipe of its effective force, the mud being at rest, by hand.

    That is largest in the drill pipe at its lower end, where the effective force is that at the bottom less what the
    heavy-weight pipe weighs over its rise, and −b κᵣ² of the drill pipe.
    """
    found = run("build_section")
    case = found["case"]
    (half, heavy, weight, *_), (_, light, *_) = case.problem.sections
    outer, bores, length = 3.5 * 0.0254, (2.25 * 0.0254, 2.764 * 0.0254), 124.0 * 0.3048
    area, inertias = np.pi / 4.0 * (outer**2 - bores[1] ** 2), [np.pi / 64.0 * (outer**4 - bore**4) for bore in bores]
    kappa = np.radians(12.0) / (100.0 * 0.3048)
    curvature = kappa / (1.0 + kappa * 0.5 * (6.125 - 3.5) * 0.0254)
    modulus = case.scales.stiffness * heavy / inertias[0]
    assert modulus == pytest.approx(30e6 * 6894.757, rel=1e-6)
    assert modulus == pytest.approx(case.scales.stiffness * light / inertias[1], rel=1e-9)
    assert found["lying"] == pytest.approx(modulus * 0.5 * outer * curvature, rel=1e-9)
    # on the low side the outer fibre of the lying pipe is pressed most; the mud presses on all sides
    slopes = np.radians(30.0) - curvature * length * np.array([0.5, 0.0])
    rise = np.diff(-np.cos(slopes))[0] / curvature
    hung = weight * case.problem.weight * case.scales.factor("force_per_length") * rise
    effective = 30000.0 * 4.4482216152605 - hung + modulus * inertias[1] * curvature**2
    assert found["largest"][0] == pytest.approx(effective / area + modulus * 0.5 * outer * curvature, rel=1e-6)
    assert np.all(np.diff(found["largest"]) > 0.0)
    assert length == pytest.approx(case.scales.length, rel=1e-12)
    assert half == 0.5


def bent_vessel() -> None:
    """w cos ψ − κᵣ(F − κᵣ²) at mid-length, where the vessel is horizontal and N = F + w × the rise to the end."""
    found = run("bent_vessel")
    problem = found["problem"]
    curvature = 1.5 / (1.0 + 1.5 * problem.clearance)
    rise = (1.0 - np.cos(0.5 * curvature)) / curvature
    tension = found["pushed"] - problem.weight * rise
    expected = problem.weight - curvature * (tension - curvature**2)
    assert found["push_on_wall"] == pytest.approx(expected, rel=1e-9)
    assert found["critical"] > found["lift_off"].force
    assert abs(found["lift_off"].solution.highest_pressure[0]) < 1e-6 * expected


def well() -> None:
    """Dawson–Paslay, 2√(B w/r), of the pipe in its hole by hand; the exact load of a long rod is above it by little."""
    found = run("well")
    inch, foot, psi = 0.0254, 0.3048, 6894.757
    stiffness = 30e6 * psi * np.pi / 64.0 * (5.0**4 - 4.276**4) * inch**4
    weight = 16.523 * 4.4482216 / foot
    by_hand = 2.0 * np.sqrt(stiffness * weight * np.sin(np.radians(found["inclination"])) / (1.75 * inch))
    assert found["formula"] == pytest.approx(by_hand, rel=1e-6)
    assert 1.0 < found["exact"] / by_hand < 1.01
