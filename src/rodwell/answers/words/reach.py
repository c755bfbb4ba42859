"""Loads that the branch of mode 1 does not reach, in words."""

from __future__ import annotations

from rodwell.answers.result.assessment import UNKNOWN, Assessment
from rodwell.answers.result.reach import out_of_reach, why_out_of_reach
from rodwell.answers.words.wording import forces_of
from rodwell.quantities.value import Value


def unreached(a: Assessment) -> list[str]:
    """A sentence for each reason, with the loads that it keeps from being reached, as end forces at s = 1."""
    reasons: dict[str, list[str]] = {}
    for at in a.applied:
        if not at.reached and at.what != UNKNOWN:  # what is not known is said with its reason where the load is judged
            reasons.setdefault(at.why, []).append(_load(a, at.load.force))
    until, branch = a.case.until, a.computed.first
    if until is not None and out_of_reach(branch, until):
        reasons.setdefault(why_out_of_reach(branch, a.case.scales), []).append(f"{_load(a, until)}, asked for")
    return [f"Not reached: {'; '.join(loads)}: {why}." for why, loads in reasons.items()]


def _load(a: Assessment, force: float) -> str:
    return forces_of(a.case).load(Value(force))
