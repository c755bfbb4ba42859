"""``rodwell endless --joint``: the endless string of equal joints on its tool joints."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rodwell.cli.listing import wrapped
from rodwell.cli.options import print_json
from rodwell.quantities.text import amount, plain
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.case.case import Case

NEARLY = 1e-6
"""How far from π, in radians, a phase counts as π."""


def show_joints(file: str, as_json: bool) -> None:
    """Print the critical load of an endless string of the joint of a case, or all numbers as JSON."""
    from rodwell.analysis.endless.jointed import FEWEST, jointed_string  # noqa: PLC0415

    case, count = _of_one_joint(file)
    found = jointed_string(case.problem)
    scales = case.scales
    finite = None if count < FEWEST else [Value(load, found.load.error) for load in found.of_joints(count)]
    if as_json:
        si = {} if scales is None else {"load_si": scales.si(found.load, "force")}
        of_count = {} if finite is None else {"string": {"joints": count, "load": [one.as_dict() for one in finite]}}
        print_json({"title": case.title, **found.as_dict(), **si, **of_count})
    else:
        sag, room = (_size(case, number, "length", "L") for number in (found.sag, found.room))
        spread = _size(case, found.spread.times(-1.0))
        waves = "neighbouring bodies bow to opposite sides"
        if math.pi - found.phase > NEARLY:
            waves = f"in waves of {plain(2.0 * math.pi / found.phase, 3)} joints"
        wrapped(f"{case.title}: an endless string of such joints, lying on its tool joints.")
        wrapped(f"It buckles sideways at {_load(case, found.load.times(-1.0))} of axial compression, {waves}.")
        if finite is not None:
            most = _load(case, finite[1].times(-1.0))
            wrapped(
                f"A string of {count} of them, its ends held against rolling, buckles between that and {most}: the "
                "difference falls with the square of the number of joints; for a few of them it is no bound."
            )
        wrapped(
            f"Each of the two edges of a tool joint bears {_size(case, found.edge_force)}; the body hangs {sag} below "
            f"its ends there, and would touch the wall at {room}."
        )
        wrapped(
            f"With the weight spread along the tool joints' clearance it would be {spread}: that is no bound. "
            "Looked at are disturbances out of the vertical plane, of any wavelength. Frictionless, small slopes; "
            "the axial force is taken as constant over some joints."
        )


def _of_one_joint(file: str) -> tuple[Case, int]:
    """The case of one joint, where its string has several that are alike, and how many: they are what it repeats."""
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.case.file import read_case  # noqa: PLC0415

    read = read_case(file)
    pipes = read.data.get("string")
    if not (isinstance(pipes, list) and len(pipes) == 1 and isinstance(pipes[0], dict) and "joints" in pipes[0]):
        return Case.read(read), 1
    data = {**read.data, "string": [{**pipes[0], "joints": 1}]}
    return Case.from_dict(data, source=read.source, folder=read.folder), int(pipes[0]["joints"])


def _load(case: Case, load: Value) -> str:
    return f"{amount(load, 6)} B/L²" if case.scales is None else case.scales.amount(load, "force", 6)


def _size(case: Case, number: Value, dimension: str = "force", unit: str = "B/L²") -> str:
    return f"{amount(number)} {unit}" if case.scales is None else case.scales.amount(number, dimension)
