"""Sentences print no digit that the error does not allow."""

from __future__ import annotations

import math
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import rodwell
from rodwell.answers.result.key_number import KeyNumber
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.wording import forces_of, place_text, quantity
from rodwell.quantities.text import amount, certain, percent, supported
from rodwell.quantities.units import System
from rodwell.quantities.value import Value

EXAMPLE = Path(__file__).parents[2] / "examples" / "drill-string.toml"
CASE = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}


@given(
    st.floats(1e-9, 1e9), st.sampled_from([1.0, -1.0]), st.floats(1e-12, 10.0), st.integers(1, 8)
)  # fmt: skip
def test_digits_shown_hide_more_than_the_error(size: float, sign: float, relative: float, digits: int) -> None:
    value, error = sign * size, size * relative
    count = certain(Value(value, error), digits)
    assert 0 <= count <= digits
    for shown, allowed in ((count, True), (count + 1, False)):  # by decimal arithmetic, not by logarithms
        if shown == 0 or shown > digits:
            continue
        unit = Decimal(10) ** (Decimal(size).adjusted() - shown + 1)
        assert (unit / 2 >= Decimal(error) * (1 - Decimal("1e-8"))) == allowed


def test_numbers_as_text() -> None:
    assert amount(Value(123.456, 0.0), 5) == "123.46"
    assert amount(Value(-123.456, 0.3)) == "−123"
    assert amount(Value(-123.456, 0.6)) == "−120"
    assert amount(Value(1807450.007, 1e-6), 6) == "1\u202f807\u202f450"  # no exponent
    assert amount(Value(0.3, 0.7)) == "0.3 ± 0.7"
    assert percent(Value(0.12006, 3e-12)) == "12.0 %"
    assert percent(Value(0.12346, 2e-4)) == "12.3 %"
    assert percent(Value(0.12346, 2e-3)) == "12 %"
    assert quantity(System("si"), Value(139582.0, 3.0), "force", 6) == "139.58 kN"
    assert quantity(System("field"), Value(4448.2216, 44.0), "force") == "1000 lbf"
    assert quantity(System("si"), Value(20.0, 30.0), "force") == "20 N ± 30 N"


@given(
    st.floats(1e-12, 1e12), st.sampled_from([1.0, -1.0]), st.floats(1e-15, 10.0), st.integers(min_value=1, max_value=8)
)  # fmt: skip
def test_a_table_shows_a_digit_in_doubt_which_a_sentence_does_not(
    size: float, sign: float, relative: float, digits: int
) -> None:
    """The last digit in a table stands where the error's first does; no digit of a sentence is in doubt."""
    number = Value(sign * size, size * relative)
    in_sentence, in_table = certain(number, digits), supported(number, digits)
    assert in_sentence <= in_table <= min(digits, in_sentence + 2)
    if 0 < in_table < digits:
        place = 10.0 ** (math.floor(math.log10(size)) - in_table + 1)
        assert (1.0 - 1e-9) * place <= number.error < (10.0 + 1e-8) * place


def test_digits_without_an_error_or_with_none_that_is_finite() -> None:
    for rule in (certain, supported):
        assert rule(Value(123.456), 5) == 5
        assert rule(Value(0.0, 0.1), 5) == 5
        assert rule(Value(1.0, float("inf")), 5) == 0


def test_tables_keep_one_digit_in_doubt_and_no_more() -> None:
    case = rodwell.Case.from_dict(CASE)
    unit = case.scales.factor("force")
    assert KeyNumber("f", "f", Value(-139582.4 / unit, 20.0 / unit), "force", 1.0).text(case) == "−139.58 kN"
    assert KeyNumber("f", "f", Value(1e-56, 3e-47), "force", 1.0).text(case) == "0 N"


def test_sentences_follow_the_errors() -> None:
    found = rodwell.answer(rodwell.Case.read(EXAMPLE))
    text = " ".join(sentences(found))
    assert "reaches 124.6 kN;" in text
    assert "(12.0 %)" in text  # (127.9595 − 114.2430)/114.2430 = 0.12006
    first, second = found.critical[:2]
    first = replace(first, load=Value(first.force, 0.3))
    second = replace(second, load=Value(first.force - 2.0, second.error))
    rough = replace(found, critical=(first, second, *found.critical[2:]))
    text = " ".join(sentences(rough))
    assert "reaches 125 kN;" in text  # ± 0.3 B/L² is ± 0.33 kN
    assert "within 1.8 ± 0.3 %" not in text
    assert "follows within 2 %" in text  # 1.75 % ± 0.26 %
    assert "into about 2 half waves" in text  # the shape is known to √(0.3/2) only
    assert forces_of(found.case).load(Value(-127.9595, 0.02)) == "139.6 kN of compression"
    assert place_text(found.case, Value(0.32384, 2e-4)) == "9.7 m from the end s = 0"  # ± 0.006 m


def test_places_of_lift_off() -> None:
    found = rodwell.answer(rodwell.Case.from_dict({"dimensionless": {"weight": 15.0, "alpha": 60.0}}))
    assert found.lift_off is not None
    (place,) = found.lift_off.s
    assert f"it lifts off at s/L = {place:.4g}" in " ".join(sentences(found)).replace("there it", "it")


@pytest.mark.parametrize("error", [1e-9, 0.02, 0.5])
def test_share_of_the_window(error: float) -> None:
    window = rodwell.answer(rodwell.Case.from_dict(CASE)).assessment.window
    window = replace(window, buckling=Value(window.buckling.value, error))
    part, spread = window.share
    low, high = window.buckling.value - error, window.buckling.value + error  # both ways to be wrong
    ends = [(b - window.end.force) / -b for b in (low, high)]
    assert max(abs(end - part) for end in ends) <= 1.02 * spread + 1e-12
