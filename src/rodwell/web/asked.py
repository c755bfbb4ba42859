"""What is asked of a state, answered: the state itself, its verdict and details, what can be copied, files, a snap."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from typing import Any

from rodwell.analysis.path.events import SNAP
from rodwell.errors import InputError
from rodwell.web import files, off_wall, state, words
from rodwell.web.chosen import chosen
from rodwell.web.explored import STRAIGHT, Explored, checked_load

Request = Mapping[str, Any]


def answer(found: Explored, request: Request) -> dict[str, Any]:
    """Return the answer to a request of one of these kinds, from what was computed for its inputs.

    Raises
    ------
    InputError
        For what is not there, or no value of its kind.
    NotConvergedError
        If a state could not be computed.
    """
    kinds: dict[str, Callable[[Explored, Request], dict[str, Any]]] = {
        "state": _state, "verdict": _verdict, "details": _details, "copy": _copy, "file": _file, "snap": _snap,
    }  # fmt: skip
    kind = request["kind"]
    return {"kind": kind} | kinds[kind](found, request)


def _state(found: Explored, request: Request) -> dict[str, Any]:
    it = chosen(found, request)
    shown = state.plain_state(found, it.shown, it.branch, it.which, it.count, known=bool(request.get("known")))
    return {"state": shown | {"note": it.note, "asked": request["load"]}}


def _verdict(found: Explored, request: Request) -> dict[str, Any]:
    return {"text": words.sentence(found, found.force(checked_load("load", request.get("load"))))}


def _details(found: Explored, request: Request) -> dict[str, Any]:
    return {"details": state.details(found, chosen(found, request).shown)}


def _copy(found: Explored, request: Request) -> dict[str, Any]:
    it = chosen(found, request)
    return {"texts": words.snippets(found, it.shown, it.branch, it.which)}


def _file(found: Explored, request: Request) -> dict[str, Any]:
    content, kind = files.file_of(found, chosen(found, request).shown, str(request.get("suffix")))
    return {"suffix": request["suffix"], "type": kind, "content": base64.b64encode(content).decode()}


def _snap(found: Explored, request: Request) -> dict[str, Any]:
    """The rod before and after a snap of the load path, to be drawn."""
    name, number = str(request.get("branch")), request.get("special")
    path = found.path
    events = [] if path is None else off_wall.events_of(path, name)
    snaps = {i: event for i, event in enumerate(events) if event.kind == SNAP}
    if path is None or not isinstance(number, int) or isinstance(number, bool) or number not in snaps:
        raise InputError("special", number, f"must be the number of a snap of {name}")
    event = snaps[number]
    assert event.state is not None
    before: Any = off_wall.before_snap(path, event)
    if before is None:
        (before,) = state.states_of(found, STRAIGHT, event.force.value)
    return {"scenes": [state.seen_of(found, shown)[0].data for shown in (before, event.state.fine)]}
