"""What is said first does not wait for what is needed later."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "drill-string.toml"

LATER = {"pint", "matplotlib", "jinja2", "scipy.optimize", "rodwell.analysis.path", "rodwell.cli.maps"}
"""Slow to import: for other units, for figures, for the page, for what happens off the wall, for other commands."""

OFF_WALL = {"scipy.linalg", "rodwell.analysis.path.follow"}
"""What writing the results needs only if the rod is followed beyond lift-off."""

PROGRAM = """
import sys
import rodwell.cli.run
from rodwell.cli.main import main

said = rodwell.cli.run._verdict

def told(answer):
    said(answer)
    print("imported:", *sorted({later} & set(sys.modules)))
    import rodwell.report.folders.case
    print("to write:", *sorted({off_wall} & set(sys.modules)))
    sys.exit(0)

rodwell.cli.run._verdict = told
sys.argv = ["rodwell", "run", {case!r}, "--out", {out!r}]
main()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="one platform tells")
def test_the_verdict_waits_for_no_import_that_it_does_not_need(tmp_path: Path) -> None:
    program = PROGRAM.format(later=LATER, off_wall=OFF_WALL, case=str(EXAMPLE), out=str(tmp_path / "out"))
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, encoding="utf-8")
    assert "buckles" in done.stdout
    assert done.stdout.splitlines()[-2:] == ["imported:", "to write:"]
    assert not (tmp_path / "out").exists()
