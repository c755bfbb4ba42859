"""Bad cases given to the library: every error names the key, what is allowed, and what to do."""

from __future__ import annotations

from typing import Any

import pytest
from bad_cases import GONE, INF, NAN, PHYSICAL, PLAIN, changed, physical, plain

from rodwell.case.case import Case, CaseError

LENGTH_EXAMPLE = 'write for example "30 m"'
WITHOUT_DIAMETER = {"hole__diameter": GONE}

BAD_QUANTITIES = [
    # zero, negative, NaN and infinite, for every kind
    physical("length-zero", "rod.length", "'0 m'", "must be above 0", rod__length="0 m"),
    physical("length-minus-zero", "rod.length", "must be above 0", rod__length="-0 m"),
    physical("length-negative", "rod.length", "'-30 m'", "must be above 0", rod__length="-30 m"),
    physical("length-nan", "rod.length", "'nan m'", "must be finite", rod__length="nan m"),
    physical("length-inf", "rod.length", "'inf m'", "must be finite", rod__length="inf m"),
    physical("length-overflows", "rod.length", "must be finite", rod__length="1e400 m"),
    physical("outer-zero", "rod.outer_diameter", "must be above 0", rod__outer_diameter="0 cm"),
    physical("outer-nan", "rod.outer_diameter", "must be finite", rod__outer_diameter="nan cm"),
    physical("inner-negative", "rod.inner_diameter", "'-1 mm'", "must not be negative", rod__inner_diameter="-1 mm"),
    physical("inner-nan", "rod.inner_diameter", "must be finite", rod__inner_diameter="nan m"),
    physical("modulus-zero", "rod.youngs_modulus", "must be above 0", rod__youngs_modulus="0 GPa"),
    physical("modulus-negative", "rod.youngs_modulus", "must be above 0", rod__youngs_modulus="-200 GPa"),
    physical("modulus-inf", "rod.youngs_modulus", "must be finite", rod__youngs_modulus="inf Pa"),
    physical("density-zero", "rod.density", "must be above 0", rod__density="0 kg/m^3"),
    physical("density-negative", "rod.density", "must be above 0", rod__density="-1 kg/m^3"),
    physical("density-nan", "rod.density", "must be finite", rod__density="nan kg/m^3"),
    physical("weight-negative", "rod.weight_per_length", "must not be negative", rod__weight_per_length="-3 N/m"),
    physical("weight-inf", "rod.weight_per_length", "must be finite", rod__weight_per_length="inf N/m"),
    physical("stiffness-zero", "rod.bending_stiffness", "must be above 0", rod__bending_stiffness="0 N m^2"),
    physical("hole-zero", "hole.diameter", "must be above 0", hole__diameter="0 m"),
    physical("hole-inf", "hole.diameter", "must be finite", hole__diameter="inf m"),
    physical("clearance-zero", "hole.clearance", "must be above 0", hole__clearance="0 m"),
    physical("clearance-negative", "hole.clearance", "must be above 0", hole__clearance="-3 cm"),
    physical("gravity-negative", "hole.gravity", "must not be negative", hole__gravity="-9.8 m/s^2"),
    physical("gravity-nan", "hole.gravity", "must be finite", hole__gravity="nan m/s^2"),
    physical("until-nan", "load.until", "must be finite", load__until="nan N"),
    physical("until-inf", "load.until", "must be finite", load__until="-inf N"),
    physical("twist-nan", "load.twist", "must be finite", load__twist="nan N m"),
    # wrong kind of unit
    physical("length-kg", "rod.length", "must be a length", "[mass]", LENGTH_EXAMPLE, rod__length="30 kg"),
    physical("length-area", "rod.length", "[length] ** 2", LENGTH_EXAMPLE, rod__length="30 m^2"),
    physical("diameter-speed", "hole.diameter", "must be a length", LENGTH_EXAMPLE, hole__diameter="70 m/s"),
    physical("modulus-force", "rod.youngs_modulus", "must be a stress", '"200 GPa"', rod__youngs_modulus="200 N"),
    physical("density-mass", "rod.density", "must be a density", '"7800 kg/m^3"', rod__density="7800 kg"),
    physical("density-is-weight", "rod.density", "must be a density", '"7800 kg/m^3"', rod__density="78 kN/m^3"),
    physical(
        "weight-is-mass", "rod.weight_per_length",
        "must be a force per length", "a weight is a force: lbf, not lb; N, not kg", '"315 N/m"',
        rod__weight_per_length="20 kg/m",
    ),
    physical(
        "weight-is-pounds", "rod.weight_per_length", "lbf, not lb", '"19.5 lbf/ft"',
        rod__weight_per_length="19.5 lb/ft",
    ),
    physical(
        "stiffness-moment", "rod.bending_stiffness", "must be a bending stiffness", '"9.8e5 N m^2"',
        rod__bending_stiffness="1 N m",
    ),
    physical("gravity-speed", "hole.gravity", "acceleration", '"9.80665 m/s^2"', hole__gravity="9.8 m/s"),
    physical("angle-length", "hole.angle_from_vertical", "angle", '"15 deg"', hole__angle_from_vertical="90 m"),
    physical("until-mass", "load.until", "must be a force", "N, not kg", '"-20 kN"', load__until="-20 kg"),
    physical("until-pounds", "load.until", "lbf, not lb", '"-5000 lbf"', load__until="-5000 lb"),
    physical("twist-force", "load.twist", "must be a moment", '"800 ft lbf"', load__twist="1 kN"),
    # unit missing, unknown, or no quantity at all
    physical("length-number", "rod.length", "= 30:", "needs a unit", '"30 m"', rod__length=30),
    physical("length-float", "rod.length", "needs a unit", '"30 m"', rod__length=30.0),
    physical("length-no-unit", "rod.length", "has no unit", LENGTH_EXAMPLE, rod__length="30"),
    physical("angle-number", "hole.angle_from_vertical", "needs a unit", '"15 deg"', hole__angle_from_vertical=90),
    physical("angle-no-unit", "hole.angle_from_vertical", "needs a unit", '"15 deg"', hole__angle_from_vertical="90"),
    physical("until-number", "load.until", "needs a unit", '"-20 kN"', load__until=-20),
    physical("unknown-unit", "rod.length", "unknown unit", "metr", LENGTH_EXAMPLE, rod__length="30 metr"),
    physical("unit-case", "rod.youngs_modulus", "unknown unit", "GPA", '"200 GPa"', rod__youngs_modulus="200 GPA"),
    physical("words", "rod.length", "thirty", LENGTH_EXAMPLE, rod__length="thirty metres"),
    physical("empty-text", "rod.length", "is not a number with a unit", LENGTH_EXAMPLE, rod__length=""),
    physical("blank-text", "rod.length", "is not a number with a unit", LENGTH_EXAMPLE, rod__length="  "),
    physical("temperature", "rod.length", "[temperature]", LENGTH_EXAMPLE, rod__length="30 degC"),
    physical("open-bracket", "rod.length", "is not a number with a unit", LENGTH_EXAMPLE, rod__length="(30 m"),
    physical("two-lengths", "rod.length", "is not a number with a unit", LENGTH_EXAMPLE, rod__length="30 m 20 cm"),
    physical("length-true", "rod.length", "= True", "must be text with a number and a unit", rod__length=True),
    physical("length-none", "rod.length", "must be text with a number and a unit", rod__length=None),
    physical("length-list", "rod.length", "must be text with a number and a unit", rod__length=["30 m"]),
    physical("length-table", "rod.length", "must be text with a number and a unit", rod__length={"value": 30}),
]  # fmt: skip

BAD_FIT = [
    physical("inner-equals-outer", "rod.inner_diameter", "must be below the outer diameter of 0.1 m",
             rod__inner_diameter="10 cm"),
    physical("inner-above-outer", "rod.inner_diameter", "must be below the outer diameter of 0.1 m",
             rod__inner_diameter="11 cm"),
    physical("rod-fills-hole", "hole.diameter", "outer diameter of 0.1 m", "does not fit", hole__diameter="10 cm"),
    physical("rod-thicker-than-hole", "hole.diameter", "outer diameter of 0.8 m", "does not fit",
             rod__outer_diameter="80 cm"),
    physical("hole-wider-than-length", "hole.diameter", "must be below the rod's length of 30 m",
             hole__diameter="1 km"),
    physical("clearance-is-length", "hole.clearance", "must be below the rod's length of 30 m",
             **WITHOUT_DIAMETER, hole__clearance="30 m"),
    physical("clearance-above-length", "hole.clearance", "must be below the rod's length of 30 m",
             **WITHOUT_DIAMETER, hole__clearance="31 m"),
    physical("angle-185", "hole.angle_from_vertical", "'185 deg'", 'from "0 deg" to "180 deg"',
             hole__angle_from_vertical="185 deg"),
    physical("angle-negative", "hole.angle_from_vertical", "'-1 deg'", 'from "0 deg" to "180 deg"',
             hole__angle_from_vertical="-1 deg"),
    physical("angle-radians", "hole.angle_from_vertical", "3.2 rad", 'from "0 deg" to "180 deg"',
             hole__angle_from_vertical="3.2 rad"),
    physical("angle-nan", "hole.angle_from_vertical", "must be finite", hole__angle_from_vertical="nan deg"),
    physical("angle-horizontal-95", "hole.angle_from_horizontal", "'95 deg'", 'from "-90 deg" to "90 deg"',
             hole__angle_from_vertical=GONE, hole__angle_from_horizontal="95 deg"),
    physical("poisson-above", "rod.poisson", "= 0.6", "above -1 and at most 0.5", rod__poisson=0.6),
    physical("poisson-below", "rod.poisson", "above -1 and at most 0.5", rod__poisson=-1),
    physical("poisson-nan", "rod.poisson", "must be finite", rod__poisson=NAN),
    physical("poisson-text", "rod.poisson", "without quotes or unit", rod__poisson="0.3"),
    physical("poisson-true", "rod.poisson", "must be a number", rod__poisson=True),
    physical("weight-too-large", "rod.length", "γ", "from 0 to 1e+09", rod__length="1000 km"),
    # data that contradict each other, or miss each other
    physical("density-and-weight", "rod.weight_per_length", "contradicts rod.density", "give only one of the two",
             rod__weight_per_length="315 N/m"),
    physical("modulus-and-stiffness", "rod.bending_stiffness", "contradicts rod.youngs_modulus",
             "give only one of the two", rod__bending_stiffness="1e6 N m^2"),
    physical("diameter-and-clearance", "hole.clearance", "contradicts hole.diameter", "give only one of the two",
             hole__clearance="30 cm"),
    physical("both-angles", "hole.angle_from_vertical", "contradicts hole.angle_from_horizontal",
             "give only one of the two", hole__angle_from_horizontal="0 deg"),
    physical("no-angle", "hole.angle_from_vertical", "is missing", "hole.angle_from_horizontal",
             hole__angle_from_vertical=GONE),
    physical("no-hole-size", "hole.diameter", "is missing", "hole.clearance", **WITHOUT_DIAMETER),
    physical("no-stiffness", "rod.youngs_modulus", "is missing", "rod.bending_stiffness", rod__youngs_modulus=GONE),
    physical("no-weight", "rod.density", "is missing", "rod.weight_per_length", rod__density=GONE),
    physical("no-length", "rod.length", "is missing; add it", rod__length=GONE),
    physical("no-outer-for-modulus", "rod.outer_diameter", "is missing", "with rod.youngs_modulus",
             rod__outer_diameter=GONE),
    physical("no-outer-for-density", "rod.outer_diameter", "is missing", "with rod.density",
             rod__outer_diameter=GONE, rod__youngs_modulus=GONE, rod__bending_stiffness="1e6 N m^2"),
    physical("no-outer-for-hole", "rod.outer_diameter", "is missing", "with hole.diameter",
             rod__outer_diameter=GONE, rod__youngs_modulus=GONE, rod__bending_stiffness="1e6 N m^2",
             rod__density=GONE, rod__weight_per_length="315 N/m"),
]  # fmt: skip

BAD_STRUCTURE = [
    physical("misspelt-length", "rod.lenght", "is not known", "did you mean 'length'?", rod__lenght="30 m"),
    physical("misspelt-modulus", "rod.young_modulus", "did you mean 'youngs_modulus'?", rod__young_modulus="1 Pa"),
    physical("misspelt-until", "load.untill", "did you mean 'until'?", load__untill="-20 kN"),
    physical("misspelt-modes", "analysis.mode", "did you mean 'modes'?", analysis__mode=3),
    physical("misspelt-title", "titel", "did you mean 'title'?", titel="Well"),
    physical("misspelt-section", "rods", "did you mean 'rod'?", rods={}),
    physical("unknown-key", "rod.colour", "is not known", "allowed are length, outer_diameter", rod__colour="red"),
    physical("unknown-section", "drill", "is not known", "allowed are title, rod, string, hole", drill={}),
    physical("poisson-in-hole", "hole.poisson", "does not belong into [hole] but into [rod]", hole__poisson=0.3),
    physical("modes-in-load", "load.modes", "does not belong into [load] but into [analysis]", load__modes=3),
    physical("until-in-analysis", "analysis.until", "not belong into [analysis] but into [load]",
             analysis__until="-1 N"),
    physical("key-without-section", "length", "it belongs into [rod]", length="30 m"),
    physical("modes-without-section", "modes", "it belongs into [analysis]", modes=4),
    physical("rod-number", "rod", "= 5", "must be a section: write [rod]", rod=5),
    physical("hole-text", "hole", "must be a section: write [hole]", hole="70 cm"),
    physical("load-list", "load", "must be a section: write [load]", load=[]),
    physical("analysis-number", "analysis", "must be a section: write [analysis]", analysis=4),
    physical("rod-tables", "rod", "must be a section: write [rod]", rod=[{"length": "30 m"}]),
    physical("title-number", "title", "= 5", "must be text in quotes", title=5),
    physical("no-rod", "rod", "is missing", "a case with [hole] needs [rod]", rod=GONE),
    physical("no-hole", "hole", "is missing", "a case with [rod] needs [hole]", hole=GONE),
    physical("hole-empty", "hole.diameter", "is missing: give it", hole={}),
    physical("both-descriptions", "dimensionless", "beside [rod] and [hole]", "give one or the other",
             dimensionless={"weight": 1.0}),
    plain("nothing", "rod", "is missing", "give [rod] and [hole], or [dimensionless]", dimensionless=GONE),
]  # fmt: skip

BAD_ANALYSIS = [
    physical("modes-zero", "analysis.modes", "= 0", "1", analysis__modes=0),
    physical("modes-negative", "analysis.modes", "= -1", "1", analysis__modes=-1),
    physical("modes-fraction", "analysis.modes", "= 2.5", "must be a whole number", analysis__modes=2.5),
    physical("modes-text", "analysis.modes", "= '4'", "must be a whole number", analysis__modes="4"),
    physical("modes-too-many", "analysis.modes", "= 100", "12", analysis__modes=100),
    physical("modes-true", "analysis.modes", "= True", "must be a whole number", analysis__modes=True),
    physical("modes-nan", "analysis.modes", "must be a whole number", analysis__modes=NAN),
    physical("rtol-zero", "analysis.rtol", "from 1e-11", "to 0.01", analysis__rtol=0),
    physical("rtol-negative", "analysis.rtol", "from 1e-11", "to 0.01", analysis__rtol=-1e-8),
    physical("rtol-too-small", "analysis.rtol", "= 1e-12", "from 1e-11", "to 0.01", analysis__rtol=1e-12),
    physical("rtol-too-large", "analysis.rtol", "= 0.1", "from 1e-11", "to 0.01", analysis__rtol=0.1),
    physical("rtol-nan", "analysis.rtol", "= nan", "from 1e-11", analysis__rtol=NAN),
    physical("rtol-inf", "analysis.rtol", "= inf", "from 1e-11", analysis__rtol=INF),
    physical("rtol-text", "analysis.rtol", "without quotes or unit", analysis__rtol="1e-8"),
    physical("rtol-true", "analysis.rtol", "must be a number", analysis__rtol=True),
]

BAD_PLAIN = [
    plain("weight-missing", "dimensionless.weight", "is missing; add it", dimensionless__weight=GONE),
    plain("weight-too-negative", "dimensionless.weight", "= -1", "up to 1e+09 in size", dimensionless__weight=-1e10),
    plain("weight-too-large", "dimensionless.weight", "up to 1e+09 in size", dimensionless__weight=1e10),
    plain("weight-nan", "dimensionless.weight", "= nan", "must be finite", dimensionless__weight=NAN),
    plain("weight-inf", "dimensionless.weight", "= inf", "must be finite", dimensionless__weight=INF),
    plain("weight-text", "dimensionless.weight", "without quotes or unit", dimensionless__weight="16.5"),
    plain("weight-unit", "dimensionless.weight", "without quotes or unit", dimensionless__weight="16.5 N"),
    plain("weight-true", "dimensionless.weight", "must be a number", dimensionless__weight=True),
    plain("weight-list", "dimensionless.weight", "number", dimensionless__weight=[16.5]),
    plain("alpha-195", "dimensionless.alpha", "= 195", "0 (vertical) over 90 (horizontal)", dimensionless__alpha=195),
    plain("alpha-negative", "dimensionless.alpha", "0 (vertical) over 90 (horizontal)", dimensionless__alpha=-1),
    plain("alpha-nan", "dimensionless.alpha", "must be finite", dimensionless__alpha=NAN),
    plain("alpha-unit", "dimensionless.alpha", "without quotes or unit", dimensionless__alpha="90 deg"),
    plain("clearance-zero", "dimensionless.clearance", "above 0 and below 1", dimensionless__clearance=0),
    plain("clearance-negative", "dimensionless.clearance", "above 0 and below 1", dimensionless__clearance=-0.1),
    plain("clearance-one", "dimensionless.clearance", "above 0 and below 1", dimensionless__clearance=1),
    plain("clearance-inf", "dimensionless.clearance", "must be finite", dimensionless__clearance=INF),
    plain("poisson", "dimensionless.poisson", "above -1 and at most 0.5", dimensionless__poisson=0.6),
    plain("until-nan", "load.until", "= nan", "must be finite", load__until=NAN),
    plain("until-inf", "load.until", "= -inf", "must be finite", load__until=-INF),
    plain("until-unit", "load.until", "without quotes or unit", load__until="-20 kN"),
    plain("until-true", "load.until", "must be a number", load__until=True),
    plain("twist-inf", "load.twist", "must be finite", load__twist=INF),
    plain("misspelt", "dimensionless.wieght", "did you mean 'weight'?", dimensionless__wieght=1.0),
    plain("length", "dimensionless.length", "into [rod]", dimensionless__length="3 m"),
    plain("with-hole", "dimensionless", "give one or the other", hole={}),
]


@pytest.mark.parametrize(
    ("data", "key", "phrases"), BAD_QUANTITIES + BAD_FIT + BAD_STRUCTURE + BAD_ANALYSIS + BAD_PLAIN
)
def test_bad_case(data: dict[str, Any], key: str, phrases: tuple[str, ...]) -> None:
    with pytest.raises(CaseError) as caught:
        Case.from_dict(data, source="well.toml")
    message = str(caught.value)
    assert message.startswith(f"well.toml: {key}")
    assert caught.value.field == key
    assert "\n" not in message
    for phrase in phrases:
        assert phrase in message


def test_unchanged_cases_are_good() -> None:
    assert Case.from_dict(PHYSICAL).problem.alpha == 90.0
    assert Case.from_dict(PLAIN).problem.weight == 16.5


def test_all_that_is_wrong_is_said_at_once() -> None:
    data = changed(PHYSICAL, rod__length="0 m", rod__lenght="2 m", hole__diameter="5 kg", analysis__modes=0)
    with pytest.raises(CaseError) as caught:
        Case.from_dict(data)
    assert len(caught.value.problems) == 4
    lines = str(caught.value).splitlines()
    assert len(lines) == 5
    for key in ("rod.length", "rod.lenght", "hole.diameter", "analysis.modes"):
        assert sum(line.strip().startswith((key + ":", key + " =")) for line in lines) == 1
