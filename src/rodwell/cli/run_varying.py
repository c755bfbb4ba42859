"""``rodwell run`` of a case whose clearance varies along its rod."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import print_json, print_written
from rodwell.cli.told import told

if TYPE_CHECKING:
    from rodwell.case.case import Case


def run_varying(case: Case, folder: Path, *, as_json: bool, quiet: bool, with_pdf: bool) -> None:
    """Compute a case whose clearance varies, write its folder, and say what it means."""
    from rodwell.answers.data.varying import varying_dict  # noqa: PLC0415
    from rodwell.answers.result.varying import varying_answer  # noqa: PLC0415
    from rodwell.answers.words.varying import varying_sentences  # noqa: PLC0415
    from rodwell.report.folders.bridged import write_varying  # noqa: PLC0415

    found, speaks = varying_answer(case), not (as_json or quiet)
    if speaks:
        click.echo(case.title)
        for sentence in varying_sentences(found):
            wrapped(sentence)

    def tell_rest(written: bool) -> None:
        if as_json:
            print_json(varying_dict(found), indent=2)
        elif speaks and written:
            print_written(folder, "report.html", with_pdf)

    with told() as ready:
        ready(tell_rest)
        write_varying(found, folder, with_pdf=with_pdf)
