"""What is asked for, answered: diagrams, states, sentences, files. Runs in a process of its own, see ``worker``."""

from __future__ import annotations

import base64
import json
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from rodwell._version import __version__
from rodwell.analysis.path.events import LOADING, SNAP
from rodwell.case.case import Case
from rodwell.errors import InputError
from rodwell.quantities.text import error_digit
from rodwell.report.reports.texts import KINDS as LABELS
from rodwell.web import files, off_wall, state, words
from rodwell.web.diagram import plain
from rodwell.web.explored import STRAIGHT, Explored, explore, newtons
from rodwell.web.inputs import DEFAULT, ENDS, MOST_MODES, controls, moved

KEPT = 6
"""Diagrams that are kept: those between which one goes back and forth."""

LARGEST_LOAD = 1e12
"""In the unit of the page: beyond lies no load of any rod."""

Send = Callable[[dict[str, Any]], None]
Request = Mapping[str, Any]


class Cancelled(Exception):  # noqa: N818 - no error: something newer was asked for
    """What is being computed is no longer wanted."""


class Engine:
    """Answers for one case: what was computed last is kept.

    Parameters
    ----------
    data
        Content of the case file; None: :data:`rodwell.web.inputs.DEFAULT`.
    folder
        From which files that the case names are sought.
    source
        Name of the case in messages.
    """

    def __init__(self, data: dict[str, Any] | None, folder: str = ".", source: str = "case") -> None:
        self.data: dict[str, Any] = DEFAULT if data is None else data
        self.folder, self.source = Path(folder), source
        self.case = self._case(self.data)
        self.controls = controls(self.data, self.case)
        self._known: OrderedDict[str, Explored] = OrderedDict()
        self._unit: tuple[float, str] | None = None

    def hello(self) -> dict[str, Any]:
        """What the page needs to begin: what can be moved, and where it stands."""
        ends = "-".join(self.case.problem.ends)
        return {
            "kind": "hello",
            "version": __version__,
            "title": self.case.title,
            "physical": self.case.scales is not None,
            "controls": [vars(control) for control in self.controls],
            "ends": ends,
            "all_ends": [ends, *(each for each in ENDS if each != ends)],
            "modes": min(self.case.modes, MOST_MODES),
            "most_modes": MOST_MODES,
        }

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

    def _case(self, data: Mapping[str, Any]) -> Case:
        case = Case.from_dict(data, source=self.source, folder=self.folder)
        if case.modes > MOST_MODES:
            data = {**data, "analysis": {**data.get("analysis", {}), "modes": MOST_MODES}}
            case = Case.from_dict(data, source=self.source, folder=self.folder)
        return case

    def explored(self, request: Request, check: Callable[[], None], send: Send | None = None) -> Explored:
        """Return what was computed for the inputs of a request, computed now where it is not at hand."""
        inputs, until = dict(request.get("inputs") or {}), request.get("until")
        if request.get("path"):
            return self._with_path(request, check, send)
        if self._unit is None and inputs and send is not None:  # loads keep the unit of the case to begin with
            self.explored({}, check)
        key = json.dumps([inputs, until], sort_keys=True)
        if key in self._known:
            self._known.move_to_end(key)
            return self._known[key]
        data = moved(self.data, self.controls, inputs)
        case = self._case(data)
        if until is not None:
            data, case = self._farther(data, case, float(until))

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

    def _farther(self, data: dict[str, Any], case: Case, shown: float) -> tuple[dict[str, Any], Case]:
        """The case followed to a load as the page shows it."""
        if not abs(shown) < LARGEST_LOAD:
            raise InputError("until", shown, f"must be below {LARGEST_LOAD:g} in size")
        assert self._unit is not None
        less = case.problem.axial_weight if data.get("load", {}).get("at") == "bottom" else 0.0
        end = (less if case.scales is not None else 0.0) - shown / (self._unit[0] * newtons(case))
        load = {**data.get("load", {}), "until": files.force_text(case, end - less)}
        load.pop("applied", None)
        if "pressure" in data:
            load["kind"] = "effective"
        data = {**data, "load": load}
        return data, self._case(data)

    def _diagram(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found = self.explored(request, check, send)
        send({"kind": "diagram", "diagram": plain(found), "whole": True, "last": True})

    def _path(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found = self.explored({**request, "path": True}, check, send)
        send({"kind": "path", "diagram": plain(found), "whole": True, "last": True})

    def _found(self, request: Request, check: Callable[[], None]) -> tuple[Explored, state.Shown, str, int, int, str]:
        """The state that is asked for, its branch, which of how many, and what is to be said of the choice."""
        found = self.explored(request, check)
        load, asked, which = request.get("load"), request.get("branch") or "", request.get("which") or 0
        if isinstance(load, bool) or not isinstance(load, int | float) or not abs(load) < LARGEST_LOAD:
            raise InputError("load", load, f"must be a number below {LARGEST_LOAD:g} in size")
        for name, value in (("which", which), ("special", request.get("special") or 0)):
            if isinstance(value, bool) or not isinstance(value, int):
                raise InputError(name, value, "must be a whole number")
        if asked and asked != STRAIGHT and request.get("special") is not None:
            if found.path is not None and asked in off_wall.LEGS.values():
                return self._event(found, asked, int(request["special"]))
            return self._special(found, asked, int(request["special"]))
        force, note = found.force(float(load)), ""
        name = asked or self._usual(found, force)
        states = state.states_of(found, name, force)
        if not states:
            if asked:
                note = f"{asked} does not pass this load: the straight rod is shown."
            name, states = STRAIGHT, state.states_of(found, STRAIGHT, force)
        which = min(max(which, 0), len(states) - 1)
        return found, states[which], name, which, len(states), note

    @staticmethod
    def _usual(found: Explored, force: float) -> str:
        """The branch that a rod follows as the load grows: past lift-off its load path, where that is known."""
        lift = found.computed.lift_off
        if found.path is not None and lift is not None and force < lift.force:
            return off_wall.LEGS[LOADING]
        return found.computed.first.name

    @staticmethod
    def _special(found: Explored, name: str, number: int) -> tuple[Explored, state.Shown, str, int, int, str]:
        """A special point of a branch, as it was located."""
        state.states_of(found, name, 0.0)  # raises where there is no such branch
        points = found[name].special_points
        if not 0 <= number < len(points):
            raise InputError("special", number, f"must be from 0 to {len(points) - 1}: {name} has no more")
        point = points[number]
        index = f"index {point.index_before} → {point.index_after}"
        what = LABELS[point.kind]
        error = error_digit(found.load_unit[0] * point.error)
        note = f"{what[:1].upper()}{what[1:]} of {name}, known to ± {error} {found.load_unit[1]}"
        return found, point.solution, name, 0, 1, f"{note}; {index}."

    @staticmethod
    def _event(found: Explored, name: str, number: int) -> tuple[Explored, state.Shown, str, int, int, str]:
        """An event of the load path."""
        assert found.path is not None
        events = off_wall.events_of(found.path, name)
        if not 0 <= number < len(events):
            raise InputError("special", number, f"must be from 0 to {len(events) - 1}: {name} has no more")
        event = events[number]
        assert event.state is not None
        error = error_digit(found.load_unit[0] * event.force.error)
        note = f"{event.meaning[:1].upper()}{event.meaning[1:]}: the load is known to ± {error} {found.load_unit[1]}."
        return found, event.state, name, 0, 1, note

    def _state(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found, solution, name, which, count, note = self._found(request, check)
        shown = state.plain_state(found, solution, name, which, count, known=bool(request.get("known")))
        send({"kind": "state", "state": shown | {"note": note, "asked": request["load"]}, "last": True})

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
        found, solution, *_ = self._found(request, check)
        send({"kind": "details", "details": state.details(found, solution), "last": True})

    def _copy(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found, solution, name, which, *_ = self._found(request, check)
        send({"kind": "copy", "texts": words.snippets(found, solution, name, which), "last": True})

    def _file(self, request: Request, send: Send, check: Callable[[], None]) -> None:
        found, solution, *_ = self._found(request, check)
        content, kind = files.file_of(found, solution, str(request.get("suffix")))
        text = base64.b64encode(content).decode()
        send({"kind": "file", "suffix": request["suffix"], "type": kind, "content": text, "last": True})


def _seldom(tell: Callable[[str, float], None], check: Callable[[], None]) -> Callable[[str, float], None]:
    """Tell what is being done ten times a second at most; look at each step whether it is still wanted."""
    import time  # noqa: PLC0415

    last = [time.monotonic()]

    def told(what: str, done: float) -> None:
        check()
        if time.monotonic() - last[0] > 0.1:
            last[0] = time.monotonic()
            tell(what, done)

    return told
