"""``rodwell path``: what happens to a rod in its hole as the load grows, and comes back."""

from __future__ import annotations

import math
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from rodwell.cli.options import (
    PARAMETERS,
    OutPath,
    check_missed,
    force_at,
    json_option,
    make_problem,
    print_json,
    print_written,
    problem_options,
    progress_bar,
    rtol_option,
)
from rodwell.cli.path_text import print_barrier, print_path, print_states
from rodwell.cli.terminal import interrupt_behind
from rodwell.cli.told import told
from rodwell.errors import InputError

if TYPE_CHECKING:
    from rodwell.analysis.path.load_path import LoadPath
    from rodwell.case.case import Case
    from rodwell.problem.problem import Problem


@click.command(short_help="The load path off the wall: lift-off, partial contact, snap, helix, and back.")
@click.argument("case", type=click.Path(path_type=Path), required=False)
@problem_options(required=False)
@click.option(
    "--until",
    help='End force at s = 1 (tension positive) to load the rod to; of a CASE with its unit, "-130 kN".  [default: of '
    "a CASE to and back from where `rodwell run` goes; where the clearance has steps, until the rod buckles]",
)
@click.option("--unload-to", help="End force to unload it to afterwards.")
@click.option("--at", help="End forces, separated by commas, at which states are shown.")
@click.option(
    "--barrier",
    help="End forces at which it is told how large a disturbance snaps the rod before it must: the energy of the "
    "saddle in between, and the turn of mid-length about the hole's axis. Takes up to a minute each.",
)
@click.option(
    "--control",
    type=click.Choice(["force", "shortening"]),
    default="force",
    show_default=True,
    help="What is controlled; with shortening, --until, --unload-to and --at are shortenings in L.",
)
@click.option("--axial-stiffness", type=float, help="EA of the rod in B/L², with --control shortening; else rigid.")
@click.option("--spring", type=float, help="Stiffness in B/L³ of a spring that drives it, with --control shortening.")
@click.option(
    "--wall-stiffness", type=float,
    help="Stiffness k L⁴/B of a wall that gives way, push per length and depth.  [default: that of CASE, or hard]",
)  # fmt: skip
@click.option("--mirror", is_flag=True, help="The other arm of the buckling mode: it differs with twist.")
@click.option("--seeds", default=3, show_default=True, help="Random disturbances tried, either way, at each snap.")
@click.option("--out", type=OutPath(), help="Folder for a figure of the path, load against shortening.")
@click.option(
    "--animation", type=OutPath(), help="File for the rod as it moves along the path, GIF or WebP by its suffix."
)
@rtol_option
@json_option
def path(
    case: Path | None,
    until: str | None,
    unload_to: str | None,
    at: str | None,
    barrier: str | None,
    control: str,
    axial_stiffness: float | None,
    spring: float | None,
    wall_stiffness: float | None,
    mirror: bool,
    seeds: int,
    out: Path | None,
    animation: Path | None,
    rtol: float,
    as_json: bool,
    **given: Any,
) -> None:
    """What happens to a rod, or that of CASE, a TOML file, as the load grows quasi-statically, and comes back.

    Buckling, lift-off, gaps, points of contact, loss of stability, where the rod snaps to, the helix, and the way
    back. The rod may leave the wall; frictionless and without inertia. End force at s = 1 in B/L², tension positive;
    places in parts of the length, gaps in parts of the clearance.
    """
    from rodwell.analysis.path.checks import checked_control, checked_value  # noqa: PLC0415
    from rodwell.analysis.path.follow import load_path  # noqa: PLC0415

    read = _case(case)
    problem, rtol = (make_problem(given), rtol) if read is None else (read.problem, _tolerance(read, rtol))
    begin, back = _range(problem, read, until, unload_to, control)
    forces, barriers = _numbers("--at", at, read, control), _numbers("--barrier", barrier, read, control)
    way = checked_control(problem, control, axial_stiffness, spring)
    for option, values in (("--at", forces), ("--barrier", barriers)):
        for value in values:
            checked_value(way, option, value)
    if wall_stiffness is None:
        wall_stiffness = math.inf if read is None else read.wall_stiffness
    _check_files(out, animation)
    span = abs(-100.0 if begin is None else begin) + 1e-12

    with progress_bar(not as_json, "buckling") as tell:
        result = load_path(
            problem, until=begin, unload_to=back, control=control, axial_stiffness=axial_stiffness, spring=spring,
            wall_stiffness=wall_stiffness, mirror=mirror, seeds=seeds, rtol=rtol,
            progress=lambda leg, force: tell(f"{leg}, F = {force:.4g}", min(abs(force) / span, 1.0)),
        )  # fmt: skip
    barriers, interrupt = _computed(result, barriers)
    files: list[Path] = []
    with told() as ready:
        ready(lambda _: _tell(result, (forces, barriers), read, files, as_json=as_json))
        _write(result, out, animation, (forces, barriers), read, files, shown=not as_json)
    if interrupt is not None:
        interrupt.kept = "the path was told, with what had been computed of its barriers"  # type: ignore[attr-defined]
        raise interrupt
    check_missed(result.missed, rtol)


def _tell(
    result: LoadPath, at: tuple[list[float], list[float]], case: Case | None, files: list[Path], *, as_json: bool
) -> None:
    """Print the path, with states and barriers ``at`` these loads, and where files of it are."""
    if as_json:
        from rodwell.problem.words import ends_text  # noqa: PLC0415

        convention = "end force F at s = 1, tension positive; places in L, gaps in clearances; "
        print_json(
            {
                **result.as_dict(*at),
                "converged": not result.missed,
                "unit": "B/L^2",
                **({} if case is None or case.scales is None else {"unit_N": case.scales.factor("force")}),
                "convention": convention + ends_text(result.problem),
            }
        )
        return
    print_path(result, case)
    if case is not None and case.scales is not None:
        click.echo(f"1 B/L² is {case.scales.text(1.0, 'force', 6)}, L {case.scales.text(1.0, 'length', 6)}.")
    for force in at[0]:
        print_states(result, force)
    for force in at[1]:
        print_barrier(result, force, case)
    for file in files:
        print_written(file)


def _check_files(out: Path | None, animation: Path | None) -> None:
    """Refuse what cannot be written before anything is computed."""
    if out is not None:
        from rodwell.store.folder import check_writable  # noqa: PLC0415

        check_writable(out)
    if animation is not None:
        from rodwell.report.folders.path import check_animation  # noqa: PLC0415

        check_animation(animation)


def _write(
    result: LoadPath,
    out: Path | None,
    animation: Path | None,
    at: tuple[list[float], list[float]],
    case: Case | None,
    files: list[Path],
    *,
    shown: bool,
) -> None:
    """Write folder and animation if they are asked for, with states and barriers ``at`` these loads.

    What is written is added to ``files``.
    """
    if out is None and animation is None:
        return
    from rodwell.report.folders.path import write_animation, write_path  # noqa: PLC0415 - imports Matplotlib

    if out is not None:
        write_path(result, out, at[0], case, at[1])
        files.append(out)
    if animation is not None:
        with progress_bar(shown, "drawing") as tell:
            write_animation(result, animation, case, field="--animation", progress=lambda done: tell("drawing", done))
        files.append(animation)


def _computed(result: LoadPath, barriers: list[float]) -> tuple[list[float], BaseException | None]:
    """Compute barriers: the loads of those begun, and Ctrl-C or the signal that ended it, or None.

    They take up to a minute each, and the path is there already: it is told, with what is known of them.
    """
    from rodwell.errors import RodwellError  # noqa: PLC0415

    begun: list[float] = []
    try:
        for value in barriers:
            with suppress(RodwellError):  # told with the barrier
                found = result.barrier(value)
                begun.append(value)
                found.turn_or_why()
            begun += [] if value in begun else [value]
    except (KeyboardInterrupt, SystemError) as error:
        interrupt = interrupt_behind(error)
        if interrupt is None:
            raise
        return begun, interrupt
    return begun, None


def _case(path: Path | None) -> Case | None:
    """The case, if one is given; else weight and inclination must be, and beside one no option of a problem."""
    given = click.get_current_context().get_parameter_source
    written = [name for name in PARAMETERS if given(name) == ParameterSource.COMMANDLINE]
    if path is None:
        for name in ("weight", "alpha"):
            if name not in written:
                raise click.UsageError(f"Missing option '--{name}' (or a case file).")
        return None
    if written:
        key = f"--{written[0].replace('_', '-')}"
        raise InputError(key, None, "belongs to a problem without a case: leave it out, or the case")
    from rodwell.case.case import Case  # noqa: PLC0415

    return Case.read(path)


def _tolerance(case: Case, rtol: float) -> float:
    """The tolerance of the case, unless another is asked for."""
    source = click.get_current_context().get_parameter_source("rtol")
    return rtol if source == ParameterSource.COMMANDLINE else case.rtol


def _range(
    problem: Problem, case: Case | None, until: str | None, back: str | None, control: str
) -> tuple[float | None, float | None]:
    """Where the path goes, and comes back to: as asked, or, of a case, as its report goes; None: until it buckles."""
    from rodwell.analysis.path.checks import checked_problem  # noqa: PLC0415

    checked_problem(problem)
    if until is not None or problem.leaves_wall:
        far = None if until is None else _number("--until", until, case, control)
        return far, None if back is None else _number("--unload-to", back, case, control)
    if problem.ramps:
        what = "must be given where the clearance varies: there no lift-off is known from which it could be chosen"
        raise InputError("--until", None, what)
    if case is None or control != "force":
        raise click.UsageError("Missing option '--until'.")
    from rodwell.answers.result.beyond import off_at, reach  # noqa: PLC0415
    from rodwell.answers.result.computed import compute  # noqa: PLC0415

    computed = compute(case)
    if off_at(computed) is None:
        raise InputError("--until", None, "must be given: no lift-off was found from which it could be chosen")
    far, start = reach(computed)
    return far, start if back is None else _number("--unload-to", back, case, control)


def _number(option: str, text: str, case: Case | None, control: str) -> float:
    """An end force in B/L², with its unit in a case with dimensions; or a shortening in L."""
    if case is not None and control == "force":
        return force_at(text, case, option=option)
    try:
        return float(text)
    except ValueError:
        raise InputError(option, text, "must be end forces in B/L² (or shortenings in L), plain numbers") from None


def _numbers(option: str, text: str | None, case: Case | None, control: str) -> list[float]:
    """Such numbers, separated by commas."""
    numbers = [] if text is None else [_number(option, part, case, control) for part in text.split(",")]
    if not all(map(math.isfinite, numbers)):
        raise InputError(option, text, "must be finite numbers, separated by commas")
    return numbers
