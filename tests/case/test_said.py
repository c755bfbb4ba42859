"""Messages in the units that were written, and what is said of gauge pressures."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from rodwell import Case, InputError
from rodwell.case.checks.said import gauge_facts, in_written_units

FIELD: dict[str, Any] = {
    "rod": {"outer_diameter": "5 in", "inner_diameter": "4.276 in", "length": "300 ft", "material": "steel"},
    "hole": {"diameter": "8.5 in", "angle_from_vertical": "30 deg"},
}


def refused(**changes: str) -> str:
    data = copy.deepcopy(FIELD)
    for key, value in changes.items():
        section, name = key.split("__")
        data.setdefault(section, {})[name] = value
    with pytest.raises(InputError) as caught:
        Case.from_dict(data)
    return str(caught.value)


@pytest.mark.parametrize(
    ("changes", "phrase"),
    [
        ({"hole__diameter": "4.9 in"}, "above the rod's outer diameter of 0.127 m (5 in)"),
        ({"rod__inner_diameter": "5.5 in"}, "below the outer diameter of 0.127 m (5 in)"),
        ({"rod__length": "2 in", "hole__diameter": "12 in"}, "the rod's length of 0.0508 m (2 in)"),
        (
            {"cylinder__outer_diameter": "8 in", "cylinder__yield_strength": "36 ksi"},
            "inner diameter of 0.2159 m (8.5 in)",
        ),
    ],
)
def test_messages_have_the_units_that_were_written(changes: dict[str, str], phrase: str) -> None:
    assert phrase in refused(**changes)


@pytest.mark.parametrize(
    ("reason", "written", "said"),
    [
        ("below 0.1 m: no", "4 in", "below 0.1 m (3.93701 in): no"),
        ("below 0.1 m", "4 m", "below 0.1 m"),
        ("below 0.1 m", 4.0, "below 0.1 m"),
        ("of 300 N/m becomes -3 N/m", "9 ppg", "of 300 N/m (20.5565 lbf/ft) becomes -3 N/m (−0.205565 lbf/ft)"),
        ("of 300 N/m and 9 m/s", "9 ppg", "of 300 N/m (20.5565 lbf/ft) and 9 m/s"),
        ("of 2 m", "9 ppg", "of 2 m (6.56168 ft)"),
        ("of 2 m", "9 sg", "of 2 m"),
    ],
)
def test_only_lengths_and_weights_are_said_twice(reason: str, written: object, said: str) -> None:
    assert in_written_units(reason, written) == said


def test_gauge_pressures_are_said_to_be_gauge() -> None:
    fact = gauge_facts({"pressure": {"inside": "2500 psig", "outside": "1500 psi"}})
    assert "counted from the atmosphere" in str(fact[0].value)
    assert "2500 psig" in fact[0].note
    assert gauge_facts({"pressure": {"inside": "2500 psi"}}) == gauge_facts({}) == ()
    data = FIELD | {"pressure": {"inside": "2500 psig"}}
    same = FIELD | {"pressure": {"inside": "2500 psi"}}
    assert Case.from_dict(data).problem == Case.from_dict(same).problem
    assert [f.label for f in Case.from_dict(data).facts if f.label == "pressures"] == ["pressures"]
