"""Table 1: double points of (77), where modes of a horizontal rod switch."""

from __future__ import annotations

import math
from collections.abc import Callable

from rodwell.analysis.straight.critical import critical_loads
from rodwell.errors import NotConvergedError
from rodwell.quantities.value import Value
from rodwell.studies.paper.claims import FORMULA, Claim, Known
from rodwell.studies.paper.work import CLEARANCE, Work, rod

ROWS = (
    (1, 3, "3.1416", "9.4248", "8.7668", "98.6960", 1),
    (2, 4, "6.2832", "12.5664", "62.3418", "197.3921", 1),
    (1, 5, "3.1416", "15.7080", "24.3523", "256.6097", 2),
    (3, 5, "9.4248", "15.7080", "219.1705", "335.5665", 1),
    (2, 6, "6.2832", "18.8496", "140.2691", "394.7842", 2),
    (4, 6, "12.5664", "18.8496", "561.0764", "513.2194", 1),
    (1, 7, "3.1416", "21.9911", "47.7305", "493.4802", 3),
    (3, 7, "9.4248", "21.9911", "429.5741", "572.4371", 2),
    (5, 7, "15.7080", "21.9911", "1193.2614", "730.3507", 1),
    (2, 8, "6.2832", "25.1327", "249.3673", "671.1331", 3),
    (4, 8, "12.5664", "25.1327", "997.4691", "789.5684", 2),
    (6, 8, "18.8496", "25.1327", "2244.3055", "986.9604", 1),
    (1, 9, "3.1416", "28.2743", "78.9014", "809.3076", 4),
    (3, 9, "9.4248", "28.2743", "710.1123", "888.2644", 3),
    (5, 9, "15.7080", "28.2743", "1972.5341", "1046.1781", 2),
    (7, 9, "21.9911", "28.2743", "3866.1668", "1283.0486", 1),
    (2, 10, "6.2832", "31.4159", "389.6364", "1026.4389", 4),
    (4, 10, "12.5664", "31.4159", "1558.5455", "1144.8741", 3),
    (6, 10, "18.8496", "31.4159", "3506.7273", "1342.2662", 2),
    (8, 10, "25.1327", "31.4159", "6234.1818", "1618.6151", 1),
)
"""n, m, k₁, k₃, γ_c, −F_c as printed, and the modal pair affected."""

AWAY = 0.002
"""The search starts this part below the printed weight."""

MOST_STEPS = 30


class DoublePoint:
    """The weight at which an even and an odd critical load of one rank are equal, found by the secant method.

    Even and odd modes are those of half the rod, guided or pinned at mid-length: with half the length loads are a
    quarter in number and the foundation a sixteenth. Each half has simple loads only, so the double point is a plain
    crossing.

    Attributes
    ----------
    weight, force
        γ_c and F_c with their errors.
    pair
        Number of the pair of modes that switch, counted on the whole rod.
    """

    def __init__(self, near: float, rank: int, work: Work) -> None:
        def loads(weight: float) -> tuple[float, float, float]:
            halves = [
                critical_loads(rod(weight / 16.0, ends=("clamped", middle)), rank, rtol=work.rtol)[-1]
                for middle in ("guided", "pinned")
            ]
            even, odd = (4.0 * half.force for half in halves)
            return even, odd, 4.0 * (halves[0].error + halves[1].error)

        before, x = (1.0 - AWAY) * near, (1.0 - 0.9 * AWAY) * near
        last = loads(before)
        for _ in range(MOST_STEPS):
            now = loads(x)
            gap, rate = now[0] - now[1], (now[0] - now[1] - last[0] + last[1]) / (x - before)
            if abs(gap) <= 2.0 * now[2] or abs(gap / rate) <= 1e-13 * x:
                break
            before, last, x = x, now, x - gap / rate
        else:
            raise NotConvergedError(f"no double point found near γ = {near:g}")
        error = (abs(gap) + now[2]) / abs(rate)
        slope = max(abs((now[i] - last[i]) / (x - before)) for i in (0, 1))
        self.weight = Value(x, error)
        self.force = Value(0.5 * (now[0] + now[1]), now[2] + slope * error)
        self.pair = _pair(x, self.force, rank, work)

    @property
    def wavenumbers(self) -> tuple[Value, Value]:
        """k₁ and k₃ from (75)."""
        a, b = -self.force.value, self.weight.value / CLEARANCE
        root = math.sqrt(a * a - 4.0 * b)
        da, db = self.force.error, self.weight.error / CLEARANCE
        out = []
        for sign in (-1.0, 1.0):
            k = math.sqrt(0.5 * (a + sign * root))
            error = (abs(1.0 + sign * a / root) * da + 2.0 * db / root) / (4.0 * k)
            out.append(Value(k, error))
        return out[0], out[1]


def _pair(weight: float, force: Value, rank: int, work: Work) -> int:
    """Which pair of modes meets, from how many loads of the whole rod come before."""
    modes = critical_loads(rod(weight), 2 * rank + 1, rtol=work.rtol)
    margin = 1e-6 * abs(force.value)
    before = sum(mode.force > force.value + margin for mode in modes)
    together = sum(abs(mode.force - force.value) <= margin for mode in modes)
    if together != 2 or before % 2:
        raise NotConvergedError(f"γ = {weight:g}: {together} loads near F = {force.value:g}, {before} before it")
    return before // 2 + 1


def double_point(work: Work, n: int, m: int) -> DoublePoint:
    """Return the double point of a row, computed once."""
    near = next(float(row[4]) for row in ROWS if row[:2] == (n, m))
    return work.once(("double", n, m), lambda: DoublePoint(near, (m - n) // 2, work))


def claims() -> list[Claim]:
    """Every entry of Table 1, and the numbers of the text after it."""
    out = []
    for n, m, k1, k3, weight, compression, pair in ROWS:
        take = _entry(n, m)
        place = f"Table 1, n = {n}, m = {m}"
        name = f"table1.{n}-{m}"
        out += [
            Claim(f"{name}.k1", place, "k₁ = nπ", k1, take(lambda p: p.wavenumbers[0])),
            Claim(f"{name}.k3", place, "k₃ = mπ", k3, take(lambda p: p.wavenumbers[1])),
            Claim(f"{name}.weight", place, "γ_c of the double point", weight, take(lambda p: p.weight)),
            Claim(f"{name}.force", place, "−F_c of the double point [B/L²]", compression,
                  take(lambda p: p.force.times(-1.0))),
            Claim(f"{name}.pair", place, "modal pair affected", str(pair), take(lambda p: Value(float(p.pair)))),
        ]  # fmt: skip
    for n, weight in ((1, "8.7668"), (2, "62.3418"), (3, "219.1705")):
        out.append(
            Claim(f"table1.text.{n}", "text after Table 1; caption of Fig. 5", f"weight of first-mode switching {n}",
                  weight, _entry(n, n + 2)(lambda p: p.weight))
        )  # fmt: skip
    out.append(_without_clearance())
    return out


def _entry(n: int, m: int) -> Callable[[Callable[[DoublePoint], Value]], Callable[[Work], Value]]:
    """Return a function that makes the computation of one entry of a row."""

    def take(part: Callable[[DoublePoint], Value]) -> Callable[[Work], Value]:
        return lambda work: part(double_point(work, n, m))

    return take


def _without_clearance() -> Claim:
    """The formula for the weights of first-mode switching as the text prints it."""
    formula = 9.0 * math.pi**4

    def evidence(work: Work) -> str:
        weights = (double_point(work, n, n + 2).weight.value / (n * n * (n + 2) ** 2 * math.pi**4) for n in (1, 2, 3))
        ratios = ", ".join(f"{ratio:.9f}" for ratio in weights)
        return f"Computed weights over n²(n+2)²π⁴ for n = 1, 2, 3: {ratios}, which is Δ."

    return Claim(
        "table1.text.formula", "text after Table 1", "weight of first-mode switching, n = 1", "mg = n²(n+2)²π⁴",
        _entry(1, 3)(lambda p: p.weight), FORMULA, formula,
        Known("8.7668", "The formula is printed without its factor Δ; the numbers beside it have it.", evidence),
    )  # fmt: skip
