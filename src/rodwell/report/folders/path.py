"""A load path as files."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from pathlib import Path

import matplotlib as mpl
from PIL import Image

from rodwell.analysis.off_wall.state import contact_state
from rodwell.analysis.path.load_path import LoadPath
from rodwell.case.case import Case
from rodwell.errors import InputError
from rodwell.plots.paths.animation import pictures
from rodwell.plots.paths.bridging import plot_bridging
from rodwell.plots.paths.path import plot_path
from rodwell.plots.style import RC
from rodwell.report.folders.figures import save_figure
from rodwell.report.pages.path import PAGE, write_path_page
from rodwell.store.folder import check_writable, whole_folder
from rodwell.store.netcdf import write_load_path
from rodwell.store.text import write_json

MOVING = ".gif", ".webp"
"""Suffixes of animations."""


def write_path(
    result: LoadPath, out: Path, at: Sequence[float] = (), case: Case | None = None, barriers: Sequence[float] = ()
) -> tuple[str, ...]:
    """Write figure (PNG, SVG), events, states at the end forces ``at`` (JSON), curve (CSV) and page to ``out``.

    In the JSON file too are ``barriers`` at other end forces.

    All states with what touches in them are in ``load-path.nc`` (NetCDF). The page shows the rod in its hole along the
    path, with a slider; of a string that bridges steps of its clearance a picture shows it from the side, at the last
    load, instead. Figure and page are in the units of ``case``.

    All files, or none; returns their names.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    planar = result.problem.leaves_wall
    with whole_folder(out) as folder:
        with mpl.rc_context(RC):
            save_figure(plot_path(result, case=case).figure, folder / "load-path")
            if planar:
                last = result.legs[-1].runs[-1][-1]
                save_figure(plot_bridging(contact_state(last)).figure, folder / "bridging")
        write_json(result.as_dict(at, barriers), folder / "load-path.json")
        write_load_path(result, folder / "load-path.nc")
        if not planar:
            write_path_page(folder / PAGE, result, case)
        curve = result.curve
        with (folder / "load-path.csv").open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(("force_s1_tension_positive", "shortening", "energy", "run"))
            for row in zip(*curve.values(), strict=True):
                writer.writerow([*(repr(float(cell)) for cell in row[:3]), int(row[3])])
        return tuple(sorted(file.name for file in folder.iterdir()))


def check_animation(file: Path, field: str = "--animation") -> None:
    """Refuse a file whose suffix is not that of an animation, or that cannot be written, before any work is done.

    Raises
    ------
    InputError
        If so; ``field`` is the name of the file's input.
    """
    if file.suffix.lower() not in MOVING:
        raise InputError(field, str(file), f"must end in {' or '.join(MOVING)}")
    check_writable(file.absolute().parent, field)


def write_animation(
    result: LoadPath,
    file: str | Path,
    case: Case | None = None,
    *,
    field: str = "file",
    progress: Callable[[float], None] | None = None,
) -> Path:
    """Write the states of a load path in order of happening as an animation, and return the file.

    Parameters
    ----------
    result
        The load path.
    file
        A GIF or WebP by its suffix, written whole or not at all.
    case
        In whose units numbers stand; None: B = L = 1.
    field
        Name of the file's input, for errors.
    progress
        Called with the part of the pictures that are drawn.

    Raises
    ------
    InputError
        If the suffix is another one, or the file cannot be written.
    """
    file = Path(file)
    check_animation(file, field)
    drawn: list[Image.Image] = []
    times: list[int] = []
    with mpl.rc_context(RC):
        for picture, milliseconds, done in pictures(result, case):
            # one palette for all: colours do not flicker, and a picture takes a tenth of the time
            drawn.append(picture.quantize(palette=drawn[0]) if drawn else picture.quantize(dither=Image.Dither.NONE))
            times.append(milliseconds)
            if progress is not None:
                progress(done)
    with whole_folder(file.absolute().parent, field) as folder:
        drawn[0].save(folder / file.name, save_all=True, append_images=drawn[1:], duration=times, loop=0)
    return file
