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
