"""The paper's closed-form values, each enclosed with proof and compared with what the paper prints."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rodwell.analysis.proof.certify import DIGITS, SPARE, ClosedForm, ball, certify, check_sign_change, weights
from rodwell.analysis.proof.enclosures import Enclosure, bits, checked_digits, enclosure
from rodwell.analysis.proof.inertia import EnclosedRod, inertia
from rodwell.analysis.proof.roots import Counter, critical_values
from rodwell.errors import NotConvergedError
from rodwell.physics.exact import vertical
from rodwell.problem.problem import Problem

Ball = Any
"""A real number with a bound of its error: flint.arb."""

CLEARANCE = Fraction(1, 100)

TABLE_1 = {
    (1, 3): ("8.7668", "98.6960"), (2, 4): ("62.3418", "197.3921"), (1, 5): ("24.3523", "256.6097"),
    (3, 5): ("219.1705", "335.5665"), (2, 6): ("140.2691", "394.7842"), (4, 6): ("561.0764", "513.2194"),
    (1, 7): ("47.7305", "493.4802"), (3, 7): ("429.5741", "572.4371"), (5, 7): ("1193.2614", "730.3507"),
    (2, 8): ("249.3673", "671.1331"), (4, 8): ("997.4691", "789.5684"), (6, 8): ("2244.3055", "986.9604"),
    (1, 9): ("78.9014", "809.3076"), (3, 9): ("710.1123", "888.2644"), (5, 9): ("1972.5341", "1046.1781"),
    (7, 9): ("3866.1668", "1283.0486"), (2, 10): ("389.6364", "1026.4389"), (4, 10): ("1558.5455", "1144.8741"),
    (6, 10): ("3506.7273", "1342.2662"), (8, 10): ("6234.1818", "1618.6151"),
}  # fmt: skip
"""γ_c and −F_c as printed, by (n, m), in the paper's order."""

COUNTED = "counts at both ends"
"""Proof: certified counts differ by one."""


@dataclass(frozen=True)
class PaperValue:
    """A number that the paper prints, and its enclosure.

    Attributes
    ----------
    equation
        Where it stands.
    quantity
        What it is.
    printed
        As printed.
    value
        Enclosure of the exact number; Δ/L = 0.01 where it enters.
    proof
        How it was proved.
    """

    equation: str
    quantity: str
    printed: str
    value: Enclosure
    proof: str

    @property
    def agrees(self) -> bool:
        """Whether the exact number, rounded to as many places, is what the paper prints."""
        return self.value.rounds_to(self.printed)

    def as_dict(self, digits: int = DIGITS) -> dict[str, Any]:
        """Plain data for JSON: decimals are texts, so that no digit is lost."""
        value, radius = self.value.text(digits)
        return {
            "equation": self.equation,
            "quantity": self.quantity,
            "printed": self.printed,
            "value": value,
            "radius": radius,
            "printed_is_value_rounded": self.agrees,
            "proof": self.proof,
        }


def paper_values(digits: int = DIGITS) -> list[PaperValue]:
    """Every load that the paper gives by a closed form, enclosed with proof.

    Table 1 and (78), (79), (87), (88), columns without weight, the rod on top, and what follows from them.

    Parameters
    ----------
    digits
        Decimal digits, 3 to 300.

    Raises
    ------
    InputError
        If ``digits`` is out of range.
    NotConvergedError
        If a proof fails.
    """
    digits = checked_digits(digits) + SPARE
    columns = [load.force for load in certify(Problem(0.0), 4, digits=digits)]
    clamped = self_weights(3, digits)
    sway = sway_weights(1, digits)
    out = list(_weightless(columns, digits))
    out += table_1(digits)
    out += _lines(columns, clamped, digits)
    out += [
        PaperValue("(87)", f"γ at F = 0, clamped, {number}", printed, value, f"(86) changes sign; {COUNTED}")
        for number, printed, value in zip(
            ("first", "second", "third"), ("74.628569", "157.032783", "325.513452"), clamped, strict=True
        )
    ]
    out.append(PaperValue("(88)", "γ at F = 0, free to sway", "18.956266", sway[0], f"J_⅓ changes sign; {COUNTED}"))
    out.append(
        PaperValue("section 5", "L_cr over that of a column free to sway", "1.58",
                   _of(lambda a, b: (a / b).root(3), digits, clamped[0], sway[0]), "from (87) and (88)")
    )  # fmt: skip
    out += [
        PaperValue("section 4.3", f"γ at F = 0, on top, {number}", printed, value,
                   f"cos x cosh x = 1 changes sign; {COUNTED}")
        for number, printed, value in zip(
            ("first", "second", "third"), ("5.0056", "38.0354", "146.1763"), weights_on_top(3, digits), strict=True
        )
    ]  # fmt: skip
    upright = certify(Problem(100.0, alpha=0.0), 1, digits=digits)[0]
    out.append(PaperValue("Fig. 9", "F of mode 1, γ = 100, α = 0", "14.3626", upright.force,
                          f"(86) changes sign; {COUNTED}"))  # fmt: skip
    out.append(PaperValue("section 4.1.3", "γ at F = 0, α = 2°", "125.95", weight_at_two_degrees(digits),
                          "counts 0 and 1 at the ends; not that it is the least"))  # fmt: skip
    return out


def table_1(digits: int = DIGITS) -> list[PaperValue]:
    """All rows of Table 1: γ_c = n²m²π⁴Δ and −F_c = (n² + m²)π², with the modes that meet there.

    By (78) both factors of (77) vanish there. Certified counts just above and below F_c prove that exactly these two
    loads lie there, and how many come before: 2·pair − 2, pair = (m − n)/2.
    """
    out = []
    for (n, m), (weight_printed, load_printed) in TABLE_1.items():
        weight = _of(lambda n=n, m=m: _pi() ** 4 * (n * n * m * m) * ball(CLEARANCE), digits)
        load = _of(lambda n=n, m=m: _pi() ** 2 * (n * n + m * m), digits)
        before = m - n - 2
        _check_double(n, m, before, digits)
        modes = f"modes {before + 1} and {before + 2}"
        row, proof = f"Table 1, n = {n}, m = {m}", f"(78); counts {before} and {before + 2}"
        out.append(PaperValue(row, f"γ_c, {modes}", weight_printed, weight, proof))
        out.append(PaperValue(row, f"−F_c, {modes}", load_printed, load, proof))
    return out


def _check_double(n: int, m: int, before: int, digits: int) -> None:
    """Prove that at γ_c two loads, and no other, lie within 10^(−digits) of F_c, with ``before`` loads above."""
    from flint import arb, ctx  # noqa: PLC0415

    with ctx.workprec(2 * bits(digits)):
        force, foundation = -(_pi() ** 2) * (n * n + m * m), _pi() ** 4 * (n * n * m * m)
        gap = abs(force) * arb(10) ** (-digits)
        counts = [
            inertia(EnclosedRod(force + side * gap, arb(0), foundation, ("clamped", "clamped"))).negative
            for side in (1, -1)
        ]
    if counts != [before, before + 2]:
        raise NotConvergedError(f"Table 1, n = {n}, m = {m}: {counts} loads above and below")


def self_weights(count: int, digits: int = DIGITS) -> list[Enclosure]:
    """Enclosures of the first self-weights γ at which a clamped vertical rod buckles at F = 0: (87).

    Counted along γ: Q falls as γ grows. (86) is proved to change its sign over each.
    """
    equation = ClosedForm("(86)", lambda weight: vertical.scorer_determinant(_zero(), weight))
    return _by_weight(lambda w: EnclosedRod(_zero(), w, _zero(), ("clamped", "clamped")), equation, count, digits)


def sway_weights(count: int, digits: int = DIGITS) -> list[Enclosure]:
    """Enclosures of the first self-weights γ at which a rod free to sway at s = 1 buckles at F = 0: (88)."""
    equation = ClosedForm("(88)", vertical.sway_bessel)
    return _by_weight(lambda w: EnclosedRod(_zero(), w, _zero(), ("clamped", "guided")), equation, count, digits)


def weights_on_top(count: int, digits: int = DIGITS) -> list[Enclosure]:
    """Enclosures of the first weights γ at which a clamped rod on top buckles at F = 0, Δ/L = 0.01 (section 4.3)."""

    def equation(weight: Ball) -> Ball:
        x = (weight / ball(CLEARANCE)).root(4)
        return x.cos() - 1 / x.cosh()

    return _by_weight(
        lambda w: EnclosedRod(_zero(), _zero(), -w / ball(CLEARANCE), ("clamped", "clamped")),
        ClosedForm("cos x cosh x = 1", equation), count, digits,
    )  # fmt: skip


def _by_weight(rod: Callable[[Ball], EnclosedRod], equation: ClosedForm, count: int, digits: int) -> list[Enclosure]:
    """Critical weights along a family in which Q falls as the weight grows."""
    found = critical_values(Counter(rod), Fraction(1), Fraction(10), count, digits)
    for item in found:
        check_sign_change(equation, item.enclosure, digits)
    return [item.enclosure for item in found]


def weight_at_two_degrees(digits: int = DIGITS) -> Enclosure:
    """A weight near 125.95 at which the clamped rod at α = 2° buckles at F = 0 (section 4.1.3).

    Proved: the count at F = 0 is 0 at the lower end of the enclosure and 1 at the upper. Since weight also presses the
    rod to the wall, it is not proved that no smaller weight does it.
    """

    def rod(weight: Ball) -> EnclosedRod:
        axial, lateral = weights(Problem(1.0, alpha=2.0))
        return EnclosedRod(_zero(), weight * axial, weight * lateral / ball(CLEARANCE), ("clamped", "clamped"))

    return critical_values(Counter(rod), Fraction(120), Fraction(10), 1, digits)[0].enclosure


def _weightless(columns: list[Enclosure], digits: int) -> Iterator[PaperValue]:
    """Wavenumbers of the weightless column, after (77)."""
    for mode, name, printed in ((2, "tan(k/2) = k/2, first", "8.9868"), (4, "tan(k/2) = k/2, second", "15.4505")):
        k = _of(lambda force: (-force).sqrt(), digits, columns[mode - 1])
        yield PaperValue("after (77)", f"k₃ at γ = 0, {name}", printed, k, f"mode {mode}: {COUNTED}")


def _lines(columns: list[Enclosure], clamped: list[Enclosure], digits: int) -> Iterator[PaperValue]:
    """Slopes of the lines (79): the chords from γ = 0 to F = 0."""
    for mode, printed in ((1, "0.5290"), (2, "0.5143")):
        slope = _of(lambda force, weight: -force / weight, digits, columns[mode - 1], clamped[mode - 1])
        yield PaperValue("(79)", f"chord slope of mode {mode} to F = 0", printed, slope, "from γ = 0 and (87)")


def _of(function: Callable[..., Ball], digits: int, *places: Enclosure) -> Enclosure:
    """Enclosure of a function of enclosed numbers."""
    from flint import ctx  # noqa: PLC0415

    with ctx.workprec(2 * bits(digits)):
        return enclosure(function(*(ball(place.low).union(ball(place.high)) for place in places)))


def _pi() -> Ball:
    from flint import arb  # noqa: PLC0415

    return arb.pi()


def _zero() -> Ball:
    from flint import arb  # noqa: PLC0415

    return arb(0)
