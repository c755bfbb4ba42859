"""The endless rod: what users ask for and hold."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from rodwell.analysis.endless.following import follow_to, start
from rodwell.analysis.endless.hysteresis import Stage, hysteresis
from rodwell.analysis.endless.limits import Limits, limits
from rodwell.analysis.endless.state import NUMBERS, PeriodicState, on_two, periodic_state
from rodwell.analysis.endless.waves import HELICAL, KINDS, SINUSOIDAL
from rodwell.errors import NotConvergedError, checked_number
from rodwell.faces import Shown, drawn
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.faces import Axes

LARGEST_BETA, LARGEST_SLOPE = 1e4, 1.0

UNIT = "q (contact, per length), qD (energy, per length), 1/l (frequency, rate), l = (B D/q)^(1/4)"
CONVENTION = (
    "beta = P/sqrt(B q/D) with the compression P positive and the normal load q per length of weight and the hole's "
    "curvature together; slope = (q D^3/B)^(1/4); rod kept on the wall, frictionless, wavelength of least energy; "
    "curvature in sqrt(q D/B), shortening per length in sqrt(q D^3/B), amplitude in rad"
)
DISTURBANCES = "dead load, kept on the wall, Bloch waves of 48 wavelengths from two periods to a hundred"


@dataclass(frozen=True)
class Endless(Shown):
    """A rod without ends on the wall of a hole: its states under one load, and the loads at which they change.

    Compression is positive here: β = P/√(Bq/D).

    Attributes
    ----------
    beta
        The load; None: only the loads at which something happens were asked for.
    slope
        ε = (qD³/B)^¼, 0 for small slopes.
    sinusoidal, helical
        The states at β, None where there is none.
    reasons
        Why there is none, by the name of the state.
    """

    beta: float | None
    slope: float
    sinusoidal: PeriodicState | None
    helical: PeriodicState | None
    reasons: dict[str, str]

    @property
    def states(self) -> dict[str, PeriodicState]:
        """The states that there are, by name."""
        both = {SINUSOIDAL: self.sinusoidal, HELICAL: self.helical}
        return {kind: state for kind, state in both.items() if state is not None}

    @property
    def loads(self) -> Limits:
        """Loads at which something happens, as compression β."""
        return limits(self.slope)

    @cached_property
    def history(self) -> tuple[Stage, ...]:
        """The states that the rod passes while the load grows, and while it falls again."""
        return hysteresis(self.slope)

    @property
    def converged(self) -> bool:
        """Whether every number of every state meets the tolerance 1e-8, relative to its own size or to 1."""
        numbers = [getattr(state, name) for state in self.states.values() for name in NUMBERS]
        loads = [load for load in self.loads.named().values() if load is not None]
        return all(number.within(RTOL, max(1.0, abs(number.value))) for number in (*numbers, *loads))

    def plot(self, ax: Axes | None = None, *, number: str = "contact") -> Axes:
        """Draw the states over β; return the axes.

        Parameters
        ----------
        number
            ``"contact"``: mean, largest and least contact force; or the name of a number of
            :class:`~rodwell.analysis.endless.state.PeriodicState`.
        """
        return drawn(self, ax, number=number)

    def as_dict(self) -> dict[str, Any]:
        """The states under the load, or, without a load, the loads, as plain data for JSON."""
        out: dict[str, Any] = {"slope": self.slope}
        if self.beta is None:
            out |= {"loads": {name: _plain(load) for name, load in self.loads.named().items()}}
            out |= {"history": [_stage(stage) for stage in self.history]}
        else:
            out |= {"beta": self.beta, **{kind: self._state(kind) for kind in KINDS}}
        return out | {"converged": self.converged, "unit": UNIT, "convention": CONVENTION}

    def _state(self, kind: str) -> dict[str, Any]:
        state = self.states.get(kind)
        if state is None:
            return {"reached": False, "reason": self.reasons[kind]}
        numbers = {name: _plain(getattr(state, name)) for name in NUMBERS}
        told = state.stability
        stability = {"stable": told.stable, "softest": _plain(told.softest), "wavenumber": told.wavenumber}
        return {
            "reached": True,
            **numbers,
            "in_contact": state.in_contact,
            "stability": stability | {"against": DISTURBANCES},
        }

    def __repr__(self) -> str:
        slope = f", slope {self.slope:g}" if self.slope else ""
        if self.beta is None:
            return f"<endless rod{slope}: {self.loads!r}>"
        states = "; ".join(
            f"{kind}: mean contact {state.contact_mean.value:.6g} q" + ("" if state.in_contact else ", on paper only")
            for kind, state in self.states.items()
        )
        return f"<endless rod at beta {self.beta:g}{slope}: {states or 'straight'}>"


def endless(beta: float | None = None, slope: float = 0.0) -> Endless:
    """States of a rod far from its ends, kept on the wall of a hole, from one load and one slope.

    Parameters
    ----------
    beta
        Load β = P/√(Bq/D): compression P (positive), bending stiffness B, normal load q per length (lateral weight and
        the curvature of the hole together, as vectors), distance D of the rod's axis from the hole's; at most 1e4.
        None: only the loads at which something happens.
    slope
        ε = (qD³/B)^¼, from 0 (small slopes) to 1; in wells about 0.01.

    Raises
    ------
    InputError
        If a number is not allowed.

    Notes
    -----
    The sinusoidal and the helical state have the wavelength of least energy. Errors are those of cut Fourier series and
    of round-off, below 1e-10 but next to buckling and where states cease. After R. Dawson and P. R. Paslay, *J.
    Petroleum Technology* 36 (1984) 1734, for buckling; the states are computed here.
    """
    slope = checked_number("slope", slope, 0.0, LARGEST_SLOPE, "from 0 (small slopes) to 1: slope = (q D³/B)^¼")
    if beta is None:
        return Endless(None, slope, None, None, {})
    allowed = (
        f"a compression from 0 to {LARGEST_BETA:g} (compression is positive in beta; a rod in tension is straight)"
    )
    beta = checked_number("beta", beta, 0.0, LARGEST_BETA, allowed)
    states: dict[str, PeriodicState | None] = {}
    reasons = {}
    for kind in KINDS:
        try:
            states[kind] = periodic_state(kind, beta, slope)
        except NotConvergedError as error:
            states[kind], reasons[kind] = None, str(error)
    return Endless(beta, slope, states[SINUSOIDAL], states[HELICAL], reasons)


def _plain(number: Value | None) -> dict[str, float] | None:
    return None if number is None else number.as_dict()


def _stage(stage: Stage) -> dict[str, Any]:
    jump = stage.jump
    told = (
        None
        if jump is None
        else {
            "to": jump.to,
            "contact_mean": [_plain(number) for number in jump.contact_mean],
            "shortening": [_plain(number) for number in jump.shortening],
            "energy_lost": _plain(jump.energy_lost),
        }
    )
    ends = {"from": _plain(stage.first), "to": _plain(stage.last)}
    return {"leg": stage.leg, "state": stage.state, **ends, "ends_with": stage.ends_with or None, "jump": told}


def states_over(kind: str, slope: float, betas: FloatArray) -> list[PeriodicState]:
    """States of a kind at rising loads, those that there are: for curves over β.

    Each is the one before followed to the next load, so that many cost little.
    """
    found: list[PeriodicState] = []
    for beta in betas if kind == SINUSOIDAL else betas[::-1]:
        try:
            known = found[-1].coarse if found else start(kind, float(beta), slope)
            found.append(on_two(follow_to(known, float(beta))))
        except NotConvergedError:
            if found:
                break
    return found if kind == SINUSOIDAL else found[::-1]
