"""A number in SI units, and in those of the reader: value, error and unit, written in one place."""

from __future__ import annotations

import pytest

from rodwell.quantities.names import SI_UNITS
from rodwell.quantities.scales import Scales
from rodwell.quantities.units import System
from rodwell.quantities.value import Peak, Value

DRILL_STRING = Scales(length=30.0, stiffness=9.8e5)


@pytest.mark.parametrize(
    ("dimension", "factor"),
    [
        ("1", 1.0), ("length", 30.0), ("curvature", 1.0 / 30.0), ("force", 9.8e5 / 900.0),
        ("force_per_length", 9.8e5 / 27e3), ("moment", 9.8e5 / 30.0), ("energy", 9.8e5 / 30.0),
        ("stress", 9.8e5 / 81e4),
    ],
)  # fmt: skip
def test_si(dimension: str, factor: float) -> None:
    data = DRILL_STRING.si(Value(-2.0, 0.25), dimension)
    assert list(data) == ["value", "error", "unit"]
    assert data["value"] == pytest.approx(-2.0 * factor, rel=1e-15)
    assert data["error"] == pytest.approx(0.25 * factor, rel=1e-15)
    assert data["unit"] == SI_UNITS[dimension]


def test_a_peak_is_written_without_its_place() -> None:
    assert DRILL_STRING.si(Peak(2.0, 0.1, 0.3), "length") == {"value": 60.0, "error": 3.0, "unit": "m"}


def test_units_of_the_reader() -> None:
    scales = Scales(length=30.0, stiffness=9.8e5, system=System("mm"))
    assert scales.shown(Value(2.0, 0.1), "length") == {
        "value": pytest.approx(60e3), "error": pytest.approx(3e3), "unit": "mm",
    }  # fmt: skip
    assert scales.si(Value(2.0, 0.1), "length") == DRILL_STRING.si(Value(2.0, 0.1), "length")


def test_beside_an_error_a_number_has_the_digits_that_this_supports() -> None:
    """One unit of length is 30 m: an error of 0.001 is 3 cm, of 1e-9 less than any digit shown."""
    assert DRILL_STRING.beside_error(Value(1.23456789, 1e-9), "length") == "37.0370 m"
    assert DRILL_STRING.beside_error(Value(1.23456789, 1e-3), "length") == "37.04 m"
    assert DRILL_STRING.beside_error(Value(1.23456789, 0.1), "length") == "37 m"
    assert DRILL_STRING.beside_error(Value(1e-9, 1e-3), "length") == "0 m"
