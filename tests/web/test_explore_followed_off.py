"""The explorer: a state off the wall is followed in an input that moves, or it is said why it is not."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from asking import ask

import rodwell
from rodwell.web import off_wall
from rodwell.web.engine import Cancelled, Engine
from rodwell.web.given import Given

LEG = off_wall.LEGS["loading"]
SHOWN = {"inputs": {}, "until": None, "load": 124.4, "branch": LEG, "which": 0}
ROD = rodwell.Problem(weight=15.0)


@pytest.fixture(scope="module")
def engine() -> Iterator[Engine]:
    """The process with the load path of the horizontal rod, a little beyond lift-off."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(off_wall.beyond, "reach", lambda _: (-124.5, -112.0))
        engine = Engine(Given(None))
        ask(engine, "path", path=True)
        yield engine


def follow(engine: Engine, start: dict[str, Any] = SHOWN, **what: Any) -> dict[str, Any]:
    return ask(engine, "follow", path=True, **{"load": 124.4, "from": start, **what})


def test_the_state_is_that_of_the_load_path_of_the_new_inputs(engine: Engine) -> None:
    inputs = {"dimensionless.weight": 15.15, "dimensionless.alpha": 89.0, "load.twist": 0.05}
    found = follow(engine, inputs=inputs)
    assert (found["kind"], found["inputs"]) == ("followed", inputs)
    state, path = found["state"], rodwell.load_path(ROD.but(weight=15.15, alpha=89.0, twist=0.05), until=-124.4)
    fresh = path.at(-124.4)[0].state
    assert (state["branch"], state["beyond"], state["index"]) == (LEG, True, 0)
    assert state["values"]["force"]["value"] == -124.4
    for name, value in (
        ("energy", fresh.energy.value), ("end_shortening", fresh.shortening.value),
        ("contact_total", fresh.contact_total.value), ("largest_push", fresh.largest_pressure.value),
    ):  # fmt: skip
        assert state["values"][name]["value"] == pytest.approx(value, rel=1e-7), name


def test_a_state_that_was_followed_is_followed_on(engine: Engine) -> None:
    there = follow(engine, inputs={"dimensionless.weight": 15.2})["state"]
    start = {"inputs": {"dimensionless.weight": 15.2}, "until": None, "load": 124.4, "branch": there["branch"]}
    back = follow(engine, start, inputs={})["state"]
    first = ask(engine, "state", path=True, load=124.4, branch=LEG)["state"]
    for name in ("energy", "contact_total", "largest_push"):
        assert back["values"][name]["value"] == pytest.approx(first["values"][name]["value"], rel=1e-9), name


@pytest.mark.parametrize(
    ("start", "what", "why"),
    [
        (SHOWN, {"inputs": {"dimensionless.clearance": 0.02}}, "% of the way"),  # it has snapped before
        (SHOWN, {"inputs": {"ends": "clamped-pinned"}}, "ends = "),
        (SHOWN, {"inputs": {"dimensionless.weight": 0.0}}, "weight = "),
        (SHOWN, {"load": "much"}, "load = 'much': must be a number"),
        (SHOWN | {"inputs": {"dimensionless.weight": 77.0}}, {}, "it is not known any more"),
        (None, {}, "it is not known any more"),
    ],
)  # fmt: skip
def test_why_it_is_not_followed_is_said(engine: Engine, start: dict[str, Any], what: dict[str, Any], why: str) -> None:
    found = follow(engine, start, **what)
    assert found["kind"] == "lost"
    assert why in found["why"]
    assert "state" not in found


def test_it_leaves_off_where_something_newer_is_asked_for(engine: Engine) -> None:
    asked = 0

    def check() -> None:
        nonlocal asked
        asked += 1
        if asked == 2:
            raise Cancelled

    request = {"kind": "follow", "path": True, "load": 124.4, "from": SHOWN, "inputs": {"dimensionless.weight": 14.0}}
    with pytest.raises(Cancelled):
        engine.answer(request, lambda _: pytest.fail("it has an answer"), check)
