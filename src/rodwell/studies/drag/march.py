"""From the bit to the hook: the equations of the axial force and of the torque, integrated upwards, compiled.

Within a piece (:data:`rodwell.studies.drag.contact.PIECE`) the height gained is known in closed form, so with Λ the
contact force summed from the lower end of the piece upwards

    F = F₀ + w Δh(u) + m Λ,      T = T₀ + μ r Λ,      dΛ/du = n̄(u, F)

one equation is left, which is solved by the pair of Dormand and Prince, with the error per length held to a tolerance.
The local state, and the side on which a string in a plane hole lies, are kept during a step; where they change within
it, the step ends there. So the right-hand side is smooth in every step.
"""

from __future__ import annotations

import numpy as np

from rodwell.compiling.kernels import formula, kernel
from rodwell.studies.drag.contact import (
    ACROSS,
    AXIAL,
    LENGTH,
    RATIO,
    STRAIGHT,
    TURNING,
    WEIGHT,
    along,
    contact,
    cosine_at,
    in_plane,
    pressed,
    state_of,
)

ARRIVED, LOCKED, STALLED = 0, 1, 2
"""The top was reached; the compression grows beyond all bounds below it; a force is no number."""

ROW = ("up", "force", "torque", "contact", "pressing", "state", "piece")
"""What is recorded at both ends of every step: distance above the bit, F, T, n̄, q, the state, number of the piece."""

SHORTEST = 1e-13
"""Steps below this part of a piece are taken as they are."""

FLOOR = 0.01
"""Where the contact force is below this part of the weight, errors are measured against that."""

MANY_CHANGES, SLIDING = 20, 0.005
"""Where the state changes more often in one piece, friction drives the force back to where it changes (a string pulled
uphill under compression): there changes are noticed at the ends of steps of this part of the piece only."""


@formula
def _rate(piece, law, up, force, summed, state, sign):
    """The right-hand side dΛ/du."""
    rise, lateral = along(piece, up)
    return contact(piece, law, lateral, force + piece[WEIGHT] * rise + piece[AXIAL] * summed, state, sign)


@formula
def _step(piece, law, up, force, summed, slope, h, state, sign):
    """One step of Dormand and Prince: Λ at its end, the slope there, and the error."""
    k1 = slope
    k2 = _rate(piece, law, up + h / 5.0, force, summed + h * k1 / 5.0, state, sign)
    k3 = _rate(piece, law, up + 0.3 * h, force, summed + h * (3.0 * k1 + 9.0 * k2) / 40.0, state, sign)
    k4 = _rate(piece, law, up + 0.8 * h, force, summed + h * (44.0 * k1 - 168.0 * k2 + 160.0 * k3) / 45.0, state, sign)
    k5 = _rate(
        piece, law, up + h * 8.0 / 9.0, force,
        summed + h * (19372.0 * k1 - 76080.0 * k2 + 64448.0 * k3 - 1908.0 * k4) / 6561.0, state, sign,
    )  # fmt: skip
    k6 = _rate(
        piece, law, up + h, force,
        summed + h * (9017.0 / 3168.0 * k1 - 355.0 / 33.0 * k2 + 46732.0 / 5247.0 * k3 + 49.0 / 176.0 * k4
                      - 5103.0 / 18656.0 * k5), state, sign,
    )  # fmt: skip
    new = summed + h * (
        35.0 / 384.0 * k1 + 500.0 / 1113.0 * k3 + 125.0 / 192.0 * k4 - 2187.0 / 6784.0 * k5 + 11.0 / 84.0 * k6
    )
    k7 = _rate(piece, law, up + h, force, new, state, sign)
    error = h * (
        71.0 / 57600.0 * k1 - 71.0 / 16695.0 * k3 + 71.0 / 1920.0 * k4 - 17253.0 / 339200.0 * k5 + 22.0 / 525.0 * k6
        - 1.0 / 40.0 * k7
    )  # fmt: skip
    return new, k7, abs(error)


@formula
def _side(piece, lateral, force):
    return 1.0 if in_plane(piece, lateral, force) >= 0.0 else -1.0


@formula
def _state(piece, law, lateral, force):
    return STRAIGHT if law.kind[0] == 0.0 else state_of(piece, pressed(piece, lateral, force), force)


@formula
def _changed(piece, law, lateral, force, state, sign):
    """Whether state or side is another one than that of the step."""
    if _state(piece, law, lateral, force) != state:
        return True
    return state == STRAIGHT and piece[ACROSS] == 0.0 and sign * in_plane(piece, lateral, force) < 0.0


@kernel
def march(pieces, law, force, torque, tolerance, longest, most, rows):
    """Integrate from the lower end of the first piece to the upper end of the last.

    Parameters
    ----------
    pieces
        (k, 12), from the bit up.
    law
        Contact by local state.
    force, torque
        Effective tension in N and torque in N m at the bit.
    tolerance
        Error of the contact force summed, relative to it, per length.
    longest
        Longest step in m.
    most
        Compression in N at which the string counts as locked.
    rows
        (m, 7): filled with what :data:`ROW` says as far as it goes; (0, 7) to record nothing.

    Returns
    -------
    tuple
        Outcome; distance above the bit that was reached in m (where it locks up, the place where the compression
        becomes infinite); F and T there; rows that there were; changes of state in the piece that had most.
    """
    below, count, busiest = 0.0, 0, 0
    for i in range(pieces.shape[0]):
        piece = pieces[i]
        start, first = force, torque
        up, summed, changes = 0.0, 0.0, 0
        h = min(longest, piece[LENGTH])
        _, lateral = along(piece, 0.0)
        state = _state(piece, law, lateral, force)
        sign = _side(piece, lateral, force)
        slope = contact(piece, law, lateral, force, state, sign)
        count = _record(rows, count, below, force, torque, slope, pressed(piece, lateral, force), state, i)
        while up < piece[LENGTH]:
            last = up + h >= piece[LENGTH] * (1.0 - 1e-14)
            if last:
                h = piece[LENGTH] - up
            new, end, error = _step(piece, law, up, start, summed, slope, h, state, sign)
            allowed = tolerance * h * max(abs(slope), abs(end), FLOOR * piece[WEIGHT]) + 1e-300
            shortest = h <= SHORTEST * piece[LENGTH]
            if not error <= allowed and not shortest:
                ratio = allowed / error if error > 0.0 and error < np.inf else 0.0
                h *= max(0.1, 0.9 * ratio**0.25)
                continue
            rise, lateral = along(piece, up + h)
            force = start + piece[WEIGHT] * rise + piece[AXIAL] * new
            changed = _changed(piece, law, lateral, force, state, sign)
            if changed and not shortest and changes < MANY_CHANGES:
                h = _until_change(piece, law, up, start, summed, slope, h, state, sign)
                new, end, error = _step(piece, law, up, start, summed, slope, h, state, sign)
                last = up + h >= piece[LENGTH]
                rise, lateral = along(piece, up + h)
                force = start + piece[WEIGHT] * rise + piece[AXIAL] * new
            up = piece[LENGTH] if last else up + h
            summed = new
            torque = first + piece[TURNING] * summed
            count = _record(rows, count, below + up, force, torque, end, pressed(piece, lateral, force), state, i)
            slope = end
            if changed:
                changes += 1
                state, sign = _state(piece, law, lateral, force), _side(piece, lateral, force)
                slope = contact(piece, law, lateral, force, state, sign)
                count = _record(rows, count, below + up, force, torque, slope, pressed(piece, lateral, force), state, i)
            if -force > most:
                pole = 4.0 * piece[RATIO] / (max(abs(piece[AXIAL]), 1e-300) * -force)
                return LOCKED, below + up + pole, force, torque, count, max(busiest, changes)
            if not np.isfinite(force):
                return STALLED, below + up, force, torque, count, changes
            grown = 5.0 if error <= 0.0 else min(5.0, 0.9 * (allowed / error) ** 0.25)
            h = min(longest, h * max(0.2, grown), piece[LENGTH])
            if changes >= MANY_CHANGES:
                h = min(h, SLIDING * piece[LENGTH])
        below += piece[LENGTH]
        busiest = max(busiest, changes)
    return ARRIVED, below, force, torque, count, busiest


@formula
def _until_change(piece, law, up, start, summed, slope, h, state, sign):
    """The shortest step found, of at most ``h``, after which state or side has changed, by bisection."""
    low, high = 0.0, h
    while high - low > SHORTEST * piece[LENGTH]:
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            break
        new, _, _ = _step(piece, law, up, start, summed, slope, middle, state, sign)
        rise, lateral = along(piece, up + middle)
        if _changed(piece, law, lateral, start + piece[WEIGHT] * rise + piece[AXIAL] * new, state, sign):
            high = middle
        else:
            low = middle
    return high


@formula
def _record(rows, count, up, force, torque, n, q, state, piece):
    """Write a row, if there is room for it; return how many there would be."""
    if count < rows.shape[0]:
        rows[count, 0], rows[count, 1], rows[count, 2], rows[count, 3] = up, force, torque, n
        rows[count, 4], rows[count, 5], rows[count, 6] = q, state, piece
    return count + 1


@kernel
def summed_contact(pieces, law, rows):
    """∫ n̄ over each piece from the recorded rows, by Gauss points of the cubic through F and dF/du: an independent sum.

    ``rows`` (m, 7) as :func:`march` filled them. Returns (k,) for the pieces.
    """
    total = np.zeros(pieces.shape[0])
    root = np.sqrt(0.6)
    place = 0.0
    starts = np.zeros(pieces.shape[0])
    for i in range(pieces.shape[0]):
        starts[i] = place
        place += pieces[i, LENGTH]
    for j in range(rows.shape[0] - 1):
        i = int(rows[j, 6])
        a, b = rows[j, 0], rows[j + 1, 0]
        if int(rows[j + 1, 6]) != i or b <= a or rows[j, 5] != rows[j + 1, 5]:
            continue
        piece, h = pieces[i], b - a
        state, low = int(rows[j, 5]), a - starts[i]
        sign = _side(piece, along(piece, low + 0.5 * h)[1], 0.5 * (rows[j, 1] + rows[j + 1, 1]))
        d0 = h * (piece[WEIGHT] * cosine_at(piece, low) + piece[AXIAL] * rows[j, 3])
        d1 = h * (piece[WEIGHT] * cosine_at(piece, low + h) + piece[AXIAL] * rows[j + 1, 3])
        rise = rows[j + 1, 1] - rows[j, 1]
        for g in range(3):
            t = 0.5 + 0.5 * (g - 1.0) * root
            bend = (1.0 - t) * (d0 - rise) - t * (d1 - rise)
            force = rows[j, 1] + t * (rise + (1.0 - t) * bend)
            weight = 8.0 / 18.0 if g == 1 else 5.0 / 18.0
            total[i] += weight * h * contact(piece, law, along(piece, low + t * h)[1], force, state, sign)
    return total
