"""The results folder of tubing in a packer."""

from __future__ import annotations

from pathlib import Path

from rodwell.plots.wells.packer import plot_packer
from rodwell.report.folders.single import write_single
from rodwell.report.reports.packer import packer_report
from rodwell.studies.packer.packer import PackerAnswer
from rodwell.studies.packer.tables import packer_dict, packer_table


def write_packer(answer: PackerAnswer, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report, figure, table, data and case to ``out``: all, or none; see :func:`write_single`."""
    return write_single(
        answer.case, out, packer_report(answer),
        picture=("packer", lambda: plot_packer(answer).figure), table=("packer", packer_table(answer)),
        data=("packer", packer_dict(answer)), with_pdf=with_pdf,
    )  # fmt: skip
