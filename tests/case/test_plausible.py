"""Values that no rod has are stopped, with the range and the unit that was meant; real rods pass."""

from __future__ import annotations

import copy
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell import Case, InputError
from rodwell.case.case import CaseError
from rodwell.case.catalogue import KINDS, package_catalogue
from rodwell.case.checks.plausible import RANGES, likely_units
from rodwell.case.file import read_case
from rodwell.quantities.units import KINDS as QUANTITIES
from rodwell.quantities.units import to_si
from rodwell.studies.sweep.varied import is_study

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
STEEL: dict[str, Any] = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}
GONE = object()


def changed(**changes: Any) -> dict[str, Any]:
    data = copy.deepcopy(STEEL)
    for path, value in changes.items():
        section, _, key = path.partition("__")
        if not key:
            data[section] = value
        elif value is GONE:
            del data[section][key]
        else:
            data.setdefault(section, {})[key] = value
    return data


def refusal(data: dict[str, Any]) -> str:
    """What a case is refused for; nothing if it is taken."""
    try:
        Case.from_dict(data)
    except InputError as error:
        return str(error)
    return ""


GIVEN_STIFFNESS = {"rod__youngs_modulus": GONE}
GIVEN_WEIGHT = {"rod__density": GONE}
CYLINDER = {"outer_diameter": "72 cm", "yield_strength": "250 MPa"}

SLIPS: list[tuple[str, dict[str, Any], str]] = [
    ("rod.youngs_modulus", {"rod__youngs_modulus": "30e6 GPa"}, '"30e6 psi"'),
    ("rod.youngs_modulus", {"rod__youngs_modulus": "30 psi"}, '"30 Mpsi"'),
    ("rod.youngs_modulus", {"rod__youngs_modulus": "200 Pa"}, '"200 GPa"'),
    ("rod.youngs_modulus", {"rod__youngs_modulus": "200e3 GPa"}, '"200e3 MPa"'),
    ("rod.youngs_modulus", {"rod__youngs_modulus": "200 MPa"}, "that of a metal"),
    ("rod.density", {"rod__density": "7850 lb/gal"}, '"7850 kg/m^3"'),
    ("rod.density", {"rod__density": "7.85 kg/m^3"}, '"7.85 g/cm^3"'),
    ("rod.density", {"rod__density": "7850 g/cm^3"}, '"7850 kg/m^3"'),
    ("rod.density", {"rod__density": "65.5 kg/m^3"}, "check both units"),
    ("rod.outer_diameter", {"rod__outer_diameter": "5 m", "hole__diameter": "7.9 m"}, '"5 in"'),
    ("rod.outer_diameter", {"rod__outer_diameter": "12.7 m", "hole__diameter": "70 m"}, '"12.7 cm"'),
    ("rod.length", {"rod__length": "300 km"}, "did you mean"),
    ("hole.diameter", {"hole__diameter": "8.5 m"}, '"8.5 in"'),
    ("hole.diameter", {"rod__outer_diameter": "0.127 mm", "hole__diameter": "216 mm"}, "400 times"),
    ("hole.clearance", {"hole__diameter": GONE, "hole__clearance": "25 m"}, '"25 mm"'),
    ("hole.gravity", {"hole__gravity": "32.2 m/s^2"}, '"32.2 ft/s^2"'),
    ("hole.gravity", {"hole__gravity": "9.81 km/s^2"}, '"9.81 m/s^2"'),
    ("hole.gravity", {"hole__gravity": "0 m/s^2", **GIVEN_WEIGHT, "rod__weight_per_length": "300 N/m"}, '"0 N/m"'),
    ("rod.yield_strength", {"rod__yield_strength": "135 psi"}, "of the modulus"),
    ("rod.yield_strength", {"rod__yield_strength": "135e3 GPa"}, '"135e3 psi"'),
    ("rod.bending_stiffness", {**GIVEN_STIFFNESS, "rod__bending_stiffness": "9.8e11 N m^2"}, "N mm²"),
    ("rod.torsional_stiffness", {"rod__torsional_stiffness": "7.5e11 N m^2"}, "times the bending stiffness"),
    ("rod.torsional_stiffness", {"rod__torsional_stiffness": "7.5e14 N m^2"}, '"7.5e14 N mm^2"'),
    ("rod.weight_per_length", {**GIVEN_WEIGHT, "rod__weight_per_length": "19.5 klbf/ft"}, '"19.5 lbf/ft"'),
    ("rod.weight_per_length", {**GIVEN_WEIGHT, "rod__weight_per_length": "9 kN/m"}, "check its unit and the diameters"),
    ("mud.density", {"mud__density": "1200 lb/gal"}, '"1200 kg/m^3"'),
    ("mud.outside", {"mud__outside": "1200 g/cm^3"}, '"1200 kg/m^3"'),
    ("pressure.outside", {"pressure__outside": "2500 MPa"}, '"2500 psi"'),
    ("load.applied", {"load__applied": "-3500 MN"}, '"-3500 kN"'),
    ("load.applied", {"load__applied": "-35000 klbf"}, "of EA"),
    ("load.until", {"load__until": "-400 MN"}, '"-400 kN"'),
    ("load.twist", {"load__twist": "1e9 N m"}, "torques reach"),
    ("supports.force", {"supports__force": "500 MN"}, '"500 kN"'),
    ("cylinder.outer_diameter", {"cylinder": CYLINDER | {"outer_diameter": "72 m"}}, '"72 cm"'),
    ("cylinder.yield_strength", {"cylinder": CYLINDER | {"yield_strength": "250e3 MPa"}}, '"250e3 psi"'),
]  # fmt: skip


@pytest.mark.parametrize(("key", "changes", "phrase"), SLIPS, ids=[f"{k}-{i}" for i, (k, _, _) in enumerate(SLIPS)])
def test_slips_of_units_are_stopped_and_may_be_let_pass(key: str, changes: dict[str, Any], phrase: str) -> None:
    data = changed(**changes)
    with pytest.raises(CaseError) as caught:
        Case.from_dict(data)
    (message,) = [f"{field}: {what}" for field, _, what in caught.value.problems if field == key]
    assert phrase in message
    assert "plausible = false" in message
    assert "plausible" not in refusal(data | {"plausible": False})  # what does not fit is still refused


@pytest.mark.parametrize("value", ["false", 0, "no"])
def test_plausible_is_true_or_false(value: object) -> None:
    with pytest.raises(InputError, match=r"plausible.*must be true or false"):
        Case.from_dict(STEEL | {"plausible": value})


def test_a_contradiction_stands_before_what_is_not_plausible() -> None:
    with pytest.raises(CaseError) as caught:
        Case.from_dict(changed(hole__diameter="1 km"))
    assert "must be below the rod's length" in str(caught.value)
    assert "not plausible" in str(caught.value)
    assert caught.value.field == "hole.diameter"


RODS: dict[str, dict[str, Any]] = {
    "drill string": STEEL,
    "slickline": changed(rod__length="300 m", rod__outer_diameter="0.108 in", hole__diameter="2.4 in"),
    "leg of a platform": changed(rod__outer_diameter="3.5 m", rod__inner_diameter="3.3 m", hole__diameter="3.6 m"),
    "conductor": changed(rod__outer_diameter="36 in", rod__inner_diameter="34 in", hole__diameter="42 in"),
    "guidewire of nitinol": changed(
        rod__length="300 mm", rod__outer_diameter="0.36 mm", rod__youngs_modulus="60 GPa", rod__density="6450 kg/m^3",
        hole__diameter="4 mm",
    ),
    "catheter of a soft polymer": changed(
        rod__length="200 mm", rod__outer_diameter="1.7 mm", rod__inner_diameter="1.2 mm", rod__youngs_modulus="25 MPa",
        rod__density="1010 kg/m^3", hole__diameter="25 mm",
    ),
    "filament": changed(
        rod__length="100 mm", rod__outer_diameter="1.75 mm", rod__youngs_modulus="26 MPa", rod__density="1200 kg/m^3",
        hole__diameter="2 mm", load__applied="-13 N",
    ),
    "glass fibre": changed(
        rod__length="5 mm", rod__outer_diameter="125 um", rod__youngs_modulus="72 GPa", rod__density="2200 kg/m^3",
        hole__diameter="250 um", rod__yield_strength="5 GPa",
    ),
    "carbon fibre": changed(
        rod__length="1 mm", rod__outer_diameter="7 um", rod__youngs_modulus="230 GPa", rod__density="1800 kg/m^3",
        hole__diameter="100 um",
    ),
    "root": changed(
        rod__length="50 mm", rod__outer_diameter="0.8 mm", rod__youngs_modulus="10 MPa", rod__density="1000 kg/m^3",
        hole__diameter="3 mm",
    ),
    "soft robot": changed(
        rod__length="300 mm", rod__outer_diameter="12 mm", rod__youngs_modulus="0.5 MPa", rod__density="1070 kg/m^3",
        hole__diameter="40 mm",
    ),
    "sucker rod of glass": changed(
        rod__length="900 m", rod__outer_diameter="1 in", rod__youngs_modulus="7e6 psi", rod__density="0.074 lb/in^3",
        hole__diameter="2.441 in",
    ),
    "on the Moon": changed(hole__gravity="1.62 m/s^2"),
    "weightless": changed(hole__gravity="0 m/s^2"),
}  # fmt: skip


@pytest.mark.parametrize("data", RODS.values(), ids=RODS)
def test_real_rods_are_plausible(data: dict[str, Any]) -> None:
    assert Case.from_dict(data).problem.weight >= 0.0


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_examples_are_plausible(path: Path) -> None:
    if not is_study(path):
        assert Case.read(path).scales is not None


def test_the_catalogue_is_plausible() -> None:
    catalogue, seen = package_catalogue(), 0
    for kind, model in KINDS.items():
        for raw in catalogue.entries[kind].values():
            entry = model.model_validate(raw)
            for name in model.model_fields:
                value = getattr(entry, name)
                if f"rod.{name}" in RANGES and value is not None:
                    assert RANGES[f"rod.{name}"].holds(value), (entry.name, name)
                    seen += 1
    assert seen > 100


def test_the_weight_of_a_pipe_is_that_on_earth() -> None:
    data = {
        "rod": {"pipe": "5 in 19.5 lb/ft drill pipe", "length": "90 m"},
        "hole": {"diameter": "8.5 in", "angle_from_vertical": "60 deg", "gravity": "1.62 m/s^2"},
    }
    with pytest.raises(InputError, match=r"hole\.gravity = .*has the weight on Earth"):
        Case.from_dict(data)


@settings(max_examples=150)
@given(st.sampled_from(sorted(RANGES)), st.floats(-3.0, 3.0), st.booleans())
def test_every_range_ends_where_it_says_and_offers_units_that_help(key: str, beyond: float, above: bool) -> None:
    allowed = RANGES[key]
    bound = allowed.high if above or allowed.low == 0.0 else allowed.low
    outside = bound * 10.0 ** (abs(beyond) + 1e-6 if bound == allowed.high else -abs(beyond) - 1e-6)
    assert allowed.holds(bound)
    assert not allowed.holds(outside)
    assert allowed.holds(0.0) == allowed.or_zero
    for unit in likely_units(allowed, outside, QUANTITIES[allowed.kind][0]):
        assert allowed.holds(to_si(f"{outside!r} {unit}", allowed.kind))


def test_catalogues_of_users_are_looked_at_too(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(
        'source = "x"\n[[material]]\nname = "odd"\nyoungs_modulus = "30e6 GPa"\ndensity = "7850 kg/m3"\n'
        '[[pipe]]\nname = "wide"\nouter_diameter = "5 m"\nmaterial = "steel"\n', encoding="utf-8",
    )  # fmt: skip
    more = {"catalogue": {"files": ["own.toml"]}}
    odd = changed(rod__youngs_modulus=GONE, rod__density=GONE, rod__material="odd", **more)
    with pytest.raises(InputError, match=r"rod\.material = 'odd': has a modulus of .* moduli are from"):
        Case.from_dict(odd, folder=tmp_path)
    wide = {"rod": {"pipe": "wide", "length": "30 m"}, "hole": {"diameter": "6 m", "angle_from_vertical": "90 deg"}}
    with pytest.raises(InputError, match=r"rod\.pipe = 'wide': has an outer diameter of .*5 m"):
        Case.from_dict(wide | more, folder=tmp_path)


def test_every_quantity_of_a_case_has_a_range() -> None:
    """A key added to the schema without a range is seen here."""
    from rodwell.case import schema
    from rodwell.case.hole.schema import CylinderInput, Hole

    sections = {"rod": schema.RodInput, "hole": Hole, "cylinder": CylinderInput, "mud": schema.Mud,
                "supports": schema.Supports, "pressure": schema.PressureAtEnd, "load": schema.LoadInput}  # fmt: skip
    plain = {"rod.poisson", "hole.angle_from_vertical", "hole.angle_from_horizontal", "hole.from_", "hole.to",
             "hole.tortuosity"}  # fmt: skip
    for section, model in sections.items():
        for name, field in model.model_fields.items():
            text = repr(field)
            if re.search(r"\bfloat\b", text):
                assert f"{section}.{name}" in RANGES or f"{section}.{name}" in plain


def test_examples_may_be_read_whole() -> None:
    assert all(read_case(path).data for path in EXAMPLES)
