"""Critical loads with proof: enclosed to any number of digits, numbered, none skipped.

What is proved, and how: see :mod:`rodwell.analysis.proof.inertia` for the counts and
:mod:`rodwell.analysis.proof.roots` for the enclosures. In short, each load lies in an interval at whose ends the
certified number of critical loads above differs by one. That proves that it exists, that no other load lies in the
interval, and which number it has. It holds for every inclination and every pair of ends. Where a closed form exists,
its change of sign over the same interval is proved too.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rodwell.analysis.proof.enclosures import Enclosure, bits, checked_digits, exact
from rodwell.analysis.proof.inertia import EnclosedRod
from rodwell.analysis.proof.roots import Counter, Critical, critical_values
from rodwell.errors import InputError, NotConvergedError, checked_whole
from rodwell.physics.exact import horizontal, vertical
from rodwell.problem.ends import WITH_Y_HELD, refuse_off_wall
from rodwell.problem.problem import Problem
from rodwell.problem.sections import refuse_sections
from rodwell.problem.words import ends_text

Ball = Any
"""A real number with a bound of its error: flint.arb."""

DIGITS = 30
SPARE = 2
"""Digits proved beyond those asked for, so that the last one shown is right."""
MOST_MODES = 50
HEAVIEST_AIRY = 1e6
"""γ up to which (86) and (88) are compared with, from 1: for larger |t| their series cancel as exp(⅔|t|^{3/2})."""


@dataclass(frozen=True)
class CertifiedLoad:
    """A critical load of the straight rod, with proof.

    Attributes
    ----------
    problem
        The problem that it belongs to.
    number
        1 for the load met first as compression grows: exactly ``number − 1`` loads lie above the interval.
    force
        Enclosure of the critical end force F at s = 1 in B/L², tension positive.
    multiplicity
        How many loads the interval holds. 1, unless two agree to all digits asked for.
    closed_form
        Equation of the paper whose change of sign over the interval was proved as well, or an empty text.
    """

    problem: Problem
    number: int
    force: Enclosure
    multiplicity: int
    closed_form: str

    def __repr__(self) -> str:
        return f"<CertifiedLoad {self.number}, {self.digits} digits proved: F = {float(self.force.middle):.15g} B/L²>"

    @property
    def digits(self) -> int:
        """Proved digits of the force, relative to |F| or to 1 if that is larger."""
        return self.force.digits


class CertifiedLoads(tuple[CertifiedLoad, ...]):
    """Certified loads in the order in which they are met as compression grows."""

    __slots__ = ()

    @property
    def shown(self) -> int:
        """Digits to show: those that every load has, all but the spare ones."""
        return max(min(load.digits for load in self) - SPARE, 1)

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON: decimals are texts, so that no digit is lost."""
        problem = self[0].problem
        return {
            "problem": {
                "weight": problem.weight, "alpha": problem.alpha, "clearance": problem.clearance,
                "ends": "-".join(problem.ends), "on_top": problem.on_top, "floats": problem.floats,
                **({"build": problem.build} if problem.hole is not None else {}),
            },
            "loads": [
                {
                    "mode": load.number,
                    "force": (text := load.force.text(self.shown))[0],
                    "radius": text[1],
                    "digits": load.digits,
                    "loads_above": load.number - 1,
                    "loads_in_interval": load.multiplicity,
                    "closed_form": load.closed_form,
                }
                for load in self
            ],
            "unit": "B/L^2",
            "convention": "end force at s = 1, tension positive; " + ends_text(problem),
        }  # fmt: skip


def certify(problem: Problem, modes: int = 5, *, digits: int = DIGITS) -> CertifiedLoads:
    """Critical end forces of the straight rod, proved: the first ``modes`` of them, none skipped.

    Of a rod without weight that lies along a hole of constant curvature in a vertical plane, too, as compression grows
    from an end force at which it is proved to be stable. Numbers of ``problem`` are taken as the decimals they are
    written as: clearance 0.01 is 1/100.

    Parameters
    ----------
    problem
        The rod; ``twist`` does not enter, ``turns`` must be 0.
    modes
        How many loads, 1 to 50; more where the last is one of several that agree to all digits.
    digits
        Decimal digits, 3 to 300: the half-width of an enclosure is at most 10^(−digits) |F|, or of 1 if |F| is smaller.

    Returns
    -------
    CertifiedLoads
        In the order in which they are met as compression grows. Loads that agree to all digits make one entry.

    Raises
    ------
    InputError
        If ``modes`` or ``digits`` is out of range, ``problem.turns`` is not 0, or the hole is curved otherwise: proofs
        use solutions of (64), whose coefficients vary there.
    NotConvergedError
        If a proof fails: the rod takes more than 3000 elements (300 with axial weight), or a sign cannot be decided.
    """
    _check_hole(problem)
    modes, digits = checked_whole("modes", modes, 1, MOST_MODES), checked_digits(digits)
    if problem.turns != 0:
        raise InputError("turns", problem.turns, "critical loads are those of the straight rod: turns must be 0")
    refuse_off_wall(problem.ends, "loads with proof")
    refuse_sections(
        problem.sections,
        "loads with proof are those of a uniform rod, whose solutions the counts use: ask for critical loads",
    )
    counter = Counter(lambda x: _rod(problem, x))
    step = Fraction(40 + math.sqrt(problem.lateral_weight / problem.clearance) + 0.1 * abs(problem.axial_weight))
    found = critical_values(counter, _before_all(problem), step, modes, digits + SPARE)
    equation = closed_form(problem)
    return CertifiedLoads(_load(problem, item, equation, digits) for item in found)


def _check_hole(problem: Problem) -> None:
    """Refuse a curved hole in which the second variation of the rod has coefficients that vary, or there is none."""
    if problem.hole is None:
        return
    given = next((name for name in ("axis", "walk", "weight") if getattr(problem, name)), None)
    if given is not None:
        raise InputError(
            given,
            f"{len(problem.axis)} points" if given == "axis" else getattr(problem, given),
            "must be left out: in a curved hole loads are proved of a rod without weight in constant curvature in a "
            "vertical plane, where equation (64) has constant coefficients; critical_loads (`rodwell critical`) says "
            "what is known of this one, with estimates of errors",
        )
    if "free" in problem.ends:  # which leaves κᵣ v v′ at that end
        raise InputError(
            "ends",
            "-".join(problem.ends),
            "must be clamped, pinned or guided in a curved hole, whose curvature couples place and slope of a free "
            "end, which the proofs do not know; critical_loads has these loads with estimates of their errors",
        )
    if problem.twist != 0.0 and problem.ends != ("clamped", "clamped"):
        reason = "must be 0 in a curved hole with these ends, which it turns around the hole: there is no critical load"
        raise InputError("twist", problem.twist, reason)


def _bent(problem: Problem) -> Fraction:
    """κᵣ of the rod that lies in an arc, positive on the outside of the bend."""
    build = -exact(problem.build) if problem.on_top != problem.floats else exact(problem.build)
    return build / (1 + exact(problem.clearance) * build)


def _before_all(problem: Problem) -> Fraction:
    """−F before the first load, where the count is the proof that there is none."""
    if problem.hole is not None:
        # N > −2√(P/Δ) is stable: on the outside of the bend with most to spare where that is an inequality of parabolas
        # in F; on the inside wherever N > 0. The form is linear in F: counts grow with the distance from there
        bent = _bent(problem)
        return 2 * bent / exact(problem.clearance) - 2 * bent**2 if bent > 0 else -2 * bent**2 - 1
    # ∫y² ≤ 4∫y'²/π² for functions that vanish at one end bounds what a negative foundation can do
    against = 4.0 * problem.lateral_weight / problem.clearance / math.pi**2 if problem.on_top else 0.0
    return Fraction(-2.0 - problem.heaviest - 1.001 * against)


def _load(problem: Problem, item: Critical, equation: ClosedForm | None, digits: int) -> CertifiedLoad:
    """The certified load of a critical value x = −F."""
    force = Enclosure(-item.enclosure.high, -item.enclosure.low)
    name = ""
    if equation is not None and item.multiplicity == 1:
        name = equation.name
        check_sign_change(equation, force, digits)
    return CertifiedLoad(problem, item.number, force, item.multiplicity, name)


def _rod(problem: Problem, x: Ball) -> EnclosedRod:
    """The rod at the end force −x, at the present precision."""
    weight, clearance, ends = weights(problem), ball(exact(problem.clearance)), problem.ends
    if problem.untouched and not problem.holds_angle:  # it can be turned as a whole: y(0) = 0, as in (65)
        ends = WITH_Y_HELD[ends[0]], ends[1]
    if problem.hole is not None:  # N − 2κᵣ² and P/Δ with P = −κᵣ(N − κᵣ²)
        bent = ball(_bent(problem))
        return EnclosedRod(-x - 2 * bent**2, weight[0], bent * (x + bent**2) / clearance, ends)
    foundation = weight[1] / clearance
    return EnclosedRod(-x, weight[0], -foundation if problem.on_top else foundation, ends)


def ball(value: Fraction) -> Ball:
    """A rational as a ball."""
    from flint import arb, fmpq  # noqa: PLC0415

    return arb(fmpq(value.numerator, value.denominator))


def weights(problem: Problem) -> tuple[Ball, Ball]:
    """Axial and lateral weight γ cos α (−γ cos α of a rod that floats) and γ sin α, exactly zero where they vanish."""
    from flint import arb, fmpq  # noqa: PLC0415

    weight, angle = ball(exact(problem.weight)), exact(problem.alpha) / 180
    turn = fmpq(angle.numerator, angle.denominator)
    zero = arb(0)
    axial = zero if angle == Fraction(1, 2) else (-weight if problem.floats else weight) * arb.cos_pi_fmpq(turn)
    return axial, zero if angle == 0 else weight * arb.sin_pi_fmpq(turn)


@dataclass(frozen=True)
class ClosedForm:
    """A function of the end force, in balls, whose zeros are the critical loads, with the name of its equation."""

    name: str
    function: Callable[[Ball], Ball]


def check_sign_change(equation: ClosedForm, place: Enclosure, digits: int) -> None:
    """Prove that a closed form has opposite signs at the two ends of an enclosure, or raise a NotConvergedError."""
    from flint import ctx  # noqa: PLC0415

    for factor in (1, 2, 4, 8, 16):
        with ctx.workprec(bits(digits) * factor):
            product = equation.function(ball(place.low)) * equation.function(ball(place.high))
            if product < 0:
                return
            if product > 0:
                break
    raise NotConvergedError(f"{equation.name} was not proved to change its sign at {float(place):.17g}")


def closed_form(problem: Problem) -> ClosedForm | None:
    """The closed form for the critical loads of ``problem``, None where none is compared with.

    Horizontal: (77) or its counterpart on top with both ends clamped; with one end pinned or guided, the factor of odd
    or even modes of a clamped rod of twice the length. Vertical: (86), and (88) with the upper end guided.
    """
    ends, upright, flat = problem.ends, problem.lateral_weight == 0.0, problem.axial_weight == 0.0
    if problem.weight == 0.0 or problem.axial_weight < 0.0 or problem.hole is not None:
        return None
    if flat and "clamped" in ends and "free" not in ends:
        name = "on top, section 4.3" if problem.on_top else "(77)"
        name = name if set(ends) == {"clamped"} else f"{name}, twice the length"
        return ClosedForm(name, lambda force: _flat(force, problem))
    if upright and 1.0 < problem.weight < HEAVIEST_AIRY:
        if ends == ("clamped", "clamped"):
            return ClosedForm("(86)", lambda force: vertical.scorer_determinant(force, weights(problem)[0]))
        if ends == ("clamped", "guided"):
            return ClosedForm("(88)", lambda force: vertical.sway_determinant(force, weights(problem)[0]))
    return None


def _flat(force: Ball, problem: Problem) -> Ball:
    """Closed form of a horizontal rod with a clamped end at the end force."""
    foundation = weights(problem)[1] / ball(exact(problem.clearance))
    other = {*problem.ends, "clamped"} - {"clamped"}
    if not other and not problem.on_top:
        return horizontal.buckling_equation(*horizontal.wavenumbers(force, foundation))
    if other:
        force, foundation = 4 * force, 16 * foundation
    c = foundation.sqrt()
    if problem.on_top:
        p = (((force * force + 4 * c * c).sqrt() - force) / 8).sqrt()  # of −F = 4P² − c²/(4P²)
        even, odd = horizontal.even_factor_on_top(p, c), horizontal.odd_factor_on_top(p, c)
    else:
        q = ((-force - 2 * c) / 4).sqrt()
        even, odd = horizontal.even_factor(q, c), horizontal.odd_factor(q, c)
    return {"guided": even, "pinned": odd}[other.pop()] if other else even * odd
