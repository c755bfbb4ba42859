"""``--figure`` and ``--out`` of commands that answer with a few numbers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from rodwell.cli.options import OutPath
from rodwell.errors import printable

if TYPE_CHECKING:
    from rodwell.report.folders.numbers import Numbers


class Keep(NamedTuple):
    """Where numbers are kept beside the terminal: a picture's file, a folder; None where not asked for."""

    figure: Path | None
    out: Path | None


def keep_options(what: str = "", *, figure: bool = True) -> Callable[[Any], Any]:
    """Options ``--figure``, which draws ``what``, and ``--out``."""

    def decorate(function: Any) -> Any:
        files = "numbers and figure" if figure else "the numbers"
        out = click.option("--out", type=OutPath(), help=f"Folder for {files}, as files.")
        function = out(function)
        if figure:
            text = f"Draw {what} to a file: .png, .svg or .pdf."
            function = click.option("--figure", type=OutPath(), help=text)(function)
        return function

    return decorate


def take_keep(given: dict[str, Any]) -> Keep:
    """Take these options out of what was given; what cannot be written is said before anything is computed."""
    figure, out = given.pop("figure", None), given.pop("out")
    if figure is not None:
        from rodwell.report.folders.figures import check_format  # noqa: PLC0415

        check_format(figure, "--figure")
    if figure is not None or out is not None:
        from rodwell.store.folder import check_writable  # noqa: PLC0415

        for folder, option in ((None if figure is None else figure.parent, "--figure"), (out, "--out")):
            if folder is not None:
                check_writable(folder, option)
    return Keep(figure, out)


def keep(where: Keep, numbers: Callable[[], Numbers], *, quiet: bool) -> None:
    """Write numbers where they are to be kept, and say so unless ``quiet``."""
    if where.figure is None and where.out is None:
        return
    from rodwell.report.folders.numbers import write_figure, write_numbers  # noqa: PLC0415

    kept = numbers()
    if where.figure is not None:
        write_figure(kept, where.figure)
    if where.out is not None:
        write_numbers(kept, where.out)
    if not quiet:
        places = ", ".join(printable(str(place)) for place in where if place is not None)
        click.echo(f"\nWritten: {places}")
