"""The results folders of cases with several clearances: by steps, or varying along the rod."""

from __future__ import annotations

from pathlib import Path

from rodwell.answers.data.bridged import bridged_dict, contact_table
from rodwell.answers.data.varying import varying_dict, varying_table
from rodwell.answers.result.bridged import Bridged
from rodwell.answers.result.varying import Varying
from rodwell.plots.paths.bridging import plot_bridging
from rodwell.plots.profiles import plot_modes
from rodwell.report.folders.single import write_single
from rodwell.report.reports.bridged import PICTURE, bridged_report
from rodwell.report.reports.varying import PICTURE as MODES
from rodwell.report.reports.varying import varying_report


def write_bridged(found: Bridged, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report, figure, table, data and case to ``out``: all, or none; see :func:`write_single`."""
    shown = found.alone if found.buckling is None else found.buckling[1]
    return write_single(
        found.case, out, bridged_report(found),
        picture=(PICTURE, lambda: plot_bridging(shown.state, scales=found.case.scales, pairs=found.case.pairs).figure),
        table=("contact", contact_table(found)), data=("answer", bridged_dict(found)), with_pdf=with_pdf,
    )  # fmt: skip


def write_varying(found: Varying, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report, figure, table, data and case to ``out``: all, or none; see :func:`write_single`."""
    return write_single(
        found.case, out, varying_report(found),
        picture=(MODES, lambda: plot_modes(found.critical, scales=found.case.scales).figure),
        table=("critical", varying_table(found)), data=("answer", varying_dict(found)), with_pdf=with_pdf,
    )  # fmt: skip
