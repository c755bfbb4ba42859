"""Why a mode has no symmetry: what the summary says must be the reason."""

from __future__ import annotations

import pytest

import rodwell


@pytest.mark.parametrize(
    ("alpha", "ends", "why"),
    [
        (90, "clamped-pinned", "unsymmetric (unequal ends)"),
        (60, "clamped-clamped", "unsymmetric (axial weight)"),
        (90, "pinned-pinned", "symmetric about mid-length"),
    ],
)
def test_reason_for_a_shape_without_symmetry(alpha: float, ends: str, why: str) -> None:
    from rodwell.answers.words.meaning import sentences

    data = {"dimensionless": {"weight": 2, "alpha": alpha, "ends": ends}, "analysis": {"modes": 1}}
    assert any(why in sentence for sentence in sentences(rodwell.answer(rodwell.Case.from_dict(data))))


def test_reason_for_a_lift_off_that_was_not_found() -> None:
    """In words, with the load to which it was sought; "end" says nothing."""
    given = {"weight": [1.5293, 1.6], "alpha": 34.887, "clearance": 0.016756, "ends": "guided-free"}
    point = rodwell.study({"dimensionless": given}).points[0]
    assert point.lift_off is None
    assert point.reasons is not None
    assert point.reasons["lift_off"].startswith("was not found: the branch was followed to the end force −21.8057 B/L²")
    assert point.reasons["lift_off"].endswith("the rod stays on the wall all the way")
