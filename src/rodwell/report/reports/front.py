"""The first sheet of a case's report: the case in words, the verdict, three numbers, what limits and by how much."""

from __future__ import annotations

from rodwell.analysis.loads.derivatives import Sensitivity
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.assessment import BUCKLED, STRAIGHT, Assessment, AtLoad
from rodwell.answers.result.spread import Spread
from rodwell.answers.words.advice import next_steps, statuses
from rodwell.answers.words.in_space import what_ends
from rodwell.answers.words.meaning import assumptions, sentences
from rodwell.answers.words.shown_loads import shown_sensitivities
from rodwell.answers.words.verdict import load_text, share_shown
from rodwell.answers.words.wording import bend_text, forces_of, quantity, size_text
from rodwell.case.case import Case
from rodwell.problem.words import ends_text
from rodwell.quantities.text import amount, percent, plain
from rodwell.quantities.value import Value
from rodwell.report.reports.content import Front, Number, Picture
from rodwell.strength.limits import LIFTS_OFF

LOGO = "logo"
"""Name of the picture of the logo."""


def front(answer: Answer, *, path: bool = False) -> Front:
    """Return the first sheet; with ``path`` its verdict goes on beyond lift-off."""
    a, case = answer.assessment, answer.case
    beyond = f" {_beyond(answer)}" if path and answer.beyond.path is not None else ""
    effective = "Forces are effective ones. " if case.with_fluids else ""
    return Front(
        verdict=sentences(answer)[0] + beyond,
        statuses=statuses(answer),
        numbers=_numbers(answer),
        picture=Picture(
            "sketch",
            f"Sketch of the case: {'; '.join(f'{name} {value}' for name, value in inputs_in_words(case))}",
            "The case as it is computed; the cross-section is to scale.",
        ),
        assumptions=f"{forces_of(case).convention}. {effective}Assumed: {'; '.join(assumptions(case))}.",
        steps=next_steps(answer),
        inputs=inputs_in_words(case),
        limits=_limits(a),
    )


def _beyond(answer: Answer) -> str:
    from rodwell.answers.words.beyond import story  # noqa: PLC0415 - takes a third of a second: only where the load path is asked for

    return story(answer.case, answer.beyond)


def inputs_in_words(case: Case) -> tuple[tuple[str, str], ...]:
    """What is computed, as pairs of what and how much."""
    p, scales, rod = case.problem, case.scales, case.rod
    lying = {0.0: "vertical", 90.0: "horizontal"}.get(p.alpha, f"{plain(p.alpha)}° from the vertical")
    bent = ", straight" if p.hole is None else f" at mid-length, {bend_text(case)}"
    upwards = ", upwards: the rod floats" if p.floats else ""
    if scales is None or rod is None:
        return (("Weight γ = mg L³/B", f"{plain(p.weight, 6)}{upwards}"),
                ("Hole", lying if p.hole is None else f"{lying}{bent}"), ("Clearance Δ/L", plain(p.clearance, 6)),
                ("Ends", ends_text(p)), *_loads(case))  # fmt: skip
    text = scales.system.text
    pipe = next((str(fact.value) for fact in case.facts if fact.label == "pipe"), "")
    across = "" if rod.outer_diameter is None else text(rod.outer_diameter, "length")
    bore = f", bore {text(rod.inner_diameter, 'length')}" if rod.inner_diameter else ""
    section = f"{across}{bore}" if across else f"stiffness {text(rod.stiffness, 'stiffness')}"
    weight = f"{scales.text(p.weight, 'force_per_length')}{upwards or (', buoyed' if case.with_fluids else '')}"
    hole = (
        f"{text(2.0 * p.clearance * scales.length + rod.outer_diameter, 'length')} wide, " if rod.outer_diameter else ""
    )
    out = [
        ("Rod", f"{pipe or section}, {scales.text(1.0, 'length')} long"),
        *([("Section", section)] if pipe and across else []),
        ("Weight per length", weight),
        ("Hole", f"{hole}{lying}{bent}"),
        ("Clearance of the axes", scales.text(p.clearance, "length")),
        ("Ends", ends_text(p)),
    ]
    if p.twist != 0.0:
        out.append(("Twisting moment at s = 1", scales.text(p.twist, "moment")))
    return (*out, *_loads(case))


def _loads(case: Case) -> tuple[tuple[str, str], ...]:
    if not case.applied:
        return (("Load", "none given: loads at which something happens are shown"),)
    return (("Load", "; ".join(load_text(case, load) for load in case.applied)),)


def _numbers(answer: Answer) -> tuple[Number, ...]:
    """Where it buckles, where that ends, and how strong it is there: three at most."""
    a, said = answer.assessment, forces_of(answer.case)
    spreads = {load.name: (load, spread) for load, spread in shown_sensitivities(answer)}
    first = "Buckles at" if answer.left_before is None else "Leaves the wall at"
    if answer.lying is not None and answer.no_window and answer.left_before is None:
        first = "Lies on the wall, as far as followed, to" if answer.lying.end is None else "Loses its stability at"
    name = "critical load of mode 1"
    if answer.lying is not None or answer.left_before is not None:  # the load of the first derivatives
        name = next(iter(spreads), name)
    out = [_load(first, answer, a.window.buckling, spreads.get(name))]
    end = a.window.end
    if end is not None and end.load is not None and not answer.no_window:
        rod = answer.case.problem.rod
        between = " between steps" if rod.stepped else " between kinks" if rod.kinked else ""
        leaves = f"Leaves the wall{between} at"
        label = leaves if end.kind == LIFTS_OFF else "Loses its stability at"
        out.append(_load(label, answer, end.load, spreads.get("lift-off load") if end.kind == LIFTS_OFF else None))
    return (*out, _third(a, said.scales is not None))[:3]


def _load(label: str, answer: Answer, force: Value, known: tuple[Sensitivity, Spread | None] | None) -> Number:
    """A load at the end shown, with the other end below it, and what the inputs leave uncertain."""
    said, scales = forces_of(answer.case), answer.case.scales
    if scales is None:
        return Number(f"{label} the end force at s = 1", f"{amount(force, 5)} B/L²", note="tension positive")
    word = "tension" if said.compression(force).value < 0.0 else "compression"
    spread = None if known is None else known[1]
    text = "" if spread is None else f"± {scales.system.text(spread.total, 'force', 2)}"
    note = said.other(force).strip(" ()") + ("; ± from the inputs" if text else "")
    return Number(f"{label}, {word}{said.at_end}", said.size(force), text, note.removeprefix("; "))


def _third(a: Assessment, dimensions: bool) -> Number:
    """Safety at the load that acts or, without one, stress, or what the wall must bear."""
    most = _most(a)
    state = most.state if most is not None and most.state is not None else a.at_lift_off or a.at_buckling
    stress, scales = a.stress(state), a.case.scales
    if stress is not None and scales is not None:
        if stress.safety is not None:
            note = f"largest von Mises stress {quantity(scales.system, stress, 'stress', 3)}"
            return Number(f"Safety factor against yield {state.name}", amount(stress.safety, 3), note=note)
        return Number(f"Largest von Mises stress {state.name}", quantity(scales.system, stress, "stress", 3))
    push = size_text(scales, state.contact, "force_per_length", "B/L³")
    return Number(f"Largest push on the wall {state.name}, per length", push)


def _most(a: Assessment) -> AtLoad | None:
    return min(a.applied, key=lambda at: at.load.force, default=None)


def _limits(a: Assessment) -> str:
    """What limits, and by how much."""
    window, said, at = a.window, forces_of(a.case), _most(a)
    what = "buckling" if a.computed.left_before is None else "leaving the wall"
    lying, first = a.computed.lying, a.limiting
    if lying is not None:
        what = what_ends(lying)
    names = {STRAIGHT: what, BUCKLED: "lift-off"}
    if at is None or at.what not in names:
        width, end = window.width, window.end
        if first is not None and first.load is not None:
            return f"What limits first: {first.name}, at {said.load(first.load, other=True)}."
        if width is None or end is None or not end.buckled or a.computed.no_window:
            return f"What limits: {what}." if at is None else ""
        share = share_shown(a)
        part = "" if share is None else f", {percent(share)} of the load at buckling"
        return f"What limits: {end.name}, {size_text(a.case.scales, width)} beyond buckling{part}."
    limit = None if window.end is None else window.end.load
    if at.what == STRAIGHT and (lying is None or lying.end is not None):
        limit = window.buckling
    name = names[at.what] if at.what == STRAIGHT or window.end is None else window.end.name
    if first is not None and first.load is not None and (limit is None or first.load.value > limit.value):
        limit, name = first.load, first.name
    if limit is None:
        return "No limit was found down to the load asked for."
    left = Value(at.load.force - limit.value, limit.error)
    size = abs(said.compression(limit).value)
    part = "" if size <= 0.0 else f" ({percent(Value(left.value / size, left.error / size))} of the limit)"
    if left.value < 0.0:
        return f"What limits: {name}, passed by {size_text(a.case.scales, left.times(-1.0))}{part.replace('(−', '(')}."
    return f"What limits: {name}; {size_text(a.case.scales, left)} more can be borne{part}."
