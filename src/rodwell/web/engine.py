"""What is asked for, answered: diagrams, states, sentences, files. Runs in a process of its own, see ``worker``."""

from __future__ import annotations

import base64
import contextlib
import json
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.path.events import SNAP
from rodwell.case.case import Case
from rodwell.errors import InputError, RodwellError
from rodwell.web import files, off_wall, state, words
from rodwell.web.chosen import Chosen, checked_load, chosen
from rodwell.web.diagram import plain
from rodwell.web.explored import STRAIGHT, Explored, explore, uncomputed
from rodwell.web.followed import Followed, followed
from rodwell.web.given import Given

KEPT = 6
"""Diagrams that are kept: those between which one goes back and forth."""

Send = Callable[[dict[str, Any]], None]
Request = Mapping[str, Any]


class Cancelled(Exception):  # noqa: N818 - no error: something newer was asked for
    """What is being computed is no longer wanted."""


class Engine:
    """Answers for one case: what was computed last is kept.

    Parameters
    ----------
    given
        The case.
    """

    def __init__(self, given: Given) -> None:
        self.given = given
        self._known: OrderedDict[str, Explored] = OrderedDict()
        self._kept: OrderedDict[str, Followed] = OrderedDict()
        self._unit: tuple[float, str] | None = None

    def answer(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        """Answer a request; the last message that is sent says ``"last": True``.

        Parameters
        ----------
        request
            ``kind``, ``id``, ``inputs``, and what belongs to the kind.
        send
            Called with each message.
        check
            Called now and then; raises :class:`Cancelled` when something newer was asked for.

        Raises
        ------
        RodwellError
            If it cannot be answered.
        """
        kinds = {
            "diagram": self._diagram, "path": self._path, "state": self._state, "verdict": self._verdict,
            "details": self._details, "copy": self._copy, "file": self._file, "snap": self._snap,
        }  # fmt: skip
        kind = request.get("kind")
        if kind not in kinds:
            raise InputError("kind", kind, f"must be one of {', '.join(kinds)}")
        kinds[kind](request, send, check)

    def explored(self, request: Request, check: Callable[[], None], send: Send | None = None) -> Explored:
        """Return what was computed for the inputs of a request, computed now where it is not at hand."""
        inputs, until = request.get("inputs"), request.get("until")
        if request.get("path"):
            return self._with_path(request, check, send)
        if self._unit is None and inputs and send is not None:  # loads keep the unit of the case to begin with
            self.explored({}, check)
        key = _key(request)
        if key in self._known:
            self._known.move_to_end(key)
            return self._known[key]
        data, case = self.given.moved(inputs)
        if until is not None:
            data, case = self._farther(data, case, until)

        def reached(so_far: Explored, last: bool) -> None:
            if self._unit is None:
                self._unit = so_far.kept_unit
            check()
            if send is not None and not last:
                send({"kind": "diagram", "diagram": plain(so_far), "whole": False})

        found = explore(data, case, _seldom(self._teller(send, check), check), reached, self._unit)
        self._known[key] = found
        while len(self._known) > KEPT:
            self._known.popitem(last=False)
        return found

    def _with_path(self, request: Request, check: Callable[[], None], send: Send | None) -> Explored:
        """The same with the load path beyond lift-off."""
        wall = self.explored({**request, "path": False}, check)
        if wall.path is not None or wall.no_path:
            return wall
        path, why = off_wall.followed(wall.computed, _seldom(self._teller(send, check), check))
        found = replace(wall, path=path, no_path=why)
        key = next(key for key, known in self._known.items() if known is wall)
        self._known[key] = found
        return found

    @staticmethod
    def _teller(send: Send | None, check: Callable[[], None]) -> Callable[[str, float], None]:
        """Tells how far a computation is, unless nobody listens or it is no longer wanted."""

        def tell(what: str, done: float) -> None:
            check()
            if send is not None:
                send({"kind": "progress", "what": what, "done": done})

        return tell

    def _farther(self, data: dict[str, Any], case: Case, shown: object) -> tuple[dict[str, Any], Case]:
        """The case followed to a load as the page shows it."""
        assert self._unit is not None
        end = uncomputed(data, case, self._unit).force(checked_load("until", shown))
        load = {**data.get("load", {})}
        load["until"] = files.force_text(case, end - files.weight_below(case, load))
        load.pop("applied", None)
        if "pressure" in data:
            load["kind"] = "effective"
        data = {**data, "load": load}
        return data, self.given.case_of(data)

    def _followed(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        """Send the state that was shown, followed to the inputs of a request; nothing where it cannot be."""
        load, start = checked_load("load", request.get("load")), self._origin(request["from"])
        found = None if start is None else followed(start, *self.given.moved(request.get("inputs")), load, check)
        if found is None:
            return
        self._kept[_followed_key(request, found.branch)] = found
        while len(self._kept) > KEPT:
            self._kept.popitem(last=False)
        shown = state.plain_state(found.explored, found.solution, found.branch, 0, 1, known=bool(request.get("known")))
        send({"kind": "followed", "state": shown | {"note": "", "asked": load}, "inputs": request.get("inputs") or {}})

    def _origin(self, origin: Request) -> Followed | None:
        """The state that was shown, if it is still known: one that was followed itself, or one of a branch."""
        known = self._kept.get(_followed_key(origin, origin.get("branch")))
        key = _key(origin)
        if known is not None or key not in self._known:
            return known
        it = chosen(self._known[key], origin)
        return Followed(self._known[key], it.shown, it.branch) if isinstance(it.shown, Solution) else None

    def _diagram(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        if isinstance(request.get("from"), Mapping) and _key(request) not in self._known:
            with contextlib.suppress(RodwellError):  # what is wrong with the inputs is told with their branches
                self._followed(request, send, check)
        found = self.explored(request, check, send)
        send({"kind": "diagram", "diagram": plain(found), "whole": True, "last": True})

    def _path(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found = self.explored({**request, "path": True}, check, send)
        send({"kind": "path", "diagram": plain(found), "whole": True, "last": True})

    def _found(self, request: Request, check: Callable[[], None]) -> tuple[Explored, Chosen]:
        """The state that is asked for, and what was computed for its inputs."""
        found = self.explored(request, check)
        return found, chosen(found, request)

    def _state(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found, it = self._found(request, check)
        shown = state.plain_state(found, it.shown, it.branch, it.which, it.count, known=bool(request.get("known")))
        send({"kind": "state", "state": shown | {"note": it.note, "asked": request["load"]}, "last": True})

    def _snap(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        """The rod before and after a snap of the load path, to be drawn."""
        found = self.explored(request, check)
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
        scenes = [state.seen_of(found, shown).data for shown in (before, event.state.fine)]
        send({"kind": "snap", "scenes": scenes, "last": True})

    def _verdict(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found = self.explored(request, check)
        send({"kind": "verdict", "text": words.sentence(found, found.force(float(request["load"]))), "last": True})

    def _details(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found, it = self._found(request, check)
        send({"kind": "details", "details": state.details(found, it.shown), "last": True})

    def _copy(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found, it = self._found(request, check)
        send({"kind": "copy", "texts": words.snippets(found, it.shown, it.branch, it.which), "last": True})

    def _file(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found, it = self._found(request, check)
        content, kind = files.file_of(found, it.shown, str(request.get("suffix")))
        text = base64.b64encode(content).decode()
        send({"kind": "file", "suffix": request["suffix"], "type": kind, "content": text, "last": True})


def _key(request: Request) -> str:
    """Of what was computed for the inputs of a request."""
    return json.dumps([dict(request.get("inputs") or {}), request.get("until")], sort_keys=True)


def _followed_key(request: Request, branch: object) -> str:
    """Of a state that was followed."""
    return json.dumps([dict(request.get("inputs") or {}), request.get("load"), branch], sort_keys=True)


def _seldom(tell: Callable[[str, float], None], check: Callable[[], None]) -> Callable[[str, float], None]:
    """Tell what is being done ten times a second at most; look at each step whether it is still wanted."""
    last = [time.monotonic()]

    def told(what: str, done: float) -> None:
        check()
        if time.monotonic() - last[0] > 0.1:
            last[0] = time.monotonic()
            tell(what, done)

    return told
