"""What is said of a load in one sentence, and how to get the same state without the page."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from rodwell.analysis.off_wall.state import ContactState
from rodwell.answers.result.answer import Answer
from rodwell.answers.words.verdict import verdict
from rodwell.case.applied import AppliedLoad
from rodwell.problem.problem import Problem
from rodwell.problem.sections import sections_text
from rodwell.web.explored import STRAIGHT, Explored
from rodwell.web.files import case_data
from rodwell.web.off_wall import leg_of
from rodwell.web.state import Shown


def sentence(explored: Explored, force: float) -> str:
    """Return the verdict on the rod at an end force F in B/L², as reports have it."""
    found, bottom = explored.computed, explored.forces.bottom
    scale = 1.0 if explored.case.scales is None else explored.case.scales.factor("force")
    given = scale * (force - (explored.forces.weight if bottom else 0.0))
    case = replace(explored.case, applied=(AppliedLoad(force, given, bottom),))
    answer = Answer(case, found.critical, found.branches, found.until, found.other_arm, found.lying)
    return verdict(answer.assessment)


def as_python(explored: Explored, solution: Shown, branch: str, which: int) -> str:
    """Return a script that computes the state that is shown."""
    problem, found = explored.case.problem, explored.computed
    lines = ["import rodwell", "", f"problem = {_call(problem)}"]
    if explored.path is not None and isinstance(solution, ContactState):
        path = explored.path
        mirror = ", mirror=True" if path.mirror else ""
        lines += [
            f"path = rodwell.load_path(problem, until={path.until!r}, unload_to={path.unload_to!r}{mirror}, "
            f"rtol={path.rtol!r})",
            f"states = path.at({solution.force!r})  # F at s = 1 in B/L², tension positive",
            f"state = next(one.state for one in states if one.leg == {leg_of(branch)!r})",
            "print(state, state.stability_index, state.certificate)",
            "print(state.gaps, state.point_forces, state.contact_total)",
        ]
        return "\n".join(lines) + "\n"
    if branch == STRAIGHT:
        lines += [f"critical = rodwell.critical_loads(problem, {len(found.critical)}, rtol={explored.case.rtol!r})",
                  f"force = {solution.force!r}  # end force F at s = 1 in B/L², tension positive",
                  "print(critical.first_met, force)"]  # fmt: skip
        return "\n".join(lines) + "\n"
    known = explored[branch]
    if found.lying is not None:
        part = "buckled" if known is found.lying.buckled else "pressed" if known is found.lying.pressed else "pulled"
        lines += [f"lying = rodwell.lying_rod(problem, [{found.until!r}], rtol={explored.case.rtol!r})",
                  f"branch = lying.{part}"]  # fmt: skip
    elif known.mode is not None:
        mirror = ", mirror=True" if known.origin.mirror else ""
        call = f"rodwell.follow(problem, mode={known.mode.number}, until={float(known.force.min())!r}{mirror}"
        lines.append(f"branch = {call}, rtol={explored.case.rtol!r})")
    else:
        call = f"problem, modes={len(found.critical)}, until={found.until!r}, rtol={explored.case.rtol!r}"
        lines += [f"diagram = rodwell.diagram({call})", f"branch = diagram[{branch!r}]"]
    lines += [
        f"state = branch.states_at({solution.force!r})[{which}]  # F at s = 1 in B/L², tension positive",
        "print(state, state.stability_index, state.certificate)",
        'print(state.largest("contact_pressure"), state.largest("xi2"), state.number("support_torque"))',
    ]
    return "\n".join(lines) + "\n"


def _call(problem: Problem) -> str:
    """The problem as it is written in Python: what differs from its defaults."""
    names = [field.name for field in fields(problem) if field.name not in ("weight", "ends")]
    default = Problem(problem.weight)
    given = [f"weight={problem.weight!r}"]
    given += [
        f"{name}={getattr(problem, name)!r}" for name in names if getattr(problem, name) != getattr(default, name)
    ]
    if problem.ends != default.ends:
        given.append(f"ends={'-'.join(problem.ends)!r}")
    return f"rodwell.Problem({', '.join(given)})"


def as_command(explored: Explored, solution: Shown) -> str:
    """Return the command that computes the same: of a case in its file, of plain numbers as options."""
    problem = explored.case.problem
    if explored.case.scales is not None:
        return "rodwell run case.toml    # case.toml: the button of that name saves it"
    options = [f"--weight {problem.weight!r}", f"--alpha {problem.alpha!r}", f"--clearance {problem.clearance!r}"]
    options += [f"--twist {problem.twist!r}"] if problem.twist else []
    options += [f"--poisson {problem.poisson!r}"] if problem.poisson != Problem.poisson else []
    options += [f"--torsion {problem.torsion!r}"] if problem.torsion is not None else []
    options += ["--floats"] if problem.floats else []
    options += [f"--sections {sections_text(problem.sections)}"] if problem.sections else []
    options += [f"--{name} {getattr(problem, name)!r}" for name in ("build", "walk") if getattr(problem, name) != 0.0]
    options += [f"--ends {'-'.join(problem.ends)}"] if problem.ends != ("clamped", "clamped") else []
    if explored.path is not None and isinstance(solution, ContactState):
        path = explored.path
        way = f"--until {path.until!r} --unload-to {path.unload_to!r}"
        return f"rodwell path {' '.join(options)} {way} --at {solution.force!r}"
    if explored.computed.lying is not None:
        return f"rodwell diagram {' '.join(options)}"
    many = len(explored.computed.critical)
    return f"rodwell diagram {' '.join(options)} --modes {many} --until {explored.computed.until!r}"


def snippets(explored: Explored, solution: Shown, branch: str, which: int) -> dict[str, Any]:
    """Return what can be copied."""
    return {
        "python": as_python(explored, solution, branch, which),
        "command": as_command(explored, solution),
        "case": case_data(explored, solution.force)[1],
    }
