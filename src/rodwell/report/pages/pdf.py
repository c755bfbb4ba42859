"""The PDF of a report, set by Typst from the same content as the page.

Typst comes as one wheel without further needs, works offline and draws vector pictures; it is an extra of the package:
``pip install 'rodwell[pdf]'``. The font is the one that Matplotlib carries, the same as in the figures; letters that it
lacks come from the system's.
"""

from __future__ import annotations

import importlib.util
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rodwell.errors import InputError
from rodwell.quantities.as_json import as_json
from rodwell.report.pages.page import Pictures, render
from rodwell.report.pages.templates import HERE
from rodwell.report.pages.viewer import Viewer
from rodwell.report.reports.content import Report
from rodwell.store.folder import whole_folder

PDF = "report.pdf"
"""Name of the file in a results folder."""

TEMPLATE = "report.typ"


def check_pdf(option: str = "--pdf") -> None:
    """Raise before any work is done if no PDF could be made.

    Raises
    ------
    InputError
        Saying how to install what is missing.
    """
    if importlib.util.find_spec("typst") is None:
        raise InputError(option, None, "needs the package typst: pip install 'rodwell[pdf]'; report.html needs nothing")


@contextmanager
def report_folder(out: str | Path, *, with_pdf: bool) -> Iterator[Path]:
    """Give the folder in which the files of ``out`` are made; all appear there at the end, or none.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF, if it is wanted, is not installed.
    """
    if with_pdf:
        check_pdf()
    with whole_folder(Path(out)) as folder:
        yield folder


def write_report(
    report: Report, pictures: Pictures, folder: Path, rod: Viewer | None = None, *, with_pdf: bool = False
) -> None:
    """Write the page of a report to ``folder``, and its PDF beside it if asked for."""
    (folder / "report.html").write_text(render(report, pictures, rod), encoding="utf-8")
    if with_pdf:
        (folder / PDF).write_bytes(pdf(report, pictures))


def pdf(report: Report, pictures: Pictures) -> bytes:
    """Return the report as PDF.

    Raises
    ------
    InputError
        If Typst is not installed.
    """
    return bytes(typeset(report, pictures))


def typeset(report: Report, pictures: Pictures, **options: Any) -> Any:
    """Return the report as Typst makes it: PDF, or with ``format="png"`` and ``ppi`` a picture of each sheet."""
    check_pdf()
    import matplotlib as mpl  # noqa: PLC0415
    import typst  # noqa: PLC0415

    files = {name: f"{name}.{kind}" for name, (kind, _) in pictures.items()}
    with tempfile.TemporaryDirectory() as home:  # Typst reads pictures from files
        for name, (_, content) in pictures.items():
            Path(home, files[name]).write_bytes(content)
        template = shutil.copy(HERE / TEMPLATE, home)
        return typst.compile(
            template,
            sys_inputs={"report": as_json(report.as_dict() | {"pictures": files})},
            font_paths=[str(Path(mpl.get_data_path(), "fonts", "ttf"))],
            **options,
        )
