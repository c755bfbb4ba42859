"""What a wound guidewire does to the vessel wall: the force on it grows with the push, faster with every turn.

120 mm of wire between two ends that may turn sideways. A line begins where the wire lies on the wall
everywhere and ends where it is no longer stable. Dots: closed form of a uniform helix. Dashed: the push at
which the straight wire buckles.
"""

from pathlib import Path

import numpy as np

import rodwell
from rodwell.plots.style import INK, MODES, WARN, new_axes


def wall_force(force, rate, clearance):
    """−p of a weightless uniform helix, θ' = rate: (52)–(55) with ω₁ = −sin η cos η/Δ and ω₃ = sin²η/Δ."""
    sine = clearance * rate
    cosine = np.sqrt(1.0 - sine**2)
    side = sine**3 * cosine / clearance**2  # F₃ = −ω₁ω₃
    return -(sine**2 / clearance * (force + side * sine) / cosine + sine * cosine / clearance * side)


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "guidewire.toml")
    wire = case.problem.but(weight=0.0, ends="pinned-pinned")
    newton = case.scales.factor("force")
    ax = new_axes()
    computed, exact = [], []
    for turns, color in zip((1, 2, 3), MODES, strict=False):
        branch = rodwell.coil(wire.but(turns=turns), until=-60.0 / newton)
        start = next(p for p in branch.special_points if p.kind == "touch_down")
        states = [start.solution, *(state for state in branch if state.force < start.force and state.stable)]
        push = np.array([-state.force for state in states])
        force = np.array([state.total_wall_force.value for state in states])
        closed = wall_force(-push, 2.0 * np.pi * turns, wire.clearance)
        ax.plot(push * newton, force * newton, color=color, lw=2.0, label=f"{turns} turn" + "s" * (turns > 1))
        ax.plot(push[::2] * newton, closed[::2] * newton, "o", color=color, ms=4)
        ax.plot(-start.force * newton, 0.0, "o", color=WARN, zorder=5)
        computed += list(force)
        exact += list(closed)
    critical = rodwell.critical_loads(wire, 1)[0].force
    ax.axvline(-critical * newton, color=INK, lw=0.9, ls="--")
    ax.plot([], [], "o", color=WARN, label="contact complete")
    ax.set_xlabel("push −F at the end s = 1  [N]")
    ax.set_ylabel("total force on the vessel wall ∫|p| ds  [N]")
    ax.set_title("0.035 in guidewire in a 6 mm vessel, both ends pinned", loc="left", fontsize=9.5)
    ax.text(-critical * newton, 25.0, " straight wire buckles", fontsize=8.5)
    ax.legend(loc="upper left", bbox_to_anchor=(0.0, 0.75))
    return ax.figure, {"computed": np.array(computed), "exact": np.array(exact), "critical": critical}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("guidewire.png", dpi=150)
