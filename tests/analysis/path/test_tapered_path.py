"""The load path of a rod that tapers: against the uniform rod, the strong form along each stretch, and virtual work."""

from __future__ import annotations

import numpy as np
import pytest
from strong_form import integrated

import rodwell
from rodwell.analysis.off_wall.measured import position
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath

TAPER = rodwell.Problem(weight=15, sections=((1.0, (1.0, 0.5), (1.0, 0.7)),))


@pytest.fixture(scope="module")
def path() -> LoadPath:
    return load_path(TAPER, until=-110.0, unload_to=-75.0, seeds=1)


def test_a_rod_that_hardly_tapers_is_a_uniform_one() -> None:
    """References: test_load_path."""
    rod = rodwell.Problem(weight=15, sections=((1.0, (1.0, 1.0 + 1e-9)),))
    found = load_path(rod, until=-127.0, seeds=1)
    assert [event.kind for event in found.events] == ["critical", "lift_off", "gap_opens"]
    loads = [event.force.value for event in found.events]
    assert loads == pytest.approx([-111.23344016, -123.173074, -124.1911865], abs=1e-6)


def test_the_whole_loop_is_followed(path: LoadPath) -> None:
    assert path.reached
    assert not path.missed
    assert [event.kind for event in path.events if event.leg == "loading"][-1] == "snap"
    assert [event.kind for event in path.events][-1] == "snap"


@pytest.mark.parametrize("twist", [0.0, 2.0])
def test_free_stretches_solve_the_equations_of_a_rod_in_space(path: LoadPath, twist: float) -> None:
    if twist:
        path = load_path(TAPER.but(twist=twist), until=-93.0, seeds=1)
    state = path.at(-95.0 if not twist else -92.0)[0].state
    assert len(state.gaps) >= 1
    assert state.certificate.passed
    for gap in state.gaps:
        end = integrated(state, gap.start.value, gap.end.value)
        x, y, _ = position(state.fine, np.array([gap.end.value]))
        assert end == pytest.approx(np.array([x[0, 0], y[0, 0]]) / TAPER.clearance, abs=3e-8)


def test_energy_changes_by_the_work_of_the_load(path: LoadPath) -> None:
    """dE/dF is the shortening: on the wall, with gaps, and of the helix."""
    for force, leg in ((-88.0, 0), (-95.0, 0), (-95.0, 1)):
        h = 1e-3
        low, here, high = (path.at(force + d)[leg].state for d in (-h, 0.0, h))
        slope = (high.energy.value - low.energy.value) / (2.0 * h)
        assert slope == pytest.approx(here.shortening.value, rel=1e-6)


def test_the_radial_moment_changes_along_a_taper() -> None:
    """The derivative by the place of the cut, against differences: the stiffness there is another."""
    model, s, h = RodInHole(TAPER.but(twist=0.7)), np.array([0.3]), 1e-5
    given = model.given.T
    rate, bend = np.array([4.0]), np.array([-3.0])
    low, here, high = (model.rim_reaction(s + d, 0.0 * s, rate, bend, given) for d in (-h, 0.0, h))
    assert here[3] == pytest.approx((high[0] - low[0]) / (2.0 * h), rel=1e-9)
    slower, faster = (model.rim_reaction(s, 0.0 * s, rate + d, bend, given)[0] for d in (-h, h))
    assert here[2] == pytest.approx((faster - slower) / (2.0 * h), rel=1e-9)


def test_a_kink_of_the_stiffness_of_a_rod_that_arches_into_the_hole() -> None:
    kinked = rodwell.Problem(weight=15, sections=((0.4, 1.0), (0.6, (1.0, 0.5))))
    arching = load_path(kinked.but(weight=0.0), until=-45.0, unload_to=-30.0, seeds=1)
    assert arching.reached
    assert all(state.state.certificate.passed for state in arching.at(-44.0))
