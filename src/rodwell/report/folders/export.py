"""One state in space, as a file of another program: the format follows from the suffix."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path.events import PathState
from rodwell.analysis.space.scene import InSpace, drawn
from rodwell.analysis.space.surfaces import SIDES
from rodwell.errors import InputError, checked_whole
from rodwell.quantities.scales import Scales
from rodwell.quantities.units import to_si
from rodwell.store.folder import whole_folder
from rodwell.store.shapes import ENLARGED, WRITERS

if TYPE_CHECKING:
    from rodwell.analysis.branch.solution import Solution
    from rodwell.analysis.space.geometry import Geometry

FORMATS = {
    ".glb": "glTF scene, for viewers and presentations",
    ".stl": "surface of the rod, closed, for printing and CAD",
    ".vtu": "ParaView: surface with every field, centreline, cylinder",
    ".csv": "centreline with frames and curvatures",
    ".html": "page to turn and zoom, works offline",
    ".png": "picture",
    ".svg": "picture for print: vectors, but the rod as dots",
    ".pdf": "picture for print, as .svg",
}
"""Formats by suffix."""

FINE = 300
"""Dots per inch of the rod in pictures made of vectors."""

FOR_THE_EYE = (*ENLARGED, ".html", ".png", ".svg", ".pdf")
"""Formats that are enlarged across the axis unless told otherwise; the others are in true scale."""


def export(
    solution: Solution | ContactState | PathState,
    path: str | Path | Sequence[str | Path],
    *,
    scales: Scales | None = None,
    rod_radius: float | str | None = None,
    radial_scale: float | None = None,
    places: int | None = None,
    sides: int = SIDES,
) -> list[Path]:
    """Write a state in space to one or more files: all of them, or none.

    Parameters
    ----------
    solution
        The state, on the wall or of a rod that may have left it, as :meth:`rodwell.LoadPath.at` returns it.
    path
        File, or files: .glb (glTF), .stl, .vtu (ParaView; two more files ``NAME-centreline.vtu`` and
        ``NAME-cylinder.vtu`` beside it), .csv, .html, .png, .svg, .pdf. Folders are made.
    scales
        Of a case in physical units (``answer.case.scales``): files are in metres and newtons, and the rod has its own
        radius where the case gives its diameter. Without, in units B = L = 1.
    rod_radius
        Radius of the rod: a number in L, or text with a unit, "5 cm", where there are scales. None: that of the case,
        or 0.2 Δ, a radius to be looked at; the theory needs none.
    radial_scale
        How many times everything across the axis is enlarged; 1 is true scale. None: 1 in .stl, .vtu and .csv, a scale
        that can be read in the others; files and pictures say which.
    places, sides
        How many places along the rod, and sides around it; None: by the mesh of the solution.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        For a suffix that is not known, and for what :meth:`rodwell.Solution.geometry` refuses; if a file cannot be
        written.
    """
    files = checked_files(path)
    radius = checked_rod_radius(rod_radius, scales)
    checked_whole("sides", sides, 3, 720)
    if isinstance(solution, PathState):
        solution = solution.state
    state = solution.fine if isinstance(solution, ContactState) else solution
    out = []
    with ExitStack() as stack:
        folders = {parent: stack.enter_context(whole_folder(parent, "path")) for parent in {f.parent for f in files}}
        for file in files:
            suffix = file.suffix.lower()
            scale = 1.0 if radial_scale is None and suffix not in FOR_THE_EYE else radial_scale
            rod = drawn(state, scales, places, radius, scale)
            target = folders[file.parent] / file.name
            if suffix in WRITERS:
                written = WRITERS[suffix](target, solution, rod, scales, sides)
            else:
                written = (_write_page if suffix == ".html" else _write_picture)(target, state, rod, scales)
            out += [file.parent / item.name for item in written]
    return out


def checked_files(path: str | Path | Sequence[str | Path], field: str = "path") -> list[Path]:
    """Return the files to be written, or raise if one has a suffix that is not known, or comes twice."""
    given = [path] if isinstance(path, str | Path) else list(path)
    files = [Path(item) for item in given]
    for file in files:
        if file.suffix.lower() not in FORMATS:
            known = ", ".join(f"{suffix} ({what})" for suffix, what in FORMATS.items())
            raise InputError(field, str(file), f"must end in one of {known}")
    if len(set(files)) < len(files):
        raise InputError(field, [str(file) for file in files], "names a file twice")
    return files


def checked_rod_radius(given: float | str | None, scales: Scales | None) -> float | None:
    """Return the radius in L from a number in L, or from text with a unit where there are scales."""
    if not isinstance(given, str):
        return given
    try:
        return float(given)
    except ValueError:
        pass
    if scales is None:
        raise InputError("rod_radius", given, "must be a number in L: without scales there is no physical length")
    try:
        return to_si(given, "length") / scales.length
    except ValueError as error:
        raise InputError("rod_radius", given, str(error)) from None


def _write_page(path: Path, state: InSpace, rod: Geometry, scales: Scales | None) -> list[Path]:
    from rodwell.report.pages.viewer import view, write_viewer  # noqa: PLC0415

    write_viewer(path, view(state, scales, rod))
    return [path]


def _write_picture(path: Path, state: InSpace, rod: Geometry, scales: Scales | None) -> list[Path]:
    from rodwell.plots.rod3d import plot_rod  # noqa: PLC0415 - slow to import
    from rodwell.report.folders.figures import DPI, PNG  # noqa: PLC0415

    ax = plot_rod(state, scales, rod_radius=rod.rod_radius, radial_scale=rod.radial_scale)
    if path.suffix.lower() == ".png":
        ax.figure.savefig(path, dpi=DPI, **PNG)
        return [path]
    for collection in ax.collections:
        collection.set_rasterized(True)  # ten thousand facets: as outlines a file of megabytes, with seams
    undated = {"Date" if path.suffix.lower() == ".svg" else "CreationDate": None}
    ax.figure.savefig(path, dpi=FINE, metadata=undated)
    return [path]
