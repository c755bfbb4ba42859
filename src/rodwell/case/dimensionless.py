"""From the numbers of a case file without dimensions to the problem: the counterpart of ``physical``."""

from __future__ import annotations

import math

from rodwell.case import schema
from rodwell.case.applied import AppliedLoad
from rodwell.case.physical import check_force_words, check_reach
from rodwell.errors import InputError
from rodwell.problem.checks import LIMITS
from rodwell.problem.ends import checked_ends
from rodwell.problem.problem import Problem
from rodwell.problem.sections import checked_sections, sections_from


def check_sections(parsed: schema.CaseFile) -> None:
    """Refuse what a case without dimensions cannot use."""
    reasons = {
        "cylinder": "a dimensionless case has no stresses",
        "supports": "a dimensionless case has no capacities",
        "mud": "the weight of a dimensionless case is that in its fluids",
        "pressure": "the forces of a dimensionless case are effective ones",
        "packer": "changes of length are those of a pipe",
        "catalogue": "a dimensionless case has no pipe",
        "units": "results of a dimensionless case are in units of B and L",
    }
    for name, why in reasons.items():
        if getattr(parsed, name) is not None:
            raise InputError(name, None, f"needs [rod] and [hole]: {why}; leave it out")


def dimensionless(
    given: schema.Dimensionless | None, load: schema.DimensionlessLoad
) -> tuple[Problem, float | None, tuple[AppliedLoad, ...]]:
    """Problem, and end forces at s = 1: N(s) = F + γ cos α (s − 1)."""
    assert given is not None
    sections = [] if given.sections is None else sections_from(given.sections, "dimensionless.sections")
    try:
        problem = Problem(
            weight=abs(given.weight),
            floats=given.weight < 0.0,
            alpha=given.alpha,
            clearance=given.clearance,
            poisson=given.poisson,
            torsion=given.torsion,
            twist=load.twist,
            ends=checked_ends(given.ends),
            sections=checked_sections(sections),
            build=given.build,
            walk=given.walk,
        )
    except InputError as error:
        section = "load" if error.field == "twist" else "dimensionless"
        if error.field == "weight":
            allowed = f"must be up to {LIMITS['weight'][1]:g} in size; negative: the rod floats"
            reason = allowed if math.isfinite(given.weight) else error.reason
            raise InputError("dimensionless.weight", given.weight, reason) from None
        raise InputError(f"{section}.{error.field}", error.value, error.reason) from None
    if load.until is None and load.applied is None:
        check_force_words(load)
    bottom = load.at == "bottom"
    more = problem.hung_weight if bottom else 0.0
    until = None if load.until is None else load.until + more
    applied = tuple(AppliedLoad(given + more, given, bottom) for given in load.applied or ())
    check_reach(until, applied)
    return problem, until, applied


def stiffness_of_wall(given: schema.Dimensionless | None) -> float:
    """Stiffness of the wall in B/L⁴; infinite: rigid."""
    if given is None or given.wall_stiffness is None:
        return math.inf
    if not 0.0 < given.wall_stiffness < math.inf:
        reason = "must be above 0 and finite; leave it out for a rigid wall"
        raise InputError("dimensionless.wall_stiffness", given.wall_stiffness, reason)
    return float(given.wall_stiffness)
