"""The report on tubing in a packer."""

from __future__ import annotations

import datetime

from rodwell._version import __version__
from rodwell.answers.words.advice import BAD, CAUTION, GOOD, OPEN, Status
from rodwell.quantities.units import System
from rodwell.report.reports.content import Front, Grid, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.texts import conversions, inputs
from rodwell.studies.packer.packer import PackerAnswer
from rodwell.studies.packer.tables import SIGNS, rows, shown
from rodwell.studies.packer.words import sentences

ON_FRONT = ("change", "free", "movement", "packer_force")


def packer_report(answer: PackerAnswer) -> Report:
    """Return the content of the report."""
    system = _system(answer)
    today = datetime.date.today().isoformat()
    found = rows(answer)
    text = sentences(answer)
    numbers = tuple(Number(row.label, shown(row, system)[0], note=row.note) for row in found if row.name in ON_FRONT)
    picture = Picture(
        "packer",
        "Changes of length one after the other, and the movement of the end",
        "Each change of length begins where the last one ended; then the movement if nothing held the tubing, and that "
        "which the packer allows. Down is longer.",
    )
    assumptions = (
        "No friction and no flow. The tubing has one section and slides in the packer's seals; the casing is rigid. "
        "Buckled tubing is the exact helix in a vertical hole, in an inclined one the exact state of a long rod on the "
        "wall at each place. " + " ".join(SIGNS[:2])
    )
    table = Grid(
        ("", "value", "± error", ""),
        tuple((row.label, *shown(row, system), row.note) for row in found),
        (1, 2),
    )
    facts = tuple((label, value) for label, value, _ in conversions(answer.case))
    return Report(
        title=answer.case.title,
        subtitle=f"Tubing in a packer that allows {answer.given.motion} motion · rodwell {__version__} · {today}",
        front=Front(text[0], _statuses(answer), numbers, picture, assumptions, tuple(text[1:]), "What else was found"),
        sections=(
            ReportSection("Numbers", (table, Words(SIGNS[2], "small"))),
            ReportSection(
                "Inputs", (Grid(("as given", ""), tuple(inputs(answer.case))), Grid(("what follows", ""), facts))
            ),
        ),
        footer=f"Computed by rodwell {__version__} from {answer.case.source}. After Lubinski, Althouse and Logan, J. "
        "Petroleum Technology 14 (1962) 655, with exact buckled states.",
        paper="us-letter" if system.name == "field" else "a4",
    )


def _statuses(answer: PackerAnswer) -> tuple[Status, ...]:
    m, strength = answer.moved, answer.case.yield_strength
    worst = max(float(value) for value in answer.stress.von_mises)
    moves = Status("Movement", CAUTION, "stopped", "the packer holds what would move further") if m.stopped else Status(
        "Movement", GOOD, "free", "the packer lets the seals move"
    )  # fmt: skip
    straight = answer.state == "straight"
    buckled = Status("Tubing", GOOD if straight else CAUTION, answer.state, "just above the packer, afterwards")
    if strength is None:
        strong = Status("Strength", OPEN, "not judged", "no yield strength is given")
    elif worst > strength:
        strong = Status(
            "Strength", BAD, "exceeded", f"equivalent stress is {worst / strength:.0%} of the yield strength"
        )
    else:
        strong = Status("Strength", GOOD, "not exceeded", f"{worst / strength:.0%} of the yield strength is used")
    numbers = Status("Numbers", GOOD if answer.converged else BAD, "converged" if answer.converged else "NOT CONVERGED",
                     "every error is within its tolerance" if answer.converged else "see the errors")  # fmt: skip
    return moves, buckled, strong, numbers


def _system(answer: PackerAnswer) -> System:
    assert answer.case.scales is not None
    return answer.case.scales.system
