"""``rodwell catalogue``: which pipes, materials and grades a case file can name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.options import print_json

if TYPE_CHECKING:
    from rodwell.case.entries import Entry
    from rodwell.quantities.units import System

KINDS = {"pipe": "rod.pipe", "material": "rod.material", "grade": "rod.grade"}


@click.command(short_help="List the pipes, materials and grades a case file can name.")
@click.argument("words", nargs=-1)
@click.option(
    "--file", "files", type=click.Path(path_type=Path), multiple=True,
    help="A catalogue of your own, beside that of the package; may be given several times.",
)  # fmt: skip
@click.option("--units", type=click.Choice(["si", "field", "mm"]), default="field", show_default=True,
              help="Units of the list.")  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in SI units, with notes.")
def catalogue(words: tuple[str, ...], files: tuple[Path, ...], units: str, as_json: bool) -> None:
    """List the pipes, materials and grades that a case file can name, with their sources.

    Only those whose name, kind or source holds all WORDS:  rodwell catalogue tubing 2-7/8
    """
    from rodwell.case.catalogue import read_catalogue  # noqa: PLC0415
    from rodwell.errors import InputError  # noqa: PLC0415
    from rodwell.quantities.units import System  # noqa: PLC0415

    try:
        known = read_catalogue([str(file) for file in files], Path())
    except InputError as error:
        raise InputError("--file", error.value, error.reason) from None
    every = {kind: [getattr(known, kind)(name) for name in known.names(kind)] for kind in KINDS}
    chosen = {kind: [entry for entry in entries if _holds(entry, words)] for kind, entries in every.items()}
    if as_json:
        print_json({kind: [e.model_dump(exclude_none=True) for e in entries] for kind, entries in chosen.items()})
        return
    if not any(chosen.values()):
        click.echo(f"Nothing in the catalogue holds {' '.join(words)}; without words, all of it is listed.")
    for kind, entries in chosen.items():
        _print(KINDS[kind], entries, System(units))


def _holds(entry: Entry, words: tuple[str, ...]) -> bool:
    from rodwell.case.catalogue import key_of  # noqa: PLC0415

    text = " ".join((entry.name, getattr(entry, "kind", ""), entry.source))
    return all(word.lower() in text.lower() or key_of(word) in key_of(entry.name) for word in words)


def _print(key: str, entries: list[Entry], system: System) -> None:
    """Entries of one kind, under the sources that they share."""
    source = ""
    for entry in entries:
        if entry.source != source:
            source = entry.source
            click.secho(f"\n{key}: {source}", bold=True)
        click.echo(f"  {entry.name:<36} {_numbers(entry, system)}")


def _numbers(entry: Entry, system: System) -> str:
    """What the name stands for."""
    dimensions = {
        "outer_diameter": ("OD", "length"), "bore": ("ID", "length"), "weight_per_length": ("", "force_per_length"),
        "bending_stiffness": ("B", "stiffness"), "youngs_modulus": ("E", "stress"), "density": ("", "density"),
        "yield_strength": ("yield", "stress"),
    }  # fmt: skip
    parts = []
    for name, (label, dimension) in dimensions.items():
        value = getattr(entry, name, None)
        if value is not None:
            parts.append(f"{label} {system.text(value, dimension)}".strip())
    return "   ".join(parts)
