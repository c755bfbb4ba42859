"""Stress of a section: Lamé by hand, the stress tensor's own invariants, and every point of the section."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell.formulas import FORMULAS
from rodwell.strength.stress import Loading, Section, stresses

THICK = Section(0.06, 0.03)


def load(force: float = 0.0, bending: float = 0.0, torque: float = 0.0, inside: float = 0.0, outside: float = 0.0):
    return Loading(*(np.array([x]) for x in (force, bending, torque, inside, outside)))


def largest(section: Section, **loads: float) -> float:
    return float(stresses(section, load(**loads)).von_mises[0])


def test_thick_pipe_under_pressure_with_closed_and_open_ends() -> None:
    """Closed ends: √3 p rₒ²/(rₒ² − rᵢ²) at the bore (Lamé, von Mises; any textbook). Open ends: no axial stress."""
    p, o, i = 80e6, THICK.outer**2, THICK.inner**2
    closed = largest(THICK, force=p * math.pi * i, inside=p)
    assert closed == pytest.approx(math.sqrt(3.0) * p * o / (o - i), rel=1e-13)
    hoop, radial = p * (o + i) / (o - i), -p
    opened = math.sqrt(hoop**2 - hoop * radial + radial**2)
    assert largest(THICK, inside=p) == pytest.approx(opened, rel=1e-13)
    found = stresses(THICK, load(inside=p))
    assert found.hoop_inner[0] == pytest.approx(hoop)
    assert found.hoop_outer[0] == pytest.approx(2.0 * p * i / (o - i))
    assert found.fibre[0] in (2, 3)  # at the bore


def test_pressure_all_around_with_its_end_force_shears_nothing() -> None:
    """The same pressure everywhere, on the end faces too: hydrostatic, so no equivalent stress (solid and hollow)."""
    for section in (THICK, Section(0.01)):
        bore = math.pi * section.inner**2
        force = 5e6 * (bore - math.pi * section.outer**2)
        assert largest(section, force=force, inside=5e6, outside=5e6) == pytest.approx(0.0, abs=1e-6)


def test_thin_pipe_tends_to_the_boiler_formula() -> None:
    thin = Section(0.1001, 0.1)
    assert largest(thin, inside=1e5) == pytest.approx(1e5 * 0.1 / 1e-4, rel=2e-3)


def test_beam_and_shaft() -> None:
    """Solid round bar: 32 M/(π d³), 16 T/(π d³), and √(σ² + 3 τ²) of both with the axial stress."""
    bar, d = Section(0.02), 0.04
    bending, shear = 32.0 * 700.0 / (math.pi * d**3), 16.0 * 400.0 / (math.pi * d**3)
    assert largest(bar, bending=700.0) == pytest.approx(bending)
    assert largest(bar, torque=400.0) == pytest.approx(math.sqrt(3.0) * shear)
    axial = 9e3 / (math.pi * d**2 / 4.0)
    both = stresses(bar, load(-9e3, 700.0, 400.0))
    assert both.von_mises[0] == pytest.approx(math.hypot(axial + bending, math.sqrt(3.0) * shear))
    assert both.axial[0] == pytest.approx(-axial)
    assert both.fibre[0] == 1  # the side that bending compresses too


def test_helix_of_lubinski() -> None:
    """Bending stress D r F/(4 I) of the weightless helix, whose moment is r F/2 (formulas.md)."""
    pipe, r, force = Section(0.0635, 0.0543), 0.04445, 1.2e5
    found = stresses(pipe, load(bending=0.5 * r * force)).bending[0]
    d, inertia = 2.0 * pipe.outer, math.pi / 4.0 * (0.0635**4 - 0.0543**4)
    assert found == pytest.approx(d * r * force / (4.0 * inertia))
    assert found == pytest.approx(FORMULAS["helix_bending_stress"].function(r=r, F=force, D=d, I=inertia))


SIZES = st.floats(-1.0, 1.0, allow_nan=False)


@settings(max_examples=60, deadline=None)
@given(
    st.floats(0.0, 0.95), SIZES, st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0),
    st.floats(0.0, 1.0), st.floats(0.0, 2.0 * math.pi),
)  # fmt: skip
def test_no_point_of_the_section_is_stressed_more(
    bore: float, force: float, bending: float, torque: float, inside: float, outside: float, share: float, around: float
) -> None:
    """The equivalent stress from the eigenvalues of the whole tensor, at any radius and any place around."""
    section = Section(0.05, 0.05 * bore)
    inside = inside if bore > 0.0 else 0.0
    n, m, t, p_i, p_o = 1e6 * force, 2e4 * bending, 2e4 * torque, 1e8 * inside, 1e8 * outside
    o, i = section.outer**2, section.inner**2
    radius = section.inner + share * (section.outer - section.inner)
    radius = max(radius, 1e-6)
    mean, swing = (p_i * i - p_o * o) / (o - i), (p_i - p_o) * i * o / ((o - i) * radius**2)
    axial = n / section.area + m * radius * math.cos(around) / section.inertia
    shear = t * radius / (2.0 * section.inertia)
    tensor = np.array([[mean - swing, 0.0, 0.0], [0.0, mean + swing, shear], [0.0, shear, axial]])
    a, b, c = np.linalg.eigvalsh(tensor)
    here = math.sqrt(0.5 * ((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2))
    worst = largest(section, force=n, bending=m, torque=t, inside=p_i, outside=p_o)
    assert here <= worst * (1.0 + 1e-9) + 1e-3
    if share == 1.0 and around == 0.0 and n * m >= 0.0:
        assert worst >= here * (1.0 - 1e-9)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.1, 0.95), SIZES, st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_effective_force_gives_the_same(
    bore: float, force: float, bending: float, torque: float, inside: float, outside: float
) -> None:
    """σ_e² = (N/A ± M r/I)² + 3 (…)² + 3 (T r/J)² with the effective force N = N_real − pᵢ Aᵢ + pₒ Aₒ (Lubinski)."""
    section = Section(0.05, 0.05 * bore)
    n, m, t, p_i, p_o = 1e6 * force, 2e4 * bending, 2e4 * torque, 1e8 * inside, 1e8 * outside
    o, i = section.outer**2, section.inner**2
    effective = n - p_i * math.pi * i + p_o * math.pi * o
    squares = []
    for r in (section.outer, section.inner):
        wall = (p_i - p_o) * i * o / ((o - i) * r**2)
        axial = abs(effective) / section.area + m * r / section.inertia
        squares.append(axial**2 + 3.0 * wall**2 + 3.0 * (t * r / (2.0 * section.inertia)) ** 2)
    found = largest(section, force=n, bending=m, torque=t, inside=p_i, outside=p_o)
    assert found == pytest.approx(math.sqrt(max(squares)), rel=1e-9, abs=1e-3)
