"""The loads that act at the points of a study: columns of its tables, plain data, and sentences."""

from __future__ import annotations

from rodwell.answers.result.assessment import BUCKLED, LEFT, OTHER_SHAPE, PULLED, STRAIGHT, UNKNOWN
from rodwell.quantities.table import Cell
from rodwell.quantities.text import error_digit, number_text, plain
from rodwell.quantities.value import Value
from rodwell.strength.limits import CYLINDER, LIFTS_OFF, SUPPORT, UNSTABLE, YIELDS
from rodwell.studies.sweep.loads import BUCKLES, LoadResult
from rodwell.studies.sweep.points import StudyPoint
from rodwell.studies.sweep.study import Study

STATES = {
    STRAIGHT: "straight",
    BUCKLED: "buckled, on the wall, stable",
    OTHER_SHAPE: "buckled into another shape",
    LEFT: "off the wall",
    PULLED: "off the wall",
    UNKNOWN: "unknown",
}
"""What the rod is at a load, as tables and summary say it."""

WORDS = {
    STRAIGHT: "straight",
    BUCKLED: "buckled",
    OTHER_SHAPE: "reshaped",
    LEFT: "off wall",
    PULLED: "off wall",
    UNKNOWN: "unknown",
}
"""The same in a word or two."""

STATE = "the rod is"
"""Title of their column."""

UNTIL = {
    BUCKLES: "it buckles",
    LIFTS_OFF: "it leaves the wall",
    UNSTABLE: "its shape loses its stability",
    YIELDS: "the rod yields",
    CYLINDER: "the cylinder yields",
    SUPPORT: "a support is loaded to its capacity",
}
"""What compression is spared for."""

NOTES = (
    "Compression to spare at a load: how much more compression until then; negative: that much beyond; empty: not "
    "reached before the rod leaves the wall or takes another shape.",
    "Stress and safety factor are those of the rod, straight or buckled on the wall; empty where it is neither.",
)


def most_loads(study: Study) -> int:
    """Largest number of loads that act at a point."""
    return max((len(point.loads) for point in study.points), default=0)


def kinds(study: Study) -> list[str]:
    """What gives at some point of a study, in the order of the table."""
    return [kind for kind in UNTIL if any(kind in state.spare for point in study.points for state in point.loads)]


def columns(study: Study, force: str, per_length: str) -> list[str]:
    """Columns of the table as a file, for each load that acts; units of force and of force per length."""
    out, many = [], most_loads(study) > 1
    for k in range(most_loads(study)):
        name = f"load {k + 1}" if many else "load"
        out += [f"{name}: effective end force F at s = 1, tension positive [{force}]", f"{name}: the rod is"]
        for kind in kinds(study):
            out += [f"{name}: compression to spare until {UNTIL[kind]} [{force}]", "± error"]
        out += [f"{name}: largest contact force per length [{per_length}]", "± error"]
        if _any(study, "stress"):
            out += [f"{name}: largest von Mises stress in the rod [Pa]", "± error"]
        if _any(study, "safety"):
            out += [f"{name}: safety factor against yield", "± error"]
    return out


def _any(study: Study, name: str) -> bool:
    return any(getattr(state, name) is not None for point in study.points for state in point.loads)


def row(study: Study, point: StudyPoint) -> list[Cell]:
    """The cells of one point for these columns."""
    out: list[Cell] = []
    unit, per = point.factor("force"), point.factor("force_per_length")
    for k in range(most_loads(study)):
        state = point.loads[k] if k < len(point.loads) else None
        out += [None, None] if state is None else [state.load.force * unit, STATES[state.what]]
        for kind in kinds(study):
            out += pair(None if state is None else state.spare.get(kind), unit)
        out += pair(None if state is None else state.contact, per)
        for name in ("stress", "safety"):
            if _any(study, name):
                out += pair(None if state is None else getattr(state, name))
    return out


def pair(number: Value | None, unit: float = 1.0) -> list[Cell]:
    """The cells of a number and its error, empty where there is none."""
    return [None, None] if number is None else [number.value * unit, number.error * unit]


def head(study: Study, force: str, short: bool = False) -> list[str]:
    """Columns for reading, one row for each point and load; ``short`` for the terminal."""
    inputs = [v.label for v in study.varied]
    out = [
        *inputs,
        f"{'−F' if short else 'compression, −F at s = 1'} [{force}]",
        STATE,
        f"to buckling [{force}]",
        "±",
        f"to lift-off [{force}]",
        "±",
    ]
    if _others(study):
        out += [f"gives first [{force}]", "±"]
    return [*out, "safety" if short else "safety factor", "±"] if _any(study, "safety") else out


def _others(study: Study) -> bool:
    """Whether anything but buckling and lift-off is reached somewhere."""
    exceeded = any(state.exceeded for point in study.points for state in point.loads)
    return exceeded or any(kind not in (BUCKLES, LIFTS_OFF) for kind in kinds(study))


LEGEND = (
    "−F: effective compression at s = 1, positive. Buckled: on the wall and stable; reshaped: buckled into "
    "another shape. To buckling, to lift-off: compression to spare, negative where exceeded. Safety: factor against "
    "yield."
)
"""What stands beside the table for reading."""


def fails(state: LoadResult) -> bool:
    """Whether the rod leaves the wall, takes another shape or is not known, or a strength is exceeded."""
    over = any(spare.value < 0.0 for kind, spare in state.spare.items() if kind not in (BUCKLES, LIFTS_OFF, UNSTABLE))
    weak = state.safety is not None and state.safety.value < 1.0
    return state.what in (LEFT, PULLED, OTHER_SHAPE, UNKNOWN) or bool(state.exceeded) or over or weak


def cells(study: Study, point: StudyPoint, scale: float) -> list[list[str]]:
    """Rows of one point for reading, one for each load; ``scale`` is the unit of force in N (1 without dimensions)."""
    inputs = [
        str(v.values[i]) if v.numbers is None else plain(v.numbers[i], 6)
        for v, i in zip(study.varied, point.at, strict=True)
    ]
    unit = point.factor("force") / scale
    rows = []
    for state in point.loads:
        out = [plain(-state.load.force * unit, 5), WORDS[state.what]]
        for kind in (BUCKLES, LIFTS_OFF):
            out += texts(state.spare.get(kind), unit)
        if _others(study):
            out += _first(state, unit)
        if _any(study, "safety"):
            out += texts(state.safety, 1.0)
        rows.append([*inputs, *out])
    return rows


def texts(number: Value | None, unit: float) -> list[str]:
    """A number with the digits that its error supports, five at most, and the error; dashes where there is none."""
    if number is None:
        return ["–", "–"]
    return [number_text(number.times(unit), 5), error_digit(number.error * unit)]


def _first(state: LoadResult, unit: float) -> list[str]:
    """What gives first as compression grows, buckling and lift-off aside."""
    if state.exceeded:
        return [f"{UNTIL[state.exceeded[0]]}: at any load", "–"]
    others = {kind: spare for kind, spare in state.spare.items() if kind not in (BUCKLES, LIFTS_OFF)}
    if not others:
        return ["–", "–"]
    kind = min(others, key=lambda key: others[key].value)
    value, error = texts(others[kind], unit)
    return [f"{UNTIL[kind]}: {value}", error]


def load_sentences(study: Study) -> list[str]:
    """How the rod stands at the loads that act, over all points."""
    pairs = [(point, state) for point in study.points for state in point.loads]
    if not pairs:
        return []
    counts = {what: sum(state.what == what for _, state in pairs) for what in STATES}
    parts = [f"{STATES[what]} in {count}" for what, count in counts.items() if count]
    out = [f"At the loads that act (load.applied) the rod is {'; '.join(parts)}, of {len(pairs)} states."]
    for kind in (BUCKLES, LIFTS_OFF, UNSTABLE, YIELDS, CYLINDER, SUPPORT):
        spare = [(state.spare[kind].value * point.factor("force"), point, state) for point, state in pairs
                 if kind in state.spare]  # fmt: skip
        if spare:
            least, point, state = min(spare, key=lambda item: item[0])
            text = "Least to spare until" if least >= 0.0 else "Furthest beyond where"
            out.append(f"{text} {UNTIL[kind]}: {_force(study, abs(least))}, for {_which(study, point, state)}.")
    safe = [(state.safety.value, point, state) for point, state in pairs if state.safety is not None]
    if safe:
        least, point, state = min(safe, key=lambda item: item[0])
        out.append(
            f"Least safety factor of the rod against yield: {plain(least, 3)}, for {_which(study, point, state)}."
        )
    return out


def _which(study: Study, point: StudyPoint, state: LoadResult) -> str:
    """A point, and its load where there are several or where it does not vary."""
    push = -state.load.force * point.factor("force")
    word = "compression" if push >= 0.0 else "tension"
    said = f"{_force(study, abs(push))} of {word} at s = 1"
    return study.inputs(point) + ("" if study.load_varies else f", under {said}")


def _force(study: Study, value: float) -> str:
    return study.system.text(value, "force", 4) if study.physical else f"{plain(value)} B/L²"
