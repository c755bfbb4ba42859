"""Weightless helices: the states computed lie on the closed form.

A helix whose ends may turn about the cylinder bears F = −(2B/Δ²) sin²η cos η at the angle η, and presses with
−p = B sin⁴η/Δ³. Here its ends are pinned after whole turns; the load is that at which they need no force
around the cylinder.
"""

import numpy as np

import rodwell
from rodwell.plots.style import MODES, new_axes

TURNS = 3


def load_without_side_force(problem):
    """End force at s = 1 at which the circumferential reaction there vanishes: it is linear in the force."""
    forces = np.array([-100.0, -200.0])
    shear = [rodwell.equilibrium(problem, force).end_reactions["shear"].value for force in forces]
    return float(forces[0] - shear[0] * (forces[1] - forces[0]) / (shear[1] - shear[0]))


def main():
    eta = np.radians([6, 12, 18, 24, 30, 36, 42, 48, 53])
    radii = np.sin(eta) / (2.0 * np.pi * TURNS)  # Δ/L that takes so many turns at the angle η
    loads, pushes = [], []
    for radius in radii:
        problem = rodwell.Problem(0, clearance=radius, turns=TURNS, ends="pinned-pinned")
        loads.append(load_without_side_force(problem))
        pushes.append(-rodwell.equilibrium(problem, loads[-1]).highest_pressure[0])
    line = np.radians(np.linspace(0.0, 60.0, 200))
    ax = new_axes()
    ax.plot(np.degrees(line), 2.0 * np.sin(line) ** 2 * np.cos(line), color=MODES[0], label="−F Δ²/B, closed form")
    ax.plot(np.degrees(eta), -np.array(loads) * radii**2, "o", color=MODES[0], label="computed")
    ax.plot(np.degrees(line), np.sin(line) ** 4, color=MODES[1], label="−p Δ³/B, closed form")
    ax.plot(np.degrees(eta), np.array(pushes) * radii**3, "s", color=MODES[1], label="computed")
    ax.axhline(4.0 / 27.0**0.5, color="#8a94a0", lw=0.8, ls="--")
    ax.annotate("most that a helix bears, 0.7698 B/Δ² at 54.7°", (1.0, 0.787), fontsize=8.5)
    ax.set_ylim(-0.03, 0.86)
    ax.set_xlabel("angle η between rod and cylinder  [degrees]")
    ax.set_ylabel("compression −F at s = 1, and push −p on the wall")
    ax.set_title("Weightless helix, ends pinned and free of side force", loc="left", fontsize=9.5)
    ax.legend(loc="upper left", bbox_to_anchor=(0.0, 0.9))
    return ax.figure, {"eta": eta, "loads": np.array(loads) * radii**2, "pushes": np.array(pushes) * radii**3}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("helix.png", dpi=150)
