"""A second method for a rod off the wall of a curved hole: the equations of a rod in space, with points of contact.

A boundary-value problem for place, tangent, curvature and internal force along free stretches, by collocation. Where
the rod touches, how hard, and where its end comes to lie along the hole are unknowns of it. Of the program it takes the
axis of the hole alone.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_bvp

from rodwell.analysis.off_wall.curved.own_places import in_fixed_axes, in_space, places_along
from rodwell.analysis.off_wall.measured import position
from rodwell.analysis.off_wall.state import ContactState

SIZE = 12
"""Unknown functions of a stretch: place, tangent, its derivative, internal force."""


def strands(state: ContactState, s: np.ndarray) -> np.ndarray:
    """Place, tangent, its derivative and force in space, (12, k), of a state at places (k,)."""
    fine = state.fine
    x, y, _ = position(fine, s)
    inside = fine.model.in_space(s, x, y, fine.load)
    k1, k2 = fine.model.beside(s)[:2]
    a = np.sqrt(1.0 - x[1] ** 2 - y[1] ** 2)
    q = a / (1.0 - k1 * x[0] - k2 * y[0])
    bend = np.stack([x[2] + a * q * k1, y[2] + a * q * k2,
                     -(x[1] * x[2] + y[1] * y[2]) / a - q * (k1 * x[1] + k2 * y[1])])  # fmt: skip
    rows = [in_space(fine, s)[0].T] + [in_fixed_axes(fine, s, one) for one in (inside.t, bend, inside.n)]
    return np.concatenate(rows)


class SpaceRod:
    """The boundary-value problem of a state whose stretches are all free, between clamped ends, points of contact."""

    def __init__(self, state: ContactState) -> None:
        self.problem, self.state = state.problem, state
        self.hole = state.problem.hole
        self.points = state.fine.solved.shape.breaks
        self.force = state.force

    def rates(self, xi: np.ndarray, v: np.ndarray, p: np.ndarray) -> np.ndarray:
        bounds = np.concatenate([[0.0], p[: self.points.size], [1.0]])
        out = np.empty_like(v)
        for i, length in enumerate(np.diff(bounds)):
            _, t, bend, n = v[SIZE * i : SIZE * (i + 1)].reshape(4, 3, -1)
            turned = -n + (np.sum(t * n, axis=0) - np.sum(bend**2, axis=0)) * t
            turned = turned - self.problem.twist * np.cross(t, bend, axis=0)
            weight = np.zeros_like(n)
            weight[2] = self.problem.weight
            out[SIZE * i : SIZE * (i + 1)] = length * np.concatenate([t, bend, turned, weight])
        return out

    def wall(self, r: np.ndarray) -> tuple[float, np.ndarray]:
        """The distance from the axis of the hole, and the direction towards it: by Newton's method on the place."""
        place = self.guess
        for _ in range(30):
            _, frame, point = (one[0] for one in self.hole.at(np.array([place])))
            off = (r - point) @ frame[2]
            place += off
            if abs(off) < 1e-15:
                break
        self.guess = place
        off = point - r
        return float(np.linalg.norm(off)), off / np.linalg.norm(off)

    def conditions(self, first: np.ndarray, last: np.ndarray, p: np.ndarray) -> np.ndarray:
        d, m = self.problem.clearance, self.points.size
        pushes, end = p[m : 2 * m], float(p[2 * m])
        _, frames, centres = self.hole.at(np.array([self.start, end]))
        r0, t0, b0, _ = first[:SIZE].reshape(4, 3)
        r1, t1, b1, n1 = last[-SIZE:].reshape(4, 3)
        left = [*(r0 - centres[0] + d * frames[0, 0]), *(t0 - frames[0, 2]), t0 @ b0]
        left += [*(r1 - centres[1] + d * frames[1, 0]), *(frames[1, :2] @ t1)]
        (k1, k2), lying = self.hole.curvatures(np.array([end]))[0], 1.0
        lying = 1.0 + d * k1
        moment = np.cross(t1, b1) - self.problem.twist * t1
        turning = k1 * frames[1, 1] - k2 * frames[1, 0]
        left.append(lying * (n1 @ frames[1, 2]) + moment @ turning - lying * self.force)
        for i in range(m):
            before, after = last[SIZE * i : SIZE * (i + 1)], first[SIZE * (i + 1) : SIZE * (i + 2)]
            self.guess = float(self.near[i])
            far, inward = self.wall(before[:3])
            left += [*(after[:9] - before[:9]), *(after[9:] - before[9:] + pushes[i] * inward)]
            left += [far - d, before[3:6] @ inward]
        return np.array(left)

    def solved(self) -> tuple[np.ndarray, object]:
        """Places and forces of contact and where the end lies, and the solution; from the state as a first guess."""
        own = self.state
        place = places_along(own.fine)
        self.start = float(place(np.zeros(1))[0])
        self.near = place(self.points)
        xi = np.linspace(0.0, 1.0, 41)
        bounds = np.concatenate([[0.0], self.points, [1.0]])
        guess = np.concatenate([
            strands(own, np.clip(a + (b - a) * xi, a + 1e-12, b - 1e-12)) for a, b in pairwise(bounds)
        ])  # fmt: skip
        pushes = [one.force.value for one in own.point_forces]
        p = np.concatenate([self.points, pushes, place(np.ones(1))])
        # away from the state: what comes out is not what went in
        bent = guess + 1e-4 * self.problem.clearance * np.sin(np.pi * xi) * np.cos(np.arange(guess.shape[0]))[:, None]
        found = solve_bvp(self.rates, self.conditions, xi, bent, p=p, tol=1e-9, max_nodes=4000)
        assert found.status == 0, found.message
        return found.p, found
