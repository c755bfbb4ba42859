"""``rodwell run`` of a case whose clearance has steps."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import check_missed, print_json, print_written, progress_bar
from rodwell.cli.told import told

if TYPE_CHECKING:
    from rodwell.case.case import Case


def run_bridged(case: Case, folder: Path, *, as_json: bool, quiet: bool, with_pdf: bool) -> None:
    """Compute a case whose clearance has steps, write its folder, and say what it means."""
    from rodwell.answers.data.bridged import bridged_dict  # noqa: PLC0415
    from rodwell.answers.result.bridged import bridged_answer  # noqa: PLC0415
    from rodwell.answers.words.bridged import bridged_sentences  # noqa: PLC0415
    from rodwell.report.folders.bridged import write_bridged  # noqa: PLC0415

    speaks = not (as_json or quiet)
    with progress_bar(speaks, "how the string lies") as tell:
        found = bridged_answer(case, tell)
    if speaks:
        click.echo(case.title)
        for sentence in bridged_sentences(found):
            wrapped(sentence)

    def tell_rest(written: bool) -> None:
        if as_json:
            print_json(bridged_dict(found), indent=2)
        elif speaks and written:
            print_written(folder, "report.html", with_pdf)

    with told() as ready:
        ready(tell_rest)
        write_bridged(found, folder, with_pdf=with_pdf)
    check_missed(list(found.missed), case.rtol)
