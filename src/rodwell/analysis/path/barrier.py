"""What holds a rod in a state that lies higher than another one: the saddle between the two, and what gets it over.

The branch of a state that ceases to be stable goes on beyond its limit point, or its bifurcation, unstable, back in
what is controlled. On it lies, at every value on the way, the pass from that state to the one to which the rod would
snap: an equilibrium with one direction downhill on either side. It is followed from there, as any path is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState, conditions
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.following import followed
from rodwell.analysis.off_wall.happening import END
from rodwell.analysis.off_wall.recognise import recognised
from rodwell.analysis.off_wall.soft import settled
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.path.disturbance import Held, held_by, turned_over
from rodwell.analysis.path.events import SNAP, Destination, Leg, PathPoint
from rodwell.analysis.path.plane import displaced
from rodwell.analysis.path.snap import flowed, kicked
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.stretches.carry import sampler
from rodwell.numerics.stretches.newton import Solved
from rodwell.quantities.value import Value

ASIDE = tuple(0.1 * 0.5**k for k in range(8))
"""Distance, in Δ, from where a state ceases to be stable at which its branch is taken up again, one after the other."""


@dataclass(frozen=True, eq=False)
class Barrier:
    """The saddle between a state of a load path and the one to which the rod would snap later.

    Attributes
    ----------
    leg
        "loading" or "unloading".
    state
        The state on the path.
    saddle
        The unstable equilibrium at the same value of what is controlled; one eigenvalue of its second variation is
        negative. Downhill on its one side lies ``state``, which descent has confirmed.
    to
        What lies downhill on its other side; its ``starts`` and ``agree`` are 1.
    held
        The state behind the soft wall with which descent was computed.
    """

    leg: str
    state: ContactState
    saddle: ContactState
    to: Destination
    held: Held

    def __repr__(self) -> str:
        return f"<Barrier {self.height.value:.6g} B/L at F = {self.state.force:.8g} B/L², to {self.to.kind}>"

    @cached_property
    def height(self) -> Value:
        """Energy of the saddle over the state, in B/L: the least work with which a disturbance gets there.

        Where the shortening is controlled, without the work of the end force, and with what is stored in series.
        """
        control, unit = self.held.control, self.state.problem.clearance**2

        def over(pass_: PatternedState, state: PatternedState) -> float:
            return (control.potential(pass_.solved) - control.potential(state.solved)) * unit

        coarse, fine = over(self.saddle.coarse, self.state.coarse), over(self.saddle.fine, self.state.fine)
        return Value(fine, float(estimated_error(fine, coarse)))

    @cached_property
    def turn(self) -> Value | None:
        """By how much mid-length must be turned about the hole's axis for the rod to snap, in rad; None: not by a half.

        The whole rod is turned, by ψ sin²(πs), and let go; it follows the gradient flow, as in something viscous. The
        least ψ after which it does not come back. The estimate of the error is that of the flow and of the soft wall in
        which it runs, and coarse; another way to turn the rod has another least turn, that may be
        larger or smaller by a tenth.
        """
        return turned_over(self.state.coarse, self.held)

    def turn_or_why(self) -> tuple[Value | None, str]:
        """:attr:`turn`, and "" or why it could not be told: height and saddle stand without it.

        Once it was broken off, as by Ctrl-C, it is not begun again.
        """
        if self._begun:
            return None, "it was broken off"
        self._begun.append(True)
        try:
            told: tuple[Value | None, str] = self.turn, ""
        except NotConvergedError as error:
            told = None, str(error)
        self._begun.clear()
        return told

    @cached_property
    def _begun(self) -> list[bool]:
        """Holds an entry while :meth:`turn_or_why` computes, and after it was broken off."""
        return []

    def as_dict(self) -> dict[str, Any]:
        """Plain data, for JSON."""
        turn, why = self.turn_or_why()
        return {
            "leg": self.leg, "force": self.state.force, "height": self.height.as_dict(),
            "turn": None if turn is None else turn.as_dict(), **({"why_no_turn": why} if why else {}),
            "to": self.to.as_dict(), "saddle": self.saddle.as_dict(),
        }  # fmt: skip


def barrier(leg: Leg, events: Sequence[PathPoint], state: ContactState, control: Control, value: float) -> Barrier:
    """The saddle between a state of a leg, at a value of what is controlled, and where the rod snaps to later.

    Raises
    ------
    InputError
        If the rod does not snap after it on this leg.
    NotConvergedError
        If no such saddle was found, or descent from it did not confirm what it lies between.
    """
    over = saddle(_giving_way(leg, events, control, value), value, control)
    held = held_by(state.coarse, control, value)
    back, beyond = (_side(over, sign, held) for sign in (1.0, -1.0))
    if beyond is not None and held.near(beyond):
        back, beyond = beyond, back
    if back is None or beyond is None or not held.near(back) or held.near(beyond):
        raise NotConvergedError(
            f"descent from the saddle at {control.name} = {value:.8g} did not end in the state of the path on one "
            "side and in another one on the other: what it lies between is not known"
        )
    model = state.coarse.model
    after = settled(model, beyond) if model.soft else recognised(model, beyond.shape, control, value)
    if after is None:
        raise NotConvergedError(f"what lies beyond the saddle at {control.name} = {value:.8g} could not be solved for")
    found = contact_state(after)
    to = Destination(found.kind, found.turns, found.energy, Value(found.force, 0.0), 1, 1)
    return Barrier(leg.name, state, contact_state(over), to, held)


def _giving_way(leg: Leg, events: Sequence[PathPoint], control: Control, value: float) -> PatternedState:
    """The state in which the rod snaps next, after it has passed a value of what is controlled."""
    snaps = [event.force.value for event in events if event.kind == SNAP and event.leg == leg.name]
    passing = leg.passing(value, control)
    for run in leg.runs[len(leg.runs) if passing is None else passing :]:
        last = run[-1]
        if any(abs(last.load - load) <= 1e-6 * max(abs(load), 1.0) for load in snaps):
            return last
    raise InputError(
        control.name, value, f"the rod does not snap from there on the {leg.name} path: a barrier is that to the next "
        "snap, and a path that goes far enough has it"
    )  # fmt: skip


def saddle(event: PatternedState, value: float, control: Control) -> PatternedState:
    """The state with one direction downhill on the branch that goes back from where a state ceases to be stable.

    Raises
    ------
    NotConvergedError
        If that branch was not found, or does not come to this value.
    """
    sense = float(np.sign(value - control.value(event.solved)))
    why = "no branch that goes back from there was found"
    for aside in ASIDE:
        for sign in (1.0, -1.0):
            start = _beside(event, sign * aside, control)
            gone = None if start is None else (control.value(start.solved) - control.value(event.solved)) * sense
            if start is None or gone is None or not 0.0 < gone <= abs(value - control.value(event.solved)):
                continue
            path = followed(start, value, control=control)
            if path.ended == END and control.index_at(path.last.solved) == 1:
                return path.last
            why = f"the branch that goes back from there ends before it ({path.ended} at F = {path.last.load:.8g} B/L²)"
    raise NotConvergedError(
        f"the saddle at {control.name} = {value:.8g} was not found; the rod snaps at F = {event.load:.8g} B/L², "
        f"and {why}"
    )


def _beside(event: PatternedState, aside: float, control: Control) -> PatternedState | None:
    """The equilibrium beside one that is about to give way, displaced in the direction in which it does; unstable."""
    found = displaced(event, event.solved.shape.chain, aside)
    state = None if found is None else PatternedState(event.pattern, event.elements, found)
    if state is None or control.index_at(state.solved) != 1 or any(one.value < 0.0 for one in conditions(state)):
        return None
    return state


def _side(over: PatternedState, sign: float, held: Held) -> Solved | None:
    """Where the flow leads from one side of a saddle."""
    return flowed(over, sampler(kicked(over.solved, sign)), held.control, held.value, held.flow)
