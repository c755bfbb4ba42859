"""Fig. 11 and section 4.2: twist of a rod prepared at its lift-off load."""

from __future__ import annotations

from rodwell.analysis.curves.curve import Curve
from rodwell.analysis.curves.states import twist_curve
from rodwell.quantities.value import Value
from rodwell.studies.paper.claims import Claim, Known
from rodwell.studies.paper.stability import sound
from rodwell.studies.paper.work import Work, rod

FIG11 = ((62.0, 16.5), (62.0, 90.0))
"""γ from and to which the curve is traced: back to where it leaves the figure on its way to infinity at γ = 15.047,
below which twist no longer lifts the rod off; beyond the switching."""

ODD = 30.0
"""A weight at which the first mode is antisymmetric."""


def fig11(work: Work) -> tuple[Curve, ...]:
    """Twist at which the rod lifts off again, T₁ > 0, on the arm where that sense presses the rod to the wall."""
    return sound(twist_curve(rod(0.0), limits, mirror=True, rtol=work.rtol) for limits in FIG11)


def claims() -> list[Claim]:
    """Twist does not enter the critical loads; which sense settles the rod."""
    place = "section 4.2"
    arm = Known(
        "-1",
        "The paper leaves open on which of the two mirror arms T₁ > 0 stabilises. For the first mode at this weight it "
        "is the arm ω₂(1) > 0; on the arm ω₂(1) < 0, along which the paper takes its other solutions, it is T₁ < 0.",
        _reflection,
    )
    return [
        Claim("fig11.upper", place, "sign of T₁ that stabilises, γ = 30, arm ω₂(1) > 0", "1",
              lambda work: _sense(work, True)),
        Claim("fig11.lower", place, "sign of T₁ that stabilises, γ = 30, arm ω₂(1) < 0", "1",
              lambda work: _sense(work, False), known=arm),
        Claim("text.twist", place, "F_c,1 at T₁ = 5 less F_c,1 at T₁ = 0, γ = 30 [B/L²]", "0.0000000", _shift),
    ]  # fmt: skip


def _sense(work: Work, mirror: bool) -> Value:
    return Value(float(work.twisted(rod(ODD), mirror=mirror).sense))


def _shift(work: Work) -> Value:
    loads = [work.critical(rod(ODD, twist=twist), 1)[0] for twist in (5.0, 0.0)]
    return Value(loads[0].force - loads[1].force, loads[0].error + loads[1].error)


def _reflection(work: Work) -> str:
    parts: list[str] = []
    for mirror, arm in ((True, "ω₂(1) > 0"), (False, "ω₂(1) < 0")):
        torsion = work.twisted(rod(ODD), mirror=mirror)
        rates = ", ".join(
            f"{rate:.6f} ± {error:.0e}" for rate, error in zip(torsion.rates, torsion.rate_errors, strict=True)
        )
        again = "none" if torsion.again is None else f"{torsion.again.value:.6f}"
        parts.append(f"on the arm {arm} dp/dT₁ = {rates} at the places that lift off, second lift-off at T₁ = {again}")
    text = "; ".join(parts)
    return f"{text[0].upper()}{text[1:]}. Reflection y → −y turns T₁ round, so this must be so."
