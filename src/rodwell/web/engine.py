"""What is asked for, answered: diagrams here, and what is asked of a state. Runs in a process of its own."""

from __future__ import annotations

import contextlib
import json
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from rodwell.analysis.branch.solution import Solution
from rodwell.case.case import Case
from rodwell.errors import InputError, RodwellError
from rodwell.web.diagram import plain
from rodwell.web.explored import Explored, checked_load, explore, uncomputed
from rodwell.web.given import Given
from rodwell.web.inputs import force_text, weight_below

if TYPE_CHECKING:
    from rodwell.web.followed import Followed

ASKED = ("state", "verdict", "details", "copy", "file", "snap")
"""What is asked of a state."""

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
        kind = request.get("kind")
        own = {"diagram": self._diagram, "path": self._path, "follow": self._follow}
        if kind in own:
            own[kind](request, send, check)
        elif kind not in ASKED:
            raise InputError("kind", kind, f"must be one of {', '.join([*own, *ASKED])}")
        else:
            found = self.explored(request, check)
            from rodwell.web import asked  # noqa: PLC0415 - the first diagram does not wait for it

            send(asked.answer(found, request) | {"last": True})

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

        for older in self._known.values():
            for branch in older.branches:
                branch.forget_tables()  # nine tenths of what is kept
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
        from rodwell.web import off_wall  # noqa: PLC0415 - the first diagram does not wait for it

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
        load["until"] = force_text(case, end - weight_below(case, load))
        load.pop("applied", None)
        if "pressure" in data:
            load["kind"] = "effective"
        data = {**data, "load": load}
        return data, self.given.case_of(data)

    def _followed(self, request: Request, check: Callable[[], None]) -> dict[str, Any] | None:
        """The state that was shown, followed to the inputs of a request, as a message; None where it cannot be."""
        from rodwell.web.followed import followed, followed_off_wall  # noqa: PLC0415 - the first diagram does not wait
        from rodwell.web.state import plain_state  # noqa: PLC0415

        load, start = checked_load("load", request.get("load")), self._origin(request["from"])
        if start is None:
            return None
        follow = followed if isinstance(start.solution, Solution) else followed_off_wall
        found = follow(start, *self.given.moved(request.get("inputs")), load, check)
        if found is None:
            return None
        self._kept[_followed_key(request, found.branch)] = found
        while len(self._kept) > KEPT:
            self._kept.popitem(last=False)
        shown = plain_state(found.explored, found.solution, found.branch, 0, 1, known=bool(request.get("known")))
        inputs = request.get("inputs") or {}
        return {"kind": "followed", "state": shown | {"note": "", "asked": load}, "inputs": inputs}

    def _follow(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        """Send a state of the load path that was shown, followed to other inputs, or why it cannot be.

        Nothing else: the diagram of these inputs comes from the process that has no path.
        """
        why, found = "it is not known any more", None
        try:
            found = self._followed(request, check) if isinstance(request.get("from"), Mapping) else None
        except RodwellError as error:
            why = str(error)
        send((found or {"kind": "lost", "why": why}) | {"last": True})

    def _origin(self, origin: Request) -> Followed | None:
        """The state that was shown, if it is still known: one that was followed itself, or one of a branch."""
        from rodwell.web.chosen import chosen  # noqa: PLC0415 - the first diagram does not wait for it
        from rodwell.web.followed import Followed  # noqa: PLC0415

        known = self._kept.get(_followed_key(origin, origin.get("branch")))
        key = _key(origin)
        if known is not None or key not in self._known:
            return known
        it = chosen(self._known[key], origin)
        return Followed(self._known[key], it.shown, it.branch)

    def _diagram(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        if isinstance(request.get("from"), Mapping) and _key(request) not in self._known:
            with contextlib.suppress(RodwellError):  # what is wrong with the inputs is told with their branches
                message = self._followed(request, check)
                if message is not None:
                    send(message)
        found = self.explored(request, check, send)
        send({"kind": "diagram", "diagram": plain(found), "whole": True, "last": True})

    def _path(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found = self.explored({**request, "path": True}, check, send)
        send({"kind": "path", "diagram": plain(found), "whole": True, "last": True})


def as_given(request: Request) -> bool:
    """Whether a request asks for the diagram of the case as it was given."""
    return request.get("kind") == "diagram" and _key(request) == _key({})


def _key(request: Request) -> str:
    """Of what was computed for the inputs of a request."""
    return json.dumps([_inputs(request), request.get("until")], sort_keys=True)


def _inputs(request: Request) -> object:
    """The inputs of a request; whatever else stands there is no key of anything that was kept."""
    inputs = request.get("inputs") or {}
    return dict(inputs) if isinstance(inputs, Mapping) else inputs


def _followed_key(request: Request, branch: object) -> str:
    """Of a state that was followed."""
    return json.dumps([_inputs(request), request.get("load"), branch], sort_keys=True)


def _seldom(tell: Callable[[str, float], None], check: Callable[[], None]) -> Callable[[str, float], None]:
    """Tell what is being done ten times a second at most; look at each step whether it is still wanted."""
    last = [time.monotonic()]

    def told(what: str, done: float) -> None:
        check()
        if time.monotonic() - last[0] > 0.1:
            last[0] = time.monotonic()
            tell(what, done)

    return told
