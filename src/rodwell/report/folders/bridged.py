"""The results folder of a case whose clearance has steps."""

from __future__ import annotations

from pathlib import Path

from rodwell.answers.data.bridged import bridged_dict, contact_table
from rodwell.answers.result.bridged import Bridged
from rodwell.plots.paths.bridging import plot_bridging
from rodwell.report.folders.single import write_single
from rodwell.report.reports.bridged import PICTURE, bridged_report


def write_bridged(found: Bridged, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report, figure, table, data and case to ``out``: all, or none; see :func:`write_single`."""
    shown = found.alone if found.buckling is None else found.buckling[1]
    return write_single(
        found.case, out, bridged_report(found),
        picture=(PICTURE, lambda: plot_bridging(shown.state, scales=found.case.scales, pairs=found.case.pairs).figure),
        table=("contact", contact_table(found)), data=("answer", bridged_dict(found)), with_pdf=with_pdf,
    )  # fmt: skip
