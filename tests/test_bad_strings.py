"""Bad case files in the engineer's words: each message names the key and says what to do."""

from __future__ import annotations

from pathlib import Path

import pytest

from rodwell.case.case import Case, CaseError

BASE = """
title = "well"
[rod]
pipe = "5 in 19.5 lb/ft drill pipe"
length = "300 ft"
grade = "S-135"
[mud]
density = "10 lb/gal"
[pressure]
inside = "500 psi"
[hole]
diameter = "8.5 in"
angle_from_vertical = "30 deg"
[load]
until = "-60000 lbf"
at = "bottom"
kind = "effective"
"""

OWN = """
source = "caliper"
[[pipe]]
name = "shaft"
outer_diameter = "2 mm"
"""

PIPE, GRADE, MUD = 'pipe = "5 in 19.5 lb/ft drill pipe"', 'grade = "S-135"', 'density = "10 lb/gal"'
LOAD, PRESSURE = '[load]\nuntil = "-60000 lbf"\nat = "bottom"\nkind = "effective"', '[pressure]\ninside = "500 psi"'
TUBE = 'outer_diameter = "5 in"\ninner_diameter = "4.276 in"'
STEEL = f'{TUBE}\nmaterial = "steel"'
OTHER_PIPE = "leave it out"

# name, what is replaced by what, key, phrases of the message
WRONG_DIMENSION = [
    ("mud-is-pressure", MUD, 'density = "10 psi"', "mud.density", ("must be a density", '"65.5 lb/gal"')),
    ("mud-is-mass", MUD, 'density = "10 lb"', "mud.density", ("must be a density", "[mass]")),
    ("mud-without-unit", MUD, "density = 10", "mud.density", ("needs a unit", '"65.5 lb/gal"')),
    ("mud-negative", MUD, 'density = "-1 lb/gal"', "mud.density", ("must not be negative",)),
    ("mud-comma", MUD, 'density = "1,2 lb/gal"', "mud.density", ("decimal point, not a comma",)),
    ("mud-unknown-unit", MUD, 'density = "10 ppb"', "mud.density", ("unknown unit", "'ppb'")),
    ("mud-inside-is-length", MUD, 'inside = "10 in"', "mud.inside", ("must be a density",)),
    ("mud-outside-nan", MUD, 'outside = "nan lb/gal"', "mud.outside", ("must be finite",)),
    ("pressure-is-force", PRESSURE, '[pressure]\ninside = "500 lbf"', "pressure.inside",
     ("must be a pressure", '"3000 psi"')),
    ("pressure-negative", PRESSURE, '[pressure]\noutside = "-5 psi"', "pressure.outside", ("must not be negative",)),
    ("pressure-without-unit", PRESSURE, "[pressure]\ninside = 500", "pressure.inside", ("needs a unit", '"20 MPa"')),
    ("strength-is-force", GRADE, 'yield_strength = "135000 lbf"', "rod.yield_strength",
     ("must be a stress", '"200 GPa"')),
    ("strength-zero", GRADE, 'yield_strength = "0 psi"', "rod.yield_strength", ("must be above 0",)),
    ("force-is-mass", '"-60000 lbf"', '"-60000 lb"', "load.until", ("must be a force", "lbf, not lb")),
    ("force-without-unit", '"-60000 lbf"', "-60000", "load.until", ("needs a unit", '"-5000 lbf"')),
    ("hole-is-area", '"8.5 in"', '"8.5 in^2"', "hole.diameter", ("must be a length",)),
    ("length-is-weight", '"300 ft"', '"300 lbf/ft"', "rod.length", ("must be a length",)),
    ("weight-is-mass", PIPE, PIPE + '\nweight_per_length = "19.5 lb/ft"', "rod.weight_per_length",
     ("a weight is a force", "lbf, not lb")),
]  # fmt: skip

IMPOSSIBLE = [
    ("pipe-does-not-fit", '"8.5 in"', '"4.9 in"', "hole.diameter", ("outer diameter of 0.127 m", "does not fit")),
    ("pipe-fills-hole", '"8.5 in"', '"5 in"', "hole.diameter", ("does not fit",)),
    ("bore-too-wide", PIPE, STEEL.replace("4.276", "5.276"), "rod.inner_diameter", ("below the outer diameter",)),
    ("bore-of-catheter-too-wide", f"{PIPE}\n", 'pipe = "6 Fr catheter"\ninner_diameter = "3 mm"\nmaterial = "peek"\n',
     "rod.inner_diameter", ("below the outer diameter of 0.002 m",)),
    ("angle-beyond", '"30 deg"', '"190 deg"', "hole.angle_from_vertical", ('from "0 deg" to "180 deg"',)),
    ("mud-in-solid-rod", f"{PIPE}\n", 'outer_diameter = "5 in"\nmaterial = "steel"\n', "pressure.inside",
     ("the rod is solid", "give rod.inner_diameter")),
    ("inner-mud-in-solid-rod", f'{PIPE}\nlength = "300 ft"\n{GRADE}\n[mud]\n{MUD}\n{PRESSURE}',
     'outer_diameter = "5 in"\nmaterial = "steel"\nlength = "300 ft"\n[mud]\ninside = "9 lb/gal"', "mud.inside",
     ("the rod is solid", "leave this out")),
    ("hole-wider-than-long", '"8.5 in"', '"700 ft"', "hole.diameter", ("below the rod's length",)),
    ("mud-needs-diameter", f"{PIPE}\n", 'bending_stiffness = "1e6 N m^2"\nweight_per_length = "300 N/m"\n',
     "rod.outer_diameter", ("is missing", "with [mud]")),
]  # fmt: skip

UNKNOWN = [
    ("pipe-misspelt", PIPE, 'pipe = "5 in 19.5 lb/ft dril pip"', "rod.pipe",
     ("not in the catalogue", "nearest: '5 in 19.5 lb/ft drill pipe'", "rod.outer_diameter")),
    ("pipe-wrong-weight", PIPE, 'pipe = "5 in 18.5 lb/ft drill pipe"', "rod.pipe",
     ("nearest:", "'5 in 19.5 lb/ft drill pipe'")),
    ("pipe-nonsense", PIPE, 'pipe = "hose"', "rod.pipe", ("not in the catalogue", "[catalogue]")),
    ("pipe-empty", PIPE, 'pipe = ""', "rod.pipe", ("must be a name, not empty",)),
    ("pipe-number", PIPE, "pipe = 5", "rod.pipe", ("must be text in quotes",)),
    ("grade-unknown", GRADE, 'grade = "S-145"', "rod.grade", ("nearest: 'S-135'", "rod.yield_strength")),
    ("grade-far-off", GRADE, 'grade = "best"', "rod.grade", ("it holds E-75, X-95", "rod.yield_strength")),
    ("material-unknown", PIPE, f'{TUBE}\nmaterial = "stel"', "rod.material", ("nearest: 'steel'", "rod.density")),
    ("material-far-off", PIPE, f'{TUBE}\nmaterial = "wood"', "rod.material", ("it holds", "titanium, nitinol")),
    ("end-unknown", 'at = "bottom"', 'at = "bit"', "load.at", ('must be "top" or "bottom"',)),
    ("kind-unknown", 'kind = "effective"', 'kind = "true"', "load.kind", ('must be "effective" or "real"',)),
    ("units-unknown", 'title = "well"', 'units = "imperial"', "units", ('must be "si" or "field" or "mm"',)),
    ("ends-unknown", GRADE, 'ends = "welded-free"', "rod.ends", ("must be two of clamped, pinned",)),
]  # fmt: skip

MISSPELT = [
    ("pipes", "pipe =", "pipes =", "rod.pipes", ("did you mean 'pipe'?",)),
    ("greade", "grade =", "greade =", "rod.greade", ("did you mean 'grade'?",)),
    ("materal", GRADE, 'materal = "steel"', "rod.materal", ("did you mean 'material'?",)),
    ("mud-densty", "density =", "densty =", "mud.densty", ("did you mean 'density'?",)),
    ("pressure-insid", "inside =", "insid =", "pressure.insid", ("did you mean 'inside'?",)),
    ("section-mudd", "[mud]", "[mudd]", "mudd", ("did you mean 'mud'?",)),
    ("section-catalog", "[mud]", '[catalog]\nfiles = ["x.toml"]\n[mud]', "catalog", ("did you mean 'catalogue'?",)),
    ("grade-in-hole", 'diameter = "8.5 in"', 'diameter = "8.5 in"\ngrade = "S-135"', "hole.grade",
     ("does not belong into [hole] but into [rod]",)),
    ("outside-in-hole", 'diameter = "8.5 in"', 'diameter = "8.5 in"\noutside = "9 lb/gal"', "hole.outside",
     ("but into [mud]",)),
    ("pipe-on-top", 'title = "well"', PIPE, "pipe", ("it belongs into [rod]",)),
    ("mud-is-text", f"[mud]\n{MUD}", "", "mud", ("must be a section: write [mud]",)),
]  # fmt: skip

CONTRADICTORY = [
    ("weight-and-density", PIPE, f'{TUBE}\nyoungs_modulus = "30e6 psi"\ndensity = "7850 kg/m^3"\n'
     'weight_per_length = "19.5 lbf/ft"', "rod.weight_per_length", ("contradicts rod.density", "only one")),
    ("pipe-and-outer", PIPE, f'{PIPE}\nouter_diameter = "5 in"', "rod.outer_diameter",
     ("contradicts rod.pipe", OTHER_PIPE)),
    ("pipe-and-inner", PIPE, f'{PIPE}\ninner_diameter = "4 in"', "rod.inner_diameter",
     ("contradicts rod.pipe", OTHER_PIPE)),
    ("pipe-and-modulus", PIPE, f'{PIPE}\nyoungs_modulus = "30e6 psi"', "rod.youngs_modulus",
     ("contradicts rod.pipe", OTHER_PIPE)),
    ("pipe-and-stiffness", PIPE, f'{PIPE}\nbending_stiffness = "1e6 N m^2"', "rod.bending_stiffness",
     ("contradicts rod.pipe", OTHER_PIPE)),
    ("pipe-and-density", PIPE, f'{PIPE}\ndensity = "7850 kg/m^3"', "rod.density",
     ("contradicts rod.pipe", OTHER_PIPE)),
    ("pipe-and-material", PIPE, f'{PIPE}\nmaterial = "titanium"', "rod.material",
     ("contradicts rod.pipe, which is of steel", OTHER_PIPE)),
    ("material-and-modulus", PIPE, f'{STEEL}\nyoungs_modulus = "30e6 psi"', "rod.youngs_modulus",
     ("contradicts rod.material", "only one")),
    ("material-and-density", PIPE, f'{STEEL}\ndensity = "7850 kg/m^3"', "rod.density",
     ("contradicts rod.material", "only one")),
    ("grade-and-strength", GRADE, f'{GRADE}\nyield_strength = "135000 psi"', "rod.yield_strength",
     ("contradicts rod.grade", "only one")),
    ("grade-of-another-material", PIPE, f'{TUBE}\nmaterial = "titanium"', "rod.grade",
     ("is a grade of steel, but the rod is of titanium", "rod.yield_strength")),
    ("one-mud-and-two", MUD, f'{MUD}\ninside = "9 lb/gal"', "mud.inside", ("contradicts mud.density", "it alone")),
    ("two-angles", '"30 deg"', '"30 deg"\nangle_from_horizontal = "60 deg"', "hole.angle_from_vertical",
     ("contradicts hole.angle_from_horizontal", "only one")),
    ("pressure-without-kind", 'kind = "effective"', "", "load.kind", ("is missing", '"real"', '"effective"')),
    ("end-without-force", 'until = "-60000 lbf"', "", "load.at", ("give load.until or load.applied too",)),
    ("kind-without-force", 'until = "-60000 lbf"\nat = "bottom"', "", "load.kind", ("give load.until or load.app",)),
    ("guidewire-without-stiffness", f'{PIPE}\nlength = "300 ft"\n{GRADE}\n[mud]\n{MUD}\n{PRESSURE}',
     'pipe = "0.035 in guidewire"\nlength = "1 m"', "rod.bending_stiffness",
     ("no stiffness is standard", "as measured")),
    ("catheter-without-bore", PIPE, 'pipe = "6 Fr catheter"\nmaterial = "peek"', "rod.inner_diameter",
     ("is missing", "no bore is standard")),
    ("guidewire-without-weight", f'{PIPE}\nlength = "300 ft"\n{GRADE}\n[mud]\n{MUD}\n{PRESSURE}',
     'pipe = "0.035 in guidewire"\nlength = "1 m"\nbending_stiffness = "1400 N·mm²"', "rod.weight_per_length",
     ("no weight is standard", "rod.material")),
]  # fmt: skip

FILES = '[catalogue]\nfiles = ["own.toml"]\n[rod]'
CATALOGUES = [
    ("missing", None, "[catalogue]\nfiles = ['own.toml']\n[rod]", ("'own.toml'", "cannot be read", "its path")),
    ("not-a-list", OWN, '[catalogue]\nfiles = "own.toml"\n[rod]', ("must be a list in square brackets",)),
    ("not-toml", "pipe = [", FILES, ("is not valid TOML",)),
    ("single-brackets", OWN.replace("[[pipe]]", "[pipe]"), FILES, ("[[pipe]], in double brackets",)),
    ("unknown-table", OWN.replace("pipe", "tube"), FILES, ("tube is not known", "[[pipe]], [[material]]")),
    ("misspelt-key", OWN.replace("outer_", "outer"), FILES, ("'shaft'", "outer_diameter is missing; add it")),
    ("unknown-key", OWN + 'colour = "red"', FILES, ("'shaft'", "colour is not known")),
    ("wrong-dimension", OWN.replace("2 mm", "2 kg"), FILES, ("'shaft'", "outer_diameter must be a length")),
    ("bore-and-wall", OWN + 'wall = "0.1 mm"\ninner_diameter = "1.8 mm"', FILES, ("inner_diameter and wall",)),
    ("wall-too-thick", OWN + 'wall = "1 mm"', FILES, ("'shaft'", "a bore below its outer diameter")),
    ("nameless", OWN.replace("name", "note"), FILES, ("name is missing; add it",)),
]

ALL = WRONG_DIMENSION + IMPOSSIBLE + UNKNOWN + MISSPELT + CONTRADICTORY


def refusal(folder: Path, text: str) -> CaseError:
    file = folder / "well.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        Case.read(file)
    assert str(caught.value).startswith("well.toml: ")
    return caught.value


def test_there_are_sixty_and_the_base_is_good(tmp_path: Path) -> None:
    assert len(ALL) >= 60
    assert len({name for name, *_ in ALL}) == len(ALL)
    file = tmp_path / "well.toml"
    file.write_text(BASE, encoding="utf-8")
    assert Case.read(file).problem.alpha == 30.0


@pytest.mark.parametrize(("name", "old", "new", "key", "phrases"), ALL, ids=[name for name, *_ in ALL])
def test_bad_string(tmp_path: Path, name: str, old: str, new: str, key: str, phrases: tuple[str, ...]) -> None:
    assert BASE.count(old) == 1
    text = BASE.replace(old, new)
    if name == "mud-is-text":
        text = 'mud = "10 lb/gal"\n' + text
    error = refusal(tmp_path, text)
    assert error.field == key
    assert f"{key}: " in str(error) or f"{key} = " in str(error)
    for phrase in phrases:
        assert phrase in error.reason


@pytest.mark.parametrize(("name", "own", "section", "phrases"), CATALOGUES, ids=[name for name, *_ in CATALOGUES])
def test_bad_catalogue(tmp_path: Path, name: str, own: str | None, section: str, phrases: tuple[str, ...]) -> None:
    if own is not None:
        (tmp_path / "own.toml").write_text(own, encoding="utf-8")
    error = refusal(tmp_path, BASE.replace("[rod]", section))
    assert error.field == "catalogue.files"
    for phrase in phrases:
        assert phrase in str(error)


@pytest.mark.parametrize("name", ["mud", "pressure", "catalogue"])
def test_what_has_no_meaning_without_dimensions(tmp_path: Path, name: str) -> None:
    content = {"mud": MUD, "pressure": 'inside = "5 psi"', "catalogue": "files = []"}[name]
    error = refusal(tmp_path, f"[dimensionless]\nweight = 5\n[{name}]\n{content}\n")
    assert error.field == name
    assert "needs [rod] and [hole]" in error.reason


def test_words_on_the_force_without_dimensions(tmp_path: Path) -> None:
    error = refusal(tmp_path, '[dimensionless]\nweight = 5\n[load]\nuntil = -5\nkind = "real"\n')
    assert error.field == "load.kind"
    assert "needs [rod] and [hole]" in error.reason
    error = refusal(tmp_path, 'units = "field"\n[dimensionless]\nweight = 5\n')
    assert error.field == "units"
    assert "leave it out" in error.reason
