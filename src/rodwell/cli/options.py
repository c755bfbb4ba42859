"""Options that several commands share."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.terminal import has_all_characters
from rodwell.errors import InputError, printable
from rodwell.quantities.as_json import as_json
from rodwell.quantities.text import plain

if TYPE_CHECKING:
    from rodwell.case.case import Case
    from rodwell.problem.problem import Problem

TOLERANCE_MISSED = 3

UNIT = "B/L²"
"""Unit of forces of a rod without dimensions."""

Progress = Callable[[str, float], None]

PARAMETERS = (
    "weight",
    "alpha",
    "clearance",
    "twist",
    "poisson",
    "torsion",
    "ends",
    "on_top",
    "outside",
    "floats",
    "turns",
    "sections",
    "build",
    "walk",
)
"""Names of the options that make a problem."""


def problem_options(required: bool = True, coiled: bool = False) -> Callable[[Any], Any]:
    """Options that describe the problem; weight and alpha are ``required`` unless a curve runs over them."""

    def decorate(function: Any) -> Any:
        options = [
            click.option("--weight", type=float, required=required, help="γ = mg L³/B, weight of the rod."),
            click.option(
                "--alpha", type=float, required=required, help="Angle of the cylinder from the vertical, degrees."
            ),
            click.option("--clearance", default=0.01, show_default=True, help="Δ/L, distance between the axes."),
            click.option("--twist", default=0.0, show_default=True, help="End twisting moment T₁ in B/L."),
            click.option("--poisson", type=float, help="Poisson's ratio ν; C/B = 1/(1 + ν).  [default: 0.3]"),
            click.option("--torsion", type=float, help="C/B as measured, instead of --poisson."),
            click.option(
                "--ends",
                default="clamped-clamped",
                show_default=True,
                help="End conditions at s = 0 and s = 1: clamped, pinned, guided (slides around the wall) or free; for "
                "critical loads and load paths also ball (joint) or loose, which the wall does not hold.",
            ),
            click.option(
                "--on-top", is_flag=True, help="The rod lies on top, ξ₂ = π, where its weight helps buckling."
            ),
            click.option("--outside", is_flag=True, help="The rod lies on the outside of the cylinder."),
            click.option(
                "--floats", is_flag=True, help="The rod is lighter than what surrounds it: weight acts upwards."
            ),
            click.option(
                "--sections",
                metavar="L:B:W,…",
                help="String of sections from s = 0, each length:stiffness[:weight[:clearance[:torsion]]]; lengths in "
                "L add up to 1, the others are ratios, 1 where left out: 0.6:1:1,0.4:0.3:0.5. A taper has 2 to 5 "
                "values at even places along the section: 0.6:1:1,0.4:1/0.3:1/0.5. A negative weight: it floats. "
                "A clearance a~b goes over smoothly (critical loads, load paths): 0.5:1:1:1,0.5:1:1:1~1.1.",
            ),
            click.option(
                "--build",
                type=float,
                help="Curvature of the hole in 1/L, > 0 where it is concave upward; α is then that at mid-length.  "
                "[default: 0]",
            ),
            click.option(
                "--walk",
                type=float,
                help="Curvature of the hole in 1/L to the right, looking towards s = 0.  [default: 0]",
            ),
        ]
        if coiled:
            options.append(
                click.option(
                    "--turns",
                    type=float,
                    default=0,
                    show_default=True,
                    help="Turns of the end s = 1 around the cylinder, whole or not.",
                )
            )
        for option in reversed(options):
            function = option(function)
        return function

    return decorate


rtol_option = click.option("--rtol", default=1e-8, show_default=True, help="Relative tolerance of the numbers.")
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON.")


units_option = click.option(
    "--units", type=click.Choice(["si", "field", "mm"]),
    help="Units of summary, report and figures: SI; lbf, ft, in, psi; N, mm, MPa.  [default: the case's, or si]",
)  # fmt: skip


def make_problem(given: dict[str, Any]) -> Problem:
    """Return the problem that the options describe; what is not given keeps its default.

    Raises
    ------
    InputError
        If it is no problem, or two options say the same thing.
    """
    from rodwell.problem.problem import Problem  # noqa: PLC0415
    from rodwell.problem.sections import sections_from  # noqa: PLC0415

    values = {name: given[name] for name in PARAMETERS if given.get(name) is not None}
    check_torsion(values)
    if "sections" in values:
        values["sections"] = sections_from(values["sections"], "--sections")
    return Problem(**{"weight": 0.0, **values})


def check_torsion(given: Mapping[str, Any]) -> None:
    """Refuse Poisson's ratio beside the torsional stiffness that it would set."""
    if given.get("poisson") is not None and given.get("torsion") is not None:
        raise InputError("--poisson", given["poisson"], "has no effect beside --torsion, C/B as measured: give one")


def print_json(data: dict[str, Any], indent: int | None = None) -> None:
    """Print data as JSON, with escapes for characters that the terminal's encoding does not have."""
    click.echo(as_json(data, reasons=True, indent=indent, ensure_ascii=not has_all_characters()))


def print_written(folder: Path, page: str = "", with_pdf: bool = False) -> None:
    """Say where results are: the page to open, which names all files beside it, or else the folder."""
    where = printable(str(folder))
    if not page:
        click.echo(f"\nWritten to {where}")
        return
    click.echo(f"\nReport: {printable(str(folder / page))}{' and report.pdf' if with_pdf else ''}")


class ToleranceMissed(click.ClickException):
    """Numbers were shown that miss their tolerance: one line that says which, and an exit code of its own."""

    exit_code = TOLERANCE_MISSED

    def show(self, file: Any = None) -> None:
        """Print the line on standard error."""
        click.echo(f"rodwell: tolerance missed: {self.message}", file=file, err=file is None)


def check_missed(what: Sequence[str], rtol: float) -> None:
    """Raise if anything that was shown misses the tolerance.

    Parameters
    ----------
    what
        What misses it, in words.
    rtol
        The tolerance.

    Raises
    ------
    ToleranceMissed
        If there is anything.
    """
    if what:
        more = f", and {len(what) - 1} more" if len(what) > 1 else ""
        raise ToleranceMissed(f"{what[0]}{more} (rtol {plain(rtol)})")


def places_text(places: Sequence[float]) -> str:
    """Places along the rod at the end of a line, or nothing."""
    return "   at s/L = " + ", ".join(plain(s, 6) for s in places) if places else ""


def note_rigid_wall(sections: Mapping[str, Any]) -> None:
    """Say on standard error that a command takes the wall as rigid, where a case has one that gives way.

    ``sections`` are those of the case file.
    """
    from rodwell.case.checks.rigid_wall import LEFT_ASIDE, gives_way  # noqa: PLC0415

    if gives_way(sections):
        click.echo(f"rodwell: {LEFT_ASIDE}", err=True)


def force_at(at: str, case: Case, word: str = "", option: str = "--at") -> float:
    """End force of an option in B/L²: as load.until in the case file, text with a unit, or a plain number without one.

    ``word`` is what may be given instead of a force.
    """
    from rodwell.quantities.units import to_si  # noqa: PLC0415

    instead = f'"{word}" or ' if word else ""
    if case.scales is None:
        try:
            return float(at)
        except ValueError:
            raise InputError(option, at, f"must be {instead}an end force in B/L², a plain number") from None
    try:
        return to_si(at, "force") / case.scales.factor("force")
    except ValueError as error:
        raise InputError(option, at, f"must be {instead}an end force: it {error}") from None


class OutPath(click.Path):
    """Where results go: an empty name, which would be the current folder, is refused."""

    def __init__(self) -> None:
        super().__init__(path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path."""
        if not str(value).strip() and not isinstance(value, Path):
            option = "--out" if param is None else param.opts[0]
            kind = 'a folder ("." is the current one)' if option == "--out" else "a file"
            raise InputError(option, value, f"is empty; name {kind}, or leave the option out")
        return super().convert(value, param, ctx)


def results_folder(out: Path | None, name: str, suffix: str = "") -> Path:
    """The folder for results: the one asked for, or one named after the case, with a ``suffix``."""
    return Path("results") / f"{name}{suffix}" if out is None else out


def out_option(name: str) -> Callable[[Any], Any]:
    """Option for the folder of results."""
    return click.option(
        "--out", type=OutPath(), default=Path("results") / name, show_default=True,
        help="Folder for figure and data.",
    )  # fmt: skip


@contextmanager
def progress_bar(show: bool, first: str) -> Iterator[Progress]:
    """A progress bar on standard error, where that is a terminal; ``first`` says what is done first."""
    if not show or not sys.stderr.isatty():
        yield lambda _what, _done: None
        return
    from rich.console import Console  # noqa: PLC0415
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn  # noqa: PLC0415

    from rodwell.analysis.discrete import first_run  # noqa: PLC0415

    note = "" if first_run.done() else " (first run: compiling once, some seconds)"
    columns = (SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(first + note, total=1.0)
        yield lambda what, done: bar.update(task, description=what + note, completed=done)
