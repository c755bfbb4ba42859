"""``rodwell init``: a first case file."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rodwell.case.first_case import Question

NAMES = ("well", "wire", "robot")
"""Kinds of first case, as :data:`rodwell.case.first_case.KINDS` has them: known without loading it."""

OPTIONS = {
    "pipe": "Pipe, wire or catheter as `rodwell catalogue` names it (well, wire).",
    "material": "Material as `rodwell catalogue` names it (robot).",
    "length": 'Length between the ends, as text with a unit: "300 ft".',
    "diameter": "Diameter of the body (robot).",
    "stiffness": "Bending stiffness, measured (wire).",
    "weight": "Weight per length (wire).",
    "hole": "Inner diameter of hole, vessel or pipe.",
    "angle": "Inclination from the vertical.",
    "mud": "Density of the mud (well).",
    "load": "Force that acts, compression negative (well: at the lower end).",
}


def _answers(function: Any) -> Any:
    """An option for each answer."""
    for name, text in reversed(OPTIONS.items()):
        function = click.option(f"--{name}", help=text)(function)
    return function


@click.command(short_help="Write a commented first case file.")
@click.argument("file", type=click.Path(path_type=Path), default=Path("case.toml"))
@click.option("--kind", type=click.Choice(NAMES), help="Pipe in a well, guidewire or catheter, robot in a pipe.")
@click.option("--units", type=click.Choice(["si", "field", "mm"]), help="Units of the results.")
@click.option("--title", help="Title of the case.")
@_answers
@click.option("--force", is_flag=True, help="Overwrite FILE.")
def init(file: Path, kind: str | None, units: str | None, title: str | None, force: bool, **given: str | None) -> None:
    """Write a commented first case to FILE (case.toml if not given), for `rodwell run`.

    On a terminal it asks for what no option gives; elsewhere it takes usual values. `rodwell keys` explains the keys.
    """
    from rodwell.case.first_case import KINDS, first_case  # noqa: PLC0415
    from rodwell.errors import InputError  # noqa: PLC0415
    from rodwell.store.text import write_whole  # noqa: PLC0415

    if file.exists() and not force:
        raise InputError("FILE", str(file), "exists already; name another, or overwrite it with --force")
    asks = _asks()
    if kind is None and not asks:
        raise InputError("--kind", None, f"is missing: give one of {', '.join(NAMES)}")
    if kind is None:
        for name, one in KINDS.items():
            click.echo(f"  {name:<6} {one.about}")
        kind = click.prompt("Kind of case", type=click.Choice(NAMES), default=NAMES[0])
    chosen = KINDS[kind]
    if units is None and asks:
        units = click.prompt("Units of the results", type=click.Choice(["si", "field", "mm"]), default=chosen.units)
    answers = {name: answer for name, answer in given.items() if answer is not None}
    if asks:
        for question in chosen.questions:
            if question.name not in answers:
                answers[question.name] = _asked(question, question.usual(units or chosen.units))
    text = first_case(kind, answers, units, title)
    write_whole(text, file)
    click.echo(f"Written: {file}. Next: look at it, put your numbers in, and\n  rodwell run {file}")


def _asks() -> bool:
    """Whether there is somebody to ask."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def _asked(question: Question, usual: str) -> str:
    """The answer to a question, asked again until a quantity is of the right kind."""

    def check(text: str) -> str:
        try:
            return question.checked(text)
        except ValueError as error:
            raise click.UsageError(str(error)) from None

    answer: str = click.prompt(question.asks, default=usual, value_proc=check)
    return answer
