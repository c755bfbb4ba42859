"""Keys of case files as the schema explains them: all of them, examples that are right, pointers for wrong names."""

from __future__ import annotations

import json
import tomllib

import pytest
from click.testing import CliRunner

from rodwell import InputError
from rodwell.case import schema
from rodwell.case.checks.explain import SECTIONS
from rodwell.case.checks.pointers import KEYS_ELSEWHERE, SECTIONS_ELSEWHERE
from rodwell.case.keys import TOP, Key, every_key, keys_named, keys_of
from rodwell.cli.main import cli
from rodwell.quantities.units import KINDS, to_si

KEYS = [key for keys in every_key().values() for key in keys]


def run(*words: str) -> str:
    result = CliRunner().invoke(cli, ["keys", *words], catch_exceptions=False, env={"COLUMNS": "80"})
    assert result.exit_code == 0
    return result.output


def test_every_key_of_the_schema_is_explained() -> None:
    found = {key.full_name for key in KEYS}
    fields = {f"{section}.{field.alias or name}" for section, model in SECTIONS.items()
              for name, field in model.model_fields.items()}  # fmt: skip
    assert found == fields | (set(schema.CaseFile.model_fields) - set(SECTIONS))
    for key in KEYS:
        assert key.meaning, key.full_name
        assert key.examples, key.full_name


@pytest.mark.parametrize("key", KEYS, ids=lambda key: key.full_name)
def test_examples_and_defaults_are_what_the_schema_takes(key: Key) -> None:
    """Each example, put into a section with what that requires, is read by the schema, and means a sane size."""
    model = schema.CaseFile if key.section == TOP else SECTIONS[key.section]
    needed = {} if key.section == TOP else {k.name: k.examples[0] for k in keys_of(key.section) if k.required}
    for written in (*key.examples, *([key.default] if key.default else [])):
        lines = needed | {key.name: written}
        data = tomllib.loads("\n".join(f"{name} = {value}" for name, value in lines.items()))
        model.model_validate(data)
        if key.unit:
            first = data[key.name][0] if isinstance(data[key.name], list) else data[key.name]
            assert to_si(first, key.kind.partition(",")[0]) is not None


def test_examples_suit_their_keys() -> None:
    """A diameter is no 30 m: lengths of a section are below those of rods."""
    sizes = {key.full_name: to_si(json.loads(key.examples[0]), "length") for key in KEYS if key.kind == "length"}
    for along in (
        "rod.length",
        "string.length",
        "string.joint_length",
        "hole.from",
        "hole.to",
        "hole.tortuosity_step",
        "hole.section.length",
        "hole.section.from",
        "hole.section.to",
    ):
        assert sizes.pop(along) > 5.0
    assert max(sizes.values()) < 1.0


def test_kinds_units_defaults_and_limits() -> None:
    key = {key.full_name: key for key in KEYS}
    length = key["rod.length"]
    assert (length.kind, length.unit, length.allowed, length.required) == ("length", "m", "above 0", True)
    assert key["load.applied"].kind == "force, or a list"
    assert key["hole.gravity"].default == '"9.80665 m/s^2"'
    assert key["rod.poisson"].default == "0.3"
    assert key["load.at"].allowed == "top or bottom"
    assert key["analysis.modes"].allowed == "from 1 to 12"
    assert key["analysis.modes"].kind == "whole number"
    assert key["study"].kind == "true or false"
    assert key["catalogue.files"].kind == "list of text"
    quantities = {k.kind.partition(",")[0] for k in KEYS if k.unit}
    assert quantities == set(KINDS) - {"speed"}  # which stands in the file of a well alone


def test_limits_in_words_are_those_that_are_checked() -> None:
    from rodwell.problem.checks import LIMITS
    from rodwell.quantities.tolerance import HIGHEST_RTOL, LOWEST_RTOL

    key = {key.full_name: key for key in KEYS}
    assert key["rod.poisson"].allowed == LIMITS["poisson"][2]
    assert key["analysis.rtol"].allowed == f"from {LOWEST_RTOL:g} to {HIGHEST_RTOL:g}"
    assert key["dimensionless.weight"].allowed == f"up to {LIMITS['weight'][1]:g} in size".replace("e+09", "e9")


def test_command_explains_all_a_section_and_a_key() -> None:
    everything = run()
    for key in KEYS:
        assert f"  {key.name} = " in everything
    assert max(map(len, everything.splitlines())) <= 80
    rod = run("[rod]")
    assert "length" in rod
    assert "angle_from_vertical" not in rod
    one = run("rod.length")
    assert 'length = "30 m" or "300 ft"' in one
    assert "Length with a unit, above 0; required: length L between the ends." in one
    assert run("gravity").count("gravity = ") == 1
    assert run("poisson").count("poisson = ") == 3
    data = json.loads(run("--json"))
    assert {key["key"] for keys in data.values() for key in keys} == {key.full_name for key in KEYS}
    assert json.loads(run("mud.density", "--json"))["mud"][0]["unit"] == "kg/m^3"


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ("rod.lenght", "did you mean 'length'"),
        ("rodd", "did you mean 'rod'"),
        ("mud.weight", 'density = "10 lb/gal"'),
        ("load.torque", "`twist`"),
        ("friction", "out of scope"),
        ("hole.youngs_modulus", "into [rod]"),
        ("rod.colour", "allowed are length, outer_diameter"),
        ("nonsense.length", "allowed are title, rod"),
        ("top.titel", "did you mean 'title'"),
        ("", "allowed are"),
        (".", "allowed are"),
    ],
)
def test_wrong_names_are_told_the_right_ones(asked: str, words: str) -> None:
    with pytest.raises(InputError) as caught:
        keys_named(asked)
    assert words in str(caught.value)
    assert repr(asked) in str(caught.value)


def test_pointers_are_to_keys_that_there_are_and_from_keys_that_there_are_not() -> None:
    for section, names in KEYS_ELSEWHERE.items():
        assert not set(names) & set(SECTIONS[section].model_fields), section
        assert all(name == name.lower() for name in names)
    assert not set(SECTIONS_ELSEWHERE) & set(SECTIONS)


@pytest.mark.parametrize("command", ["run", "screen", "audit", "export", "verify"])
def test_helps_point_to_the_keys(command: str) -> None:
    assert "rodwell keys" in " ".join(CliRunner().invoke(cli, [command, "--help"]).output.split())


def test_top_help_names_both() -> None:
    text = " ".join(CliRunner().invoke(cli, ["--help"]).output.split())
    assert "rodwell init" in text
    assert "rodwell keys" in text
