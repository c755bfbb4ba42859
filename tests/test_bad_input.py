"""Bad input to the library: every error names the key, what is allowed, and what to do."""

from __future__ import annotations

import copy
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.minimum import equilibrium
from rodwell.analysis.straight.critical import critical_loads
from rodwell.answers.result.answer import answer
from rodwell.answers.words.meaning import sentences
from rodwell.case.case import SECTIONS, Case, CaseError
from rodwell.errors import InputError, NotConvergedError, RodwellError
from rodwell.problem.problem import Problem
from rodwell.quantities.units import KINDS, to_si

NAN, INF = math.nan, math.inf

PHYSICAL: dict[str, Any] = {
    "rod": {
        "length": "30 m",
        "outer_diameter": "10 cm",
        "youngs_modulus": "200 GPa",
        "density": "7800 kg/m^3",
    },
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}
PLAIN: dict[str, Any] = {"dimensionless": {"weight": 16.5}}
GONE = object()


def changed(base: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """Return a copy of a case with ``section__key = value`` changed, added, or (GONE) taken away."""
    out = copy.deepcopy(base)
    for path, value in changes.items():
        *sections, key = path.split("__")
        place = out
        for section in sections:
            place = place.setdefault(section, {})
        if value is GONE:
            del place[key]
        else:
            place[key] = value
    return out


def physical(name: str, key: str, *phrases: str, **changes: Any) -> Any:
    return pytest.param(changed(PHYSICAL, **changes), key, phrases, id=name)


def plain(name: str, key: str, *phrases: str, **changes: Any) -> Any:
    return pytest.param(changed(PLAIN, **changes), key, phrases, id="plain-" + name)


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


BAD_FILES = [
    pytest.param(b"[rod\nlength = '30 m'\n", ("is not valid TOML", "line 1"), id="open-section"),
    pytest.param(b"[rod]\nlength = 30 m\n", ("is not valid TOML", "line 2"), id="no-quotes"),
    pytest.param(b"[rod]\nlength = \n", ("is not valid TOML", "line 2"), id="no-value"),
    pytest.param(b"[rod]\n[rod]\n", ("is not valid TOML", "twice"), id="section-twice"),
    pytest.param(b"\x00\xff\xfe\x80binary", ("is not text in UTF-8", "TOML"), id="binary"),
    pytest.param("[rod]\n".encode("utf-16"), ("is not text in UTF-8", "TOML"), id="utf-16"),
    pytest.param(b"", ("rod: is missing", "give [rod] and [hole], or [dimensionless]"), id="empty"),
    pytest.param(b"# only a comment\n", ("rod: is missing", "[dimensionless]"), id="comment"),
    pytest.param(b"rod = 5\n", ("rod = 5", "write [rod]"), id="rod-number"),
    pytest.param(b"[[rod]]\nlength = '30 m'\n", ("rod = ", "write [rod]"), id="list-of-tables"),
    pytest.param(b"[dimensionless]\nweight = nan\n", ("dimensionless.weight = nan", "must be finite"), id="nan"),
    pytest.param(b"[dimensionless]\nweight = 16.5\nalpha = 1979-05-27\n", ("dimensionless.alpha",), id="date"),
]


@pytest.mark.parametrize(("content", "phrases"), BAD_FILES)
def test_bad_file(tmp_path: Path, content: bytes, phrases: tuple[str, ...]) -> None:
    file = tmp_path / "well.toml"
    file.write_bytes(content)
    with pytest.raises(InputError) as caught:
        Case.read(file)
    assert "well.toml" in str(caught.value)
    for phrase in phrases:
        assert phrase in str(caught.value)


def test_missing_file_suggests_its_neighbour(tmp_path: Path) -> None:
    (tmp_path / "drill-string.toml").write_text("")
    with pytest.raises(InputError, match=r"does not exist; did you mean '.*drill-string\.toml'\?"):
        Case.read(tmp_path / "drill-sting.toml")


def test_missing_file_without_neighbours(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"case file = .*nothing\.toml'.*does not exist$"):
        Case.read(tmp_path / "no-such-folder" / "nothing.toml")


def test_folder_for_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is a folder; name a TOML file in it"):
        Case.read(tmp_path)


def test_file_below_a_file(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"case file = .*cannot be read"):
        Case.read(tmp_path / "file" / "well.toml")


def test_file_without_permission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> str:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(InputError, match=r"case file = .*cannot be read: Permission denied"):
        Case.read(tmp_path / "well.toml")


BAD_PROBLEMS = [
    pytest.param({"weight": -1.0}, "weight", "from 0 to 1e+09", id="weight-negative"),
    pytest.param({"weight": 1e10}, "weight", "from 0 to 1e+09", id="weight-large"),
    pytest.param({"weight": NAN}, "weight", "must be finite", id="weight-nan"),
    pytest.param({"weight": INF}, "weight", "must be finite", id="weight-inf"),
    pytest.param({"weight": "heavy"}, "weight", "must be a number", id="weight-text"),
    pytest.param({"weight": None}, "weight", "must be a number", id="weight-none"),
    pytest.param({"weight": [1.0]}, "weight", "must be a number", id="weight-list"),
    pytest.param({"weight": 1j}, "weight", "must be a number", id="weight-complex"),
    pytest.param({"alpha": 195.0}, "alpha", "from 0 (vertical) over 90 (horizontal) to 180", id="alpha-195"),
    pytest.param({"alpha": -1e-9}, "alpha", "from 0 (vertical) over 90 (horizontal)", id="alpha-negative"),
    pytest.param({"alpha": NAN}, "alpha", "must be finite", id="alpha-nan"),
    pytest.param({"clearance": 0.0}, "clearance", "above 0 and below 1", id="clearance-zero"),
    pytest.param({"clearance": -0.01}, "clearance", "above 0 and below 1", id="clearance-negative"),
    pytest.param({"clearance": 1.0}, "clearance", "above 0 and below 1", id="clearance-one"),
    pytest.param({"clearance": INF}, "clearance", "must be finite", id="clearance-inf"),
    pytest.param({"poisson": 0.51}, "poisson", "above -1 and at most 0.5", id="poisson-above"),
    pytest.param({"poisson": -1.0}, "poisson", "above -1 and at most 0.5", id="poisson-below"),
    pytest.param({"twist": NAN}, "twist", "must be finite", id="twist-nan"),
    pytest.param({"twist": "none"}, "twist", "must be a number", id="twist-text"),
    pytest.param({"turns": "half"}, "turns", "whole or not", id="turns-half"),
    pytest.param({"turns": True}, "turns", "must be a number", id="turns-true"),
    pytest.param({"turns": 1001}, "turns", "from -1000 to 1000", id="turns-many"),
    pytest.param({"turns": 20}, "turns", "cannot wind around so often at clearance 0.01", id="turns-for-length"),
    pytest.param({"on_top": 1}, "on_top", "must be True or False", id="on-top-number"),
    pytest.param({"on_top": "yes"}, "on_top", "must be True or False", id="on-top-text"),
]


@pytest.mark.parametrize(("values", "field", "remedy"), BAD_PROBLEMS)
def test_bad_problem(values: dict[str, Any], field: str, remedy: str) -> None:
    with pytest.raises(InputError) as caught:
        Problem(**({"weight": 16.5} | values))
    assert caught.value.field == field
    assert str(caught.value).startswith(field)
    assert remedy in str(caught.value)
    if values[field] is not None:
        assert repr(values[field]) in str(caught.value)
    with pytest.raises(InputError):
        Problem(16.5).but(**values)


HORIZONTAL = Problem(16.5)


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(HORIZONTAL, rtol=1e-4)


@pytest.fixture(scope="module")
def first_load(branch: Branch) -> float:
    assert branch.mode is not None
    return branch.mode.force


BAD_CALLS = [
    pytest.param(lambda: critical_loads(HORIZONTAL, 0), "modes", "from 1 to 200", id="count-zero"),
    pytest.param(lambda: critical_loads(HORIZONTAL, -1), "modes", "from 1 to 200", id="count-negative"),
    pytest.param(lambda: critical_loads(HORIZONTAL, 201), "modes", "from 1 to 200", id="count-large"),
    pytest.param(lambda: critical_loads(HORIZONTAL, 2.5), "modes", "whole number", id="count-fraction"),
    pytest.param(lambda: critical_loads(HORIZONTAL, True), "modes", "whole number", id="count-true"),
    pytest.param(lambda: critical_loads(HORIZONTAL, "3"), "modes", "whole number", id="count-text"),
    pytest.param(lambda: critical_loads(HORIZONTAL, rtol=0.0), "rtol", "from 1e-11", id="critical-rtol-zero"),
    pytest.param(lambda: critical_loads(HORIZONTAL, rtol=NAN), "rtol", "from 1e-11", id="critical-rtol-nan"),
    pytest.param(lambda: critical_loads(HORIZONTAL, rtol=0.1), "rtol", "to 0.01", id="critical-rtol-large"),
    pytest.param(lambda: critical_loads(HORIZONTAL.but(turns=1)), "turns", "turns must be 0", id="critical-coiled"),
    pytest.param(lambda: follow(HORIZONTAL, 0), "mode", "from 1 to 200", id="mode-zero"),
    pytest.param(lambda: follow(HORIZONTAL, 1.5), "mode", "whole number", id="mode-fraction"),
    pytest.param(lambda: follow(HORIZONTAL, until=NAN), "until", "finite end force", id="until-nan"),
    pytest.param(lambda: follow(HORIZONTAL, until=-INF), "until", "finite end force", id="until-inf"),
    pytest.param(lambda: follow(HORIZONTAL, rtol=1e-12), "rtol", "from 1e-11", id="follow-rtol-small"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=0.0), "largest_step", "from 0.0001 to 1", id="step-zero"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=-1), "largest_step", "from 0.0001 to 1", id="step-neg"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=2), "largest_step", "from 0.0001 to 1", id="step-large"),
    pytest.param(lambda: follow(HORIZONTAL, largest_step=NAN), "largest_step", "from 0.0001 to 1", id="step-nan"),
    pytest.param(
        lambda: follow(HORIZONTAL.but(on_top=True)), "until", "not pressed to the wall", id="on-top-without-until"
    ),
    pytest.param(lambda: follow(HORIZONTAL.but(turns=1)), "turns", "turns must be 0", id="follow-coiled"),
    pytest.param(lambda: equilibrium(HORIZONTAL.but(turns=1), NAN), "force", "finite end force", id="force-nan"),
    pytest.param(lambda: equilibrium(HORIZONTAL.but(turns=1), INF), "force", "finite end force", id="force-inf"),
    pytest.param(lambda: equilibrium(HORIZONTAL, -10.0), "turns", "must not be 0", id="equilibrium-without-turns"),
    pytest.param(lambda: equilibrium(HORIZONTAL.but(turns=1), -10.0, rtol=1.0), "rtol", "to 0.01", id="force-rtol"),
]


@pytest.mark.parametrize(("call", "field", "remedy"), BAD_CALLS)
def test_bad_call(call: Callable[[], object], field: str, remedy: str) -> None:
    with pytest.raises(InputError) as caught:
        call()
    assert str(caught.value).startswith(field)
    assert remedy in str(caught.value)


def test_until_is_the_critical_load(branch: Branch, first_load: float) -> None:
    assert branch.mode is not None
    with pytest.raises(InputError, match=r"until = .*must be below the critical load"):
        follow(HORIZONTAL, branch.mode, until=first_load)


def test_start_needs_an_end(branch: Branch) -> None:
    with pytest.raises(InputError, match=r"^until: must be given to follow a branch from a given state"):
        follow(HORIZONTAL, start=branch[3])
    with pytest.raises(InputError, match=r"^until = .*must differ"):
        follow(HORIZONTAL, start=branch[3], until=branch[3].force)


def test_start_of_another_problem(branch: Branch) -> None:
    with pytest.raises(InputError, match=r"^start = .*belongs to another problem"):
        follow(HORIZONTAL.but(weight=17.0), start=branch[3], until=-130.0)


@pytest.mark.parametrize("force", [1e5, -1e5])
def test_force_beyond_the_branch(branch: Branch, force: float) -> None:
    low, high = branch.force.min(), branch.force.max()
    with pytest.raises(InputError) as caught:
        branch.at(force)
    message = str(caught.value)
    assert message.startswith("force = ")
    assert f"covers {low:.6g} to {high:.6g} B/L²; follow it further" in message


@pytest.mark.parametrize("clearance", [0.3, 0.5, 0.9])
def test_load_beyond_ninety_degrees(clearance: float) -> None:
    case = Case.from_dict(
        {
            "dimensionless": {"weight": 16.5, "clearance": clearance},
            "load": {"until": -65.0},
            "analysis": {"modes": 1, "rtol": 1e-4},
        }
    )
    told = next(text for text in sentences(answer(case)) if text.startswith("Not reached: "))
    assert told.startswith(
        "Not reached: the end force −65 B/L² at s = 1, asked for: the branch of mode 1 goes no farther"
    )
    assert "than the end force −5" in told
    assert "the rod turned across the cylinder" in told


def test_load_beyond_ninety_degrees_in_newtons() -> None:
    data = changed(
        PHYSICAL,
        hole__diameter=GONE,
        hole__clearance="15 m",
        load__until="-80 kN",
        analysis={"modes": 1, "rtol": 1e-4},
    )
    told = [text for text in sentences(answer(Case.from_dict(data))) if text.startswith("Not reached: ")]
    assert len(told) == 1
    assert re.search(r"^Not reached: 80 kN of compression.*goes no farther than 6\d\.\d+ kN of compression", told[0])


@pytest.mark.parametrize(
    ("turns", "clearance", "force"),
    [
        pytest.param(3, 0.05, -10.0, id="winding-too-steep"),
        pytest.param(1, 0.15, -1000.0, id="compression-too-large"),
    ],
)
def test_coil_beyond_ninety_degrees(turns: int, clearance: float, force: float) -> None:
    with pytest.raises(NotConvergedError, match=rf"no coiled state found at F = {force:g} B/L².*\|η\| = 90°"):
        equilibrium(Problem(16.5, clearance=clearance, turns=turns), force)


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
