"""The agreement table: every printed number beside the computed one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from rodwell._version import __version__
from rodwell.studies.paper.claims import AGREES, DOCUMENTED, UNEXPLAINED, Finding
from rodwell.studies.paper.items import Item, chosen
from rodwell.studies.paper.work import Work

Progress = Callable[[str, float], None]

CONVENTION = (
    "Units B = L = 1; end force F at s = 1, tension positive, −F compression; Δ/L = 0.01, ν = 0.3; both ends clamped "
    "unless said otherwise; α from the vertical; dead loads."
)


@dataclass(frozen=True)
class Agreement:
    """Findings in the order of the paper, and the tolerance they were computed to."""

    findings: tuple[Finding, ...]
    rtol: float

    def __iter__(self) -> Iterator[Finding]:
        return iter(self.findings)

    def __len__(self) -> int:
        return len(self.findings)

    def count(self, verdict: str) -> int:
        """How many findings have a verdict."""
        return sum(finding.verdict == verdict for finding in self.findings)

    @property
    def passed(self) -> bool:
        """Whether every difference is a documented one."""
        return self.count(UNEXPLAINED) == 0

    @property
    def summary(self) -> str:
        """The outcome in a sentence."""
        text = f"{len(self)} printed values: {self.count(AGREES)} agree in all printed digits"
        documented, other = self.count(DOCUMENTED), self.count(UNEXPLAINED)
        text += f", {documented} differ and are explained" if documented else ""
        return text + (f", {other} differ without explanation." if other else ".")

    def as_dict(self) -> dict[str, Any]:
        """Return the table as plain data, for JSON."""
        return {
            "convention": CONVENTION,
            "version": __version__,
            "rtol": self.rtol,
            "passed": self.passed,
            "summary": self.summary,
            "findings": [finding.as_dict() for finding in self.findings],
        }


def agreement(
    only: Sequence[str] | None = None, *, work: Work | None = None, progress: Progress | None = None
) -> Agreement:
    """Recompute the printed numbers of the paper, or of the items named in ``only``, and compare.

    Parameters
    ----------
    only
        Names of items, see :data:`rodwell.studies.paper.items.ITEMS`; None for all.
    work
        Tolerance, and what is already computed.
    progress
        Called with what is being computed and the part done.

    Raises
    ------
    InputError
        For an unknown name.
    NotConvergedError
        If something cannot be computed to the tolerance.
    """
    items, work = chosen(only), work or Work()
    pairs = [(item, claim) for item in items for claim in _claims(item)]
    findings = []
    for i, (item, claim) in enumerate(pairs):
        if progress is not None:
            progress(f"numbers: {item.title}", i / len(pairs))
        findings.append(claim.check(work))
    return Agreement(tuple(findings), work.rtol)


def _claims(item: Item) -> list[Any]:
    return item.claims() if item.claims is not None else []
