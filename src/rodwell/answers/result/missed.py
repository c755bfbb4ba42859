"""Which numbers of an answer miss the tolerance, in words."""

from __future__ import annotations

from rodwell.analysis.branch.missed import missed as missed_on
from rodwell.answers.result.answer import Answer
from rodwell.quantities.text import with_error


def missed(answer: Answer) -> list[str]:
    """Return what misses the tolerance: key numbers first, then branches, then states at loads."""
    rtol = answer.case.rtol
    out = [
        f"{key.label}: {with_error(key.number, 8)}"
        for key in answer.key_numbers.values()
        if not key.number.within(rtol, key.scale)
    ]
    for branch in answer.branches:
        out += missed_on(branch)
    states = (at.state for at in answer.assessment.applied if at.state is not None)
    out += [f"the state {s.name}" for s in states if s.solution is not None and not s.solution.converged]
    return out
