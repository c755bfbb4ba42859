"""Parameter studies: reading lists and ranges, points against single cases, worst cases, points that fail."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from varied import string

import rodwell
from rodwell import InputError
from rodwell.plots.study import plot_study
from rodwell.studies.sweep.plain import study_dict
from rodwell.studies.sweep.study import Study
from rodwell.studies.sweep.tables import sentences, study_table
from rodwell.studies.sweep.varied import varied_inputs
from rodwell.studies.varied import MOST_POINTS


@pytest.mark.parametrize(
    ("written", "numbers", "unit", "second"),
    [
        ("30..90 deg in 13", [30 + 5 * i for i in range(13)], "deg", "35.0 deg"),
        ("30 deg .. 90 deg in 3", [30, 60, 90], "deg", "60.0 deg"),
        ("90..30 deg in 3", [90, 60, 30], "deg", "60.0 deg"),
        ("8..12 in in 3", [8, 10, 12], "in", "10.0 in"),
        ("20 cm..0.4 m in 2", [0.2, 0.4], "m", "0.4 m"),
        ("-2e3..-1e3 N in 2", [-2000, -1000], "N", "-1000.0 N"),
        ("10..40 in 7", [10, 15, 20, 25, 30, 35, 40], "", 15.0),
        (".1...3 in 3", [0.1, 0.2, 0.3], "", 0.2),
        (["30 deg", "45 deg"], [30, 45], "deg", "45 deg"),
        (["1 m", "50 cm"], [1, 0.5], "m", "50 cm"),
        ([10, 20.5], [10, 20.5], "", 20.5),
    ],
)
def test_lists_and_ranges(written: Any, numbers: list[float], unit: str, second: Any) -> None:
    (found,) = varied_inputs({"hole": {"x": written}})
    assert found.numbers == pytest.approx(numbers, rel=1e-12)
    assert (found.name, found.unit, found.written) == ("hole.x", unit, written)
    assert found.values[1] == second


@pytest.mark.parametrize("text", ["../pipes.toml", "5 in", "wait ..", "clamped-clamped", "1.5 m", "a..b"])
def test_texts_that_are_no_ranges(text: str) -> None:
    assert varied_inputs({"rod": {"x": text}}) == ()


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6), st.integers(2, 50))
def test_ranges_are_even_and_include_both_ends(first: float, width: float, count: int) -> None:
    (found,) = varied_inputs({"load": {"twist": f"{first!r}..{first + width!r} N m in {count}"}})
    assert found.numbers is not None
    assert len(found.numbers) == count
    tolerance = 1e-12 * (abs(first) + width)
    assert found.numbers[0] == pytest.approx(first, abs=tolerance)
    assert found.numbers[-1] == pytest.approx(first + width, abs=tolerance)
    steps = [b - a for a, b in zip(found.numbers[:-1], found.numbers[1:], strict=True)]
    assert steps == pytest.approx([width / (count - 1)] * (count - 1), abs=2 * tolerance)


@pytest.mark.parametrize(
    ("changes", "names"),
    [
        ({}, "no input that varies"),
        ({"hole__diameter": "60..80 cm"}, "is not a range"),
        ({"hole__diameter": "60..80 cm in 1"}, "from 2 to"),
        ({"hole__diameter": "60..60 cm in 3"}, "from one finite value to another"),
        ({"hole__diameter": "60 kg..80 cm in 3"}, "do not go together"),
        ({"hole__diameter": "sixty..80 cm in 3"}, "is not a range"),
        ({"hole__diameter": f"60..80 cm in {MOST_POINTS + 1}"}, f"2 to {MOST_POINTS}"),
        ({"hole__diameter": ["60 cm"]}, "at least two"),
        ({"hole__diameter": []}, "at least two"),
        ({"hole__diameter": [["60 cm", "70 cm"], "80 cm"]}, "single values"),
        ({"hole__diameter": ["60..70 cm in 2", "80 cm"]}, "single values"),
        ({"hole__diameter": ["60 ± 1 cm", "80 cm"]}, "±"),
        ({"hole__diameter": [True, False]}, "single values"),
        ({"analysis__modes": [1, 2]}, "cannot vary"),
        ({"load__until": ["-1 kN", "-2 kN"]}, "cannot vary"),
        ({"load__applied": "-20..-10 kN"}, "is not a range.*list of loads that act"),
        ({"load__applied": "-20..-10 m in 3"}, "must be a force"),
        ({"load__applied": ["-20..-10 kN in 3"], "rod__length": ["20 m", "30 m"]}, "load.applied"),
        ({"rod__length": "20..30 m in 3", "hole__diameter": "60..80 cm in 3", "rod__poisson": [0.2, 0.3]}, "third"),
        ({"rod__length": "20..30 m in 30", "hole__diameter": "60..80 cm in 30"}, "30 × 30 = 900 points"),
        ({"hole__diametre": "60..80 cm in 3"}, "did you mean 'diameter'"),
        ({"hole__diameter": ["60 kg", "80 kg"]}, "must be a length"),
        ({"hole__diameter": "5..9 cm in 3"}, "does not fit"),
    ],
)
def test_what_is_refused(changes: dict[str, Any], names: str) -> None:
    with pytest.raises(InputError, match=names):
        rodwell.study(string(**changes))


@pytest.fixture(scope="module")
def inclined() -> Study:
    """Inclination and length: 2 × 2 points of the paper's string."""
    return rodwell.study(string(rod__length=["20 m", "30 m"], hole__angle_from_vertical="60..90 deg in 2"))


def test_points_are_the_single_cases(inclined: Study) -> None:
    """Every point is what the case alone gives, in SI units of its own."""
    assert [inclined.inputs(point) for point in inclined.points] == [
        "length of the rod 20 m, inclination from the vertical 60°",
        "length of the rod 20 m, inclination from the vertical 90°",
        "length of the rod 30 m, inclination from the vertical 60°",
        "length of the rod 30 m, inclination from the vertical 90°",
    ]
    for point, (length, alpha) in zip(inclined.points, [(20, 60), (20, 90), (30, 60), (30, 90)], strict=True):
        stiffness = 200e9 * math.pi / 64 * 0.1**4
        weight = 7800 * 9.80665 * math.pi / 4 * 0.1**2
        problem = rodwell.Problem(weight * length**3 / stiffness, alpha, 0.3 / length)
        lift = rodwell.follow(problem).lift_off
        assert lift is not None
        unit = stiffness / length**2
        critical = -rodwell.critical_loads(problem, 1)[0].force
        axial = weight * length * math.cos(math.radians(alpha))
        found, bottom = point.compression("critical"), point.compression("critical", bottom=True)
        off = point.compression("lift_off")
        assert found is not None
        assert bottom is not None
        assert off is not None
        assert found.value == pytest.approx(critical * unit, rel=1e-8)
        assert bottom.value == pytest.approx(critical * unit + axial, rel=1e-8, abs=1e-6 * unit)
        assert off.value == pytest.approx(-lift.force * unit, rel=1e-7)
        assert point.places == pytest.approx(lift.s, rel=1e-6)
        assert point.contact is not None
        assert point.contact.value == pytest.approx(lift.solution.wall.contact.value, rel=1e-6)
        assert point.reasons is None
        table = study_table(inclined)
        (at,) = (i for i, title in enumerate(table.columns) if title.startswith("largest contact force"))
        assert table.rows[point.number][at] == pytest.approx(point.contact.value * unit / length, rel=1e-12)


def test_worst_case_is_that_of_physical_forces() -> None:
    """Longer strings buckle at less force in N, although at more in B/L²."""
    result = rodwell.study(string(rod__length=["10 m", "40 m"], hole__angle_from_vertical="90 deg"))
    first, second = (point.critical for point in result.points)
    assert first is not None
    assert second is not None
    assert second.value < first.value  # in B/L², tension positive
    worst = result.worst()
    assert worst is not None
    assert worst.number == 1
    assert "length of the rod 40 m" in sentences(result)[0]


def test_weights_of_the_paper() -> None:
    """Lift-off at w = 15 is −123.1730743 B/L² (theory, section 4, checked by two programs)."""
    result = rodwell.study({"dimensionless": {"weight": [15, 5]}})
    lift = result.points[0].lift_off
    assert lift is not None
    assert lift.value == pytest.approx(-123.1730743, abs=2e-7)
    worst = result.worst("lift_off")
    assert worst is not None
    assert worst.at == (1,)


def test_points_that_fail_say_why() -> None:
    """Beyond 180° there is no case; at 0° lift-off is buckling; the others are computed."""
    result = rodwell.study({"dimensionless": {"weight": 40, "alpha": [0, 45, 190]}})
    vertical, tilted, wrong = result.points
    assert wrong.case is None
    assert wrong.critical is None
    assert "from 0 (vertical) over 90" in (wrong.reasons or {})["case"]
    assert vertical.lift_off is not None
    assert vertical.critical is not None
    assert vertical.lift_off.value == pytest.approx(vertical.critical.value)
    assert vertical.contact is None
    assert "coincides" in (vertical.reasons or {})["contact"]
    assert tilted.reasons is None
    assert result.incomplete == (vertical, wrong)
    assert any("1 of 3 points could not be computed" in line for line in sentences(result))
    row = study_table(result).rows[2]
    assert "must be from 0 (vertical) over 90" in str(row[-1])
    assert None in row
    json.dumps(study_dict(result), allow_nan=False)
    assert len(plot_study(result).axes) == 2


def test_end_conditions_can_vary() -> None:
    result = rodwell.study({"dimensionless": {"weight": 0.0, "ends": ["clamped-clamped", "pinned-pinned"]}})
    loads = [point.critical.value for point in result.points if point.critical is not None]
    assert loads == pytest.approx([-4 * math.pi**2, -(math.pi**2)], rel=1e-8)
    assert result.varied[0].numbers is None
    assert [tick.get_text() for tick in plot_study(result).axes[1].get_xticklabels()] == [
        "clamped-clamped",
        "pinned-pinned",
    ]
