"""Heavy-weight pipe below drill pipe: the buckled string at lift-off, with the step of its stiffness.

Above: bending moment b ω₂ (continuous) and curvature ω₂ (which jumps) at lift-off. Below: the contact pressure; the
string leaves the wall in the limber section.
"""

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

import rodwell

SECTIONS = ((0.5, 1.0, 1.37), (0.5, 0.534, 0.63))
"""Length, stiffness, weight: two joints of 5 in heavy-weight pipe below as much 5 in drill pipe, in mud."""


def main():
    problem = rodwell.Problem(weight=8.2, alpha=40, clearance=0.0012, sections=SECTIONS)
    lift = rodwell.follow(problem).lift_off
    state = lift.solution
    step = state.step_loads[0]
    s = np.union1d(np.linspace(0.0, 1.0, 801), [np.nextafter(step.s, 0.0), step.s])
    f = state.fields(s)
    figure = Figure(figsize=(7.2, 5.6), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    blue, orange = mpl.colormaps["tab10"](0), mpl.colormaps["tab10"](1)
    upper.plot(s, f["omega2"], color=blue, label="curvature ω₂  [1/L]")
    upper.plot(s, f["rod_M2"], color=orange, label="bending moment b ω₂  [B/L]")
    lower.plot(s, f["contact_pressure"], color=blue)
    lower.plot(lift.s, [0.0] * len(lift.s), "o", color="#b3261e", label="lift-off")
    for ax in (upper, lower):
        ax.axvline(step.s, color="grey", lw=0.8, ls=":")
        ax.axhline(0.0, color="grey", lw=0.8)
        ax.legend(loc="upper left")
    upper.set_title(
        f"string of 2 sections at lift-off, F = {lift.force:.2f} B/L² (tension positive)", loc="left", fontsize=9.5
    )
    lower.set_ylabel("contact pressure p  [B/L³]\n(below 0: pressed on the wall)")
    lower.set_xlabel("s, from the lower end")
    at = np.searchsorted(s, step.s)
    sides = {name: (f[name][at - 1], f[name][at]) for name in ("omega2", "rod_M2", "rod_M3", "omega3")}
    return figure, (problem, lift, step, sides)


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("heavy_weight.png", dpi=150)
