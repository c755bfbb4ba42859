"""Strings off the wall along holes whose curvature varies in a vertical plane: arcs, limits, the force along."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from analysis.curved.whole_rod import plane_axis
from scipy.integrate import solve_ivp

from rodwell import Case, LoadPath, Problem, critical_loads, load_path, sensitivities
from rodwell.analysis.discrete.curved import hole_at, rates_at, stations_along, undeformed_place
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.answers.result.bridged import bridged_answer

Strings = tuple[tuple[float, ...], ...]

STIFFER: Strings = ((0.5, 1, 1), (0.5, 3, 1))
STABILISER: Strings = ((0.4, 1, 1, 1), (0.2, 2, 3, 0.5), (0.4, 1, 1, 1))
FLOATS: Strings = ((0.4, 1, 1), (0.2, 1, -1), (0.4, 1, 1))

ARC = plane_axis(lambda _: 0.2)
TIGHTER = plane_axis(lambda s: 0.05 + 0.3 * s, 0.2)


def path_of(sections: Strings, points: list[tuple[float, ...]] | None) -> LoadPath:
    if points is None:
        return load_path(Problem(50.0, 90.0, 1e-3, build=0.2, sections=sections), rtol=1e-10)
    return load_path(Problem(50.0, clearance=1e-3, axis=points, sections=sections), rtol=1e-10)


@pytest.mark.parametrize("sections", [STIFFER, STABILISER, FLOATS])
def test_a_circle_given_by_points_is_an_arc(sections: Strings) -> None:
    one, other = path_of(sections, None), path_of(sections, ARC)
    assert [event.kind for event in one.events] == [event.kind for event in other.events]
    for event, same in zip(one.events, other.events, strict=True):
        rel = 3e-8 if event.kind == "gap_closes" else 1e-9  # which goes like the root of the load
        assert same.force.value == pytest.approx(event.force.value, rel=rel)
    assert one.events[-1].kind == "critical"


@pytest.mark.parametrize("sections", [STIFFER, STABILISER])
def test_where_the_curvature_varies_forces_in_space_are_in_balance(sections: Strings) -> None:
    found = path_of(sections, TIGHTER).first("critical")
    assert found is not None
    assert found.state is not None
    assert found.met
    assert found.state.certificate.worst < 1e-7
    assert found.state.own_places.certificate.worst < 1e-7
    assert found.state.place_errors["energy"] < 1e-4 * abs(found.state.energy.value)


def test_of_a_step_of_the_weight_alone_the_load_is_that_on_the_wall() -> None:
    problem = Problem(50.0, clearance=1e-3, axis=TIGHTER, sections=((0.5, 1, 1), (0.5, 1, 3)))
    found = load_path(problem).first("critical")
    assert found is not None
    assert found.force.value == pytest.approx(critical_loads(problem, 1)[0].force, rel=1e-9)


def test_the_force_along_the_hole_goes_on_over_steps_of_the_clearance() -> None:
    """N′ = w q T·k h + b κᵣ k₁′/h² + N r k₁′/h², h = 1 + r k₁, of a rod at the distance r from the axis, by SciPy."""
    problem = Problem(50.0, clearance=1e-2, axis=TIGHTER, sections=STABILISER)
    model, load = rod_in_hole(problem), -300.0

    def rate(s: float, force: np.ndarray, b: float, q: float, r: float) -> np.ndarray:
        at = undeformed_place(problem, np.array([s]))
        (k1, *_), climb = hole_at(problem, at)
        bend = rates_at(problem, at)[0]
        h = 1.0 + r * k1
        return np.asarray(problem.weight * q * climb * h + b * k1 / h * bend / h**2 + force * r * bend / h**2)

    n = load * (1.0 + problem.clearance * hole_at(problem, undeformed_place(problem, np.ones(1)))[0][0])
    parts = zip(((0.6, 1.0), (0.4, 0.6), (0.0, 0.4)), problem.sections[::-1], strict=True)
    for (low, high), (_, b, q, c, _) in parts:
        found = solve_ivp(
            rate, (high, low), np.atleast_1d(n), args=(b, q, c * 1e-2), rtol=1e-11, atol=1e-11, dense_output=True
        )
        places = np.linspace(low, high, 9)
        # places on the axis are those of a rod at one clearance
        assert model.drive(places, load) == pytest.approx(found.sol(places)[0], rel=2e-6)
        n = found.y[:, -1]


def test_derivatives_along_an_axis_are_those_of_differences() -> None:
    problem = Problem(50.0, clearance=1e-2, axis=TIGHTER, sections=STABILISER)
    (found,) = sensitivities(problem)
    assert set(found.derivatives) == {"weight", "clearance"}
    more = load_path(problem.but(weight=50.05)).first("critical")
    assert more is not None
    assert found.derivatives["weight"].value == pytest.approx((more.force.value - found.force) / 0.05, rel=1e-3)


SURVEY = "MD [m],INC,AZI\n" + "".join(f"{1000 + 10 * i},{40 + 1.5 * i + 0.15 * i * i},30\n" for i in range(9))


def surveyed(folder: Path, *parts: tuple[str, str, str]) -> Case:
    """A string of sections (length, outer and inner diameter) along stations 10 m apart."""
    (folder / "survey.csv").write_text(SURVEY)
    keys = ("length", "outer_diameter", "inner_diameter")
    sections = [dict(zip(keys, part, strict=True)) | {"material": "steel"} for part in parts]
    hole = {"diameter": "8.5 in", "survey": "survey.csv", "from": "1015 m"}
    return Case.from_dict({"string": sections, "hole": hole}, folder=folder)


def test_elements_end_at_stations_of_a_survey(tmp_path: Path) -> None:
    """Balance in space, where the gap beside the step passes a station: without them it is missed by 10⁻⁵."""
    problem = surveyed(tmp_path, ("30 ft", "6.5 in", "4 in"), ("90 ft", "6.5 in", "2.8125 in")).problem
    path = load_path(problem)
    stations = stations_along(problem)
    gaps = [state.bounds[2] for state in path.legs[0].runs[0]]
    assert min(gaps) < stations[1] < max(gaps)
    for load in (path.legs[0].runs[0][0].load, -20.0, -100.0, -500.0):
        state = path.at(load)[0].state
        assert state.certificate.worst < 1e-7
    assert path.first("critical") is not None


def test_what_misses_its_balance_beside_a_station_loses_no_answer(tmp_path: Path) -> None:
    """A stabiliser between collars: at its clearance it is not quite beside the stations at which elements end."""
    collars, stabiliser = ("6.5 in", "2.8125 in"), ("5 ft", "8.25 in", "2.8125 in")
    found = bridged_answer(surveyed(tmp_path, ("30 ft", *collars), stabiliser, ("85 ft", *collars)))
    assert found.buckling is not None
    assert found.buckling[0].met
    assert found.buckling[1].state.certificate.worst < 1e-7
    assert found.alone.state.certificate.passed == (not any("balance missed by" in one for one in found.missed))
    assert found.alone.state.certificate.worst < 1e-5
    assert not found.converged
