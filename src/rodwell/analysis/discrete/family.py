"""Families of equilibria of a :class:`Problem`: where rod meets solver."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from rodwell.analysis.discrete.curved import along_rod
from rodwell.analysis.discrete.ramped import along_ramps
from rodwell.errors import InputError
from rodwell.numerics.equilibria.family import MIRROR, Family, Given
from rodwell.numerics.equilibria.series import series_path
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.held import Ends
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.curved import RodInCurvedHole, TaperedRodInCurvedHole
from rodwell.physics.on_wall.model import RodOfSections, RodOnCylinder
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, COUNT, FORCE, LATERAL_WEIGHT, RAMP, SIDE, TWIST
from rodwell.physics.on_wall.ramps import RodOnRamps
from rodwell.physics.on_wall.tapered import TERMS, RodOfTapers
from rodwell.problem.clearances import check_lies, refuse_bridging
from rodwell.problem.ends import OFF_WALL_ENDS, WITH_Y_HELD, refuse_off_wall
from rodwell.problem.problem import Problem
from rodwell.problem.rod import Rod
from rodwell.problem.varying import CURVATURES, Parameter, ParameterPath, throughout
from rodwell.problem.varying import FORCE as END_FORCE
from rodwell.quantities.arrays import FloatArray

HELD = {
    "clamped": (2, False),
    "pinned": (1, False),
    "guided": (1, True),
    "free": (0, False),
    "ball": (1, False),
    "loose": (0, False),
}
"""How many of the first two spline coefficients of y at an end are held, and whether the outermost follows the next."""


def parameters(problem: Problem, force: float = 0.0) -> FloatArray:
    """Physical parameters of ``problem`` in the order that kernels take them, (7,)."""
    out = np.empty(COUNT)
    out[RAMP] = problem.rise
    out[FORCE], out[AXIAL_WEIGHT], out[LATERAL_WEIGHT] = force, problem.axial_weight, problem.foundation
    if problem.hole is not None:
        out[AXIAL_WEIGHT] = out[LATERAL_WEIGHT] = problem.weight
    out[CLEARANCE], out[TWIST], out[SIDE] = problem.clearance, problem.twist, -1.0 if problem.outside else 1.0
    return out


def spline_ends(problem: Problem) -> Ends:
    """What the end conditions of ``problem`` hold.

    Without lateral weight, a rod with no end that holds y can be turned around the cylinder as a whole; y(0) = 0 then
    picks one of these equal states.
    """
    first, last = problem.ends
    if problem.lateral_weight == 0.0 and not problem.holds_angle and problem.hole is None:
        first = WITH_Y_HELD[first]
    (held_0, tied_0), (held_1, tied_1) = HELD[first], HELD[last]
    return Ends((held_0, held_1), (tied_0, tied_1))


def pair_ends(problem: Problem) -> tuple[Ends, Ends]:
    """What the ends of a rod off the wall hold of x, inwards from the wall, and of y.

    Ends on the wall are radially held: x and x' are. Without a wall a rod with no end that holds y can be moved along
    y as a whole, and one with loose ends along x: the displacement at s = 0 is held then.
    """
    first, last = problem.ends
    around = [HELD[first], HELD[last]]
    inwards = [HELD[end if end in OFF_WALL_ENDS else "clamped"] for end in problem.ends]
    for field in (around, inwards):
        if all(held == 0 or tied for held, tied in field):  # nothing holds the displacement itself
            field[0] = (2, False) if field[0][1] else (1, False)
    (x, y) = (Ends((f[0][0], f[1][0]), (f[0][1], f[1][1])) for f in (inwards, around))
    return x, y


def path(problem: Problem, parameter: Parameter, force: float = 0.0) -> FloatArray:
    """Parameters as one of :data:`PATHS` varies, or several: see :class:`rodwell.numerics.equilibria.family.Family`."""
    for name in parameter.names if isinstance(parameter, ParameterPath) else (parameter,):
        if (problem.hole is not None or name in CURVATURES) and name not in IN_CURVED_HOLE:
            known = ", ".join(IN_CURVED_HOLE)
            reason = f"must be one of {known} along a branch in a curved hole, which changes with it; loads as "
            raise InputError("parameter", name, f"{reason}functions of it are curves: lift_off_curve, special_curve")
        if problem.ramps and name not in WHERE_CLEARANCE_VARIES:
            known = ", ".join(WHERE_CLEARANCE_VARIES)
            raise InputError("parameter", name, f"must be one of {known} where the clearance varies along the rod")
    if isinstance(parameter, ParameterPath):
        return _own_path(problem, parameter, force)
    out = np.zeros((4, COUNT))
    out[0] = parameters(problem, force)
    if parameter == "weight":
        out[1, [AXIAL_WEIGHT, LATERAL_WEIGHT]] = _per_weight(problem)
        out[0, [AXIAL_WEIGHT, LATERAL_WEIGHT]] = 0.0
    elif parameter == "alpha":
        out[2, AXIAL_WEIGHT] = -problem.weight if problem.floats else problem.weight
        out[3, LATERAL_WEIGHT] = -problem.weight if problem.on_top else problem.weight
        out[0, [AXIAL_WEIGHT, LATERAL_WEIGHT]] = 0.0
    elif parameter not in TORSIONAL:
        which = {"force": FORCE, "clearance": CLEARANCE, "twist": TWIST}[parameter]
        out[1, which], out[0, which] = 1.0, 0.0
    return out


def _own_path(problem: Problem, along: ParameterPath, force: float) -> FloatArray:
    """Parameters along a path of one's own."""
    found = series_path(lambda t: parameters(along.problem(problem, t), along.force(t, force)), *along.limits)
    if found is None:
        names = ", ".join(along.names)
        reason = f"is no smooth function of {along}: follow the smooth pieces of the path one after the other"
        raise InputError("parameter", names, reason)
    return found


def _per_weight(problem: Problem) -> tuple[float, float]:
    if problem.hole is not None:
        return 1.0, 1.0
    unit = problem.but(weight=1.0)
    return unit.axial_weight, unit.foundation


TORSIONAL = ("poisson", "torsion")
"""Parameters on which no state depends, only how far it is twisted: the twisting moment is constant along the rod."""

PATHS = ("force", "weight", "alpha", "clearance", "twist", *TORSIONAL)
"""Parameters in which a branch can be followed: F, γ, α in degrees, Δ/L, T₁, ν, C/B."""

IN_CURVED_HOLE = ("force", "weight", "twist", *TORSIONAL)
"""Those of a curved hole, which stays as it is."""

WHERE_CLEARANCE_VARIES = ("force", "weight", "alpha", *TORSIONAL)
"""Those of a rod on a wall whose clearance varies, which stays as it is."""


def family(
    problem: Problem,
    space: SplineSpace,
    *,
    parity: int,
    wavenumber: float,
    scale: float,
    parameter: Parameter = END_FORCE,
    force: float = 0.0,
) -> Family:
    """Equilibria of ``problem`` as a parameter varies (at the end force ``force``, if that is another).

    ``wavenumber`` sets the slope that counts as one unit of arclength, Δ k (an amplitude of one radian);
    ``scale`` the change of the parameter that does.

    Raises
    ------
    InputError
        If the rod would leave the wall at its ends.
    """
    refuse_off_wall(problem.ends, "buckled states")
    refuse_bridging(problem, "buckled states")
    if problem.ramps:
        check_lies(problem)
    line = path(problem, parameter, force)
    along = throughout(problem, parameter)
    return Family(
        model=rod_model(problem),
        path=line,
        space=space,
        ends=spline_ends(problem),
        parity=parity,
        scale_c=problem.clearance,
        slope_scale=problem.clearance * wavenumber,
        lam_scale=scale,
        reflections=reflections(problem, parameter),
        given=given_along(problem),
        first_integral=all(_autonomous(one) and one.same_sides for one in along)
        and problem.ends == ("clamped", "clamped"),
        cells=tuple(sign for sign in _cells(problem) if all(sign in _cells(one) for one in along)),
    )


def in_other_hole(equilibria: Family, problem: Problem, force: float) -> Family:
    """The same equilibria along the end force, from ``force``, of a problem in another hole, curved or straight."""
    return replace(
        equilibria,
        model=rod_model(problem),
        path=path(problem, END_FORCE, force),
        ends=spline_ends(problem),
        given=given_along(problem),
        first_integral=False,
        cells=(),
    )


def _autonomous(problem: Problem) -> bool:
    """Whether the energy density does not depend on s."""
    return problem.axial_weight == 0.0 and not problem.sections and problem.hole is None


def rod_model(problem: Problem) -> RodOnCylinder | RodOfSections | RodOfTapers | RodInCurvedHole | RodOnRamps:
    """The model of a problem's rod on its wall."""
    if problem.ramps:
        return RodOnRamps()
    if problem.hole is not None:
        return TaperedRodInCurvedHole() if problem.tapered else RodInCurvedHole()
    if problem.tapered:
        return RodOfTapers()
    return RodOfSections() if problem.sections else RodOnCylinder()


def _cells(problem: Problem) -> tuple[int, ...]:
    """Signs of reflections y(p + x) → ± y(p − x) about any place p, where both ends are such places.

    Of a horizontal rod: a pinned end asks y(−x) = −y(x), a guided one y(−x) = y(x), which the twisting moment forbids.
    """
    if not _autonomous(problem) or problem.turns != 0:
        return ()
    signs = (-1,) if problem.twist != 0.0 else (-1, 1)
    ends = {"pinned": -1, "guided": 1}
    return signs if all(ends.get(end) in signs for end in problem.ends) else ()


def given_along(problem: Problem) -> Given | None:
    """What kernels are given along s: of sections, b, q and d of :mod:`rodwell.physics.on_wall.sections`, (m, 3).

    Of sections that taper, what :mod:`rodwell.physics.on_wall.tapered` names, (m, 17); of a curved hole, what
    :mod:`rodwell.physics.on_wall.curved` does, (m, 45), or (m, 52) where sections taper; where the clearance varies,
    what :mod:`rodwell.physics.on_wall.ramps` does, (m, 66).
    """
    if problem.ramps:
        return along_ramps(problem)
    if problem.hole is not None:
        return along_rod(problem)
    return given_in_kernels(problem.rod) if problem.sections else None


def given_in_kernels(rod: Rod) -> Given:
    """The same of a rod of sections."""
    return partial(_columns_at, polynomials(rod), rod) if rod.tapered else given_of(rod)


def polynomials(rod: Rod) -> FloatArray:
    """Origin and coefficients of each section that may taper, (n, 17)."""
    columns = [rod.breaks[:-1, None]]
    for profile, terms in ((rod.stiffness, TERMS), (rod.weight, TERMS), (rod.lever, TERMS + 1)):
        columns.append(np.pad(profile.coefficients, ((0, 0), (0, terms - profile.coefficients.shape[1]))))
    return np.concatenate(columns, axis=1)


def given_of(rod: Rod) -> Given:
    """b, q and d of a rod of sections at places (m,), (m, 3)."""
    if rod.tapered:
        return partial(_of_tapers, rod)
    columns = np.stack(
        [rod.stiffness.coefficients[:, 0], rod.weight.coefficients[:, 0], rod.lever.coefficients[:, 0]], 1
    )
    return partial(_columns_at, columns, rod)


def _of_tapers(rod: Rod, places: FloatArray) -> FloatArray:
    weight = rod.weight(places)
    return np.stack([rod.stiffness(places), weight, rod.lever(places) - weight * (places - 1.0)], axis=1)


def _columns_at(columns: FloatArray, rod: Rod, places: FloatArray) -> FloatArray:
    return np.ascontiguousarray(columns[rod.stiffness.piece_of(places)])


def reflections(problem: Problem, parameter: Parameter = END_FORCE) -> tuple[tuple[int, bool], ...]:
    """Reflections (sign, turned), y(s) → ± y(s) or ± y(1 − s), that the problem has for any value of a parameter.

    The twisting moment forbids all but y(s) → −y(1 − s); axial weight or unequal ends forbid to turn the rod round;
    a coil forbids to change one sign alone, and a hole that leaves the vertical plane to change any. The identity is
    left out.
    """
    others = [_reflections(one) for one in throughout(problem, parameter)]
    return tuple(one for one in _reflections(problem) if all(one in other for other in others))


def _reflections(problem: Problem) -> tuple[tuple[int, bool], ...]:
    turnable = problem.symmetric
    plain = problem.twist == 0.0 and problem.turns == 0
    if problem.in_space:
        return ((1, True),) if plain and turnable else ()
    found = [MIRROR] if plain else []
    found += [(1, True)] if plain and turnable else []
    return (*found, (-1, True)) if turnable else tuple(found)


def shape(family: Family, state: State, s: FloatArray, orders: int, c: FloatArray | None = None) -> FloatArray:
    """Y and its derivatives at ``s`` (m,), (orders, m): the spline (with coefficients ``c``, if given) and the ramp."""
    out = state.space.evaluate(state.c if c is None else c, s, orders)
    ramp = family.parameters(state.lam)[RAMP]
    out[0] += ramp * s
    if orders > 1:
        out[1] += ramp
    return out
