"""How far the formula of every handbook is from the exact load.

Dawson–Paslay, 2√(B w sin α/r), over the exact critical load of a horizontal rod: safe but far too low for a
short rod, and good to a percent once the rod has many half waves. The circles are exact: at (78), n and m
half waves, the ratio is 2nm/(n² + m²).
"""

import numpy as np

import rodwell
from rodwell.plots.style import INK, MODES, new_axes

CLEARANCE = 0.01


def ratio(weight):
    """Formula over exact first critical load, horizontal, both ends clamped."""
    exact = -rodwell.critical_loads(rodwell.Problem(weight, clearance=CLEARANCE), 1)[0].force
    return 2.0 * np.sqrt(weight / CLEARANCE) / exact


def main():
    weights = np.geomspace(0.5, 3e5, 90)
    ax = new_axes()
    ax.plot(weights, [ratio(weight) for weight in weights], color=MODES[0], lw=2.0, label="Dawson–Paslay / exact")
    pairs = [(n, n + 2) for n in range(1, 12)]
    switches = [n**2 * m**2 * np.pi**4 * CLEARANCE for n, m in pairs]
    found = [(n, m, ratio(weight)) for (n, m), weight in zip(pairs, switches, strict=True)]
    ax.plot(switches, [r for *_, r in found], "o", color="white", mec=INK, label="modes n and n + 2 switch, (78)")
    ax.axhline(1.0, color=INK, lw=0.8)
    ax.set_xscale("log")
    ax.set_ylim(0.0, 1.1)
    ax.set_xlabel("weight γ = mg L³/B, which grows with the cube of the length")
    ax.set_ylabel("formula / exact compression −F at buckling")
    ax.set_title("Horizontal, Δ/L = 0.01, both ends clamped", loc="left", fontsize=9.5)
    ax.legend(loc="lower right")
    return ax.figure, found


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("formulas.png", dpi=150)
