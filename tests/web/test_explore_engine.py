"""What the explorer's engine answers, against the library: states, verdicts, files, and what can be moved."""

from __future__ import annotations

import base64
import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rodwell
from rodwell.quantities.as_json import as_json
from rodwell.web import words
from rodwell.web.engine import Cancelled, Engine
from rodwell.web.given import Given
from rodwell.web.inputs import DEFAULT, as_toml, moved

EXAMPLES = Path(__file__).parents[2] / "examples"
FIELD = EXAMPLES / "field-drill-pipe.toml"


def never() -> None:
    """No request is cancelled."""


def ask(engine: Engine, kind: str, **what: Any) -> dict[str, Any]:
    out: list[dict[str, Any]] = []
    engine.answer({"kind": kind, "id": 1, "inputs": {}, **what}, out.append, never)
    assert [message.get("last", False) for message in out] == [False] * (len(out) - 1) + [True]
    assert json.loads(as_json(out[-1])) == json.loads(json.dumps(out[-1]))  # plain data, nothing that is not finite
    return out[-1]


@pytest.fixture(scope="module")
def plain() -> Engine:
    return Engine(Given(None))


@pytest.fixture(scope="module")
def field() -> Engine:
    return Engine(Given(tomllib.loads(FIELD.read_text(encoding="utf-8"))))


def test_states_are_those_of_the_library(plain: Engine) -> None:
    """30 seeded states: force, largest push, largest angle and T₂ as the library has them for the same inputs."""
    rng = np.random.default_rng(24)
    for weight in (5.0, 15.0, 40.0):
        inputs = {"dimensionless.weight": weight, "dimensionless.alpha": 60.0}
        data = ask(plain, "diagram", inputs=inputs)["diagram"]
        problem = rodwell.Problem(weight=weight, alpha=60.0)
        until = -data["range"][1]
        branch = rodwell.follow(problem, mode=1, until=until)
        low = data["buckles"]["load"]
        for load in low + (data["range"][1] - low) * rng.uniform(0.02, 0.98, 10):
            found = ask(plain, "state", inputs=inputs, load=load)["state"]
            state = branch.at(-load)
            expected = {
                "force": -load, "largest_push": state.largest("contact_pressure").value,
                "largest_angle": state.largest("xi2").value, "T2": state.number("support_torque").value,
            }  # fmt: skip
            for name, value in expected.items():
                assert found["values"][name]["value"] == pytest.approx(value, rel=1e-9, abs=1e-12)
            assert found["index"] == state.stability_index
            assert found["branch"] == "mode 1"


def followed(engine: Engine, origin: dict[str, Any], inputs: dict[str, Any], **what: Any) -> dict[str, Any] | None:
    """The state that stands there before the diagram of other inputs, if one does."""
    out: list[dict[str, Any]] = []

    class Enough(Exception):  # noqa: N818 - not an error
        pass

    def send(message: dict[str, Any]) -> None:
        out.append(message)
        raise Enough

    request = {"kind": "diagram", "inputs": inputs, "from": origin, "load": origin["load"], **what}
    with pytest.raises(Enough):
        engine.answer(request, send, never)
    if out[0]["kind"] != "followed":
        return None
    assert out[0]["inputs"] == inputs
    state: dict[str, Any] = out[0]["state"]
    return state


def test_the_state_shown_is_followed_in_what_is_moved(plain: Engine, field: Engine) -> None:
    """Before anything else of the new inputs: the state that their branches then have, which begin elsewhere."""
    steps = [({"dimensionless.weight": 15.3}, 118.4), ({"dimensionless.weight": 15.3, "load.twist": 0.1}, 118.4),
             ({"dimensionless.alpha": 80.0, "dimensionless.clearance": 0.012}, 118.4)]  # fmt: skip
    cases = [(plain, "mode 1", steps), (field, "mode 1", [({"rod.length": 303.0, "modes": 1}, 35000.0)])]
    for engine, branch, moves in cases:
        ask(engine, "diagram")
        origin: dict[str, Any] = {"inputs": {}, "until": None, "load": moves[0][1], "branch": branch, "which": 0}
        for inputs, load in moves:
            state = followed(engine, origin, inputs)
            assert state is not None
            origin = origin | {"inputs": inputs, "branch": state["branch"]}  # goes on from there
            expected = ask(engine, "state", inputs=inputs, load=load)["state"]
            assert (state["branch"], state["index"]) == (expected["branch"], expected["index"])
            assert state["load"] == pytest.approx(load, rel=1e-12)
            for name, value in expected["values"].items():
                assert state["values"][name]["value"] == pytest.approx(value["value"], rel=1e-8, abs=1e-10), name
            assert state["curves"]["push"]["unit"] == expected["curves"]["push"]["unit"]


def test_the_straight_rod_is_followed_and_what_ends_in_it(plain: Engine) -> None:
    below = {"inputs": {}, "until": None, "load": 50.0, "branch": "straight", "which": 0}
    state = followed(plain, below, {"dimensionless.weight": 20.0})
    assert state is not None
    assert (state["branch"], state["index"]) == ("straight", 0)
    assert state["values"]["largest_push"]["value"] == pytest.approx(20.0, rel=1e-12)  # its weight
    high = followed(plain, below | {"load": 220.0}, {"dimensionless.weight": 14.9})
    assert high is not None
    assert high["index"] == 3  # as many critical loads are passed: see above
    buckled = {"inputs": {}, "until": None, "load": 111.6, "branch": "mode 1", "which": 0}
    state = followed(plain, buckled, {"dimensionless.weight": 16.0})
    assert rodwell.critical_loads(rodwell.Problem(16.0), 1)[0].force < -111.6  # heavier, it has not buckled
    assert state is not None
    assert (state["branch"], state["values"]["largest_angle"]["value"]) == ("straight", 0.0)


def test_what_cannot_be_followed_comes_with_the_branches(plain: Engine) -> None:
    origin = {"inputs": {}, "until": None, "load": 118.4, "branch": "mode 1", "which": 0}
    for inputs in ({"ends": "pinned-clamped", "modes": 1}, {"sections": "0.6:1:1,0.4:0.5:2", "modes": 1}):
        assert followed(plain, origin, inputs) is None
    unknown = origin | {"inputs": {"dimensionless.weight": 7.0}}
    assert followed(plain, unknown, {"dimensionless.weight": 16.5}) is None


def test_following_ends_where_something_newer_is_wanted(plain: Engine) -> None:
    out: list[dict[str, Any]] = []

    def check() -> None:
        raise Cancelled

    origin = {"inputs": {}, "until": None, "load": 118.4, "branch": "mode 1", "which": 0}
    inputs = {"dimensionless.weight": 15.05}
    with pytest.raises(Cancelled):
        plain.answer({"kind": "diagram", "inputs": inputs, "from": origin, "load": 118.4}, out.append, check)
    assert out == []


def test_loads_of_the_diagram_are_those_of_the_answer(field: Engine) -> None:
    answer = rodwell.answer(rodwell.Case.read(FIELD))
    data = ask(field, "diagram")["diagram"]
    keys = answer.key_numbers
    factor = answer.case.scales.factor("force") / 4.4482216152605
    weight = answer.case.problem.axial_weight  # shown at the bottom, compression positive
    assert data["buckles"]["load"] == pytest.approx(factor * (weight - answer.buckling.value), rel=1e-12)
    assert data["lifts_off"]["load"] == pytest.approx(factor * (weight - keys["lift_off_load"].value), rel=1e-12)
    assert data["axis"] == {"label": "compression at the bottom", "unit": "lbf", "end": " at the bottom"}
    assert data["suggested"] == pytest.approx(35000.0, rel=1e-12)  # load.applied of the file
    assert [b["name"] for b in data["branches"]][:3] == ["mode 1", "mode 2", "mode 3"]
    text = ask(field, "verdict", load=35000.0)["text"]
    from rodwell.answers.words.verdict import verdict

    assert text == verdict(answer.assessment)


def test_a_rod_that_buckles_under_its_weight_is_told_with_the_word_tension() -> None:
    engine = Engine(Given(tomllib.loads((EXAMPLES / "long-string.toml").read_text(encoding="utf-8"))))
    data = ask(engine, "diagram", inputs={"modes": 1})["diagram"]
    assert data["buckles"]["load"] < 0.0
    assert data["buckles"]["text"].endswith("kN of tension at the top")


def test_the_first_branch_comes_before_the_others_and_these_before_the_secondary_ones() -> None:
    out: list[dict[str, Any]] = []
    Engine(Given(None)).answer({"kind": "diagram", "inputs": {}}, out.append, never)
    drawn = [message for message in out if message["kind"] == "diagram"]
    assert [message["whole"] for message in drawn] == [False, False, True]
    first, primary, last = ({b["name"] for b in message["diagram"]["branches"]} for message in drawn)
    assert first == {"mode 1"}
    assert primary == {"mode 1", "mode 2", "mode 3"}
    assert last == primary | {"secondary 1"}
    assert len({json.dumps([message["diagram"][name] for name in ("buckles", "lifts_off")]) for message in drawn}) == 1


def test_stable_unstable_and_off_the_wall_change_at_special_points(plain: Engine) -> None:
    data = ask(plain, "diagram")["diagram"]
    first, second = data["branches"][:2]
    lift = next(p for p in first["special"] if p["kind"] == "lift_off")
    assert lift["force"] == pytest.approx(-123.173074384872, rel=1e-12)  # AUTO-07p, see tests/validation
    for load, off in zip(first["load"], first["off"], strict=True):
        assert off == (load >= lift["load"] * (1.0 - 1e-12))
    turn = next(p for p in second["special"] if p["kind"] == "branch_point")
    for load, index in zip(second["load"], second["index"], strict=True):
        assert index == (1 if load < turn["load"] * (1.0 - 1e-12) else 0)


def test_the_straight_rod_is_shown_where_no_branch_passes(plain: Engine) -> None:
    below = ask(plain, "state", load=50.0)["state"]
    assert (below["branch"], below["index"], below["stable"]) == ("straight", 0, True)
    assert below["values"]["largest_push"]["value"] == pytest.approx(15.0, rel=1e-12)  # its weight
    assert max(map(abs, below["curves"]["side"]["values"])) == 0.0
    above = ask(plain, "state", load=220.0, branch="straight")["state"]
    assert above["index"] == 3  # critical loads −111.2, −127.3, −206.5
    other = ask(plain, "state", load=115.0, branch="mode 2")["state"]
    assert other["branch"] == "straight"
    assert "mode 2 does not pass" in other["note"]


def test_a_special_point_is_shown_as_it_was_located(plain: Engine) -> None:
    data = ask(plain, "diagram")["diagram"]
    k = next(k for k, p in enumerate(data["branches"][0]["special"]) if p["kind"] == "lift_off")
    found = ask(plain, "state", load=data["branches"][0]["special"][k]["load"], branch="mode 1", special=k)["state"]
    branch = rodwell.follow(rodwell.Problem(15.0), mode=1)
    assert found["force"] == pytest.approx(branch.lift_off.force, rel=1e-12)
    assert abs(min(found["curves"]["push"]["values"])) < 1e-2
    assert "index 0 → 0" in found["note"]
    details = ask(plain, "details", load=123.0, branch="mode 1", special=k)["details"]
    assert details["converged"]
    assert details["certificate"]["passed"]


def test_every_vertex_lies_within_the_wall(plain: Engine, field: Engine) -> None:
    for engine, load in ((plain, 118.0), (plain, 180.0), (field, 35000.0)):
        scene = ask(engine, "state", load=load)["state"]["scene"]
        part = next(part for part in scene["parts"] if part["name"] == "rod")
        q = np.frombuffer(base64.b64decode(part["positions"]), dtype="<u2").reshape(-1, 3)
        low, high = np.array(part["low"]), np.array(part["high"])
        points = low + q / 65535.0 * (high - low)
        wall = 0.5 * scene["height"]  # radius of the wall as drawn
        assert np.hypot(points[:, 1], points[:, 2]).max() <= 1.001 * wall
        assert np.hypot(points[:, 1], points[:, 2]).max() >= 0.99 * wall  # it touches it


def test_triangles_are_left_out_where_the_page_knows_them(plain: Engine) -> None:
    first, second = (ask(plain, "state", load=118.0, known=known)["state"]["scene"]["parts"] for known in (False, True))
    assert all("triangles" in part for part in first)
    assert not any("triangles" in part for part in second)
    assert [part["positions"] for part in first] == [part["positions"] for part in second]


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


def test_farther_than_was_followed(plain: Engine) -> None:
    last = ask(plain, "diagram")["diagram"]["range"][1]
    data = ask(plain, "diagram", until=1.3 * last)["diagram"]
    assert data["range"][1] == pytest.approx(1.3 * last, rel=1e-12)
    assert ask(plain, "state", until=1.3 * last, load=1.25 * last)["state"]["branch"] == "mode 1"


def test_loads_keep_their_unit_while_inputs_move() -> None:
    engine = Engine(Given(tomllib.loads((EXAMPLES / "drill-string.toml").read_text(encoding="utf-8"))))
    shown = [ask(engine, "diagram", inputs=i)["diagram"] for i in ({"rod.length": 55.0}, {})]
    assert [each["axis"]["unit"] for each in shown] == ["kN", "kN"]
    for each in shown:  # B/L² is another force for another length
        assert each["buckles"]["load"] == pytest.approx(float(each["buckles"]["text"].split()[0]), rel=1e-3)


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
     ({"sections": "0.5:1:1:1,0.5:2:1:0.8", "dimensionless.build": 0.1}, "straight holes"),
     ({"dimensionless.weight": "15"}, "must be a number"),
     ({"dimensionless.clearance": 2.0}, "clearance = 2"), ({"dimensionless.weight": float("nan")}, "weight")],
)  # fmt: skip
def test_wrong_inputs_are_told(plain: Engine, inputs: dict[str, Any], what: str) -> None:
    with pytest.raises(rodwell.InputError) as error:
        ask(plain, "diagram", inputs=inputs)
    assert what in str(error.value)


@pytest.mark.parametrize(
    ("request_", "what"),
    [({"kind": "dance"}, "kind = 'dance'"), ({"kind": "state", "load": None}, "load"),
     ({"kind": "state", "load": 1e99}, "load"),
     ({"kind": "state", "load": 118.0, "branch": "mode 9"}, "branch = 'mode 9'"),
     ({"kind": "state", "load": 118.0, "which": "x"}, "which"),
     ({"kind": "state", "load": 118.0, "branch": "mode 1", "special": 50}, "special = 50"),
     ({"kind": "file", "load": 118.0, "suffix": "exe"}, "file = 'exe'"), ({"kind": "diagram", "until": 1e40}, "until")],
)  # fmt: skip
def test_wrong_requests_are_told(plain: Engine, request_: dict[str, Any], what: str) -> None:
    kind = request_["kind"]
    with pytest.raises(rodwell.InputError) as error:
        ask(plain, kind, **{k: v for k, v in request_.items() if k != "kind"})
    assert what in str(error.value)


def test_what_is_cancelled_ends_and_leaves_nothing_behind(plain: Engine) -> None:
    calls = []

    def check() -> None:
        calls.append(1)
        if len(calls) > 5:
            raise Cancelled

    inputs = {"dimensionless.weight": 33.0}
    with pytest.raises(Cancelled):
        plain.answer({"kind": "diagram", "inputs": inputs}, lambda _message: None, check)
    assert len(calls) == 6
    assert ask(plain, "diagram", inputs=inputs)["diagram"]["branches"]


TEXTS = st.text(max_size=20).filter(lambda text: "\x7f" not in text and text.isprintable())
NUMBERS = st.one_of(st.booleans(), st.integers(-(10**6), 10**6), st.floats(allow_nan=False, allow_infinity=False))
KEYS = st.from_regex(r"[a-z_]{1,8}", fullmatch=True)


@given(st.dictionaries(KEYS, st.one_of(TEXTS, NUMBERS, st.lists(st.integers(0, 9), max_size=3)), max_size=4))
def test_cases_come_back_from_their_text(section: dict[str, Any]) -> None:
    data = {"title": "x", "rod": section}
    assert tomllib.loads(as_toml(data)) == data


def test_the_default_is_a_case() -> None:
    assert rodwell.Case.from_dict(DEFAULT).problem == rodwell.Problem(15.0)
