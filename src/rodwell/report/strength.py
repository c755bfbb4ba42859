"""The part of the report on strength: loads that act, the safe window, stresses, formulas beside the exact loads."""

from __future__ import annotations

from rodwell.practice.along import along, shown
from rodwell.practice.answer import Answer
from rodwell.practice.assessment import BUCKLED, LEFT, OTHER_SHAPE, STRAIGHT, Assessment, AtLoad
from rodwell.practice.audit import Row
from rodwell.practice.limits import LIFTS_OFF, Limit
from rodwell.practice.loaded import LoadedRod
from rodwell.practice.units import SI, System
from rodwell.practice.verdict import local_sentence
from rodwell.report.templates import template

WORDS = {
    STRAIGHT: "straight, stable",
    BUCKLED: "buckled, on the wall, stable",
    OTHER_SHAPE: "beyond the stable part of mode 1: it takes another shape",
    LEFT: "has left the wall",
}


def strength_section(answer: Answer, picture: str) -> str:
    """Return the HTML of this part; ``picture`` is the address of the figure along the rod."""
    a = answer.assessment
    strong = answer.case.yield_strength is not None and a.section is not None
    used = answer.case.cylinder is not None or answer.case.supports is not None
    return str(
        template("strength.html.j2").render(
            applied=[_applied(a, at) for at in a.applied],
            stressed=a.section is not None,
            strong=strong,
            borne=used,
            window=_window(a),
            limits=_limits(a),
            local=local_sentence(answer),
            picture=picture,
            shown=shown(answer, along(answer, 2)).state.name,
            stresses=[_stress(a, state) for state in a.states] if a.section is not None else [],
            strength="" if not strong else _system(a).text(answer.case.yield_strength or 0.0, "stress"),
            formulas=[_formula(a, row) for row in a.formulas],
        )
    )


def _system(a: Assessment) -> System:
    return SI if a.case.scales is None else a.case.scales.system


def _text(a: Assessment, value: float, dimension: str, digits: int = 5) -> str:
    """A number in units B = L = 1 in those of the case."""
    if a.case.scales is not None:
        return a.case.scales.text(value, dimension, digits)
    unit = {"force": "B/L²", "force_per_length": "B/L³", "length": "L"}[dimension]
    return f"{value:.{digits}g} {unit}".replace("-", "−")


def _error(value: float) -> str:
    return f"{value:.0e}".replace("e-0", "e-").replace("-", "−")


def _applied(a: Assessment, at: AtLoad) -> dict[str, str]:
    load, state = at.load, at.state
    kind = "real" if load.real else "effective"
    given = _system(a).text(load.given, "force", 6) if a.case.scales is not None else f"{load.given:.6g} B/L²"
    row = {
        "given": f"{given.replace('-', '−')} at the {'bottom, s = 0' if load.bottom else 'top, s = 1'} ({kind})",
        "force": _text(a, load.force, "force"),
        "what": WORDS.get(at.what, at.why),
    }
    if state is None:
        return row
    found, used = a.stress(state), [support.utilisation for support in a.supports(state)]
    cylinder = a.cylinder(state)
    used += [] if cylinder is None else [cylinder.utilisation]
    return row | {
        "contact": _text(a, state.contact.value, "force_per_length", 4),
        "total": _text(a, state.total_contact[0], "force", 4),
        "shortening": _text(a, state.shortening[0], "length", 4) if not state.straight else "0",
        "stress": "" if found is None else _system(a).text(found.value, "stress", 4),
        "safety": "" if found is None or found.safety is None else f"{found.safety[0]:.3g}",
        "used": f"{100.0 * max(used):.3g} %" if used else "",
    }


def _window(a: Assessment) -> str:
    """The window in words."""
    window = a.window
    if a.branch.lift_off_at_buckling:
        return "There is none: nothing presses the rod to the wall, and it leaves it as soon as it buckles."
    end, width = window.end, window.width
    if end is None or width is None:
        return f"No lift-off was found down to {_text(a, a.answer.until, 'force')} at s = 1."
    if not end.buckled:
        return "There is none: the shape into which the rod buckles is unstable from the start (under dead loads)."
    percent = "" if window.percent is None else f", {window.percent:.3g} % of the compression at s = 0 at buckling"
    text = f"From buckling to {end.name} {_text(a, width[0], 'force')} of compression can be added{percent}"
    text += "; the buckled shape lies on the wall and is stable all the way (under dead loads)"
    limit = a.limiting
    return text + ("." if limit is None else f". What limits first is {limit.name}.")


def _limits(a: Assessment) -> list[dict[str, str]]:
    """Buckling, and what gives after it, or before it."""
    weight = a.case.problem.axial_weight
    start = a.window.buckling
    first = Limit("buckling", *start)
    rows = []
    for limit in sorted([first, *a.window.limits], key=lambda one: -(one.force if one.force is not None else 1e300)):
        if limit.force is None:
            rows.append({"name": _upper(limit.name), "top": "at any force", "bottom": "", "error": "", "note": ""})
            continue
        where = "" if limit.s is None else f"at s/L = {limit.s:.4g}"
        if limit is not first and limit.kind != LIFTS_OFF and not limit.buckled:
            where += "; before the rod buckles, which it then does not do elastically"
        name = "Buckling: first critical load of the straight rod" if limit is first else _upper(limit.name)
        rows.append(
            {
                "name": name,
                "top": _text(a, limit.force, "force", 6),
                "bottom": _text(a, limit.force - weight, "force", 6),
                "error": _text(a, limit.error, "force", 1),
                "note": where.removeprefix("; "),
            }
        )
    return rows


def _upper(text: str) -> str:
    return text[:1].upper() + text[1:]


def _stress(a: Assessment, state: LoadedRod) -> dict[str, str]:
    found, system = a.stress(state), _system(a)
    assert found is not None
    return {
        "name": f"{state.name}, {'straight' if state.straight else 'buckled'}",
        "value": system.text(found.value, "stress", 6),
        "error": system.text(found.error, "stress", 1),
        "where": f"s/L = {found.s:.4g}, {found.fibre}",
        "axial": system.text(found.axial, "stress"),
        "bending": system.text(found.bending, "stress"),
        "torsion": system.text(found.torsion, "stress"),
        "safety": "" if found.safety is None else f"{found.safety[0]:.4g}",
    }


def _formula(a: Assessment, row: Row) -> dict[str, str]:
    main = row.main
    assert main is not None
    assert row.value is not None
    percent = "–" if main.percent is None else f"{main.percent:+.1f} %".replace("-", "−")
    return {
        "name": row.formula.name,
        "value": _text(a, row.value, "force"),
        "place": row.formula.place or "",
        "exact": _text(a, main.exact, "force"),
        "percent": percent,
        "verdict": "safe" if main.safe else "unsafe",
        "against": {"critical": "critical load", "lift_off": "lift-off"}[row.against],
        "validity": "inside" if row.valid else "outside: " + "; ".join(row.reasons),
    }
