"""What errors hold, beside their text."""

from __future__ import annotations

import pytest

import rodwell
from rodwell.problem.problem import Problem


def test_the_old_name_of_a_reason_goes_on_working_and_says_the_new_one() -> None:
    with pytest.raises(rodwell.InputError) as error:
        Problem(-1.0)
    with pytest.warns(DeprecationWarning, match=r"InputError\.problem is now InputError\.reason"):
        assert error.value.problem == error.value.reason
    assert str(error.value) == f"weight = -1.0: {error.value.reason}"
