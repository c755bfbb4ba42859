"""The part of the report on strength: loads that act, the safe window, stresses, formulas beside the exact loads."""

from __future__ import annotations

from rodwell.answers.comparison.beside import FormulaRow
from rodwell.answers.data.along import along, shown
from rodwell.answers.result.assessment import BUCKLED, LEFT, OTHER_SHAPE, STRAIGHT, Assessment, AtLoad
from rodwell.answers.words.reach import unreached
from rodwell.answers.words.verdict import local_sentence
from rodwell.answers.words.wording import quantity
from rodwell.quantities.text import amount, minus, plain, supported
from rodwell.quantities.units import SI, System
from rodwell.quantities.value import Value
from rodwell.report.reports.content import Block, Grid, Picture, ReportSection, Words
from rodwell.strength.limits import LIFTS_OFF, Limit
from rodwell.strength.loaded import LoadedRod

WORDS = {
    STRAIGHT: "straight, stable",
    BUCKLED: "buckled, on the wall, stable",
    OTHER_SHAPE: "beyond the stable part of mode 1: it takes another shape",
    LEFT: "has left the wall",
}


def strength_sections(a: Assessment) -> tuple[ReportSection, ...]:
    """Return the sections on strength: those that the case has something to say on."""
    return (*_at_loads(a), _window(a), *_stress_section(a), *_formulas(a))


def _at_loads(a: Assessment) -> tuple[ReportSection, ...]:
    """What becomes of the rod at each load that acts."""
    if not a.applied:
        return ()
    stressed, strong = a.section is not None, _strong(a)
    borne = a.case.cylinder is not None or a.case.supports is not None
    columns = [
        ("Load as given", "given", True),
        ("Effective, at s = 1", "force", True),
        ("The rod", "what", True),
        ("Largest contact per length", "contact", True),
        ("Contact in all", "total", True),
        ("Approach of the ends", "shortening", True),
        ("Largest von Mises", "stress", stressed),
        ("Safety factor", "safety", strong),
        ("Most used capacity", "used", borne),
    ]
    shown_columns = [(head, name) for head, name, wanted in columns if wanted]
    rows = [_applied(a, at) for at in a.applied]
    table = Grid(
        tuple(head for head, _ in shown_columns),
        tuple(tuple(row.get(name, "") for _, name in shown_columns) for row in rows),
        numeric=tuple(i for i in range(len(shown_columns)) if i not in (0, 2)),
    )
    note = (
        "Tension positive. The approach of the ends is that by buckling. Where the rod has left the wall, or mode 1 "
        "has lost its stability, no numbers are given."
    )
    missed = [Words(sentence, "warning") for sentence in unreached(a)]
    return (ReportSection("At the loads that act", (table, Words(note, "small"), *missed)),)


def _strong(a: Assessment) -> bool:
    return a.case.yield_strength is not None and a.section is not None


def _window(a: Assessment) -> ReportSection:
    """Window, limits, and the figure along the rod."""
    local = local_sentence(a)
    caption = "Effective axial force along the rod, tension positive"
    caption += ", with the local limits of an endless rod at its lower end." if local else "."
    if a.section is not None:
        state = shown(along(a, 2)).state.name
        caption += (
            f" Stress in the rod {state}: axial from the real force, bending at the outer surface (either sign), and "
            "the largest von Mises stress of each section."
        )
    alternative = f"Force{' and stress' if a.section is not None else ''} along the rod"
    blocks: list[Block] = [Words(_window_text(a)), _limits(a)]
    blocks += [Words(local, "small")] if local else []
    return ReportSection("The safe window, and what limits it", (*blocks, Picture("along-rod", alternative, caption)))


def _stress_section(a: Assessment) -> tuple[ReportSection, ...]:
    if a.section is None:
        return ()
    head = ["State", "Largest von Mises", "± error", "Where", "axial there", "bending there, ±", "torsion there"]
    rows = tuple(_stress(a, state) for state in a.states)
    note = (
        "Lamé's stresses from the pressures, the real axial force in the wall, bending √(M₂² + M₃²) and torsion M₁ of "
        "the rod, at the inner and the outer surface; shear force and the pressing on the wall are neglected; nominal "
        "dimensions. "
    )
    if _strong(a):
        head.append("Safety factor")
        strength = _system(a).text(a.case.yield_strength or 0.0, "stress")
        if a.case.string is None:
            note += f"Safety factor: yield strength {strength} over the von Mises stress."
        else:
            note += "Safety factor: yield strength of a section over its largest von Mises stress, the least of all."
    else:
        note += "Give rod.grade or rod.yield_strength for safety factors."
    return (ReportSection("Stress in the rod", (Grid(tuple(head), rows, (1, 2, 4, 5, 6, 7)), Words(note, "small"))),)


def _formulas(a: Assessment) -> tuple[ReportSection, ...]:
    if not a.formulas:
        return ()
    head = ("Formula", "Load", "at", "Exact there", "Difference", "Verdict", "Beside", "Validity")
    note = (
        "Compression positive, at the place where the formula's force is measured: top s = 1, middle, bottom s = 0. "
        "Difference: formula/exact − 1. Unsafe: the formula's load is above the exact one; safe: below it, and the "
        "formula is valid for the rod; low: below it, but the formula is not meant for such a rod. Helical formulas "
        "stand beside lift-off, where a rod on the wall ends. rodwell audit compares every formula, coils included."
    )
    table = Grid(head, tuple(_formula(a, row) for row in a.formulas), numeric=(1, 3, 4))
    return (ReportSection("Formulas of practice beside the exact loads", (table, Words(note, "small"))),)


def _system(a: Assessment) -> System:
    return SI if a.case.scales is None else a.case.scales.system


_UNITS = {"force": "B/L²", "force_per_length": "B/L³", "length": "L"}


def _text(a: Assessment, value: float, dimension: str, digits: int = 5) -> str:
    """A number in units B = L = 1 in those of the case."""
    if a.case.scales is not None:
        return a.case.scales.text(value, dimension, digits)
    return minus(f"{value:.{digits}g} {_UNITS[dimension]}")


def _sized(a: Assessment, number: Value, dimension: str, digits: int = 4) -> str:
    """The same with the digits that its error allows, where that is not shown."""
    scales = a.case.scales
    if scales is None:
        return f"{amount(number, digits)} {_UNITS[dimension]}"
    return quantity(scales.system, number.times(scales.factor(dimension)), dimension, digits)


def _beside_error(a: Assessment, number: Value, dimension: str) -> str:
    """The same with the digits that its error supports, where that is shown."""
    if a.case.scales is not None:
        return a.case.scales.beside_error(number, dimension)
    count = supported(number, 6)
    return minus(f"{number.value:.{count}g} {_UNITS[dimension]}") if count else "0"


def _applied(a: Assessment, at: AtLoad) -> dict[str, str]:
    load, state = at.load, at.state
    kind = "real" if load.real else "effective"
    given = _system(a).text(load.given, "force", 6) if a.case.scales is not None else f"{load.given:.6g} B/L²"
    row = {
        "given": f"{minus(given)} at the {'bottom, s = 0' if load.bottom else 'top, s = 1'} ({kind})",
        "force": _text(a, load.force, "force"),
        "what": WORDS.get(at.what, f"not known: {at.why}"),
    }
    if state is None:
        return row
    stress, used = a.stress(state), [support.utilisation for support in a.supports(state)]
    cylinder = a.cylinder(state)
    used += [] if cylinder is None else [cylinder.utilisation]
    return row | {
        "contact": _sized(a, state.contact, "force_per_length"),
        "total": _sized(a, state.total_contact, "force"),
        "shortening": _sized(a, state.shortening, "length") if not state.straight else "0",
        "stress": "" if stress is None else quantity(_system(a), stress, "stress"),
        "safety": "" if stress is None or stress.safety is None else amount(stress.safety, 3),
        "used": f"{100.0 * max(used):.3g} %" if used else "",
    }


def _window_text(a: Assessment) -> str:
    """The window in words."""
    window = a.window
    if a.branch.lift_off_at_buckling:
        return "There is none: nothing presses the rod to the wall, and it leaves it as soon as it buckles."
    end, width = window.end, window.width
    if end is None or width is None:
        down_to = max(a.computed.until, a.branch.reach[0])  # it may end before it is where it was to go
        return f"No lift-off was found down to {_text(a, down_to, 'force')} at s = 1."
    if not end.buckled:
        return "There is none: the shape into which the rod buckles is unstable from the start (under dead loads)."
    percent = "" if window.percent is None else f", {window.percent:.3g} % of the compression at s = 0 at buckling"
    text = f"From buckling to {end.name} {_sized(a, width, 'force', 5)} of compression can be added{percent}"
    text += "; the buckled shape lies on the wall and is stable all the way (under dead loads)"
    limit = a.limiting
    return text + ("." if limit is None else f". What limits first is {limit.name}.")


def _limits(a: Assessment) -> Grid:
    """Buckling, and what gives after it, or before it."""
    weight, first = a.case.problem.hung_weight, Limit("buckling", a.window.buckling)
    rows = []
    for limit in sorted([first, *a.window.limits], key=lambda one: -(one.force if one.force is not None else 1e300)):
        if limit.load is None:
            rows.append((_upper(limit.name), "at any force", "", "", ""))
            continue
        note = "" if limit.s is None else f"at s/L = {limit.s:.4g}"
        if limit is not first and limit.kind != LIFTS_OFF and not limit.buckled:
            note += "; before the rod buckles, which it then does not do elastically"
        rows.append(
            (
                "Buckling: first critical load of the straight rod" if limit is first else _upper(limit.name),
                _beside_error(a, limit.load, "force"),
                _beside_error(a, Value(limit.load.value - weight, limit.load.error), "force"),
                _error(_text(a, limit.load.error, "force", 1)),
                note.removeprefix("; "),
            )
        )
    head = ("What", "End force at s = 1", "Effective force at s = 0", "± error", "Remark")
    return Grid(head, tuple(rows), numeric=(1, 2, 3))


def _error(text: str) -> str:
    """An error with its unit, small numbers without an exponent: "700 nN", not "7e+02 nN"."""
    value, _, unit = text.partition(" ")
    return minus(f"{plain(float(value.replace('−', '-')), 1)} {unit}")


def _upper(text: str) -> str:
    return text[:1].upper() + text[1:]


def _stress(a: Assessment, state: LoadedRod) -> tuple[str, ...]:
    """A state: its largest stress, the parts that make it up, and the safety factor."""
    stress, system = a.stress(state), _system(a)
    assert stress is not None
    row = (
        f"{state.name}, {'straight' if state.straight else 'buckled'}",
        system.beside_error(stress, "stress"),
        _error(system.text(stress.error, "stress", 1)),
        f"s/L = {stress.s:.4g}, {stress.fibre}",
        *(system.text(part, "stress") for part in (stress.axial, stress.bending, stress.torsion)),
    )
    return row if stress.safety is None else (*row, amount(stress.safety))


def _formula(a: Assessment, row: FormulaRow) -> tuple[str, ...]:
    """A formula: its load, the exact one, and how they compare."""
    main = row.main
    assert main is not None
    assert row.value is not None
    return (
        row.formula.name,
        _text(a, row.value, "force"),
        row.formula.place or "",
        _text(a, main.exact, "force"),
        "–" if main.percent is None else minus(f"{main.percent:+.1f} %"),
        row.verdict,
        {"critical": "critical load", "lift_off": "lift-off"}[row.against],
        "inside" if row.valid else "outside: " + "; ".join(row.reasons),
    )
