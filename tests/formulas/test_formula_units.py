"""Every formula of practice: its units and dimension, what the registry says of it, where it holds."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from steel_case import STEEL

from rodwell.errors import InputError
from rodwell.formulas import FORMULAS, LEFT_OUT, SYMBOLS, FormulaInputs, helix

VALUES = {"alpha": 63.0, "n": 2.0, "m": 2.0, "mu": 0.2, "mud": 9.0, "beta_0": 0.3, "F": 300.0, "F_1": 200.0,
          "F_2": 300.0, "F_p": 100.0, "x": 0.1, "build": 0.3, "turn": 0.2, "B": 2.0, "w": 40.0, "r": 0.03, "L": 3.0,
          "p": 0.7, "T": 1.5, "D": 0.02, "I": 1e-3, "A": 0.04, "A_i": 0.1, "A_o": 0.2}  # fmt: skip


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_units(force: float, length: float) -> None:
    """In other units of force and length every formula's value changes as its dimension says; Dellinger's nearly."""
    for formula in FORMULAS.values():
        base = {name: VALUES.get(name, 1.3) for name in formula.takes}
        powers = {name: SYMBOLS[name][:2] for name in base}
        other = {name: v * 10.0 ** (force * powers[name][0] + length * powers[name][1]) for name, v in base.items()}
        scale = force * formula.dimension[0] + length * (formula.dimension[1] + formula.defect)
        expected = formula.function(**base) * 10.0**scale
        assert formula.function(**other) == pytest.approx(expected, rel=1e-9), formula.key


def test_units_with_pint() -> None:
    """Each formula takes mixed field units and gives a quantity of its own dimension and size."""
    import pint

    ureg = pint.UnitRegistry()
    unit = {"force": ("N", "lbf"), "length": ("m", "inch")}
    for formula in FORMULAS.values():
        base = {name: VALUES.get(name, 1.3) for name in formula.takes}
        mixed = {}
        for i, (name, value) in enumerate(base.items()):
            powers = SYMBOLS[name][:2]
            si = ureg.Quantity(value, f"{unit['force'][0]}**{powers[0]} * {unit['length'][0]}**{powers[1]}")
            if name == "alpha":
                si = ureg.Quantity(value, "degree")
            elif powers == (0, 0):
                mixed[name] = value
                continue
            field = f"{unit['force'][i % 2]}**{powers[0]} * {unit['length'][i % 2]}**{powers[1]}"
            mixed[name] = si if name == "alpha" else si.to(field)
        found = ureg.Quantity(formula.function(**mixed)).to_base_units()
        want = ureg.Quantity(1.0, f"N**{formula.dimension[0]} * m**{formula.dimension[1] + formula.defect}")
        powers = {name: round(power, 9) for name, power in found.dimensionality.items()}
        assert powers == {name: round(power, 9) for name, power in want.dimensionality.items()}, formula.key
        assert found.magnitude == pytest.approx(formula.function(**base), rel=1e-9), formula.key


def test_registry_is_complete_and_says_what_it_must() -> None:
    for key, formula in FORMULAS.items():
        assert formula.key == key
        assert all((formula.name, formula.text, formula.source, formula.evidence, formula.holds))
        assert set(formula.takes) <= set(SYMBOLS)
        assert (formula.place is not None) == (formula.kind in ("sinusoidal", "helical"))
        assert formula.text.splitlines()[0] in formula.function.__doc__
    assert FORMULAS["dellinger"].defect == 0.001
    assert all(item.reason for item in LEFT_OUT)
    assert "memory" in LEFT_OUT[0].reason


def test_validity() -> None:
    long = FormulaInputs(**STEEL, L=1000.0)
    assert FORMULAS["dawson_paslay"].violations(long) == []
    assert "not long" in FORMULAS["dawson_paslay"].violations(FormulaInputs(**STEEL, L=149.0))[0]
    assert FORMULAS["dawson_paslay"].violations(FormulaInputs(**STEEL, L=151.0)) == []
    steep = FormulaInputs(**{**STEEL, "alpha": 45.0}, L=1000.0)
    assert any("axial weight" in reason for reason in FORMULAS["dawson_paslay"].violations(steep))
    assert any("horizontal" in reason for reason in FORMULAS["qiu"].violations(steep))
    on_top = FormulaInputs(**STEEL, L=1000.0, pressed=False)
    assert any("press" in reason for reason in FORMULAS["dawson_paslay"].violations(on_top))
    assert FORMULAS["dellinger"].violations(FormulaInputs(**{**STEEL, "alpha": 10.0}, L=1000.0)) == [
        "near vertical: α = 10°"
    ]
    pinned = FormulaInputs(1.0, 512.0, 0.0, 0.01, 1.0, ends=("pinned", "pinned"))
    assert FORMULAS["lubinski"].violations(pinned) == []
    assert (
        "20"
        in FORMULAS["lubinski"].violations(FormulaInputs(1.0, 8000.0, 0.0, 0.01, 1.0, ends=("pinned", "pinned")))[0]
    )
    assert FORMULAS["euler_clamped"].violations(FormulaInputs(1.0, 0.0, 0.0, 0.01, 1.0)) == []
    frictional = FormulaInputs(**STEEL, L=1000.0, more=(("mu", 0.5),))
    assert "0.3" in FORMULAS["gao_miska"].violations(frictional)[0]
    strong = FormulaInputs(1.0, 0.0, 90.0, 1.0, 1.0, more=(("F", 0.8),))
    assert "no weightless helix" in FORMULAS["helical_contact"].violations(strong)[0]


def test_bad_input() -> None:
    with pytest.raises(InputError, match="below it the pipe is straight"):
        helix.mitchell_lateral_rate(1.0, 1.0, 2.0)
