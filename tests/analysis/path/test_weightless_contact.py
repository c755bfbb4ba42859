"""The weightless rod, clamped at the wall, within a plane: contact in closed form by elliptic integrals.

Until the rod touches the opposite wall any plane is as good as another; here states are held in none, and solved for
from planar starts. What ``load_path`` makes of such rods is in ``test_arching_rods``.

A clamped elastica of modulus k has F = −16K², K = K(k), and rises by k/K at mid-length (four quarter waves in its
length); it reaches the opposite wall where k/K = 2Δ. Pressed on, it is two spans, each held parallel to the wall at
both ends; the contact at mid-length has no curvature left, and grows to a line, at −157.818791660462 for Δ = 0.01
(exact elastica, theory of the rod in a hole), and at −16π² for small slopes: a span of length ½ is then one whole wave.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipk

import rodwell
from rodwell.analysis.off_wall.arrange import at_load, refined, solved
from rodwell.analysis.off_wall.certificate import contact_certificate
from rodwell.analysis.off_wall.conditions import PatternedState, apart
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.carry import Sampler, angle_of, sampler
from rodwell.numerics.stretches.walk import search, tangent_in_load


def modulus(condition) -> float:
    """The modulus k at which a condition on k and K(k) is met."""
    return float(brentq(lambda k: condition(k, ellipk(k * k)), 1e-6, 0.9, xtol=1e-15))


def planar(rise: float) -> Sampler:
    """A cosine arch from the bottom of the hole; the rise in clearances."""

    def sample(s):
        wave, fields = 2.0 * np.pi, np.zeros((2, 3, s.size))
        arch = 1.0 - np.cos(wave * s), wave * np.sin(wave * s), wave**2 * np.cos(wave * s)
        fields[0] = 0.5 * rise * np.stack(arch)
        fields[0, 0] -= 1.0
        return fields, angle_of(fields)

    return sample


def arch(clearance: float, force: float) -> PatternedState:
    k = modulus(lambda k, whole: 16.0 * whole**2 + force)
    rise = k / ellipk(k * k) / clearance
    model = RodInHole(rodwell.Problem(weight=0.0, clearance=clearance))
    # in its plane: out of it the arch may turn about the line between its ends, and nothing says how far
    state = solved(model, Pattern((False,), planar=True), np.zeros(0), force, planar(rise))
    assert state is not None
    top = float(sampler(state.solved.shape)(np.array([0.5]))[0][0, 0, 0])
    assert top + 1.0 == pytest.approx(rise, rel=1e-9)
    return state


def spans(clearance: float, force: float) -> PatternedState:
    """Two spans that meet at the opposite wall."""
    model = RodInHole(rodwell.Problem(weight=0.0, clearance=clearance))
    state = solved(model, Pattern((False, False)), np.array([0.5]), force, planar(2.0))
    assert state is not None
    assert state.bounds == pytest.approx([0.0, 0.5, 1.0], abs=1e-12)
    return state


@pytest.mark.parametrize("clearance", [0.01, 0.03])
def test_it_touches_the_opposite_wall(clearance: float) -> None:
    k = modulus(lambda k, whole: k / whole - 2.0 * clearance)
    exact = -16.0 * float(ellipk(k * k)) ** 2
    if clearance == 0.01:
        assert exact == pytest.approx(-39.4979222900122, abs=1e-12)
    state = arch(clearance, exact + 0.3 * (-4.0 * np.pi**2 - exact))

    def gap(one) -> float:
        return apart(PatternedState(state.pattern, state.elements, one), [0])[0].value

    found = search(state.model, state.solved, tangent_in_load(state.solved, -1.0), gap, 1e-4, 0.5)
    assert found.shape.load == pytest.approx(exact, rel=1e-11)
    # the shear that the contact takes over is none at first
    touching = at_load(spans(clearance, -45.0), exact)
    assert float(touching.solved.forces[0]) == pytest.approx(0.0, abs=1e-7)


@pytest.mark.parametrize(("clearance", "exact"), [(0.01, -157.818791660462), (1e-4, -16.0 * np.pi**2)])
def test_its_point_of_contact_grows_to_a_line(clearance: float, exact: float) -> None:
    """Where the curvature of the gap beside the point vanishes.

    It is known to some 1e-5 only, since nothing places a point of contact without curvature; among many loads that
    evens out.
    """
    state = spans(clearance, -152.0)
    assert contact_certificate(state).passed
    state = refined(state, 2)
    away = np.linspace(-0.3, 0.3, 61)
    found = [at_load(state, exact + float(one)) for one in away]
    curvatures = [float(one.solved.openings[0]) for one in found if one is not None]
    assert len(curvatures) == away.size
    roots = np.roots(np.polyfit(away, curvatures, 2))
    assert roots[np.argmin(np.abs(roots))] == pytest.approx(0.0, abs=1e-7 * abs(exact))
