"""Downhill from a shape that is no equilibrium: linearly implicit Euler steps on the gradient flow, behind a soft rim.

The disc's rim is a spring here, ½k(R − 1)² per length where R > 1: whatever touches it, and where, is found by the
flow, not prescribed. A minimum found like this is close to one behind the hard rim, as 1/k, and tells the pattern of
contact.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rodwell.numerics.stretches.assembly import Assembled, assemble, bubbles_of
from rodwell.numerics.stretches.bordered import Row, bordered, residuals
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.newton import MOST_MOVED, Solved, solve
from rodwell.quantities.arrays import FloatArray

FIRST_RATE, LOWEST_RATE, HIGHEST_RATE = 2e3, 1e-1, 1e9
"""Inverse step of time: the first, one at which the flow is like Newton's method, and one at which it gives up."""

MOST_EULER_STEPS = 1000

WANTED, MOST = 0.3, 3.0
"""By which part of itself a step would be corrected if the equations were solved exactly: wanted, and how many times
that is accepted."""

AT_REST = 1e-7
"""Steps below this, in coordinates of nodes, are round-off: what corrects them tells nothing."""

SLOWER, LEAST_SLOWER, FASTER = 2.5, 1.5, 0.4
"""Most by which the rate grows, least by which it does after a step that was too wrong, and most by which it falls."""

STEEPEST, FORGOTTEN = 8.0, 0.85
"""With which power of the rate a step becomes less wrong: two steps from one shape tell, the first of them refused.

No more than the first; and where nothing was refused what they told is forgotten by this factor from step to step.
"""

POSITION_MASS, SLOPE_MASS = 0.5, 1.0 / 105.0
"""Mass at a node from an element beside it: of values, times its length, and of slopes, times its cube."""

JOINED, LINGERED = 1e-3, 0.1
"""Distance from another way downhill, in radii of the disc, within which one is on it, and part of the speed that comes
later below which a way lingers beside a saddle.

The speed of the flow is a small disturbance of it that is carried along: by as much as it grows, others may. So ways
that are close where one lingers may part yet, and those that are close later are one to ten times that distance.
"""


@dataclass(eq=False, repr=False)
class Way:
    """A way downhill from where it lingered last: places of the nodes at each step (k, 2n), and where it led."""

    places: FloatArray
    end: Solved

    def passes(self, place: FloatArray) -> bool:
        """Whether nodes at a place (2n,) lie on the way: on a chord between two steps."""
        start, chord = self.places[:-1], np.diff(self.places, axis=0)
        part = np.sum((place - start) * chord, axis=1) / np.maximum(np.sum(chord**2, axis=1), 1e-30)
        off = place - start - np.clip(part, 0.0, 1.0)[:, None] * chord
        return bool(np.min(np.max(np.abs(off), axis=1), initial=np.inf) <= JOINED)


def way_from(places: FloatArray, rates: FloatArray, end: Solved) -> Way:
    """The way through ``places`` (k+1, 2n), in steps of the times 1/``rates`` (k,), that led to ``end``."""
    speeds = np.max(np.abs(np.diff(places, axis=0)), axis=1) * rates
    later = np.maximum.accumulate(speeds[::-1])[::-1]
    lingers = np.flatnonzero(speeds < LINGERED * later)
    return Way(places[lingers[-1] + 1 if lingers.size else 0 :], end)


@dataclass(frozen=True)
class SoftRim:
    """A model behind a soft rim."""

    model: Any
    stiffness: float

    def drift(self, s: FloatArray, u: FloatArray, load: float, mixed: FloatArray, given: FloatArray) -> FloatArray:
        """That of the model."""
        return np.asarray(self.model.drift(s, u, load, mixed, given))

    def rim(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """That of the model: on a hard rim nothing is added."""
        kept: tuple[FloatArray, ...] = self.model.rim(s, u, load, given)
        return kept

    def interior(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density with rim."""
        energy, by_load, gradient, mixed, hessian = self.model.interior(s, u, load, given)
        energy = energy + pressed_in(self.stiffness, u[:, 0], gradient, hessian)
        return energy, by_load, gradient, mixed, hessian


def pressed_in(stiffness: float, place: FloatArray, gradient: FloatArray, hessian: FloatArray) -> FloatArray:
    """Energy ½k(R − 1)² of a soft rim per length where the place (2, …) is beyond it.

    Its first and second derivatives are added to ``gradient`` (2, 3, …) and ``hessian`` (2, 3, 2, 3, …).
    """
    radius = np.maximum(np.hypot(*place), 1.0)  # within the rim nothing pushes: the normal there does not matter
    depth = radius - 1.0
    push, normal = stiffness * depth / radius, place / radius
    gradient[:, 0] += push * place
    pressed = (stiffness * (depth > 0.0) - push) * normal[:, None] * normal
    pressed[0, 0] += push
    pressed[1, 1] += push
    hessian[:, 0, :, 0] += pressed
    return np.asarray(0.5 * stiffness * depth**2)


def _mass(shape: Shape) -> FloatArray:
    """Mass of the nodes' coordinates as blocks (n, 4, 4): lumped, and none for the bubbles, which follow at once."""
    h = np.diff(shape.places)
    out = np.zeros((h.size + 1, 4, 4))
    for k in range(4):
        mass = POSITION_MASS * h if k < 2 else SLOPE_MASS * h**3
        out[:-1, k, k] += mass
        out[1:, k, k] += mass
    return out


def descended(
    model: Any,
    shape: Shape,
    stiffness: float,
    row: Row,
    index: Callable[[Solved], int],
    wanted: float = WANTED,
    ways: list[Way] | None = None,
) -> Solved | None:
    """The minimum of the energy behind a rim of this stiffness to which the flow leads from ``shape``, free everywhere.

    ``row`` is what is held on the way, and ``index`` the stability index where it is. The way is followed the closer,
    the less of itself a step is ``wanted`` to be wrong by. None if the flow does not come to rest.

    Where it comes upon one of ``ways``, from other shapes of the same chain, the rest is known: from there on they are
    one, within what steps are wrong by. A way that joins none is added.
    """
    rim, rate = SoftRim(model, stiffness), FIRST_RATE
    out, mass = assemble(rim, shape), _mass(shape)
    walked, rates = [shape.cartesian[:, :2].ravel()], []
    refused, steepness = None, 1.0
    for _ in range(MOST_EULER_STEPS):
        pulled = replace(out, diagonal=out.diagonal + rate * mass)
        ahead, wrong = None, np.inf
        if index(Solved(rim, pulled)) == 0:
            ahead, wrong = _euler_step(rim, pulled, row, rate * mass)
        if ahead is None or wrong > MOST * wanted:
            refused = rate, wrong
            rate *= min(max((wrong / wanted) ** (1.0 / steepness), LEAST_SLOWER), SLOWER)
            if rate > HIGHEST_RATE:
                return None
            continue
        steepness = max(FORGOTTEN * steepness, 1.0)
        if refused is not None and np.isfinite(refused[1]):
            steepness = min(max(math.log(refused[1] / wrong) / math.log(rate / refused[0]), 1.0), STEEPEST)
        refused = None
        out = ahead
        walked.append(out.shape.cartesian[:, :2].ravel())
        rates.append(rate)
        met = next((way for way in ways or () if way.passes(walked[-1])), None)
        if met is not None:
            return met.end
        rate *= min(max((wrong / wanted) ** (1.0 / steepness), FASTER), SLOWER)
        if rate < LOWEST_RATE:
            rest = solve(rim, out.shape, row)[1]
            if rest is not None and index(rest) == 0:
                if ways is not None:
                    ways.append(way_from(np.array(walked), np.array(rates), rest))
                return rest
            rate *= 64.0
    return None


def _euler_step(rim: SoftRim, pulled: Assembled, row: Row, pull: FloatArray) -> tuple[Assembled | None, float]:
    """One Newton step of implicit Euler, and what part of it another one with the same matrix would add.

    ``pull`` (n, 4, 4) is the mass over the step of time, which ``pulled`` has in its Hessian.
    """
    matrix, shape = bordered(pulled, row), pulled.shape
    nodes, breaks, load = matrix.increments(*residuals(pulled, row))
    size = float(np.max(np.abs(nodes)))
    if not np.isfinite(size) or float(np.max(np.abs(nodes[:, :2]))) > MOST_MOVED:
        return None, np.inf
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        ahead = assemble(rim, shape.moved(nodes, bubbles_of(pulled, nodes, breaks, load, 1.0), breaks, load))
    if not np.isfinite(ahead.energy):
        return None, np.inf
    residual, moments, lacks = residuals(ahead, row)
    more = matrix.increments(residual + (pull @ nodes[..., None])[..., 0], moments, lacks)[0]
    return ahead, float(np.max(np.abs(more))) / max(size, AT_REST)
