"""One self-contained HTML page for a report: opens offline, prints with its front on a sheet of its own."""

from __future__ import annotations

from dataclasses import replace

from rodwell.report.pages.templates import HERE, embedded, template
from rodwell.report.pages.viewer import Viewer
from rodwell.report.reports.content import Report, unbroken

Pictures = dict[str, tuple[str, bytes]]
"""Type ("svg" or "png") and content of each picture by name."""

STYLE = "report.css"


def render(report: Report, pictures: Pictures, rod: Viewer | None = None) -> str:
    """Return the page.

    The picture of the rod on the front can be turned where ``rod`` is given; the still one among the pictures prints,
    and stands in where the browser cannot draw in three dimensions.
    """
    images = {name: {"source": embedded(*picture), "photo": picture[0] != "svg"} for name, picture in pictures.items()}
    if rod is not None:
        rod = replace(rod, caption=unbroken(rod.caption))
    style = (HERE / "assets" / STYLE).read_text(encoding="utf-8")
    return str(template("report.html.j2").render(report=report.as_dict(), pictures=images, rod=rod, style=style))
