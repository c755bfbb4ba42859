"""The folders of a bifurcation diagram and of curves in two parameters."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.diagram import Diagram
from rodwell.analysis.curves.curve import Curve
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.quantities.table import Cell, Table
from rodwell.report.folders.beside import Start, Work
from rodwell.store.folder import whole_folder
from rodwell.store.netcdf import write_branches
from rodwell.store.netcdf import write_curves as write_curves_netcdf
from rodwell.store.tables import write_csv
from rodwell.store.text import write_json


def write_diagram(diagram: Diagram, out: Path, start: Start | None = None) -> tuple[str, ...]:
    """Write figure, branches (NetCDF) and special points (JSON) of a diagram to ``out``: all files, or none.

    ``start`` starts a second process for :func:`drawing_diagrams`; without it the figure is drawn here. States off the
    wall, where branches leave it, are in the NetCDF file and in a table (CSV). Returns the names of the files.
    """
    shown = [branch for branch in diagram.branches if branch.parameter == "force"], diagram.critical
    pictures = start(*shown) if start else lambda: drawing_diagrams()(*shown)
    with whole_folder(out) as folder:
        write_branches(diagram, folder / "branches.nc")
        for suffix, content in pictures().items():
            (folder / f"diagram.{suffix}").write_bytes(content)
        write_json(diagram.as_dict(), folder / "diagram.json")
        if any(branch.beyond is not None for branch in diagram.branches):
            write_csv(off_wall_table(diagram), folder / "off-wall.csv")
        return tuple(sorted(file.name for file in folder.iterdir()))


def off_wall_table(diagram: Diagram) -> Table:
    """States off the wall of all branches of a diagram, in the order of travel."""
    columns = (
        "branch", "end force at s = 1, tension positive [B/L^2]", "energy relative to the straight rod [B/L]",
        "approach of the ends [L]", "largest gap [clearance]", "stability index",
    )  # fmt: skip
    rows: list[tuple[Cell, ...]] = []
    for branch in diagram.branches:
        if branch.beyond is not None:
            off, name = branch.beyond, branch.name
            numbers = (off.force, off.numbers("energy"), off.numbers("end_shortening"), off.largest_gap)
            for *values, index in zip(*numbers, off.stability_index, strict=True):
                rows.append((name, *map(float, values), int(index)))
    return Table("off the wall", columns, tuple(rows))


def write_curves(curves: Sequence[Curve], out: Path) -> tuple[str, ...]:
    """Write figure, points (NetCDF and JSON) of curves to ``out``: all files, or none. Returns their names."""
    with whole_folder(out) as folder:
        _draw_curves(curves, folder)
        write_curves_netcdf(curves, folder / "curves.nc")
        write_json({"curves": [curve.as_dict() for curve in curves]}, folder / "curves.json")
        return tuple(sorted(file.name for file in folder.iterdir()))


def drawing_diagrams() -> Work:
    """Ready to draw bifurcation diagrams as PNG and SVG (bytes, by suffix): what that takes is imported.

    They show end curvature, or energy for a coil, against compression.
    """
    import matplotlib as mpl  # noqa: PLC0415 - half a second, in the second process

    from rodwell.plots.bifurcation import plot_bifurcation  # noqa: PLC0415
    from rodwell.plots.style import RC  # noqa: PLC0415
    from rodwell.report.folders.figures import png_and_svg  # noqa: PLC0415

    def draw(branches: Sequence[Branch], critical: CriticalLoads) -> dict[str, bytes]:
        with mpl.rc_context(RC):
            return png_and_svg(plot_bifurcation(branches, critical).figure)

    return draw


def _draw_curves(curves: Sequence[Curve], folder: Path) -> None:
    """Draw curves as PNG and SVG."""
    import matplotlib as mpl  # noqa: PLC0415 - half a second, when there are curves to draw

    from rodwell.plots.curves import plot_curves  # noqa: PLC0415
    from rodwell.plots.style import RC  # noqa: PLC0415
    from rodwell.report.folders.figures import save_figure  # noqa: PLC0415

    with mpl.rc_context(RC):
        save_figure(plot_curves(curves).figure, folder / "curves")
