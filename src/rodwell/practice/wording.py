"""Forces and places in the reader's words."""

from __future__ import annotations

from rodwell.practice.answer import Answer


def force_text(answer: Answer, value: float, error: float | None = None) -> str:
    """A force in the reader's units: SI first where the case has dimensions."""
    plain = f"{value:.6g} B/L²".replace("-", "−")
    if error is not None:
        plain = f"{value:.10g} ± {error:.1e} B/L²".replace("-", "−")
    if answer.case.scales is None:
        return plain
    return f"{answer.case.scales.text(value, 'force')} ({plain})"


def place_text(answer: Answer, s: float) -> str:
    """A place along the rod."""
    if answer.case.scales is None:
        return f"s/L = {s:.6g}"
    return f"{answer.case.scales.text(s, 'length')} from the end s = 0 (s/L = {s:.6g})"
