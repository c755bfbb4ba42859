"""[report]: what stands at the head of a report, and what is said of a logo that cannot be shown."""

from __future__ import annotations

from pathlib import Path

import pytest

import rodwell
from rodwell.case.about import LARGEST_LOGO

PROBLEM = {"dimensionless": {"weight": 15}}
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>'


def test_lines_in_order_and_the_logo(tmp_path: Path) -> None:
    (tmp_path / "logo.SVG").write_bytes(SVG)
    given = {"revision": "B ± 1", "client": "Oil", "logo": "logo.SVG"}
    case = rodwell.Case.from_dict({**PROBLEM, "report": given}, folder=tmp_path)
    assert case.about.lines == (("Client", "Oil"), ("Revision", "B ± 1"))  # words, no uncertain input
    assert case.about.logo == ("svg", SVG)
    assert rodwell.Case.from_dict(PROBLEM).about.lines == ()


@pytest.mark.parametrize(
    ("report", "said"),
    [
        ({"logo": "none.png"}, "report.logo = 'none.png': cannot be read"),
        ({"logo": "logo.bmp"}, "must be a picture: .png, .svg, .jpg, .jpeg"),
        ({"logo": "large.png"}, "at most 2000000 go into a page"),
        ({"client": ""}, "report.client"),
        ({"clinet": "Oil"}, "did you mean 'client'?"),
        ({"author": 5}, "report.author"),
    ],
)
def test_bad_heads(tmp_path: Path, report: dict[str, object], said: str) -> None:
    (tmp_path / "large.png").write_bytes(b"x" * (LARGEST_LOGO + 1))
    with pytest.raises(rodwell.InputError) as raised:
        rodwell.Case.from_dict({**PROBLEM, "report": report}, folder=tmp_path)
    assert said in str(raised.value)
