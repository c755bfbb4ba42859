"""Sections in a line: what is written is read again."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell.errors import InputError
from rodwell.problem.sections import checked_sections, sections_from, sections_text

number = st.floats(0.1, 10.0)
ratio = number | st.lists(number, min_size=2, max_size=2).map(tuple)


@given(st.lists(st.tuples(ratio, ratio, number, ratio), min_size=1, max_size=4))
def test_what_is_written_is_read_again(ratios: list[tuple[float | tuple[float, ...], ...]]) -> None:
    sections = checked_sections([(1.0 / len(ratios), *one) for one in ratios])
    assert checked_sections(sections_from(sections_text(sections))) == sections


def test_ratios_of_one_are_left_out_and_what_is_no_number_is_named() -> None:
    assert sections_text([(0.6, 1.0, 1.0, 1.0, 1.0), (0.4, (1.0, 0.3), 1.0, 1.0, 1.0)]) == "0.6:1,0.4:1/0.3"
    with pytest.raises(InputError, match=r"--sections, section 2 = '0\.5:soft'"):
        sections_from("0.5:1,0.5:soft", "--sections")
