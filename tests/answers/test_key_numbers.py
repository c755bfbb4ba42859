"""Key numbers of an answer: what each of them is, and the old name of all of them."""

from __future__ import annotations

from pathlib import Path

import pytest

import rodwell
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.key_number import KeyNumber
from rodwell.quantities.value import Value

CASE = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}
BARE = rodwell.Case.from_dict({"dimensionless": {"weight": 15.0, "alpha": 90.0}})


@pytest.fixture(scope="module")
def answer() -> Answer:
    return rodwell.answer(BARE)


def test_a_key_number_is_a_value_with_what_it_is() -> None:
    case = rodwell.Case.from_dict(CASE)
    assert case.scales is not None
    key = KeyNumber("push", "Push", Value(-3.0, 0.5), "force", 10.0, "at the top")
    assert (key.value, key.error) == tuple(key.number)
    unit = case.scales.factor("force")
    assert key.physical(case) == (pytest.approx(-3.0 * unit), pytest.approx(0.5 * unit), "N")
    assert key.as_dict(case) == {
        "label": "Push", "value": -3.0, "error": 0.5, "unit": "B/L^2", "si": case.scales.si(key.number, "force"),
        "note": "at the top",
    }  # fmt: skip
    assert set(key.as_dict(case.in_units("field"))) == {"label", "value", "error", "unit", "si", "field", "note"}
    assert key.physical(BARE) is None
    assert set(key.as_dict(BARE)) == {"label", "value", "error", "unit", "note"}
    assert key.text(BARE) == ""


def test_the_old_name_goes_on_working_and_says_the_new_one(answer: Answer) -> None:
    with pytest.warns(DeprecationWarning, match=r"Answer\.figures is now Answer\.key_numbers") as told:
        assert answer.figures is answer.key_numbers
    assert Path(told[0].filename) == Path(__file__)  # the line that uses the old name, not that of the library


def test_names_in_files_stay(answer: Answer) -> None:
    data = answer.as_dict()["figures"]
    assert list(data) == list(answer.key_numbers)
    assert data["lift_off_load"]["value"] == answer.key_numbers["lift_off_load"].value


def test_one_number_that_is_not_known_well_enough_is_told(answer: Answer) -> None:
    assert answer.converged
    numbers = answer.key_numbers
    key = numbers["end_shear"]
    limit = answer.case.rtol * key.scale
    for error, converged in ((0.999 * limit, True), (1.001 * limit, False)):
        rough = Answer(answer.case, answer.critical, answer.branches, answer.until)
        changed = KeyNumber(key.name, key.label, Value(key.value, error), key.dimension, key.scale)
        rough.__dict__["key_numbers"] = numbers | {"end_shear": changed}
        assert rough.converged is converged
