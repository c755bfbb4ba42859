"""Which state the endless rod is in while the load grows, and while it falls."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.analysis.endless.following import BUCKLING
from rodwell.analysis.endless.limits import limits
from rodwell.analysis.endless.state import periodic_state
from rodwell.analysis.endless.waves import HELICAL, SINUSOIDAL
from rodwell.errors import NotConvergedError
from rodwell.quantities.value import Value

STRAIGHT = "straight"
BUCKLES, LIFTS_OFF, CEASES = "buckling", "lift_off", "ceases"


@dataclass(frozen=True)
class Jump:
    """From one state in full contact to another at the same load; each pair is (before, after).

    Attributes
    ----------
    to
        The state after it.
    contact_mean
        Mean contact force per length in q.
    shortening
        Axial shortening per length in √(qD³/B).
    energy_lost
        Energy per length in qD by which the state after it lies lower.
    """

    to: str
    contact_mean: tuple[Value, Value]
    shortening: tuple[Value, Value]
    energy_lost: Value


@dataclass(frozen=True)
class Stage:
    """One state on the way up, or on the way down.

    Attributes
    ----------
    leg
        ``"loading"`` or ``"unloading"``.
    state
        ``"straight"``, ``"sinusoidal"`` or ``"helical"``.
    first, last
        Loads β between which the rod is in that state, in the order in which they are passed; None: no bound.
    ends_with
        What happens at ``last``: ``"buckling"`` (also backwards, without a jump), ``"lift_off"``, ``"ceases"``, or
        nothing, ``""``.
    jump
        To which state in full contact the rod could go from there; None where it need not, or where there is none.
    """

    leg: str
    state: str
    first: Value | None
    last: Value | None
    ends_with: str
    jump: Jump | None = None


def hysteresis(slope: float) -> tuple[Stage, ...]:
    """The stages of loading, then of unloading, of a rod that stays in its state until that ends.

    The sinusoidal state grows out of the straight one without a jump. It ends where it lifts off, and so does the
    helix on the way back. What a rod that has left the wall does next is not computed here: the jumps lead to the
    only other state in full contact, for a rod that finds its way there at the same load.
    """
    loads = limits(slope)
    buckling, down = loads.buckling, loads.helix_lift_off
    up, how = (loads.sinusoidal_lift_off, LIFTS_OFF)
    if up is None:
        up, how = loads.sinusoidal_ceases, CEASES
    rises = _jump(SINUSOIDAL, HELICAL, up, slope)
    stages = [
        Stage("loading", STRAIGHT, None, buckling, BUCKLES),
        Stage("loading", SINUSOIDAL, buckling, up, how if up else "", rises),
    ]
    if rises is not None:
        stages.append(Stage("loading", HELICAL, up, loads.helix_largest, CEASES if loads.helix_largest else ""))
    begins = buckling if down is None else down
    if down is not None:
        below = SINUSOIDAL if down.value > BUCKLING else STRAIGHT
        falls = _jump(HELICAL, below, down, slope)
        stages.append(Stage("unloading", HELICAL, loads.helix_largest, down, LIFTS_OFF, falls))
    if begins.value > BUCKLING:
        stages.append(Stage("unloading", SINUSOIDAL, begins, buckling, BUCKLES))
    stages.append(Stage("unloading", STRAIGHT, begins if begins.value < BUCKLING else buckling, None, ""))
    return tuple(stages)


def _jump(kind: str, other: str, load: Value | None, slope: float) -> Jump | None:
    """From one state to another at a load; None if there is no load, or no such state in contact."""
    if load is None:
        return None
    before, after = (_numbers(each, load.value, slope) for each in (kind, other))
    if before is None or after is None:
        return None
    (e1, n1, c1), (e2, n2, c2) = before, after
    return Jump(other, (n1, n2), (c1, c2), Value(e1.value - e2.value, e1.error + e2.error))


def _numbers(kind: str, beta: float, slope: float) -> tuple[Value, Value, Value] | None:
    """Energy, mean contact force and shortening of a state in contact."""
    if kind == STRAIGHT:
        return Value(-1.0), Value(1.0), Value(0.0)
    try:
        state = periodic_state(kind, beta, slope)
    except NotConvergedError:
        return None
    pulls = state.contact_least.value < -1e-9  # at lift-off itself it is 0
    return None if pulls else (state.energy, state.contact_mean, state.shortening)
