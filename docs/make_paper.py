"""Table and figures of the page on validation, called by ``make_pages``: everything is computed here."""

from __future__ import annotations

from pathlib import Path

from shown import number

import rodwell
from rodwell.plots.paper.figures import DRAW
from rodwell.plots.paper.frame import context
from rodwell.report.folders.paper import markdown
from rodwell.studies.paper.agreement import agreement
from rodwell.studies.paper.items import ITEMS
from rodwell.studies.paper.work import Work

FIGURES = ("fig4", "fig9", "fig10")
"""Figures shown on the page: those that take a second at most."""

DPI = 140

COMMANDS = {"paper-list": "paper --list", "paper-some": "paper --only eq87,eq88 --no-figures --out results/paper"}


def pages(out: Path) -> dict[str, str]:
    """Return the agreement table, and draw figures into ``out``; a difference without explanation ends the build."""
    work = Work()
    table = agreement(work=work)
    if not table.passed:
        raise RuntimeError(f"docs: {table.summary}")
    for name in FIGURES:
        compute = ITEMS[name].figure
        assert compute is not None
        figure = DRAW[name](compute(work))
        with context():
            figure.savefig(out / f"{name}.png", dpi=DPI)
    return {"agreement.md": markdown(table)}


def numbers() -> dict[str, str]:
    """Bifurcations that the paper does not mention, quoted in the text."""
    out = {}
    for key, problem, mode, until in (
        ("on_top_65_2", rodwell.Problem(65, on_top=True), 2, -420.0),
        ("fourth_15", rodwell.Problem(15), 4, -450.0),
    ):
        branch = rodwell.follow(problem, mode, until=until)
        out[key] = number(next(p.force for p in branch.special_points if p.kind == "branch_point"), 6)
    for weight in (15.5, 16.5, 17.6):
        again = rodwell.torsion(rodwell.Problem(weight)).again
        assert again is not None
        out[f"again_{10 * weight:.0f}"] = number(again.value, 6)
    return out
