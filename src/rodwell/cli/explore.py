"""``rodwell explore``: the rod live in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click


@click.command(short_help="Live in the browser: move inputs and load, see the rod buckle.")
@click.argument("case", type=click.Path(path_type=Path), required=False)
@click.option(
    "--port", type=click.IntRange(0, 65535), default=0, show_default="any that is free", help="Port to listen on."
)
@click.option("--browser/--no-browser", default=True, show_default=True, help="Open the page in the browser.")
def explore(case: Path | None, port: int, browser: bool) -> None:
    """Explore a case in the browser: sliders for its inputs and the load, branches, contact, the rod in its hole.

    CASE is a case file; without it, a dimensionless rod. Prints the address of the page, which this machine alone can
    open, and serves it until Ctrl-C. Needs the extra rodwell[explore].
    """
    from rodwell.web.serve import check_installed, serve  # noqa: PLC0415

    check_installed()
    data: dict[str, Any] | None = None
    folder, source = ".", "case"
    if case is not None:
        from rodwell.case.file import read_case  # noqa: PLC0415

        read = read_case(case)
        data, folder, source = read.data, str(read.folder), read.source

    def opened(address: str) -> None:
        click.echo(f"rodwell explore: {address}   (Ctrl-C ends it)")
        if browser:
            import webbrowser  # noqa: PLC0415

            webbrowser.open(address)

    try:
        serve((data, folder, source), port, opened)
    except KeyboardInterrupt as interrupt:
        from rodwell.cli.terminal import Terminated  # noqa: PLC0415

        if isinstance(interrupt, Terminated):
            raise
