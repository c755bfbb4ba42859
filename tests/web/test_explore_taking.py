"""What is taken away from the explorer, and what can be moved in it: cases, commands, files, inputs, wrong ones."""

from __future__ import annotations

import base64
import tomllib
from typing import Any

import pytest
from asking import EXAMPLES, ask
from hypothesis import given
from hypothesis import strategies as st

import rodwell
from rodwell.web import words
from rodwell.web.engine import Engine
from rodwell.web.given import Given
from rodwell.web.inputs import DEFAULT, as_toml, moved


@pytest.mark.parametrize("name", ["plain", "field"])
def test_the_case_that_is_saved_gives_the_same_numbers(name: str, request: pytest.FixtureRequest) -> None:
    engine: Engine = request.getfixturevalue(name)
    inputs = {"plain": {"dimensionless.alpha": 75.0, "modes": 2}, "field": {"rod.length": 250.0, "mud.density": 11.0}}
    data = ask(engine, "diagram", inputs=inputs[name])["diagram"]
    load = 0.4 * data["buckles"]["load"] + 0.6 * data["lifts_off"]["load"]
    state = ask(engine, "state", inputs=inputs[name], load=load)["state"]
    text = base64.b64decode(ask(engine, "file", inputs=inputs[name], load=load, suffix="toml")["content"]).decode()
    case = rodwell.Case.from_dict(tomllib.loads(text))
    answer = rodwell.answer(case)
    assert case.applied[0].force == pytest.approx(state["force"], rel=1e-12)
    assert answer.buckling.value == pytest.approx(data["buckles"]["force"], rel=1e-9)
    assert answer.lift_off_load.value == pytest.approx(data["lifts_off"]["force"], rel=1e-9)
    same = answer.first.at(case.applied[0].force)
    assert same.largest("contact_pressure").value == pytest.approx(state["values"]["largest_push"]["value"], rel=1e-9)


def test_what_is_copied_runs_and_gives_the_state(plain: Engine, capsys: pytest.CaptureFixture[str]) -> None:
    data = ask(plain, "diagram")["diagram"]
    for branch, load in (("", 118.0), ("secondary 1", 200.0), ("straight", 90.0)):
        state = ask(plain, "state", load=load, branch=branch)["state"]
        texts = ask(plain, "copy", load=load, branch=branch)["texts"]
        names: dict[str, Any] = {}
        exec(texts["python"], names)
        if branch != "straight":
            angle = state["values"]["largest_angle"]["value"]
            assert names["state"].largest("xi2").value == pytest.approx(angle, rel=1e-9)
        assert capsys.readouterr().out
    assert texts["command"].startswith("rodwell diagram --weight 15.0 --alpha 90.0")
    from rodwell.cli.main import cli

    command = cli.commands["diagram"].make_context("diagram", texts["command"].split()[2:])
    assert command.params["until"] == pytest.approx(-data["range"][1])


def test_the_command_that_is_copied_leaves_out_nothing_of_the_problem() -> None:
    from rodwell.cli.main import cli
    from rodwell.cli.options import make_problem

    given = {"weight": -12.0, "alpha": 60.0, "clearance": 0.02, "ends": "pinned-clamped"}
    for torsion in ({"poisson": 0.4}, {"torsion": 1.5}):
        data = {"dimensionless": given | torsion, "load": {"twist": 0.5, "until": -100.0}, "analysis": {"modes": 1}}
        engine = Engine(Given(data))
        words = ask(engine, "copy", load=60.0, branch="straight")["texts"]["command"].split()
        command = cli.commands[words[1]].make_context(words[1], words[2:])
        assert make_problem(command.params) == engine.given.case.problem


def test_what_is_copied_leaves_out_nothing_of_the_problem() -> None:
    for values in (
        {"weight": 10.0, "alpha": 60.0, "build": 0.2, "walk": 0.1},
        {"weight": 10.0, "poisson": 0.4, "twist": 1.0, "ends": "pinned-clamped", "turns": 1.5},
        {"weight": 10.0, "torsion": 0.7, "sections": [(0.5, 1.0, 1.0), (0.5, 2.0, 1.5)]},
    ):
        problem = rodwell.Problem(**values)
        assert eval(words._call(problem)) == problem


def test_files_are_what_they_are_called(plain: Engine, field: Engine) -> None:
    starts = {"glb": b"glTF", "png": b"\x89PNG", "svg": b"<?xml", "nc": b"\x89HDF", "html": b"<!doctype html>"}
    for suffix, start in starts.items():
        content = base64.b64decode(ask(plain, "file", load=118.0, suffix=suffix)["content"])
        assert content[:40].lower().startswith(start.lower())
    lines = base64.b64decode(ask(field, "file", load=35000.0, suffix="csv")["content"]).decode().splitlines()
    head = lines[0].split(",")
    assert head[0] == "s [m]"
    assert "contact_pressure [N/m]" in head
    row = [float(x) for x in lines[-1].split(",")]
    assert row[0] == pytest.approx(300.0 * 0.3048)
    assert len(row) == len(head)


@pytest.mark.parametrize(
    ("inputs", "problem"),
    [({"sections": "0.6:1:1,0.4:0.5:2"}, {"sections": [(0.6, 1.0, 1.0), (0.4, 0.5, 2.0)]}),
     ({"dimensionless.build": 0.1}, {"build": 0.1}),
     ({"sections": "0.6,0.4:0.5:2", "dimensionless.build": 0.1},
      {"sections": [(0.6, 1.0, 1.0), (0.4, 0.5, 2.0)], "build": 0.1})],
)  # fmt: skip
def test_sections_and_build_are_computed_copied_and_saved(
    plain: Engine, inputs: dict[str, Any], problem: dict[str, Any]
) -> None:
    from rodwell.cli.main import cli
    from rodwell.cli.options import make_problem

    expected = rodwell.Problem(15.0, **problem)
    inputs = inputs | {"modes": 1}
    data = ask(plain, "diagram", inputs=inputs)["diagram"]
    assert data["buckles"]["force"] == pytest.approx(rodwell.critical_loads(expected, 1)[0].force, rel=1e-12)
    texts = ask(plain, "copy", inputs=inputs, load=50.0, branch="straight")["texts"]
    assert rodwell.Case.from_dict(tomllib.loads(texts["case"])).problem == expected
    command = texts["command"].split()
    assert make_problem(cli.commands["diagram"].make_context("diagram", command[2:]).params) == expected
    assert f"problem = {words._call(expected)}" in texts["python"]


def test_the_rod_lies_in_a_hole_that_leaves_the_vertical_plane(plain: Engine) -> None:
    inputs = {"dimensionless.walk": 0.1}
    data = ask(plain, "diagram", inputs=inputs)["diagram"]
    assert data["straight"] is None
    assert data["buckles"]["text"] == "not before it lifts off"
    state = ask(plain, "state", inputs=inputs, load=80.0)["state"]
    texts = ask(plain, "copy", inputs=inputs, load=80.0)["texts"]
    names: dict[str, Any] = {}
    exec(texts["python"], names)
    lying = rodwell.lying_rod(rodwell.Problem(15.0, walk=0.1), [-80.0])
    assert lying.end is not None
    assert data["lifts_off"]["force"] == pytest.approx(lying.end.force, rel=1e-8)
    expected = lying.at(-80.0).largest("contact_pressure").value
    assert names["state"].largest("contact_pressure").value == pytest.approx(expected, rel=1e-8)
    assert state["values"]["largest_push"]["value"] == pytest.approx(expected, rel=1e-8)
    assert "lies along the hole" in ask(plain, "verdict", inputs=inputs, load=80.0)["text"]
    assert texts["command"] == "rodwell diagram --weight 15.0 --alpha 90.0 --clearance 0.01 --walk 0.1"
    with pytest.raises(rodwell.InputError, match="none at which the rod was followed"):
        ask(plain, "state", inputs=inputs, load=1e4)


def test_a_string_can_be_moved_in_the_words_of_its_case() -> None:
    data = tomllib.loads((EXAMPLES / "bottom-hole-assembly.toml").read_text(encoding="utf-8"))
    data["rod"]["length"] = "120 ft"  # a check of the sections' lengths
    engine = Engine(Given(data))
    controls = {control.name: control for control in engine.given.controls if control.name.startswith("string.")}
    names = ["1.joint_length", "1.outer_diameter", "1.inner_diameter", "2.length"]
    assert sorted(controls) == sorted(f"string.{name}" for name in names)
    assert controls["string.2.length"].label == "drill pipe: length"
    assert (controls["string.2.length"].value, controls["string.2.length"].unit) == (60.0, "ft")
    assert not {"rod.length", "hole.build"} & {control.name for control in engine.given.controls}
    moves = {"string.2.length": 90.0, "string.1.inner_diameter": 2.5, "ends": "pinned-clamped"}
    other = moved(engine.given.data, engine.given.controls, moves)
    case = rodwell.Case.from_dict(tomllib.loads(as_toml(other)))
    assert case.string is not None
    assert case.string.length == pytest.approx(150.0 * 0.3048)
    assert case.problem.ends == ("pinned", "clamped")
    (before, pipe, *_), (after, other_pipe, *_) = engine.given.case.problem.sections, case.problem.sections
    assert after[1] / other_pipe[1] > before[1] / pipe[1] > 1.0  # stiffer with a smaller bore


def test_loads_at_the_bottom_of_a_curved_hole_are_saved_as_they_act() -> None:
    data = tomllib.loads((EXAMPLES / "build-section.toml").read_text(encoding="utf-8"))
    engine = Engine(
        Given(data | {"load": {"at": "bottom", "applied": "-30000 lbf"}, "analysis": {"modes": 1, "rtol": 1e-7}})
    )
    found = ask(engine, "diagram")["diagram"]
    assert found["axis"]["end"] == " at the bottom"
    load = 0.5 * found["buckles"]["load"]
    state = ask(engine, "state", load=load)["state"]
    text = base64.b64decode(ask(engine, "file", load=load, suffix="toml")["content"]).decode()
    assert rodwell.Case.from_dict(tomllib.loads(text)).applied[0].force == pytest.approx(state["force"], rel=1e-12)
    farther = ask(engine, "diagram", until=1.1 * found["range"][1])["diagram"]
    assert farther["range"][1] == pytest.approx(1.1 * found["range"][1], rel=1e-12)


def test_what_can_be_moved_stands_in_the_words_of_the_case(field: Engine) -> None:
    found = {control.name: control for control in field.given.controls}
    first, last = ["rod.length", "rod.weight_per_length"], ["mud.density", "load.twist", "hole.build", "hole.walk"]
    assert [*found] == [*first, "hole.diameter", "hole.angle_from_vertical", *last]
    assert (found["rod.length"].value, found["rod.length"].unit) == (300.0, "ft")
    assert (found["rod.weight_per_length"].value, found["rod.weight_per_length"].unit) == (19.5, "lbf/ft")
    assert not found["rod.weight_per_length"].given
    other = moved(field.given.data, field.given.controls, {"hole.diameter": 9.0, "ends": "pinned-clamped", "modes": 2})
    assert other["hole"]["diameter"] == "9.0 in"
    assert (other["rod"]["ends"], other["analysis"]["modes"]) == ("pinned-clamped", 2)
    assert field.given.data["hole"]["diameter"] == "8.5 in"  # the case to begin with stays
    same = moved(field.given.data, field.given.controls, {"hole.diameter": 8.5, "rod.weight_per_length": 19.5})
    assert same == field.given.data  # what was not moved stays as it was written


@pytest.mark.parametrize(
    ("inputs", "what"),
    [({"ends": "glued"}, "ends = 'glued'"), ({"modes": 99}, "modes = 99"), ({"modes": True}, "modes"),
     ({"nothing": 1.0}, "cannot be moved"), ({"sections": 3}, "sections = 3"),
     ({"sections": "0.5:1"}, "must add up to 1"), ({"sections": "0.5:x,0.5"}, "section 1 = '0.5:x'"),
     ({"sections": "0.5:1:1:1,0.5:2:1:0.8", "dimensionless.build": 0.1}, "must have one clearance"),
     ({"dimensionless.weight": "15"}, "must be a number"),
     ({"dimensionless.clearance": 2.0}, "clearance = 2"), ({"dimensionless.weight": float("nan")}, "weight")],
)  # fmt: skip
def test_wrong_inputs_are_told(plain: Engine, inputs: dict[str, Any], what: str) -> None:
    with pytest.raises(rodwell.InputError) as error:
        ask(plain, "diagram", inputs=inputs)
    assert what in str(error.value)


TEXTS = st.text(max_size=20).filter(lambda text: "\x7f" not in text and text.isprintable())
NUMBERS = st.one_of(st.booleans(), st.integers(-(10**6), 10**6), st.floats(allow_nan=False, allow_infinity=False))
KEYS = st.from_regex(r"[a-z_]{1,8}", fullmatch=True)


@given(st.dictionaries(KEYS, st.one_of(TEXTS, NUMBERS, st.lists(st.integers(0, 9), max_size=3)), max_size=4))
def test_cases_come_back_from_their_text(section: dict[str, Any]) -> None:
    data = {"title": "x", "rod": section}
    assert tomllib.loads(as_toml(data)) == data


def test_the_default_is_a_case() -> None:
    assert rodwell.Case.from_dict(DEFAULT).problem == rodwell.Problem(15.0)
