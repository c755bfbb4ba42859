"""The tutorial: its cells run, its numbers are those known from elsewhere, and it is kept without outputs.

The documentation executes it in Jupyter; here its code runs as a script, which needs no more than the package.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

TUTORIAL = Path(__file__).resolve().parents[2] / "examples" / "tutorial.ipynb"


@pytest.fixture(scope="module")
def notebook() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(TUTORIAL.read_text(encoding="utf-8"))
    return found


def test_tutorial_is_kept_without_outputs(notebook: dict[str, Any]) -> None:
    assert notebook["nbformat"] == 4
    for cell in notebook["cells"]:
        assert cell.get("outputs", []) == []
        assert cell.get("execution_count") is None


def test_cells_of_the_tutorial_run(notebook: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    from matplotlib import pyplot

    before = mpl.get_backend()
    pyplot.switch_backend("agg")
    pyplot.close("all")  # what other tests left open does not count
    names: dict[str, Any] = {}
    try:
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                exec(compile("".join(cell["source"]), cell["id"], "exec"), names)
        assert len(pyplot.get_fignums()) == 6
    finally:
        pyplot.close("all")
        pyplot.switch_backend(before)
    assert "agree" in capsys.readouterr().out
    assert names["branch"].lift_off.s == pytest.approx((0.5,))
    # a rod without weight, clamped and pinned, buckles at 4.4934² B/L² = 20.19 B/L²: the wire is almost that
    wire = names["study"].points[2].compression("critical").value
    assert wire == pytest.approx(4.493409**2 * 1400e-6 / 0.12**2, rel=0.01)
    # the stress by another way: curvature as the second derivative of the centreline in space, plus |F|/A
    state = names["answer"].first.at(names["case"].until)
    rod = state.geometry(4001)
    bend = np.linalg.norm(np.diff(rod.centreline, 2, axis=0), axis=1) * 4000.0**2
    force = abs(names["case"].until) * names["scales"].factor("force")
    expected = (200e9 * 0.05 * bend.max() / 30.0 + force / (np.pi * 0.05**2)) / 1e6
    assert names["largest"] == pytest.approx(expected, rel=2e-3)
