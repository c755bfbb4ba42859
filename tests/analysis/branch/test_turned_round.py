"""Inclinations beyond horizontal: a rod seen from its other end is the same rod."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell import Problem, certify, critical_loads, follow, loads_without_wall

ENDS = ("clamped", "pinned", "guided", "free")

problems = st.builds(
    Problem,
    weight=st.floats(5.0, 300.0),
    alpha=st.floats(20.0, 89.0),
    clearance=st.floats(0.002, 0.05),
    ends=st.tuples(st.sampled_from(ENDS), st.sampled_from(ENDS)),
)


@settings(max_examples=25, deadline=None)
@given(problems)
def test_critical_loads_from_the_other_end(problem: Problem) -> None:
    here, there = critical_loads(problem, 2), critical_loads(problem.turned_round, 2)
    allowed = here.errors + there.errors + 1e-13 * problem.weight
    assert np.all(np.abs(here.forces - problem.axial_weight - there.forces) <= allowed)


@pytest.mark.parametrize("ends", ["clamped-pinned", "free-clamped", "guided-clamped"])
def test_lift_off_from_the_other_end(ends: str) -> None:
    problem = Problem(40.0, 62.0, ends=ends)  # type: ignore[arg-type]
    here, there = follow(problem), follow(problem.turned_round)
    one, other = here.labelled("lift_off 1"), there.labelled("lift_off 1")
    assert other.force == pytest.approx(one.force - problem.axial_weight, abs=one.error + other.error)
    assert sorted(1.0 - s for s in other.s) == pytest.approx(sorted(one.s), abs=1e-6)
    assert there.converged
    places = np.linspace(0.0, 1.0, 9)
    y, turned = one.solution.fields(places)["y"], other.solution.fields(1.0 - places)["y"]
    assert np.abs(turned) == pytest.approx(np.abs(y), abs=1e-6 * problem.clearance)


def test_long_rods_are_resolved_at_their_lower_end_whichever_it_is() -> None:
    problem = Problem(3000.0, 140.0)
    here, there = follow(problem), follow(problem.turned_round)
    assert here.labelled("lift_off 1").force == pytest.approx(
        there.labelled("lift_off 1").force + problem.axial_weight, abs=1e-6
    )
    elements = [branch[-1].meshes.fine.space.elements for branch in (here, there)]
    assert max(elements) < 1.2 * min(elements)


def test_loads_without_the_wall_and_with_proof_from_the_other_end() -> None:
    problem = Problem(30.0, 150.0, ends="pinned-clamped", twist=1.0)  # type: ignore[arg-type]
    here, there = loads_without_wall(problem), loads_without_wall(problem.turned_round)
    assert here.forces[0] == pytest.approx(there.forces[0] + problem.axial_weight, abs=1e-9)
    upright = Problem(30.0, 180.0, ends="pinned-clamped")  # type: ignore[arg-type]
    (proved,) = certify(upright, 1)
    assert float(proved.force.middle) == pytest.approx(critical_loads(upright, 1).forces[0], abs=1e-9)
    assert upright.lateral_weight == 0.0


def test_an_inclination_that_looks_like_radians_is_asked_back() -> None:
    with pytest.warns(UserWarning, match=r"taken in degrees.* for 1\.5708 rad give 90"):
        Problem(15.0, np.pi / 2.0)
