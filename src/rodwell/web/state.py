"""One state of what was computed: found, and put into numbers, curves and a scene for the page.

Every state that the page shows comes from :func:`states_of`: on branches of the rod on the wall, and on its load path,
where it may have left it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.off_wall.certificate import LIMIT
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.space.geometry import Geometry
from rodwell.analysis.space.scene import drawn
from rodwell.errors import InputError, NotConvergedError
from rodwell.plots.paths.axes import described
from rodwell.plots.units import axis
from rodwell.quantities.names import QUANTITIES
from rodwell.quantities.text import number_text, plain
from rodwell.quantities.value import Peak, Value
from rodwell.report.pages.viewer import View, view
from rodwell.report.reports.texts import PLAIN_UNITS
from rodwell.web import off_wall
from rodwell.web.explored import NO_PULL, STRAIGHT, Explored

PLACES, SIDES = 241, 12
"""Places along the rod, of the curves too, and sides around it in the scene: what is drawn twenty times a second."""

DIGITS = 6

SAME = 1e-6
"""Part by which the highest pressure and the largest in size differ at most if they are one."""

Shown = Solution | ContactState


def states_of(explored: Explored, branch: str, force: float) -> tuple[Shown, ...]:
    """Return the states of a branch at an end force F in B/L², in order of travel; none if it does not pass there.

    Raises
    ------
    InputError
        For a branch that is not there.
    NotConvergedError
        If a state could not be computed.
    """
    if branch == STRAIGHT:
        start = explored.computed.first[0]  # where the branch leaves the straight rod: a rod without deflection
        point = start.meshes.at(start.point, force)
        if point is None:
            raise NotConvergedError(f"the straight rod could not be computed at F = {force:g} B/L²")
        return (Solution(start.problem, point, start.meshes),)
    if explored.path is not None and branch in off_wall.LEGS.values():
        return off_wall.states_at(explored.path, branch, force)
    if branch not in {known.name for known in explored.branches}:
        names = ", ".join([STRAIGHT, *(known.name for known in explored.branches)])
        raise InputError("branch", branch, f"must be one of {names}")
    return explored[branch].states_at(force)


OTHERS = {
    "end_shortening": "approach of the ends", "energy": "energy", "omega2_at_0": "end curvature",
    "omega2_at_1": "end curvature",
}  # fmt: skip
"""Further numbers of a state, and what they are called beside their symbol."""

KNOWN = ("rod", "material line", "cylinder")
"""Parts of the scene whose triangles are the same in every state."""


def plain_state(
    explored: Explored, solution: Shown, branch: str, which: int, count: int, *, known: bool = False
) -> dict[str, Any]:
    """Return a state as plain data: numbers with errors, curves along the rod, the scene.

    Parameters
    ----------
    explored, solution
        What was computed, and one state of it.
    branch, which, count
        Its branch, its place among the states there at this load, and how many these are.
    known
        Whether the page knows the triangles of the scene from a state before: they are left out then.
    """
    here = solution.fine if isinstance(solution, ContactState) else solution
    seen, rod = seen_of(explored, here, KNOWN if known else ())
    if isinstance(solution, ContactState):
        own = _off_the_wall(explored, solution, branch)
    else:
        own = _on_the_wall(explored, solution, branch)
    return own | {
        "branch": branch,
        "which": which,
        "count": count,
        "force": solution.force,
        "load": explored.shown(solution.force),
        "index": solution.stability_index,
        "stable": solution.stability_index == 0,
        "curves": curves(explored, solution, rod),
        "scene": seen.data,
        "bar": seen.bar,
    }


def seen_of(
    explored: Explored, solution: Solution | PatternedState, known: tuple[str, ...] = ()
) -> tuple[View, Geometry]:
    """The rod in its hole in three dimensions: what is seen of it, and where it is; ``known`` as of :func:`view`."""
    scales = explored.case.scales
    rod = drawn(solution, scales, PLACES)
    return view(solution, scales, rod, SIDES, readings=False, known=known), rod


def _on_the_wall(explored: Explored, solution: Solution, branch: str) -> dict[str, Any]:
    push = solution.largest("contact_pressure")
    off = is_off(solution, push.value)
    return {
        "off": off,
        "beyond": False,
        "accurate": solution.accurate,
        "headline": headline(explored, solution, branch, off),
        "values": numbers(explored, solution, push),
        "y": explored.ordinates({which: solution.number(which).value for which in Measured}),
    }


def _off_the_wall(explored: Explored, state: ContactState, branch: str) -> dict[str, Any]:
    load = explored.forces.load(Value(state.force))
    known = off_wall.numbers(state)
    return {
        "off": False,
        "beyond": True,
        "accurate": state.certificate.passed,
        "headline": f"{branch} at {load}: {described(state.fine, explored.case.scales)}",
        "values": {"force": _force(explored, state.force)}
        | {name: _number(explored, label, of, value, s) for name, (label, of, value, s) in known.items()},
        "y": explored.ordinates(off_wall.ordinates(state.fine)),
    }


def is_off(solution: Solution, largest: float) -> bool:
    """Whether the wall would have to pull somewhere: the rod has left it before. ``largest``: size of the pressure."""
    top, error = solution.number(Measured.P_MAX)
    return bool(top > max(error, NO_PULL * largest))


def headline(explored: Explored, solution: Solution, branch: str, off: bool) -> str:
    """What is shown, in one line."""
    load = explored.forces.load(Value(solution.force))
    what = "the straight rod" if branch == STRAIGHT else branch
    index = solution.stability_index
    stable = "stable" if index == 0 else f"unstable (index {index})"
    if branch != STRAIGHT and off:
        stable += "; the wall would have to pull: the rod has left it before this load"
    return f"{what} at {load}: {stable}"


def numbers(explored: Explored, solution: Solution, push: Peak) -> dict[str, Any]:
    """The numbers of a state by name: in B = L = 1 with their errors, and as they are shown.

    ``push``: the largest size of the contact pressure.
    """
    angle, torque = solution.largest("xi2"), solution.number("support_torque")
    pulled = solution.number(Measured.P_MAX).value > (1.0 - SAME) * push.value
    contact = "largest pull that the wall would have to give" if pulled else "largest push on the wall"
    out = {
        "force": _force(explored, solution.force),
        "largest_push": _number(explored, contact, "contact_pressure", push, push.s),
        "largest_angle": _angle("largest angle around the hole", angle, angle.s),
        "T2": _number(explored, "torque on the hole at s = 0, T₂(0)", "support_torque", torque),
    }  # fmt: skip
    for name, label in OTHERS.items():
        out[name] = _number(explored, f"{label} {QUANTITIES[name].symbol}", name, solution.number(name))
    return out


def _force(explored: Explored, force: float) -> dict[str, Any]:
    factor, unit = explored.load_unit
    compression = explored.forces.compression(Value(force)).value * factor
    return {"label": explored.forces.axis, "value": force, "error": 0.0, "shown": compression, "unit": unit,
            "text": f"{plain(compression, 10)} {unit}"}  # fmt: skip


def _number(explored: Explored, label: str, name: str, number: Any, s: float | None = None) -> dict[str, Any]:
    scales, dimension = explored.case.scales, QUANTITIES[name].dimension
    factor, unit = axis(name, scales, abs(number.value))
    known = Value(number.value, number.error)
    if scales is None:
        text, error = number_text(known, DIGITS), plain(number.error, 1)
        text, error = f"{text} {PLAIN_UNITS[dimension]}".rstrip(), f"{error} {PLAIN_UNITS[dimension]}".rstrip()
    else:
        text, error = scales.beside_error(known, dimension, DIGITS), scales.text(number.error, dimension, 1)
    return {"label": label, "value": number.value, "error": number.error, "shown": number.value * factor, "unit": unit,
            "text": text, "error_text": error, "s": s}  # fmt: skip


def _angle(label: str, number: Any, s: float) -> dict[str, Any]:
    degrees = Value(float(np.degrees(number.value)), float(np.degrees(number.error)))
    return {
        "label": label, "value": number.value, "error": number.error, "shown": degrees.value, "unit": "°",
        "text": f"{number_text(degrees, DIGITS)}°", "error_text": f"{plain(degrees.error, 1)}°", "s": s,
    }  # fmt: skip


def curves(explored: Explored, solution: Shown, rod: Geometry) -> dict[str, Any]:
    """Push on the wall and place around it along the rod, in the units shown; the gap of a rod off the wall.

    ``rod`` is the same state in space, whose fields are known already.
    """
    s, scales = rod.s, explored.case.scales
    fields = solution.fields(s) if isinstance(solution, ContactState) else rod.fields
    along, along_unit = (1.0, "L") if scales is None else axis("y", scales, 1.0)
    push = -fields["contact_pressure"]
    factor, unit = axis("contact_pressure", scales, float(np.abs(push).max()))
    if isinstance(solution, ContactState):
        gap, far = explored.case.problem.clearance * fields["gap"], axis("z", scales, explored.case.problem.clearance)
        more = {"gap": {"label": "gap", "unit": far[1], "values": (gap * far[0]).tolist()}}
        side = np.unwrap(fields["angle"])
    else:
        more, side = {}, fields["xi2"]
    return more | {
        "s": {"label": "s from the end s = 0", "unit": along_unit, "values": (s * along).tolist()},
        "push": {"label": "push on the wall", "unit": unit, "values": (push * factor).tolist()},
        "side": {"label": "angle around the hole", "unit": "°", "values": np.degrees(side).tolist()},
    }


def details(explored: Explored, solution: Shown) -> dict[str, Any]:
    """What a click asks for: index, certificate, whether the tolerance is met, the supports' loads."""
    if isinstance(solution, ContactState):
        return _details_off_the_wall(explored, solution)
    certificate, wall = solution.certificate, solution.wall
    return {
        "index": solution.stability_index,
        "converged": solution.converged,
        "rtol": explored.case.rtol,
        "certificate": {
            "worst": certificate.worst, "equation": certificate.worst_equation, "limit": certificate.limit,
            "passed": certificate.passed,
        },
        "wall": {
            "total": _number(explored, "contact force, all directions added", "force", wall.total),
            "torque": wall.meaning,
        },
    }  # fmt: skip


def _details_off_the_wall(explored: Explored, state: ContactState) -> dict[str, Any]:
    known = state.certificate
    worst = max(known.residuals, key=lambda name: known.residuals[name])
    return {
        "index": state.stability_index,
        "converged": known.passed,
        "rtol": explored.case.rtol,
        "certificate": {"worst": known.worst, "equation": worst, "limit": LIMIT, "passed": known.passed},
        "wall": {
            "total": _number(explored, "contact force, all directions added", "force", state.contact_total),
            "torque": "contact is complete" if state.fine.pattern.full else "partial contact",
        },
    }
