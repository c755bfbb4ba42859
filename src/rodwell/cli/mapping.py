"""``rodwell map``: one number of very many problems, on this machine or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import check_missed, check_torsion, json_option, make_problem, print_json, progress_bar
from rodwell.cli.told import told
from rodwell.errors import InputError, NotConvergedError, printable

if TYPE_CHECKING:
    from rodwell.studies.maps.result import Map
    from rodwell.studies.maps.workers import Workers

QUANTITIES = ("critical", "lift-off", "limit", "secondary", "contact", "contact-total", "shortening", "stress")
"""Numbers that can be asked for; a test holds them against the registry, which is slow to import."""

PARAMETERS = ("weight", "alpha", "clearance", "twist", "poisson", "torsion", "ends", "load")
FLAGS = ("on_top", "outside")

PICTURES = (".png", ".svg", ".pdf", ".html")
"""Kinds of files for pictures."""

DPI = 150


def _parameters(function: Any) -> Any:
    """Options of the problem: each takes one value, or many."""
    meanings = {
        "weight": "γ = mg L³/B, weight of the rod.",
        "alpha": "Angle of the cylinder from the vertical, degrees.",
        "clearance": "Δ/L, distance between the axes.  [default: 0.01]",
        "twist": "End twisting moment T₁ in B/L.",
        "poisson": "Poisson's ratio.",
        "torsion": "Torsional stiffness C/B.",
        "ends": "End conditions at s = 0 and s = 1.  [default: clamped-clamped]",
        "load": "End force at s = 1 in B/L², tension positive, for numbers at a load.",
    }
    for name in reversed(PARAMETERS):
        function = click.option(f"--{name}", metavar="VALUES", help=meanings[name])(function)
    for flag, text in (("outside", "The rod lies on the outside."), ("on-top", "The rod lies on top.")):
        function = click.option(f"--{flag}", is_flag=True, help=text)(function)
    return function


class StorePath(click.ParamType):  # type: ignore[type-arg]
    """Where a map is kept, a folder or the address of an object store, or its picture; an empty name is refused."""

    def __init__(self, name: str = "store") -> None:
        self.name = name

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the path."""
        if not str(value).strip():
            option = "--out" if param is None else param.opts[0]
            raise InputError(option, value, "is empty; name it, for example lift-off.zarr, lift-off.png")
        if self.name == "picture" and Path(value).suffix.lower() not in PICTURES:
            raise InputError("--picture", value, f"must end in {', '.join(PICTURES)}")
        return str(value)


@click.command("map", short_help="One number over up to four parameters: many problems, on many processes.")
@click.argument("case", type=click.Path(path_type=Path), required=False)
@click.option("--quantity", type=click.Choice(QUANTITIES), default="lift-off", show_default=True, help="What to map.")
@_parameters
@click.option("--sections", help="String of sections from s = 0: length:stiffness[:weight[:clearance[:torsion]]], …")
@click.option("--vary", nargs=2, multiple=True, metavar="KEY VALUES", help="A key of CASE, section.key, that varies.")
@click.option("--samples", default=0, help="How many samples of the parameters that have a distribution.")
@click.option("--sampling", type=click.Choice(["sobol", "random"]), default="sobol", show_default=True)
@click.option("--seed", default=0, show_default=True, help="From which samples are drawn.")
@click.option("--halvings", default=6, show_default=True, help="How often edges across a jump are halved; 0: never.")
@click.option("--workers", default=1, show_default=True, help="Processes on this machine.")
@click.option("--scheduler", metavar="URL", help="Address of a Dask scheduler, in place of --workers.")
@click.option(
    "--rtol",
    type=float,
    help="Relative tolerance; CASE has analysis.rtol.  [default: 1e-8]",
)
@json_option
@click.option("--quiet", is_flag=True, help="Print neither progress nor summary.")
@click.option(
    "--out",
    type=StorePath(),
    required=True,
    metavar="NAME.zarr",
    help="Zarr store that keeps the map; needs rodwell[map].",
)
@click.option(
    "--picture",
    type=StorePath("picture"),
    metavar="FILE",
    help="Draw the map: PNG, SVG, PDF; HTML is a page to point at cells.",
)
def map_command(
    case: Path | None,
    vary: tuple[tuple[str, str], ...],
    as_json: bool,
    quiet: bool,
    out: str,
    picture: str | None,
    **given: Any,
) -> None:
    """Map a number over one to four parameters of a problem, or of CASE, a TOML file.

    VALUES are a range, "5..200 in 40" or "1..300 in 40 log"; a list, "5, 10, 20"; a distribution, "normal(100, 5)",
    "uniform(5, 200)", "loguniform(1, 300)", "triangular(5, 20, 50)", of which --samples are drawn; or one value.
    Ranges and distributions in CASE vary too.

    The map is kept chunk by chunk. Broken off, by whatever, it goes on where it was with the same command.
    """
    from rodwell.store.mapping import map as compute  # noqa: PLC0415

    of, over = _asked(case, vary, given)
    options = {name: given[name] for name in _OPTIONS}
    with named_as_options(out), progress_bar(not quiet and not as_json, "workers start") as tell:
        result = compute(of, over=over, out=out, progress=tell, started=telling(quiet or as_json), **options)

    def tell_all(_: bool) -> None:
        if as_json:
            print_json(result.as_dict(), indent=2)
        elif not quiet:
            _summary(result, out)

    with told() as ready:
        ready(tell_all)
        if picture is not None:
            _draw(result, Path(picture))
    if not result.extremes:
        raise NotConvergedError(f"no cell has a value; {printable(out)} says why, cell by cell")
    missed = result.missed
    check_missed([f"{missed} of {result.question.size} cells"] if missed else [], result.question.rods.rtol)


_OPTIONS = ("quantity", "samples", "sampling", "seed", "halvings", "workers", "scheduler", "rtol")


def _asked(case: Path | None, vary: tuple[tuple[str, str], ...], given: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
    """The problem or case, and what varies."""
    from rodwell.case.file import read_case  # noqa: PLC0415

    named = [name for name in (*PARAMETERS, *FLAGS, "sections") if given[name]]
    if case is not None:
        if named:
            key = f"--{named[0].replace('_', '-')}"
            raise InputError(
                key, given[named[0]], 'belongs to a problem; a case has keys: --vary rod.length "10..20 m in 5"'
            )
        read = read_case(case)
        return read, dict(vary)
    if vary:
        raise InputError("--vary", vary[0][0], "needs a case file; a problem has --weight, --alpha and so on")
    check_torsion(given)
    over = {name: given[name] if name == "ends" else _number(given[name]) for name in PARAMETERS if given[name]}
    for name in ("weight", "alpha"):
        if name not in over:
            raise click.UsageError(f"Missing option '--{name}'.")
    return make_problem({"alpha": 90.0, **{name: given[name] for name in (*FLAGS, "sections")}}), over


def _number(text: str) -> Any:
    """One value as a number, anything else as it was written."""
    try:
        return float(text)
    except ValueError:
        return text


def telling(silent: bool) -> Callable[[Workers], None]:
    """What is called when workers have started: says where one can look at them."""

    def started(workers: Workers) -> None:
        if not silent and workers.dashboard:
            click.echo(f"Dashboard of the {workers.count} workers: {workers.dashboard}", err=True)

    return started


@contextmanager
def named_as_options(out: str | None, option: str = "--out") -> Iterator[None]:
    """Name inputs as the options that they are; let an interrupt say that what was done is kept in ``out``."""
    try:
        yield
    except InputError as error:
        if hasattr(error, "problems") or error.field not in (*PARAMETERS, *FLAGS, *_OPTIONS, "out"):
            raise
        named = option if error.field == "out" else f"--{error.field.replace('_', '-')}"
        raise InputError(named, error.value, error.reason) from None
    except KeyboardInterrupt as interrupt:
        if out is not None:
            interrupt.kept = f"what was done is kept in {printable(out)}; the same command goes on"  # type: ignore[attr-defined]
        raise


def _draw(result: Map, picture: Path) -> None:
    """Write the figure of a map, whole or not at all."""
    from rodwell.plots.maps.figure import plot_map  # noqa: PLC0415
    from rodwell.report.pages.map import write_map_page  # noqa: PLC0415

    part = picture.with_name(f".{picture.stem}.part{picture.suffix}")
    try:
        if picture.suffix.lower() == ".html":
            write_map_page(result, part)
        else:
            plot_map(result).figure.savefig(part, dpi=DPI)
        part.replace(picture)
    except InputError as error:
        raise InputError("--picture", str(picture), error.reason) from None
    except OSError as error:
        raise InputError("--picture", str(picture), f"cannot be written ({error.strerror})") from None
    finally:
        part.unlink(missing_ok=True)


def _summary(result: Map, out: str) -> None:
    from rodwell.studies.maps.words import sentences, title  # noqa: PLC0415

    wrapped(title(result))
    for line in sentences(result):
        wrapped(line, "  ")
    click.echo(f"\nKept in {printable(out)}: xarray.open_zarr({out!r})")
