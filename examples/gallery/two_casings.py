"""Tubing in two casings: how it lies over the edge of the narrower one, and when it buckles.

Seen from the side, height much larger than length: without end force, and at the load at which it buckles sideways. It
touches the edge at one place, and is free on both sides of it.
"""

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

import rodwell

SECTIONS = ((0.5, 1.0, 1.0, 1.0), (0.5, 1.0, 1.0, 1.8))
"""Length, stiffness, weight, clearance: 2 7/8 in tubing, half of it in 7 in, half of it in 9 5/8 in casing."""


def main():
    problem = rodwell.Problem(weight=33.5, alpha=90, clearance=0.0011, sections=SECTIONS)
    path = rodwell.load_path(problem)
    buckling = path.first("critical")
    states = {
        "without end force": path.at(0.0)[0].state,
        f"buckles, F = {buckling.force.value:.2f} B/L²": buckling.state,
    }
    figure = Figure(figsize=(7.2, 3.4), layout="constrained")
    ax = figure.subplots()
    s = np.linspace(0.0, 1.0, 801)
    floor = -problem.rod.clearance(s)
    ax.fill_between(s, -2.0, floor, color="#d9dee3", lw=0, step="mid")
    for number, (name, state) in enumerate(states.items()):
        colour = mpl.colormaps["tab10"](number)
        ax.plot(s, state.fields(s)["x"] / problem.clearance, color=colour, label=name)
        for point in state.point_forces:
            height = state.fields(np.array([point.s.value]))["x"] / problem.clearance
            ax.plot(point.s.value, height, "o", color=colour, ms=4)
    ax.set_xlabel("s, from the lower end  (dots: point forces)")
    ax.set_ylabel("height above the hole's axis  [Δ]")
    ax.set_ylim(-2.0, -0.7)
    ax.legend(loc="upper right")
    return figure, (problem, states["without end force"], buckling)


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("two_casings.png", dpi=150)
