"""A printed number, the computed one, and whether they agree in all digits that are printed."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rodwell.quantities.value import Value
from rodwell.studies.paper.work import Work

DIGITS, INTERVAL, FORMULA = "digits", "interval", "formula"
"""How a claim is compared: with the digits printed, with "a ± b", or with what a printed formula gives."""

FORMULA_NOISE = 1e-11
"""Relative to a formula's value: what its evaluation in double precision may leave."""

AGREES, DOCUMENTED, UNEXPLAINED = "agrees", "differs, documented", "differs"


@dataclass(frozen=True)
class Known:
    """A difference that is understood.

    Attributes
    ----------
    correct
        What should be printed; the computed value must agree with this, or the difference is not the documented one.
    explanation
        Why the paper prints something else, as far as that is known.
    evidence
        Computes what supports the explanation, in words.
    """

    correct: str
    explanation: str
    evidence: Callable[[Work], str]


@dataclass(frozen=True)
class Claim:
    """A number of the paper and how it is computed here.

    Attributes
    ----------
    key
        Short name, unique.
    place
        Where in the paper it stands.
    quantity
        What it is, with unit and sign as printed.
    printed
        The number as printed; for a ``FORMULA`` the formula.
    compute
        The same quantity from the engine, in the unit and sign of the paper.
    rule
        How the two are compared.
    formula
        What the printed formula gives, for the rule ``FORMULA``.
    known
        The documented difference, if there is one.
    note
        What a reader should know about a number even where it agrees.
    """

    key: str
    place: str
    quantity: str
    printed: str
    compute: Callable[[Work], Value]
    rule: str = DIGITS
    formula: float | None = None
    known: Known | None = None
    note: str = ""

    def check(self, work: Work) -> Finding:
        """Compute the number and compare."""
        computed = self.compute(work)
        agrees = matches(self.printed, computed, self.rule, self.formula)
        documented, evidence = False, ""
        if not agrees and self.known is not None:
            documented = matches(self.known.correct, computed)
            evidence = self.known.evidence(work)
        return Finding(self, computed, agrees, documented, evidence)


@dataclass(frozen=True)
class Finding:
    """The outcome of one claim.

    Attributes
    ----------
    claim
        What is printed.
    computed
        What is computed, with its error.
    agrees
        Whether all printed digits agree.
    documented
        Whether they do not, and the difference is the documented one.
    evidence
        What supports the documented difference.
    """

    claim: Claim
    computed: Value
    agrees: bool
    documented: bool
    evidence: str

    @property
    def verdict(self) -> str:
        """The outcome in words."""
        return AGREES if self.agrees else DOCUMENTED if self.documented else UNEXPLAINED

    @property
    def remark(self) -> str:
        """Explanation and evidence of a difference, else the note."""
        if self.agrees or self.claim.known is None:
            return self.claim.note
        return typeset(f"{self.claim.known.explanation} {self.evidence}".strip())

    def as_dict(self) -> dict[str, Any]:
        """Return the finding as plain data, for JSON."""
        return {
            "key": self.claim.key,
            "place": self.claim.place,
            "quantity": self.claim.quantity,
            "printed": self.claim.printed,
            "computed": self.computed.value,
            "error": self.computed.error,
            "agrees": self.agrees,
            "verdict": self.verdict,
            "remark": self.remark,
        }


def matches(printed: str, computed: Value, rule: str = DIGITS, formula: float | None = None) -> bool:
    """Whether a computed value agrees with what is printed.

    ``DIGITS``: it rounds to the printed digits, to within its error, and the error is less than half a unit of the last
    one. ``INTERVAL``: it lies in "a ± b". ``FORMULA``: it is what the formula gives, to within its error.
    """
    if not (math.isfinite(computed.value) and math.isfinite(computed.error)):
        return False
    if rule == FORMULA:
        assert formula is not None
        return abs(computed.value - formula) <= computed.error + FORMULA_NOISE * max(1.0, abs(formula))
    if rule == INTERVAL:
        middle, width = (float(part) for part in printed.split("±"))
        return abs(computed.value - middle) <= width + computed.error and computed.error < width
    half = 0.5 * 10.0 ** -decimals(printed)
    close = abs(computed.value - float(printed)) <= half * (1.0 + 1e-9) + computed.error
    return close and computed.error < half


def typeset(text: str) -> str:
    """Typographic minus signs before numbers, hyphens elsewhere."""
    return re.sub(r"(?<![\w^])-(?=\d)|(?<=\de)-(?=\d)", "−", text)


def decimals(printed: str) -> int:
    """Number of digits after the point of a printed number."""
    return len(printed.partition(".")[2])
