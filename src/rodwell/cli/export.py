"""``rodwell export``: one state of a case in space, for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.off_wall import off_wall_option
from rodwell.cli.options import OutPath, check_missed, force_at, note_rigid_wall, progress_bar, units_option
from rodwell.errors import printable
from rodwell.quantities.text import plain

if TYPE_CHECKING:
    from rodwell.analysis.branch.solution import Solution
    from rodwell.analysis.off_wall.state import ContactState
    from rodwell.case.case import Case

LIFT_OFF = "lift-off"


@click.command(short_help="Write one state of a case in space: glTF, STL, VTK, picture.")
@click.argument("case", type=click.Path(path_type=Path))
@click.option(
    "--at",
    default=LIFT_OFF,
    show_default=True,
    help='End force at s = 1, tension positive, with its unit ("-130 kN", a plain number in B/L² without dimensions).',
)
@click.option(
    "--to", "files", type=OutPath(), multiple=True, required=True,
    help="File; the suffix says the format: .glb, .stl, .vtu, .csv, .html, .png, .svg, .pdf. More than one is fine.",
)  # fmt: skip
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@click.option("--mirror", is_flag=True, help="The other arm, ω₂(1) > 0.")
@off_wall_option
@click.option("--rod-radius", help='Radius of the rod, "5 cm" or a number in L.  [default: the case\'s, or 0.2 Δ]')
@click.option(
    "--radial-scale", type=float,
    help="Enlargement across the axis.  [default: 1 in .stl, .vtu, .csv; readable in the others]",
)  # fmt: skip
@click.option("--places", type=int, help="Places along the rod.  [default: 401 or more]")
@units_option
@click.option("--sides", type=int, default=24, show_default=True, help="Sides of the rod's cross-section.")
def export(
    case: Path,
    at: str,
    files: tuple[Path, ...],
    mode: int,
    mirror: bool,
    off_wall: bool,
    rod_radius: str | None,
    radial_scale: float | None,
    places: int | None,
    sides: int,
    units: str | None,
) -> None:
    """Write one state of CASE, a TOML file, in space: scene, surface, fields or centreline.

    Lengths are in metres and forces in newtons where the case has dimensions, otherwise in units B = L = 1; --units is
    for what is printed and drawn. `rodwell keys` explains the keys of a case file.
    """
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.errors import InputError  # noqa: PLC0415
    from rodwell.report.folders.export import checked_files, checked_rod_radius  # noqa: PLC0415
    from rodwell.report.folders.export import export as write  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415

    read = Case.read(case).in_units(units)
    note_rigid_wall(read.given)
    force = None if at == LIFT_OFF else force_at(at, read, LIFT_OFF)
    checked_files(files, "--to")
    for file in files:
        check_writable(file.parent, "--to")
    try:
        radius = checked_rod_radius(rod_radius, read.scales)
        with progress_bar(True, "the branch") as tell:
            state = _state(read, force, mode, mirror, at, off_wall)
            tell("files", 0.9)
            written = write(
                state,
                files,
                scales=read.scales,
                rod_radius=radius,
                radial_scale=radial_scale,
                places=places,
                sides=sides,
            )
    except InputError as error:
        names = {
            name: f"--{name.replace('_', '-')}" for name in ("rod_radius", "radial_scale", "places", "sides", "mode")
        }
        names |= {"path": "--to", "until": "--at", "force": "--at"}
        given = {"rod_radius": rod_radius, "until": at, "force": at}
        value = given.get(error.field, error.value)
        raise InputError(names.get(error.field, error.field), value, error.reason) from None
    click.echo(f"{_text(state, read)}\nWritten: " + ", ".join(printable(str(file)) for file in written))
    check_missed([] if state.converged else ["the state that was written"], read.rtol)


def _state(
    case: Case, force: float | None, mode: int, mirror: bool, at: str, off_wall: bool
) -> Solution | ContactState:
    """The state asked for by ``--at``, on the branch of the mode."""
    from rodwell.analysis.branch.follow import follow  # noqa: PLC0415
    from rodwell.answers.result.reach import passes, why_out_of_reach  # noqa: PLC0415
    from rodwell.errors import NotConvergedError  # noqa: PLC0415

    off_wall = off_wall and force is not None
    branch = follow(case.problem, mode, until=force, mirror=mirror, off_wall=off_wall, rtol=case.rtol)
    if force is not None and branch.beyond is not None and not passes(branch, force):
        return branch.beyond.at(force)
    if force is not None and not passes(branch, force):
        raise NotConvergedError(f"--at = {at} cannot be reached: {why_out_of_reach(branch, case.scales)}")
    if force is not None:
        return branch.at(force)
    if branch.lift_off is None or branch.lift_off_at_buckling:
        why = "lifts off as soon as it buckles" if branch.lift_off_at_buckling else branch.ending
        raise NotConvergedError(f"mode {mode} has no buckled state at lift-off ({why}); give an end force with --at")
    return branch.lift_off.solution


def _text(state: Solution | ContactState, case: Case) -> str:
    physical = "" if case.scales is None else f" ({case.scales.text(state.force, 'force', 6)})"
    index = "stable" if state.stability_index == 0 else f"stability index {state.stability_index}"
    return f"End force at s = 1: {plain(state.force, 10)} B/L²{physical}, tension positive; {index}"
