"""The report of torque and drag of a well."""

from __future__ import annotations

import datetime
import math

from rodwell._version import __version__
from rodwell.answers.words.advice import BAD, CAUTION, GOOD, OPEN, Status
from rodwell.quantities.table import Cell
from rodwell.quantities.text import plain
from rodwell.quantities.value import Value
from rodwell.report.reports.content import Block, Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.front import LOGO
from rodwell.report.reports.texts import short
from rodwell.studies.drag.calibration import Calibration
from rodwell.studies.drag.contact import NAMES
from rodwell.studies.drag.drag import Drag, OperationResult
from rodwell.studies.drag.tables import operations_table
from rodwell.studies.drag.words import (
    FAILS,
    assumptions,
    depth,
    failure,
    force,
    level_of_one,
    not_judged,
    scatter,
    sentences,
    sentences_of,
    torque,
    unbalanced,
    units,
    way_left_out,
    yields,
)

MOST_INTERVALS = 30


def picture_of(number: int) -> str:
    """Name of the picture of an operation, counted from 0."""
    return f"operation-{number + 1}"


def drag_report(found: Drag, calibration: Calibration | None = None) -> Report:
    """Return the content of the report on a well."""
    well = found.well
    today = datetime.date.today().isoformat()
    sections = [_operations(found), *(_operation(found, one, i) for i, one in enumerate(found.operations))]
    if found.road_map is not None:
        sections.append(_road_map())
    if calibration is not None:
        sections.append(_calibration(calibration))
    return Report(
        title=well.title,
        subtitle=f"Torque and drag · {len(found.operations)} operations · rodwell {__version__} · {today}",
        front=_front(found),
        sections=(*sections, _inputs(found)),
        footer=f"Computed by rodwell {__version__} from {well.source} and {well.survey.source}. "
        f"{assumptions(found)[-1]}",
        paper="us-letter" if well.system.name == "field" else "a4",
        about=well.about.lines,
        logo="" if well.about.logo is None else LOGO,
    )


def _front(found: Drag) -> Front:
    text, well = sentences(found), found.well
    numbers = []
    for one in found.operations[:6]:
        load = one.ends.hook_load
        value = "locks up" if load is None else force(well, load)
        note = f"bit at {depth(well, one.operation.bit_depth)}"
        if one.operation.bit_force:
            note += f", {force(well, Value(one.operation.bit_force))} at the bit"
        numbers.append(Number(f"Hook load, {one.operation.name}", value, "", note))
    return Front(
        verdict=text[0],
        statuses=(_reached(found), _buckling(found), _strength(found), _numbers(found)),
        numbers=tuple(numbers),
        picture=Picture(
            "forces",
            "Inclination, and effective force of every operation with the limits of buckling, against measured depth",
            "Effective force along the string, tension positive; red: compression at which it buckles, and from which "
            "it is helical at the latest, for the operation with the deepest bit. Compression that grows beyond bounds "
            "is cut.",
        ),
        assumptions=" ".join(assumptions(found)),
        steps=tuple(text[1:9]),
        next_title="What else was found",
    )


def _reached(found: Drag) -> Status:
    bad = [one.operation.name for one in found.operations if not one.possible]
    if bad:
        return Status("Depth", BAD, "not reached", f"not possible: {', '.join(bad)}")
    if way_left_out(found):
        what = "every operation is possible with the bit at its depth; the way down of a stiff string is not looked at"
        return Status("Depth", OPEN, "way not looked at", what)
    return Status("Depth", GOOD, "reached", "every operation is possible with the push there is")


def _buckling(found: Drag) -> Status:
    buckled = [one.operation.name for one in found.operations if one.run.buckled]
    if buckled:
        return Status("Buckling", CAUTION, "buckled in places", f"in {', '.join(buckled)}")
    return Status("Buckling", GOOD, "straight", "in every operation, everywhere")


def _strength(found: Drag) -> Status:
    known = [one for one in found.operations if any(math.isfinite(v) for v in one.strength.used)]
    if not known:
        return Status("Stress", OPEN, "not judged", "no yield strength is given")
    bad = [one.operation.name for one in known if yields(one)]
    if bad:
        return Status("Stress", BAD, "beyond yield", f"in {', '.join(bad)}")
    most = max(float(v) for one in known for v in one.strength.used if math.isfinite(v))
    reason = f"the largest von Mises stress is {plain(100.0 * most, 3)} % of the yield strength"
    if not_judged(found):
        what = f"no yield strength is given for {', '.join(not_judged(found))}; elsewhere {reason}"
        return Status("Stress", OPEN, "not judged everywhere", what)
    return Status("Stress", GOOD, "below yield", reason)


def _numbers(found: Drag) -> Status:
    if not unbalanced(found):
        return Status("Numbers", GOOD, "balanced", "the work of the ends is that of gravity and friction to 10⁻⁸")
    return Status("Numbers", BAD, "not balanced", "; ".join(unbalanced(found)))


def _operations(found: Drag) -> ReportSection:
    """Every operation by the three laws of contact, and what its bounds are."""
    table = operations_table(found)
    shown = range(0, len(table.columns) - 1)
    ends = [i for i in shown if i < 11]
    rest = [0, *(i for i in shown if i >= 11)]
    blocks: list[Block] = []
    for columns in (ends, rest):
        rows = tuple(tuple(_text(row[i], table.columns[i]) for i in columns) for row in table.rows)
        head = tuple(table.columns[i] for i in columns)
        blocks.append(Grid(head, rows, numeric=tuple(range(1, len(columns))), marked=tuple(sorted(table.marked))))
    blocks.append(Words(
        "Helix early and helix late are the bounds where two local states are stable; the verdict takes the worse. "
        "Without buckling and by correlation are what other programs compute. Numbers with all their digits: "
        "operations.csv, drag.xlsx, drag.json.", "small",
    ))  # fmt: skip
    return ReportSection("Operations", tuple(blocks))


def ends_grid(found: Drag) -> Grid:
    """Hook load and torque of every operation."""
    well = found.well
    rows = tuple(
        (one.operation.name, depth(well, one.operation.bit_depth),
         "locks up" if one.ends.hook_load is None else force(well, one.ends.hook_load),
         "–" if one.ends.torque is None else torque(well, one.ends.torque), level_of_one(one))
        for one in found.operations
    )  # fmt: skip
    return Grid(("operation", "bit at", "hook load", "torque at surface", "verdict"), rows, numeric=(1, 2, 3))


def _text(cell: Cell, title: str) -> str:
    if cell is None:
        return "–"
    if title.startswith("±") and isinstance(cell, float):
        return short(cell) if cell else "0"
    return plain(cell, 5) if isinstance(cell, float) else str(cell)


def _operation(found: Drag, one: OperationResult, number: int) -> ReportSection:
    """What was found of one operation."""
    well = found.well
    blocks: list[Block] = []
    text = sentences_of(well, one)
    if level_of_one(one) == FAILS:
        blocks.append(Words(f"This operation {failure(well, one)}.", "warning"))
    if text:
        blocks.append(Items(tuple(text)))
    blocks.append(Picture(
        picture_of(number),
        f"Force, contact force and stress or torque along the string, {one.operation.name}, against measured depth",
        "Left: effective force, and that in the wall where fluids make it another; buckled intervals are shaded. "
        "Middle: contact force per length, mean of the local state. Right: torque where the string turns, else the "
        "largest von Mises stress.",
    ))  # fmt: skip
    blocks += _intervals(found, one)
    return ReportSection(one.operation.name[:1].upper() + one.operation.name[1:], tuple(blocks))


def _intervals(found: Drag, one: OperationResult) -> list[Block]:
    """Table of the buckled intervals."""
    buckled = one.run.buckled
    if not buckled:
        return []
    (m, unit), (n, force_unit), (q, per) = (units(found.well)[k] for k in ("depth", "force", "per_length"))
    rows = []
    for low, high, state in buckled[:MOST_INTERVALS]:
        inside = (one.run.measured_depth <= low) & (one.run.measured_depth >= high) & (one.run.states == state)
        compression, contact = -one.run.forces[inside], one.run.contacts[inside]
        bend = one.strength.bending[inside]
        rows.append((
            NAMES[state], plain(high / m, 6), plain(low / m, 6), plain(compression.max() / n),
            plain(contact.max() / q), plain(bend.max() / units(found.well)['stress'][0]),
        ))  # fmt: skip
    head = ("state", f"from [{unit}]", f"to [{unit}]", f"largest compression [{force_unit}]",
            f"largest contact force [{per}]", f"largest bending stress [{units(found.well)['stress'][1]}]")  # fmt: skip
    more = len(buckled) - MOST_INTERVALS
    note = [Words(f"{more} more intervals stand in drag.json.", "small")] if more > 0 else []
    return [Grid(head, tuple(rows), numeric=(1, 2, 3, 4, 5)), *note]


def _road_map() -> ReportSection:
    return ReportSection("Road map", (
        Picture("road-map", "Hook load and torque against the depth of the bit, for each operation and friction",
                "Hook load without the block, tension positive, against the depth of the bit. Thin: the push there is "
                "does not suffice; a curve ends where the string locks up. Where two local states are stable, the one "
                "with more contact is taken."),
        Words("The numbers stand in road-map.csv.", "small"),
    ))  # fmt: skip


def _calibration(found: Calibration) -> ReportSection:
    """Friction factors found, and how well they meet the measurements."""
    rows = tuple(
        (name, plain(value.value), "not told" if not math.isfinite(value.error) else plain(value.error, 2))
        for name, value in zip(found.names, found.friction, strict=True)
    )
    doubts: list[Block] = [Words(note, "warning") for note in found.notes]
    return ReportSection("Friction from measurements", (
        *doubts,
        Grid(("section", "friction factor", "± standard error"), rows, numeric=(1, 2)),
        Picture("calibration", "Measured and computed hook loads against the depth of the bit",
                "Measured loads (points) and those computed with the friction factors found (lines)."),
        Words(f"{scatter(found.well, found)} about those computed with these factors "
              f"({len(found.measured)} measurements). The standard "
              "error is that of the scatter alone: it does not cover what the model leaves out.", "small"),
    ))  # fmt: skip


def _inputs(found: Drag) -> ReportSection:
    """String and hole as they were taken."""
    well = found.well
    (m, unit), (q, per) = (units(well)[k] for k in ("depth", "per_length"))
    string = tuple(
        (part.name, "to surface" if math.isinf(part.rod.length) else plain(part.rod.length / m, 6),
         well.system.text(part.rod.outer_diameter or 0.0, "length"), plain(part.weight / q, 5),
         well.system.text(part.rod.stiffness, "stiffness"))
        for part in well.string
    )  # fmt: skip
    hole = tuple(
        (part.name, plain(part.start / m, 6), plain(min(part.end, well.end) / m, 6),
         well.system.text(part.diameter, "length"), plain(part.friction))
        for part in well.hole
    )  # fmt: skip
    return ReportSection("String and hole", (
        Grid(("string, from the bit up", f"length [{unit}]", "outer diameter", f"weight in the fluids [{per}]",
              "bending stiffness"), string, numeric=(1, 2, 3, 4)),
        Grid(("hole, from the top down", f"from [{unit}]", f"to [{unit}]", "diameter", "friction factor"), hole,
             numeric=(1, 2, 3, 4)),
        Items(tuple(assumptions(found))),
    ))  # fmt: skip
