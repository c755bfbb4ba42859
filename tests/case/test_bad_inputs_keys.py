"""A hundred more bad case files: each message names the key, shows the value, and says what to write instead."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from rodwell.case.case import Case, CaseError

PHYSICAL: dict[str, Any] = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}
PLAIN: dict[str, Any] = {"dimensionless": {"weight": 16.5}}
ANY = "any value"

OUT_OF_SCOPE, BELONGS = "is out of scope in this version", "does not belong into"

# section.key, what is said of it; the value is one that such a key would have
NO_KEYS = [
    ("mud.weight", 'write density = "10 lb/gal"'),
    ("mud.mud_weight", 'write density = "10 lb/gal"'),
    ("mud.mw", 'write density = "10 lb/gal"'),
    ("mud.gradient", "the gradient over g"),
    ("mud.specific_gravity", 'write density = "1200 kg/m^3"'),
    ("mud.pressure", "write [pressure] with inside and outside"),
    ("mud.annulus", "write outside"),
    ("mud.internal", "write inside"),
    ("load.torque", "`twist`: write that instead"),
    ("load.force", "the end force is `applied`, tension positive"),
    ("load.axial_force", "the end force is `applied`, tension positive"),
    ("load.compression", "compression with a minus sign"),
    ("load.push", "compression with a minus sign"),
    ("load.wob", 'at = "bottom"'),
    ("load.weight_on_bit", 'at = "bottom"'),
    ("load.hook_load", 'at = "top"'),
    ("load.pressure", "write [pressure]"),
    ("load.end", "write at"),
    ("load.rotation", "a dead torque, twist"),
    ("load.friction", OUT_OF_SCOPE),
    ("load.aplied", "did you mean 'applied'?"),
    ("load.outside", "into [mud]"),
    ("rod.tool_joint_diameter", "belongs into [[string]], which takes joints"),
    ("rod.tool_joint_length", "belongs into [[string]], which takes joints"),
    ("rod.tool_joints", "on its tool joints it buckles at less"),
    ("rod.diameter", "write outer_diameter (and inner_diameter for a pipe)"),
    ("rod.OD", "write outer_diameter"),
    ("rod.ID", "write inner_diameter"),
    ("rod.radius", "twice the radius"),
    ("rod.wall_thickness", "the outer diameter less twice the wall"),
    ("rod.E", "write youngs_modulus"),
    ("rod.elastic_modulus", "write youngs_modulus"),
    ("rod.EI", "write bending_stiffness"),
    ("rod.GJ", "write torsional_stiffness"),
    ("rod.shear_modulus", "write torsional_stiffness (GJ), or poisson"),
    ("rod.nu", "write poisson"),
    ("rod.weight", 'write weight_per_length = "19.5 lbf/ft"'),
    ("rod.mass_per_length", "give the weight instead"),
    ("rod.linear_density", "give the weight instead"),
    ("rod.taper", "write one [[string]] for each section"),
    ("rod.sections", "write one [[string]] for each section"),
    ("rod.curvature", "the rod is straight when free"),
    ("rod.friction_factor", OUT_OF_SCOPE),
    ("rod.temperature", "thermal strain is not treated"),
    ("rod.torsional_stifness", "did you mean 'torsional_stiffness'?"),
    ("rod.clearance", f"{BELONGS} [rod] but into [hole]"),
    ("rod.twist", f"{BELONGS} [rod] but into [load]"),
    ("rod.title", "to the top of the file"),
    ("rod.units", "to the top of the file"),
    ("rod.study", "to the top of the file"),
    ("hole.radius", "twice the radius"),
    ("hole.size", "write diameter"),
    ("hole.inner_diameter", "write diameter"),
    ("hole.outer_diameter", "in [cylinder]"),
    ("hole.inclination", 'write angle_from_vertical = "30 deg"'),
    ("hole.angle", "write angle_from_vertical or angle_from_horizontal"),
    ("hole.azimuth", "write walk, or a survey"),
    ("hole.section", "must be sections: write [[hole.section]], with two brackets"),
    ("hole.dogleg", 'build = "3 deg/30 m"'),
    ("hole.turn_rate", "walk sideways"),
    ("hole.friction", OUT_OF_SCOPE),
    ("pressure.internal", "write inside"),
    ("pressure.surface", "both at s = 1"),
    ("analysis.tolerance", "write rtol"),
    ("analysis.mesh", "chosen by the tolerance rtol"),
    ("supports.twist", "write torque"),
    ("supports.bending", "write moment"),
    ("cylinder.yield", "did you mean 'yield_strength'?"),
    ("catalogue.file", "did you mean 'files'?"),
]

NO_SECTIONS = [
    ("friction", "the wall is frictionless"),
    ("temperature", "thermal strain is not treated"),
    ("well", "rodwell screen SURVEY --case CASE"),
    ("survey", "give it on the command line"),
    ("fluids", "fluids stand in [mud]"),
    ("casing", "its strength stands in [cylinder]"),
    ("borehole", "the borehole is [hole]"),
    ("Drill-Pipe", "name it with rod.pipe"),
]

# section, key, value, what is allowed, remedy
BAD_VALUES = [
    ("rod", "bending_stiffness", ["1e5 N m^2", "2e5 N m^2"], "text with a number", "study = true at the top"),
    ("rod", "bending_stiffness", ["1e5 N m^2", "2e5 N m^2"], "text with a number", "one [[string]] for each section"),
    ("rod", "outer_diameter", ["5 in", "6 in"], "text with a number and a unit", "one [[string]] for each section"),
    ("rod", "poisson", [0.2, 0.3], "must be a number", "one [[string]] for each section"),
    ("rod", "grade", ["S-135", "E-75"], "must be text in quotes", "study = true at the top"),
    ("rod", "ends", ["clamped-clamped", "pinned-pinned"], "must be two of clamped", "study = true at the top"),
    ("rod", "length", ["20 m", "30 m"], "text with a number", "study = true at the top"),
    ("hole", "diameter", ["60 cm", "70 cm"], "text with a number", "study = true at the top"),
    ("hole", "angle_from_vertical", ["30 deg", "60 deg"], "text with a number", "study = true at the top"),
    ("load", "twist", ["1 N m", "2 N m"], "text with a number", "study = true at the top"),
    ("hole", "diameter", "60..80 cm in 3", "is not a number with a unit", "compute it with `rodwell run`"),
    ("hole", "angle_from_vertical", "192 deg", '"0 deg" to "180 deg"', "s = 1 is the lower end"),
    ("hole", "angle_from_vertical", "-5 deg", '"0 deg" to "180 deg"', "s = 1 is the lower end"),
    ("hole", "diameter", "10.0000001 cm", "at least 1e-07 of it is needed", "check the units of diameters and length"),
    ("rod", "torsional_stiffness", "0 N m^2", "must be above 0", ""),
    ("rod", "torsional_stiffness", "5 N m", "must be a torsional stiffness", '"7.5e5 N m^2"'),
    ("rod", "torsional_stiffness", 13, "needs a unit", '"7.5e5 N m^2"'),
    ("hole", "angle_from_vertical", "3 m", "must be an angle", '"15 deg"'),
    ("hole", "gravity", "3 m", "must be an acceleration", '"9.80665 m/s^2"'),
]  # fmt: skip

TOP = [
    ("study", "yes", "must be true or false", "without quotes"),
    ("study", 1, "must be true or false", "without quotes"),
    ("title", 5, "must be text in quotes", ""),
    ("units", "metric", 'must be "si" or "field" or "mm"', ""),
]


def refusal(data: dict[str, Any]) -> CaseError:
    with pytest.raises(CaseError) as caught:
        Case.from_dict(data, source="well.toml")
    assert "\n" not in str(caught.value)
    return caught.value


def test_there_are_a_hundred() -> None:
    assert len(NO_KEYS) + len(NO_SECTIONS) + len(BAD_VALUES) + len(TOP) >= 100


@pytest.mark.parametrize(("name", "words"), NO_KEYS, ids=[name for name, _ in NO_KEYS])
def test_what_is_no_key(name: str, words: str) -> None:
    section, key = name.split(".")
    data = copy.deepcopy(PHYSICAL)
    data.setdefault(section, {})[key] = ANY
    needed = {"cylinder": {"outer_diameter": "75 cm", "yield_strength": "300 MPa"}, "catalogue": {"files": []},
              "supports": {"force": "1 kN"}}  # fmt: skip
    data[section] |= needed.get(section, {})
    error = refusal(data)
    assert error.field == name
    assert f"well.toml: {name} = {ANY!r}: " in str(error)
    assert words in error.reason


@pytest.mark.parametrize(("name", "words"), NO_SECTIONS, ids=[name for name, _ in NO_SECTIONS])
def test_what_is_no_section(name: str, words: str) -> None:
    for value in ({"a": 1}, [{"a": 1}]):
        error = refusal({**PHYSICAL, name: value})
        assert error.field == name
        assert words in error.reason


@pytest.mark.parametrize(("section", "key", "value", "allowed", "remedy"), BAD_VALUES)
def test_bad_value(section: str, key: str, value: Any, allowed: str, remedy: str) -> None:
    data = copy.deepcopy(PHYSICAL)
    data.setdefault(section, {})[key] = value
    error = refusal(data)
    assert error.field == f"{section}.{key}"
    assert f"{section}.{key} = {value!r}" in str(error)
    assert allowed in error.reason
    assert remedy in error.reason


@pytest.mark.parametrize(("key", "value", "allowed", "remedy"), TOP)
def test_bad_value_at_the_top(key: str, value: Any, allowed: str, remedy: str) -> None:
    error = refusal({**PHYSICAL, key: value})
    assert f"{key} = {value!r}" in str(error)
    assert allowed in error.reason
    assert remedy in error.reason


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("torsion", 0, "from 1e-06"),
        ("torsion", "13", "plain number"),
        ("alpha", 192, "s = 1 below"),
        ("gamma", 5, "write weight"),
        ("twist", 1, "into [load]"),
        ("torsional_stiffness", 1, "write torsion"),
        ("turns", 1, "--turns"),
        ("weight", [10, 20], "study = true at the top"),
    ],
)
def test_without_dimensions(key: str, value: Any, words: str) -> None:
    error = refusal({"dimensionless": {"weight": 16.5, key: value}})
    assert f"dimensionless.{key} = {value!r}: " in str(error)
    assert words in error.reason


def test_lists_of_a_file_that_says_it_is_a_study_point_to_run() -> None:
    error = refusal({**PHYSICAL, "study": True, "rod": {**PHYSICAL["rod"], "length": ["20 m", "30 m"]}})
    assert "compute it with `rodwell run`" in error.reason
    assert "study = true" not in error.reason


def test_an_unknown_section_hides_no_unknown_key() -> None:
    """All that is wrong is listed: sections, keys of the rod, and those of [load], which is read last."""
    data = copy.deepcopy(PHYSICAL)
    data |= {"friction": {"factor": 0.3}, "rods": {}, "load": {"torque": "1 N m", "until": "-5 m"}}
    data["rod"]["lenght"] = "2 m"
    with pytest.raises(CaseError) as caught:
        Case.from_dict(data)
    assert {key for key, *_ in caught.value.problems} == {
        "friction", "rods", "rod.lenght", "load.torque", "load.until",
    }  # fmt: skip
    assert len(str(caught.value).splitlines()) == 6
