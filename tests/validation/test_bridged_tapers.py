"""Sections that taper beside steps of the clearance: the string in its hole, and the load at which it buckles."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from analysis.along_s import drift_and_differences
from scipy.integrate import solve_ivp

from rodwell import Problem, jointed_string, load_path
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.errors import InputError

SECTIONS = ((0.3, 1.0, 1.0), (0.4, (1.0, 0.4, 0.3), (1.2, 0.7), 0.6), (0.3, (0.3, 0.8, 1.0, 0.9), 0.8))
STRING = Problem(200.0, 70.0, clearance=1e-3, sections=SECTIONS)


@pytest.fixture(scope="module")
def buckling() -> Any:
    """The load at which it buckles, and the state there."""
    return load_path(STRING).events[-1]


def test_bridged_states_are_in_balance(buckling: Any) -> None:
    """Force balance along free stretches and at edges, of the force that follows by moment balance with b′ t′."""
    assert buckling.met
    assert buckling.state.certificate.passed, buckling.state.certificate
    assert {point.kind for point in buckling.state.point_forces} >= {"edge", "end"}


def _ratio(ratio: Any, part: float) -> float:
    values = np.atleast_1d(ratio)
    return float(np.polyval(np.polyfit(np.linspace(0.0, 1.0, values.size), values, values.size - 1), part))


def _misfit(buckling: Any, force: float) -> float:
    """Determinant that vanishes where a disturbance out of the plane may grow, by small slopes.

    (b v″)″ − (N v′)′ + (p/ρ) v = 0 with the contact force p per length, and a spring P/ρ at each point force P, ρ the
    clearance there.
    """
    state, ends = buckling.state, np.cumsum([0.0, *(length for length, *_ in SECTIONS)])
    clearances = [STRING.clearance * (section[3] if len(section) > 3 else 1.0) for section in SECTIONS]
    points = {point.s.value: point.force.value for point in state.point_forces}
    touched = [(one.start.value, one.end.value) for one in state.contacts]
    whole = np.eye(4)
    for low, high in pairwise(np.unique(np.round([*ends, *points], 12))):
        k = int(np.searchsorted(ends, 0.5 * (low + high))) - 1
        length, b, q, *_ = SECTIONS[k]
        lies = any(start <= 0.5 * (low + high) <= end for start, end in touched)

        def rates(s: float, y: np.ndarray, k: int = k, length: float = length, b: Any = b, q: Any = q,
                  lies: bool = lies) -> np.ndarray:  # fmt: skip
            v, slope, moment, shear = y.reshape(4, 4)
            part = (s - ends[k]) / length
            bed = STRING.lateral_weight * _ratio(q, part) / clearances[k] if lies else 0.0
            axial = force + STRING.axial_weight * float(STRING.rod.lever(np.array([s]))[0])
            return np.concatenate([slope, moment / _ratio(b, part), shear + axial * slope, -bed * v])

        found = solve_ivp(rates, (low, high), whole.ravel(), method="DOP853", rtol=1e-10, atol=1e-12)
        whole = found.y[:, -1].reshape(4, 4)
        narrow = min(clearances[k : k + 2] if high == pytest.approx(ends[k + 1]) else clearances[k : k + 1])
        spring = sum(value for s, value in points.items() if abs(s - high) < 1e-9)
        whole[3] -= spring / narrow * whole[0]
    return float(np.linalg.det(whole[np.ix_((0, 1), (2, 3))]))


def test_the_buckling_load_is_that_of_shooting(buckling: Any) -> None:
    """The linear problem out of the plane, with contact as it is in the state; slopes are of the order of Δ."""
    load = buckling.force.value
    below, above = (_misfit(buckling, load * (1.0 + change)) for change in (-2e-5, 2e-5))
    assert below * above < 0.0


@pytest.mark.parametrize("fields", [1, 2])
def test_what_a_density_changes_by_along_s(fields: int) -> None:
    """Against differences: on the wall with slope and twist, and off it."""
    model = RodInHole(STRING.but(clearance=0.01, twist=2.0))
    drift, known = drift_and_differences(model, fields, model.given[1][:, None, None])
    assert drift == pytest.approx(known, abs=1e-8 * float(np.max(np.abs(known))))


def test_an_end_of_contact_passes_steps_of_the_stiffness_in_the_plane() -> None:
    """There is no slope around the wall that a couple would have to hold: the same as of tapers in their limit.

    A step that took an end of a stretch past that of an element ended in an IndexError.
    """
    middles = (np.arange(6) + 0.5) / 6
    middle = [(0.4 / 6, _ratio((1.0, 0.6, 0.3), part), _ratio((1.2, 0.7), part), 0.6) for part in middles]
    upper = [(0.05, _ratio((0.3, 0.5, 1.2, 1.0), part), 0.8) for part in middles]
    string = STRING.but(clearance=0.01, sections=((0.3, 1.0), *middle, *upper))
    path = load_path(string)
    assert "buckles sideways" in path.ended_because
    assert path.events[-1].state.certificate.passed


def test_endless_strings_of_joints_take_no_tapers() -> None:
    joint = ((0.05, 1.0, 1.0, 0.5), (0.9, (1.0, 0.8, 1.0), 1.0, 1.0), (0.05, 1.0, 1.0, 0.5))
    with pytest.raises(InputError, match="endless strings of joints are not computed of sections that taper"):
        jointed_string(Problem(1.0, 90.0, clearance=1e-3, sections=joint))
