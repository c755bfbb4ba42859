"""One way to write numbers: digits, thousands, powers of ten, signs; and what is written can be read."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell.quantities.text import SEPARATOR, error_digit, number_text, plain, readable, signed, with_error
from rodwell.quantities.value import Value
from rodwell.quantities.written import number_and_rest


@pytest.mark.parametrize(
    ("number", "digits", "text", "with_zeros"),
    [
        (-124.62, 4, "−124.6", "−124.6"),
        (34227.3, 4, "34_230", "34_230"),
        (34227.3, 6, "34_227.3", "34_227.3"),
        (9999.6, 4, "10_000", "10_000"),
        (1234.5, 4, "1234", "1234"),  # four digits stand together; half to even
        (30.0, 6, "30", "30.0000"),
        (0.12, 3, "0.12", "0.120"),
        (6.3948e-5, 5, "6.3948 × 10⁻⁵", "6.3948 × 10⁻⁵"),
        (2.165381487e9, 4, "2.165 × 10⁹", "2.165 × 10⁹"),  # no digits are made up
        (2.165381487e9, 10, "2_165_381_487", "2_165_381_487"),
        (0.0, 4, "0", "0"),
    ],
)
def test_numbers(number: float, digits: int, text: str, with_zeros: str) -> None:
    assert plain(number, digits) == text.replace("_", SEPARATOR)
    assert plain(number, digits, zeros=True) == with_zeros.replace("_", SEPARATOR)


@given(st.floats(-1e12, 1e12), st.integers(1, 12), st.booleans())
def test_what_is_written_is_read_again(number: float, digits: int, zeros: bool) -> None:
    text = plain(number, digits, zeros=zeros)
    read = number_and_rest(text)
    assert read is not None
    assert read[1] == ""
    assert read[0] == pytest.approx(number, rel=0.51 * 10.0 ** (1 - digits), abs=1e-300)
    assert not re.search(r"e|-|\d{5}(?!\d*$)(?=.*\.)", text) or "." in text.partition(".")[0]


def test_signs_errors_and_prefixes() -> None:
    assert signed(111.5) == "+111.5"
    assert signed(-111.5) == "−111.5"
    assert error_digit(1.2e-11) == "1 × 10⁻¹¹"
    assert with_error(Value(-111.23344021, 2e-8)) == "−111.2334402 ± 2 × 10⁻⁸"  # ten digits at most
    assert with_error(Value(-400.0)) == "−400"  # exact: where a branch was asked to end
    assert number_text(Value(1.5, 2e-3)) == "1.500"  # a zero that is known
    assert readable(6.39e-5, "N") == "63.9 µN"
    assert readable(999.99999, "N") == "1 kN"  # the prefix of what is written
    assert readable(12000.0, "N·m") == "12 kN·m"
