"""Whatever a case holds, it is a case or an error says why: random keys, values, units."""

from __future__ import annotations

import copy
import math
from typing import Any

from bad_cases import INF, NAN, PHYSICAL, PLAIN, changed
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rodwell.case.case import SECTIONS, Case, CaseError
from rodwell.errors import RodwellError
from rodwell.quantities.units import KINDS, to_si

# Fuzzing: whatever comes in, a result or an error of our own comes out.

NAMES = sorted({key for model in SECTIONS.values() for key in model.model_fields})
NUMBERS = st.one_of(
    st.floats(min_value=1e-30, max_value=1e30),
    st.floats(min_value=-1e30, max_value=-1e-30),
    st.integers(min_value=-(10**30), max_value=10**30),
    st.sampled_from([0.0, -0.0, NAN, INF, -INF, 1, 0, -1, 90, 0.5]),
)
UNIT_NAMES = st.sampled_from([
    "m", "cm", "in", "ft", "deg", "rad", "N", "kN", "lbf", "lb", "kg", "N/m", "lbf/ft", "N m", "ft lbf", "Pa", "GPa",
    "psi", "kg/m^3", "lb/gal", "N m^2", "m/s^2", "ppg", "degC", "dB", "%", "", "m m", "/m", "m^", "s", "µm", "°",
])  # fmt: skip
QUANTITIES = st.builds(lambda number, unit: f"{number} {unit}", NUMBERS, UNIT_NAMES)
TEXTS = st.text(max_size=12).filter(lambda text: "*" not in text and "^" not in text)
VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), NUMBERS, QUANTITIES, TEXTS, st.binary(max_size=4), st.dates()),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(TEXTS, inner, max_size=3)),
    max_leaves=4,
)
SECTION = st.dictionaries(st.one_of(st.sampled_from(NAMES), TEXTS), VALUES, max_size=5)
ANYTHING = st.dictionaries(
    st.one_of(st.sampled_from([*SECTIONS, "title"]), TEXTS), st.one_of(SECTION, VALUES), max_size=4
)


def makes_a_case_or_says_why(data: dict[str, Any]) -> None:
    refused = None
    try:
        case = Case.from_dict(data)
    except RodwellError as problem:
        refused = problem
    if refused is not None:
        assert isinstance(refused, CaseError)
        assert all(what for _, _, what in refused.problems)
        assert str(refused).startswith("case: ")
        assert len(str(refused)) > len("case: ") + 10
        return
    numbers = (case.problem.weight, case.problem.alpha, case.problem.clearance, case.problem.poisson)
    assert all(math.isfinite(number) for number in (*numbers, case.problem.twist, case.until or 0.0, case.rtol))
    assert 1 <= case.modes <= 12


@given(ANYTHING)
@settings(max_examples=100, suppress_health_check=[HealthCheck.too_slow])
def test_any_dictionary(data: dict[str, Any]) -> None:
    makes_a_case_or_says_why(data)


@given(st.sampled_from([PHYSICAL, PLAIN]), st.sampled_from(list(SECTIONS)), st.sampled_from(NAMES), VALUES)
@settings(max_examples=300, suppress_health_check=[HealthCheck.too_slow])
def test_one_value_changed(base: dict[str, Any], section: str, name: str, value: Any) -> None:
    makes_a_case_or_says_why(changed(base, **{f"{section}__{name}": value}))


RIGHT_UNITS = {
    "length": ["m", "in"], "outer_diameter": ["m", "cm"], "inner_diameter": ["m"], "youngs_modulus": ["Pa", "psi"],
    "density": ["kg/m^3"], "diameter": ["m", "ft"], "angle_from_vertical": ["deg", "rad"], "gravity": ["m/s^2"],
}  # fmt: skip


@given(st.data())
@settings(max_examples=200, suppress_health_check=[HealthCheck.too_slow])
def test_right_units_and_any_number(data: st.DataObject) -> None:
    given_case = copy.deepcopy(PHYSICAL)
    for name in data.draw(st.lists(st.sampled_from(sorted(RIGHT_UNITS)), max_size=4, unique=True)):
        section = "hole" if name in SECTIONS["hole"].model_fields else "rod"
        given_case[section][name] = f"{data.draw(NUMBERS)} {data.draw(st.sampled_from(RIGHT_UNITS[name]))}"
    makes_a_case_or_says_why(given_case)


@given(st.one_of(VALUES, QUANTITIES, TEXTS), st.sampled_from(sorted(KINDS)))
@settings(max_examples=400, suppress_health_check=[HealthCheck.too_slow])
def test_any_quantity(value: object, kind: str) -> None:
    refused = None
    try:
        number = to_si(value, kind)
    except ValueError as problem:
        refused = problem
    if refused is not None:
        assert type(refused) is ValueError
        assert len(str(refused)) > 10
        return
    assert isinstance(value, str)
    assert math.isfinite(number)
