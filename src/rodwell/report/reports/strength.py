"""The part of the report on strength: loads that act, the safe window, stresses, formulas beside the exact loads."""

from __future__ import annotations

from rodwell.answers.comparison.beside import FormulaRow
from rodwell.answers.data.along import along, shown
from rodwell.answers.result.assessment import BUCKLED, LEFT, OTHER_SHAPE, PULLED, STRAIGHT, Assessment, AtLoad
from rodwell.answers.words.in_space import no_window
from rodwell.answers.words.reach import unreached
from rodwell.answers.words.verdict import load_text, local_sentence, share_shown
from rodwell.answers.words.wording import forces_of, place_text, quantity, side_of
from rodwell.quantities.forces import end_name
from rodwell.quantities.text import amount, minus, number_text, percent, plain
from rodwell.quantities.units import SI, System
from rodwell.quantities.value import Value
from rodwell.report.reports.content import Block, Grid, Items, Picture, ReportSection, Words
from rodwell.strength.limits import LIFTS_OFF, Limit
from rodwell.strength.loaded import LoadedRod

WORDS = {
    STRAIGHT: "straight, stable",
    BUCKLED: "buckled, on the wall, stable",
    OTHER_SHAPE: "beyond the stable part of mode 1: it takes another shape",
    LEFT: "has left the wall",
    PULLED: "has left the wall",
}


def _words(a: Assessment, at: AtLoad) -> str:
    if at.what == STRAIGHT and a.case.problem.hole is not None:
        return "lies along the hole"
    return WORDS.get(at.what, f"not known: {at.why}")


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
        ("The other end bears", "other", a.case.scales is not None and a.case.problem.hung_weight != 0.0),
        ("Effective, at s = 1", "force", a.case.scales is None),
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
    by = "by buckling" if a.computed.lying is None else f"against the undeformed rod on the {side_of(a.case)} side"
    note = (
        f"{'Effective forces. ' if a.case.with_fluids else ''}The approach of the ends is that "
        f"{by}. Where the rod has left the wall, or mode 1 has lost its stability, no numbers are given."
    )
    missed = [Words(sentence, "warning") for sentence in unreached(a)]
    return (ReportSection("At the loads that act", (table, Words(note, "small"), *missed)),)


def _strong(a: Assessment) -> bool:
    return a.case.yield_strength is not None and a.section is not None


def _window(a: Assessment) -> ReportSection:
    """Window, limits, and the figure along the rod."""
    local = local_sentence(a)
    caption = "Effective axial force along the rod, "
    caption += "tension positive" if a.case.scales is None else "compression positive"
    caption += ", with the compression at which an endless rod buckles and lifts off." if local else "."
    if a.section is not None:
        state = shown(along(a, 2)).state.name
        caption += (
            f" Stress in the rod {state}, tension positive: axial from the real force, bending at the outer surface "
            "(either sign), and the largest von Mises stress of each section."
        )
    alternative = f"Force{' and stress' if a.section is not None else ''} along the rod"
    blocks: list[Block] = [Words(_window_text(a)), _limits(a)]
    blocks += [Words(local, "small")] if local else []
    return ReportSection("The safe window, and what limits it", (*blocks, Picture("along-rod", alternative, caption)))


def _stress_section(a: Assessment) -> tuple[ReportSection, ...]:
    if a.section is None:
        return ()
    head = ["State", "Largest von Mises", "±\u00a0error", "Where", "axial there", "bending there, ±", "torsion there"]
    rows = tuple(_stress(a, state) for state in a.states)
    note = (
        "Lamé's stresses from the pressures, the real axial force in the wall, bending √(M₂² + M₃²) and torsion M₁ of "
        "the rod, at the inner and the outer surface; shear force and the pressing on the wall are neglected; nominal "
        "dimensions. "
    )
    note += "" if a.case.problem.hole is None else "Bending contains that by the hole. "
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
    """Formulas that apply to the rod beside the exact loads; below the table those that do not, and why."""
    if not a.formulas:
        return ()
    head = ("Formula", "Gives, as compression", "at", "Exact there", "Difference", "It is", "Held against")
    rows = tuple(_formula(a, row) for row in a.formulas if row.valid)
    note = (
        "Compression positive, at the place where the formula's force is measured: top s = 1, middle, bottom s = 0. "
        "Difference: formula/exact − 1. Unsafe: above the exact load. Safe but useless: below it by half or more. "
        "Helical formulas stand beside lift-off, where a rod on the wall ends. rodwell audit compares every formula."
    )
    blocks: list[Block] = [Grid(head, rows, numeric=(1, 3, 4)), Words(note, "small")] if rows else []
    left_out = [row for row in a.formulas if not row.valid]
    if left_out:
        blocks.append(Words("Not applicable to this rod, and so not shown:", "small"))
        blocks.append(Items(tuple(f"{row.formula.name}: {'; '.join(row.reasons)}." for row in left_out)))
    return (ReportSection("Formulas of practice beside the exact loads", tuple(blocks)),)


def _system(a: Assessment) -> System:
    return SI if a.case.scales is None else a.case.scales.system


_UNITS = {"force": "B/L²", "force_per_length": "B/L³", "length": "L"}


def _text(a: Assessment, value: float, dimension: str, digits: int = 5) -> str:
    """A number in units B = L = 1 in those of the case."""
    if a.case.scales is not None:
        return a.case.scales.text(value, dimension, digits)
    return f"{plain(value, digits)} {_UNITS[dimension]}"


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
    return f"{number_text(number, 6)} {_UNITS[dimension]}"


def _applied(a: Assessment, at: AtLoad) -> dict[str, str]:
    load, state = at.load, at.state
    row = {
        "given": load_text(a.case, load),
        "other": forces_of(a.case).other(Value(load.force)).strip(" ()"),
        "force": _text(a, load.force, "force"),
        "what": _words(a, at),
    }
    if state is None:
        return row
    stress, used = a.stress(state), [support.utilisation for support in a.supports(state)]
    cylinder = a.cylinder(state)
    used += [] if cylinder is None else [cylinder.utilisation]
    return row | {
        "contact": _sized(a, state.contact, "force_per_length"),
        "total": _sized(a, state.total_contact, "force"),
        "shortening": _sized(a, state.shortening, "length") if state.solution else "0",
        "stress": "" if stress is None else quantity(_system(a), stress, "stress"),
        "safety": "" if stress is None or stress.safety is None else amount(stress.safety, 3),
        "used": f"{plain(100.0 * max(used), 3)} %" if used else "",
    }


def _window_text(a: Assessment) -> str:
    """The window in words."""
    window, lying = a.window, a.computed.lying
    if lying is not None and lying.buckled is None:
        return f"There is none: {no_window(lying)}"
    if a.computed.left_before is not None:
        return "There is none: the curve of the hole takes the rod off this side of the wall before it buckles."
    if a.branch.lift_off_at_buckling:
        return "There is none: nothing presses the rod to the wall, and it leaves it as soon as it buckles."
    end, width = window.end, window.width
    if end is None or width is None:
        far = max(a.computed.until, a.branch.reach[0])  # it may end before it is where it was to go
        return f"No lift-off was found down to {forces_of(a.case).load(Value(far), other=True)}."
    if not end.buckled:
        return "There is none: the shape into which the rod buckles is unstable from the start (under dead loads)."
    share = share_shown(a)
    part = "" if share is None else f", {percent(share)} of that{forces_of(a.case).at_end} at buckling"
    text = f"From buckling to {end.name} {_sized(a, width, 'force')} of compression can be added{part}"
    text += "; the buckled shape lies on the wall and is stable all the way (under dead loads)"
    limit = a.limiting
    return text + ("." if limit is None else f". What limits first is {limit.name}.")


def _limits(a: Assessment) -> Grid:
    """Buckling, and what gives after it, or before it, at both ends where they differ."""
    said, first = forces_of(a.case), Limit("buckling", a.window.buckling)
    straight, left = a.case.problem.hole is None, a.computed.left_before is not None
    buckles = f"Buckling: first critical load of the {'straight rod' if straight else 'rod as it lies'}"
    lying = a.computed.lying
    if lying is not None:
        left = lying.buckled is None and lying.end is not None
        buckles = (
            "The last load followed: the rod lies there" if lying.end is None else "Buckling of the rod as it lies"
        )
    two = said.scales is None or said.weight != 0.0
    rows = []
    for limit in sorted(
        [*([] if left else [first]), *a.window.limits], key=lambda one: -(one.force if one.force is not None else 1e300)
    ):
        if limit.load is None:
            rows.append((_upper(limit.name), "at any force", *([""] if two else []), "", ""))
            continue
        note = "" if limit.s is None else place_text(a.case, Value(limit.s))
        if limit is not first and limit.kind != LIFTS_OFF and not limit.buckled:
            note += "; before the rod buckles, which it then does not do elastically" if lying is None else ""
        rows.append(
            (
                buckles if limit is first else _upper(limit.name),
                *(_beside_error(a, load, "force") for load in _both_ends(a, limit.load)[: 1 + two]),
                _text(a, limit.load.error, "force", 1),
                note.removeprefix("; "),
            )
        )
    heads = ("End force at s = 1", "Effective force at s = 0")
    if said.scales is not None:
        there = end_name(said.scales, bottom=not said.bottom)
        heads = (f"Compression{said.at_end}", f"at {there}")
    head = ("What", *heads[: 1 + two], "±\u00a0error", "Where")
    return Grid(head, tuple(rows), numeric=tuple(range(1, 3 + two)))


def _both_ends(a: Assessment, load: Value) -> tuple[Value, Value]:
    """A load at the end shown and at the other one: compression, or without dimensions tension positive."""
    said = forces_of(a.case)
    here, there = said.compression(load), Value((0.0 if said.bottom else said.weight) - load.value, load.error)
    return (here, there) if said.scales is not None else (here.times(-1.0), there.times(-1.0))


def _upper(text: str) -> str:
    return text[:1].upper() + text[1:]


def _stress(a: Assessment, state: LoadedRod) -> tuple[str, ...]:
    """A state: its largest stress, the parts that make it up, and the safety factor."""
    stress, system = a.stress(state), _system(a)
    assert stress is not None
    row = (
        f"{state.name}, {_shape(a, state)}",
        system.beside_error(stress, "stress"),
        system.text(stress.error, "stress", 1),
        f"{place_text(a.case, Value(stress.s))}, {stress.fibre}",
        *(system.text(part, "stress") for part in (stress.axial, stress.bending, stress.torsion)),
    )
    return row if stress.safety is None else (*row, amount(stress.safety))


def _shape(a: Assessment, state: LoadedRod) -> str:
    if not state.straight:
        return "buckled"
    return "straight" if a.case.problem.hole is None else "along the hole"


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
        row.judgement,
        {"critical": "critical load", "lift_off": "lift-off"}[row.against],
    )
