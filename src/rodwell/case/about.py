"""[report] of a case file: for whom a report is, by whom, and the logo on it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rodwell.case.kinds import Line, SectionInput, _key
from rodwell.errors import InputError

KINDS = {".png": "png", ".svg": "svg", ".jpg": "jpeg", ".jpeg": "jpeg"}
LARGEST_LOGO = 2_000_000
"""Bytes that a logo may have: it stands inside of the page."""


class ReportInput(SectionInput):
    """[report]: what stands at the head of the report, to be signed."""

    client: Line | None = _key(None, "for whom", "Example Oil plc")
    project: Line | None = _key(None, "of which it is a part", "Well A-12, 8 1/2 in section")
    author: Line | None = _key(None, "who made it", "A. Engineer")
    revision: Line | None = _key(None, "of the report", "B, for approval")
    logo: Line | None = _key(
        None, "picture at its head (PNG, JPEG, SVG), from the folder of the case file", "logo.svg",
        allowed="at most 2 MB",
    )  # fmt: skip


@dataclass(frozen=True)
class About:
    """What stands at the head of a report, as (name, text) in order; kind and content of the logo, if there is one."""

    lines: tuple[tuple[str, str], ...] = ()
    logo: tuple[str, bytes] | None = None


NOBODY = About()


def about_of(given: Mapping[str, str] | None, folder: Path) -> About:
    """Return what a report says of itself, from the section as it was checked.

    The logo is sought from the folder of the case file.

    Raises
    ------
    InputError
        If the logo is no picture that a page and a PDF can show, too large, or cannot be read.
    """
    if given is None:
        return NOBODY
    names = ("client", "project", "author", "revision")
    lines = tuple((name.capitalize(), given[name]) for name in names if name in given)
    return About(lines, _logo(given["logo"], folder) if "logo" in given else None)


def _logo(name: str, folder: Path) -> tuple[str, bytes]:
    kind = KINDS.get(Path(name).suffix.lower())
    if kind is None:
        raise InputError("report.logo", name, f"must be a picture: {', '.join(KINDS)}")
    try:
        content = (folder / name).read_bytes()
    except OSError as error:
        why = error.strerror or "unknown reason"
        raise InputError(
            "report.logo", name, f"cannot be read ({why}); its path is from the case file's folder"
        ) from None
    if len(content) > LARGEST_LOGO:
        raise InputError("report.logo", name, f"has {len(content)} bytes; at most {LARGEST_LOGO} go into a page")
    return kind, content
