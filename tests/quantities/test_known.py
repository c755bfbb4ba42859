"""Units that are known without the registry are what the registry says they are."""

from __future__ import annotations

import pytest

from rodwell.quantities import units
from rodwell.quantities.known import _NAMES, known
from rodwell.quantities.units import KINDS, to_si


@pytest.mark.parametrize("name", _NAMES)
def test_a_known_unit_is_that_of_the_registry(name: str) -> None:
    one = _NAMES[name]
    quantity = units._registry().Quantity(1.0, name).to_base_units()
    assert one.size == pytest.approx(quantity.magnitude, rel=1e-15)
    powers = {str(unit): power for unit, power in quantity.unit_items()}
    expected = zip(("meter", "kilogram", "second", "radian"), one.powers, strict=True)
    assert powers == {unit: power for unit, power in expected if power}


@pytest.mark.parametrize(
    ("text", "kind"),
    [("19.5 lbf/ft", "force per length"), ("7800 kg/m^3", "density"), ("800 ft-lbf", "moment"), ("1.2 kN m", "moment"),
     ("3 deg/30 m", "curvature"), ("9.8e5 N·m²", "bending stiffness"), ("6 Fr", "length"), ("30 m/h", "speed")],
)  # fmt: skip
def test_products_of_known_units_need_no_registry(text: str, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    number, unit = units._split(text, "")
    expected = units._by_registry(number, units.plain_unit(unit, kind), unit, kind)
    monkeypatch.setattr(units, "_registry", None)
    assert to_si(text, kind) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize("unit", ["N/m*s", "m/s/s", "N/", "/m", "N^m", "m^-2", "(N)", "", "furlong", "m+m", "2 m"])
def test_any_other_text_is_left_to_the_registry(unit: str) -> None:
    assert known(unit) is None


def test_a_known_unit_of_another_kind_is_refused() -> None:
    for kind in set(KINDS) - {"length"}:
        with pytest.raises(ValueError, match="must be"):
            to_si("3 m", kind)
