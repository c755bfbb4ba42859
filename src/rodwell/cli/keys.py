"""``rodwell keys``: what each key of a case file means."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import print_json

if TYPE_CHECKING:
    from rodwell.case.keys import Key


@click.command(short_help="Explain the keys of a case file: kind, default, examples, meaning.")
@click.argument("name", metavar="[SECTION | KEY]", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def keys(name: str | None, as_json: bool) -> None:
    """Explain every key of a case file, those of one section, or one key.

    rodwell keys rod   rodwell keys rod.length   rodwell keys twist   rodwell keys top (before the first section)
    """
    from rodwell.case.keys import every_key, keys_named  # noqa: PLC0415

    found: dict[str, list[Key]] = {}
    for key in keys_named(name) if name is not None else [key for keys in every_key().values() for key in keys]:
        found.setdefault(key.section, []).append(key)
    if as_json:
        print_json({section: [key.as_dict() for key in listed] for section, listed in found.items()})
        return
    for section, listed in found.items():
        _print(section, listed)
    if name is None:
        wrapped(
            "Quantities are text with a number and a unit, any of the right kind. `rodwell init` writes a first case."
        )


def _print(section: str, listed: list[Key]) -> None:
    """The keys of a section: name and examples, then kind, what is allowed, default and meaning."""
    from rodwell.case.keys import TOP, purpose  # noqa: PLC0415

    if section == TOP:
        click.secho(purpose(section), bold=True)
    else:
        click.secho(f"[[{section}]]" if section in ("string", "hole.section") else f"[{section}]", bold=True)
        wrapped(purpose(section))
    click.echo()
    for key in listed:
        click.echo(f"  {click.style(key.name, bold=True)} = {' or '.join(key.examples)}")
        wrapped(_about(key), "      ")
    click.echo()


def _about(key: Key) -> str:
    kind = f"{key.kind} with a unit" if key.unit else key.kind
    limits = f", {key.allowed}" if key.allowed else ""
    needed = "; required" if key.required else f"; default {key.default}" if key.default else ""
    meaning = key.meaning.replace("`", "").replace("**", "")
    return f"{kind[:1].upper()}{kind[1:]}{limits}{needed}: {meaning}."
