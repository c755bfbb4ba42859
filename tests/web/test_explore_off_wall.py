"""The explorer beyond lift-off: states of the load path are those of the library, and begin on the wall's branch."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator
from typing import Any

import pytest

import rodwell
from rodwell.errors import InputError
from rodwell.quantities.as_json import as_json
from rodwell.web import off_wall
from rodwell.web.engine import Cancelled, Engine
from rodwell.web.given import Given

FARTHEST, BACK = -124.5, -112.0
BEYOND = off_wall.LEGS["loading"]


def never() -> None:
    """No request is cancelled."""


def ask(engine: Engine, kind: str, **what: Any) -> dict[str, Any]:
    out: list[dict[str, Any]] = []
    engine.answer({"kind": kind, "id": 1, "inputs": {}, "path": True, **what}, out.append, never)
    assert json.loads(as_json(out[-1])) == json.loads(json.dumps(out[-1]))
    return out[-1]


@pytest.fixture(scope="module")
def engine() -> Iterator[Engine]:
    """The horizontal rod, followed a little beyond lift-off and back."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(off_wall.beyond, "reach", lambda _: (FARTHEST, BACK))
        engine = Engine(Given(None))
        ask(engine, "path")
        yield engine


@pytest.fixture(scope="module")
def data(engine: Engine) -> dict[str, Any]:
    return ask(engine, "path")["diagram"]


def test_the_load_path_begins_on_the_branch_of_the_wall(engine: Engine, data: dict[str, Any]) -> None:
    """The same numbers from two models at a load before lift-off, in every ordinate that both have."""
    leg = next(branch for branch in data["branches"] if branch["name"] == BEYOND)
    assert "support_torque" not in leg["y"]
    wall = ask(engine, "state", load=118.0)["state"]
    path = ask(engine, "state", load=118.0, branch=BEYOND)["state"]
    assert (wall["branch"], path["branch"]) == ("mode 1", BEYOND)
    for name, value in path["y"].items():
        assert value == pytest.approx(wall["y"][name], rel=1e-6, abs=1e-7), name
    for name in ("largest_push", "end_shortening", "energy"):
        assert path["values"][name]["value"] == pytest.approx(wall["values"][name]["value"], rel=1e-8)
    assert path["curves"]["side"]["values"] == pytest.approx(wall["curves"]["side"]["values"], abs=1e-6)
    assert path["curves"]["push"]["values"] == pytest.approx(wall["curves"]["push"]["values"], rel=1e-6)


def test_past_lift_off_the_rod_is_on_its_load_path(engine: Engine, data: dict[str, Any]) -> None:
    path = rodwell.load_path(rodwell.Problem(15.0), until=FARTHEST, unload_to=BACK, rtol=1e-8)
    expected = path.at(-124.4)[0].state
    found = ask(engine, "state", load=124.4)["state"]
    assert (found["branch"], found["beyond"], found["index"]) == (BEYOND, True, 0)
    gap = max(one.largest.value for one in expected.gaps)
    assert found["values"]["largest_gap"]["value"] == pytest.approx(0.01 * gap, rel=1e-9)
    force = max(one.force.value for one in expected.point_forces)
    assert found["values"]["largest_point_force"]["value"] == pytest.approx(force, rel=1e-9)
    assert max(found["curves"]["gap"]["values"]) == pytest.approx(0.01 * gap, rel=1e-2)
    assert "partial contact, 3 gaps" in found["headline"]
    assert data["range"][1] >= 124.5
    assert data["snaps_at"]["text"] == "not up to 124.5 B/L² at s = 1"


def test_events_are_shown_as_they_were_located(engine: Engine, data: dict[str, Any]) -> None:
    leg = next(branch for branch in data["branches"] if branch["name"] == BEYOND)
    kinds = [event["kind"] for event in leg["special"]]
    number = kinds.index("gap_opens")
    assert leg["special"][number]["load"] == pytest.approx(124.1911865, abs=1e-6)  # theory-2, section 1
    found = ask(engine, "state", load=leg["special"][number]["load"], branch=BEYOND, special=number)["state"]
    assert found["note"].startswith("A gap opens: the load is known to ±")
    with pytest.raises(InputError, match="has no more"):
        ask(engine, "state", load=120.0, branch=BEYOND, special=99)
    with pytest.raises(InputError, match="must be the number of a snap"):
        ask(engine, "snap", branch=BEYOND, special=number)


def test_details_files_and_what_is_copied(engine: Engine, capsys: pytest.CaptureFixture[str]) -> None:
    details = ask(engine, "details", load=124.4)["details"]
    assert details["certificate"]["passed"]
    texts = ask(engine, "copy", load=124.4)["texts"]
    exec(texts["python"], {})
    assert "partial contact" in capsys.readouterr().out
    assert "--until -124.5 --unload-to -112.0 --at -124.4" in texts["command"]
    table = base64.b64decode(ask(engine, "file", load=124.4, suffix="csv")["content"]).decode()
    assert "gap [clearance]" in table
    with pytest.raises(InputError, match="holds states on the wall"):
        ask(engine, "file", load=124.4, suffix="nc")


LOOSE = {"dimensionless.alpha": 0.0, "dimensionless.weight": 0.0, "load.twist": 2.0}


def test_a_rod_that_nothing_presses_to_the_wall_and_is_twisted_says_why_there_is_none() -> None:
    data = ask(Engine(Given(None)), "path", inputs=LOOSE)["diagram"]
    assert [branch["name"] for branch in data["branches"] if branch["name"] in off_wall.LEGS.values()] == []
    assert "twist" in data["snaps_at"]["text"]


def test_following_ends_at_once_where_something_newer_is_asked_for() -> None:
    engine = Engine(Given(None))
    engine.answer({"kind": "diagram", "inputs": {}}, lambda _: None, never)
    seen: list[str] = []

    def check() -> None:
        if any("beyond" in each for each in seen):
            raise Cancelled

    with pytest.raises(Cancelled):
        engine.answer({"kind": "path", "inputs": {}}, lambda message: seen.append(message.get("what", "")), check)
    assert engine.explored({}, never).path is None
