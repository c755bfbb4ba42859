"""A study as table and as plain data, and what it means in sentences."""

from __future__ import annotations

from collections import Counter

from rodwell.problem.words import hole_text
from rodwell.quantities.table import Cell, Table
from rodwell.quantities.text import amount, number_text, percent, plain
from rodwell.studies.sweep import load_columns
from rodwell.studies.sweep.points import StudyPoint
from rodwell.studies.sweep.study import APPLIED, Study


def notes(study: Study) -> tuple[str, ...]:
    """What the loads of a table are."""
    return (
        "Compression positive, at s = 1, where the end force acts, or at s = 0, the lower end of an inclined cylinder.",
        "First mode. Lift-off: the first load at which the rod leaves the wall somewhere; frictionless, "
        f"{holes(study)}.",
        "± is the estimate of the numerical error, from two nested meshes.",
    )


def holes(study: Study) -> str:
    """Whether the holes of the points are straight or curved; of how many points where there are both."""
    counts = Counter(hole_text(point.case.problem) for point in study.points if point.case is not None)
    if len(counts) < 2:
        return next(iter(counts), "no hole is known")
    said = (f"{hole} at {n} point{'s' * (n > 1)}" for hole, n in sorted(counts.items(), reverse=True))
    return ", ".join(said)


LOADS = {"critical": "buckles", "lift_off": "leaves the wall"}
STRENGTHS = {
    "yield": "yield strength of the rod",
    "cylinder": "yield strength of the cylinder",
    "support": "capacity of the most loaded support",
}


def units(study: Study) -> tuple[str, str]:
    """Units of force and of force per length in tables."""
    return ("N", "N/m") if study.physical else ("B/L²", "B/L³")


def study_table(study: Study) -> Table:
    """One row for each point; the worst cases at buckling and at lift-off are marked."""
    force, per_length = units(study)
    columns = ["point"]
    columns += [f"{v.name} [{v.unit}]" if v.unit else v.name for v in study.varied]
    columns += ["γ = mg L³/B", "α [deg]", "Δ/L"]
    for what in LOADS.values():
        columns += [f"{what}: compression at s = 1 [{force}]", f"± error [{force}]", f"{what}: at s = 0 [{force}]"]
    columns += ["half waves of the mode", "leaves the wall at s/L", f"largest contact force at lift-off [{per_length}]"]
    columns += [f"± error of it [{per_length}]"]
    for what in _beside(study).values():
        columns += [f"{what}: compression at s = 1 [{force}]", f"± error [{force}]"]
    for kind in _told(study):
        columns += [f"part of the {STRENGTHS[kind]} used at lift-off", "± error"]
    columns += load_columns.columns(study, force, per_length)
    columns.append("remarks")
    rows = tuple(_row(study, point) for point in study.points)
    of_loads = load_columns.NOTES if load_columns.most_loads(study) else ()
    return Table("Points", tuple(columns), rows, worst_points(study), (*notes(study), *of_loads))


BESIDE = {
    "without_wall": "buckles without the wall's help",
    "other_arm": "the other arm leaves the wall",
}
"""Further loads of a table as a file: the second where twist makes the arms of a mode differ."""


def _beside(study: Study) -> dict[str, str]:
    """Those that some point has."""
    return {name: what for name, what in BESIDE.items() if any(getattr(p, name) is not None for p in study.points)}


def worst_points(study: Study) -> frozenset[int]:
    """Numbers of the points that are marked as worst cases: none where the load varies, which they do not depend on."""
    if study.load_varies:
        return frozenset()
    return frozenset(worst.number for name in LOADS if (worst := study.worst(name)) is not None)


def _told(study: Study) -> list[str]:
    """Kinds of strength that the cases of a study tell of."""
    return [kind for kind in STRENGTHS if any(kind in point.used for point in study.points)]


def _row(study: Study, point: StudyPoint) -> tuple[Cell, ...]:
    cells: list[Cell] = [point.number + 1]
    for varied, i in zip(study.varied, point.at, strict=True):
        cells.append(str(varied.values[i]) if varied.numbers is None else varied.numbers[i])
    problem = None if point.case is None else point.case.problem
    cells += [None] * 3 if problem is None else [problem.weight, problem.alpha, problem.clearance]
    for name in LOADS:
        top, bottom = point.compression(name), point.compression(name, bottom=True)
        cells += [*(top or (None, None)), None if bottom is None else bottom.value]
    cells += [point.half_waves, ", ".join(f"{s:.6g}" for s in point.places) or None]
    cells += load_columns.pair(point.contact, point.factor("force_per_length"))
    for name in _beside(study):
        cells += load_columns.pair(point.compression(name))
    for kind in _told(study):
        cells += load_columns.pair(point.used.get(kind))
    return (*cells, *load_columns.row(study, point), remarks(study, point))


def remarks(study: Study, point: StudyPoint) -> str:
    """Worst case, and why results are missing."""
    parts = [
        f"worst case: least compression that {'buckles it' if name == 'critical' else 'lifts it off'}"
        for name in LOADS
        if point.number in worst_points(study) and study.worst(name) is point
    ]
    names = {"case": "not computed", "critical": "critical load", "lift_off": "lift-off", "contact": "contact force"}
    names["applied"] = "at the load"
    parts += [f"{names[name]}: {reason}" for name, reason in (point.reasons or {}).items()]
    return "; ".join(parts)


def load_text(study: Study, value: float) -> str:
    """A force for reading."""
    return study.system.text(value, "force", 5) if study.physical else f"{plain(value, 6)} B/L²"


def scales(study: Study) -> tuple[float, str, float, str]:
    """Divisor and unit of forces, and of contact forces, that suit the largest of the study, for reading."""
    force, per_length = units(study)
    if not study.physical:
        return 1.0, force, 1.0, per_length
    loads = [load for point in study.points for name in LOADS if (load := point.compression(name)) is not None]
    contacts = [p.contact.value * p.factor("force_per_length") for p in study.points if p.contact is not None]
    scale, force = study.system.unit("force", max((abs(load.value) for load in loads), default=1.0))
    per, per_length = study.system.unit("force_per_length", max(contacts, default=1.0))
    return scale, force, per, per_length


def head(study: Study, short: bool = False) -> list[str]:
    """Columns of the table of rods for reading; ``short`` for the terminal."""
    _, force, _, per_length = scales(study)
    shown = (v for v in study.varied if v.name != APPLIED)
    inputs = [v.label for v in shown]
    if short:
        return [*inputs, f"buckles [{force}]", "±", "at s = 0", "lifts off", "±", "s/L", f"contact [{per_length}]"]
    return [
        *inputs, f"buckles, −F at s = 1 [{force}]", "± error", f"at s = 0 [{force}]",
        f"leaves the wall, −F at s = 1 [{force}]", "± error", "at s/L", f"largest contact force then [{per_length}]",
    ]  # fmt: skip


def cells(study: Study, point: StudyPoint) -> list[str]:
    """One row of the table of rods for reading; a dash where there is no result."""
    scale, _, per, _ = scales(study)
    shown = [(v, i) for v, i in zip(study.varied, point.at, strict=True) if v.name != APPLIED]
    out = [str(v.values[i]) if v.numbers is None else plain(v.numbers[i], 6) for v, i in shown]
    for name in LOADS:
        top, bottom = point.compression(name), point.compression(name, bottom=True)
        out += ["–", "–"] if top is None else load_columns.texts(top, 1.0 / scale)
        if name == "critical":
            out.append("–" if bottom is None else number_text(bottom.times(1.0 / scale), 5))
    out.append(", ".join(plain(s, 3) for s in point.places) or "–")
    unit = point.factor("force_per_length") / per
    return [*out, "–" if point.contact is None else number_text(point.contact.times(unit), 4)]


def _beyond_theory(study: Study) -> list[str]:
    """Points at which strain, slenderness, slope or shortening are not what the theory assumes."""
    beyond = [point for point in study.points if point.validity is not None and point.validity.left]
    if not beyond:
        return []
    first = beyond[0]
    assert first.validity is not None
    where = study.rod_inputs(first)
    text = f"At {len(beyond)} of {len(study.points)} points the theory's small strain is left"
    return [
        f"{text}: take their loads as a rough guide only ({f'for {where}: ' if where else ''}{first.validity.why})."
    ]


def sentences(study: Study) -> list[str]:
    """What was found, worst cases first; before all, where the theory's assumptions are left."""
    out = _beyond_theory(study)
    for name, what in LOADS.items():
        worst = study.worst(name)
        load = None if worst is None else worst.compression(name)
        if worst is None or load is None:
            out.append(f"No point has a load at which it {what}.")
            continue
        others = [other.value for point in study.points if (other := point.compression(name)) is not None]
        text = f"compression at which it {what} is {load_text(study, load.value)} at s = 1"
        if study.rod_inputs(worst):
            text = f"Worst case: the least {text}, for {study.rod_inputs(worst)}"
            out.append(f"{text}; the largest over the study is {load_text(study, max(others))}.")
        else:
            out.append(f"The least {text}, whatever the load.")
        if load.value < 0.0:
            out.append(
                "Negative compression is tension: there the rod buckles under its own weight unless it is pulled."
            )
    for kind in _told(study):
        used = {point.number: point.used[kind] for point in study.points if kind in point.used}
        most = max(used, key=lambda number: used[number].value)
        part = used[most]
        share = percent(part) if part.value < 10.0 else f"{amount(part, 3)} times all of it"
        where = study.rod_inputs(study.points[most])
        out.append(f"Most of the {STRENGTHS[kind]} used at lift-off: {share}{f', for {where}' if where else ''}.")
    out += load_columns.load_sentences(study)
    lacking = [point for point in study.points if point.critical is None and point.lift_off is None and not point.loads]
    if lacking:
        out.append(f"{len(lacking)} of {len(study.points)} points could not be computed; the table says why.")
    partly = [p for p in study.points if p.critical is not None and p.lift_off is None]
    if partly:
        out.append(f"{len(partly)} points have no lift-off load; the table says why.")
    return out
