"""What the explorer's engine answers, against the library: states, verdicts, diagrams, and what is followed."""

from __future__ import annotations

import base64
import json
import tomllib
from typing import Any

import numpy as np
import pytest
from asking import EXAMPLES, FIELD, ask, never

import rodwell
from rodwell.web.engine import Cancelled, Engine
from rodwell.web.given import Given


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


def test_a_state_to_follow_whose_inputs_are_none_is_lost(plain: Engine) -> None:
    """Found by fuzzing: inputs that are no mapping, of the state that was shown, are those of no diagram."""
    for inputs in (True, 7, "x", [1, 2]):
        found = ask(plain, "follow", load=118.0, **{"from": {"load": None, "branch": None, "inputs": inputs}})
        assert found["kind"] == "lost"
