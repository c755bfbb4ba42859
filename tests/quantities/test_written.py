"""Numbers and units as people write them: understood where they mean one thing, refused with the remedy elsewhere."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell import Case, InputError
from rodwell.quantities.units import in_unit_of, to_si
from rodwell.quantities.written import number_and_rest
from rodwell.studies.sweep.varied import varied_inputs

LBF, FOOT, POUND = 4.4482216152605, 0.3048, 0.45359237


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("1.25 sg", "density", 1250.0),
        ("1.25 SG", "density", 1250.0),
        ("1.25 s.g.", "density", 1250.0),
        ("80 pcf", "density", 80.0 * POUND / FOOT**3),
        ("10 ppg", "density", 10.0 * POUND / (231.0 * 0.0254**3)),
        ("7850 kg/m3", "density", 7850.0),
        ("7.85 g/cc", "density", 7850.0),
        ("19.5 ppf", "force per length", 19.5 * LBF / FOOT),
        ("19.5 lbf/ft", "force per length", 19.5 * LBF / FOOT),
        ("2 klbs/ft", "force per length", 2e3 * LBF / FOOT),
        ("-20 klbs", "force", -20e3 * LBF),
        ("-20 klbf", "force", -20e3 * LBF),
        ("−20 kip", "force", -20e3 * LBF),
        ("3 daN", "force", 30.0),
        ("2 kdaN", "force", 20e3),
        ("10 tf", "force", 98066.5),
        ("10 tonf_us", "force", 20e3 * LBF),
        ("10 tonf_uk", "force", 22.4e3 * LBF),
        ("100 barg", "pressure", 1e7),
        ("100 psig", "pressure", 100.0 * LBF / 0.0254**2),
        ("800 ft-lbf", "moment", 800.0 * LBF * FOOT),
        ("800 ft·lbf", "moment", 800.0 * LBF * FOOT),
        ("800 ft.lbf", "moment", 800.0 * LBF * FOOT),
        ("1.2 kNm", "moment", 1200.0),
        ("1.2 N.m", "moment", 1.2),
        ("10 ft-klbs", "moment", 10e3 * LBF * FOOT),
        ("9.8e5 Nm2", "bending stiffness", 9.8e5),
        ("200 N/mm2", "stress", 2e8),
        ("30 Msi", "stress", 30e6 * LBF / 0.0254**2),
        ("8.5 in.", "length", 8.5 * 0.0254),
        ('8.5"', "length", 8.5 * 0.0254),
        ("5 mil", "length", 5 * 25.4e-6),
        ("6 Fr", "length", 2e-3),
    ],
)
def test_units_of_the_trade(text: str, kind: str, value: float) -> None:
    assert to_si(text, kind) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "kind", "meant"),
    [
        ("30 KN", "force", "kN"),
        ("30 Lbf", "force", "lbf"),
        ("30 KLBF", "force", "klbf"),
        ("30 DAN", "force", "daN"),
        ("200 gpa", "stress", "GPa"),
        ("200 GPA", "stress", "GPa"),
        ("200 mpa", "stress", "MPa"),
        ("30e6 PSI", "stress", "psi"),
        ("20 Bar", "pressure", "bar"),
        ("20 BARG", "pressure", "barg"),
        ("30 Ft", "length", "ft"),
        ("30 IN", "length", "in"),
        ("30 M", "length", "m"),
        ("30 MM", "length", "mm"),
        ("90 DEG", "angle", "deg"),
        ("10 PPG", "density", "ppg"),
        ("7850 KG/M3", "density", "kg/m3"),
        ("19.5 LBF/FT", "force per length", "lbf/ft"),
        ("1.2 KNM", "moment", "kN m"),
    ],
)
def test_capitals_get_the_unit_that_was_meant(text: str, kind: str, meant: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"did you mean {meant!r}?")):
        to_si(text, kind)


@pytest.mark.parametrize(
    ("text", "kind", "remedies"),
    [
        ("10 tonf", "force", ["tonf_us", "tonf_uk", "tf"]),
        ("3000 psia", "pressure", ["psig", "14.696"]),
        ("200 bara", "pressure", ["barg", "1.01325"]),
        ("0.52 psi/ft", "density", ["1199 kg/m^3"]),
        ("19.5 lb/ft", "force per length", ["lbf, not lb"]),
        ("2 7/8 in", "length", ['"2.875 in"']),
        ("2-7/8 in", "length", ['"2.875 in"']),
    ],
)
def test_what_means_several_things_is_refused_with_the_remedy(text: str, kind: str, remedies: list[str]) -> None:
    with pytest.raises(ValueError, match="for example") as caught:
        to_si(text, kind)
    for remedy in remedies:
        assert remedy in str(caught.value)


SEPARATORS = [" ", "\u00a0", "\u2009", "\u202f", "'", "’", "_"]


@given(st.integers(1000, 10**12), st.sampled_from(SEPARATORS), st.sampled_from(["", "-", "+"]))
def test_thousands_that_mean_one_thing_are_understood(number: int, separator: str, sign: str) -> None:
    text = f"{number:,}".replace(",", separator)
    value = -number if sign == "-" else number
    assert to_si(f"{sign}{text} N", "force") == value
    assert to_si(f"{sign}{text}.5 N", "force") == pytest.approx(value + (-0.5 if sign == "-" else 0.5), rel=1e-15)


@given(st.integers(10**6, 10**12))
def test_two_commas_separate_thousands(number: int) -> None:
    assert to_si(f"{number:,} N", "force") == number
    assert to_si(f"{number:,}.25 N", "force") == number + 0.25


@given(st.integers(0, 999), st.text("0123456789", min_size=1, max_size=4), st.sampled_from(["", "-", "−"]))
def test_one_comma_is_never_guessed_and_its_remedies_are_right(whole: int, after: str, sign: str) -> None:
    """35,000 is thirty-five thousand or thirty-five: both are offered, and each is read as what it says."""
    with pytest.raises(ValueError, match="for example") as caught:
        to_si(f"{sign}{whole},{after} N", "force")
    message = str(caught.value).partition("; for example")[0]
    offered = [to_si(text, "force") for text in re.findall(r'"([^"]+)"', message)]
    minus = -1.0 if sign else 1.0
    expected = [minus * float(f"{whole}.{after}")]
    if len(after) == 3 and whole:
        expected.insert(0, minus * float(f"{whole}{after}"))
    assert offered == pytest.approx(expected)


@pytest.mark.parametrize(("text", "right"), [("1.234,5 m", 1234.5), ("1.234.567 m", 1234567.0)])
def test_continental_numbers_get_the_right_remedy(text: str, right: float) -> None:
    with pytest.raises(ValueError, match="for example") as caught:
        to_si(text, "length")
    assert to_si(re.findall(r'"([^"]+)"', str(caught.value))[0], "length") == right


def test_every_reader_of_numbers_reads_the_same() -> None:
    """Ranges and uncertainties: thousands are understood, a single comma is refused with what to write."""
    (found,) = varied_inputs({"rod": {"length": "1 000..3 000 m in 3"}})
    assert found.numbers == (1000.0, 2000.0, 3000.0)
    with pytest.raises(InputError, match=r'"1000 m" if the comma separates thousands'):
        varied_inputs({"rod": {"length": "1,000 m..3,000 m in 3"}})
    data = {
        "rod": {"length": "3 000 cm ± 1 %", "bending_stiffness": "1e6 Nm2", "weight_per_length": "300 N/m"},
        "hole": {"clearance": "30 cm", "angle_from_vertical": "90 deg"},
    }
    assert Case.from_dict(data).rod is not None
    assert Case.from_dict(data).rod.length == 30.0  # type: ignore[union-attr]
    data["rod"]["length"] = "3,000 cm ± 1 %"
    with pytest.raises(InputError, match=r'"3000 cm" if the comma'):
        Case.from_dict(data)


def test_units_of_ranges_are_those_of_the_trade() -> None:
    assert in_unit_of(1.0, "deg/30 m", "deg/100 ft") == pytest.approx(30.48 / 30.0)
    assert in_unit_of(1.0, "sg", "kg/m3") == pytest.approx(1000.0)
    assert in_unit_of(1.0, "kNm", "ft-lbf") == pytest.approx(1000.0 / (LBF * FOOT))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("deg/100 ft", math.radians(1.0) / 30.48),
        ("deg/100ft", math.radians(1.0) / 30.48),
        ("deg/30 m", math.radians(1.0) / 30.0),
        ("°/30m", math.radians(1.0) / 30.0),
        ("deg/10 m", math.radians(1.0) / 10.0),
        ("deg/ft", math.radians(1.0) / 0.3048),
    ],
)
def test_degrees_per_lengths_of_the_field(text: str, value: float) -> None:
    assert in_unit_of(1.0, text, "rad/m") == pytest.approx(value, rel=1e-12)
    with pytest.raises(ValueError, match="do not go together"):
        in_unit_of(1.0, "deg/95 ft", "rad/m")


def test_long_text_is_read_in_no_time() -> None:
    assert number_and_rest("1" + " " * 100_000 + "m") is None
    for text in (" " * 100_000, "1 m" + "*" * 5000, "1" + " 000" * 5000, "1," * 5000, "(" * 5000):
        with pytest.raises(ValueError, match="for example"):
            to_si(text, "length")
