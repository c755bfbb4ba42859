"""First critical load over weight at four inclinations, force at the top.

Horizontal, weight presses the rod into the wall and holds it; vertical, it buckles the rod from below, in the
end without any force at the top. Crosses: two modes have the same load, and the first one gives way to the
second.
"""

import rodwell
from rodwell.plots.style import INK, MODES, new_axes


def main():
    ax = new_axes()
    start, double = {}, []
    for color, alpha in zip(MODES, (90, 60, 30, 0), strict=False):
        curve = rodwell.critical_curves(rodwell.Problem(0, alpha=alpha), "weight", (0.0, 110.0), modes=2)[0]
        ax.plot(curve.x, -curve.values, color=color, lw=2.0, label=f"α = {alpha}°")
        start[alpha] = curve.values[0]
        for mark in curve.marks:
            if mark.kind == "double_point":
                double.append((mark.x, mark.value))
                ax.plot(mark.x, -mark.value, "x", color=INK, ms=7, mew=1.8)
    ax.axhline(0.0, color=INK, lw=0.8)
    ax.set_xlabel("weight γ = mg L³/B")
    ax.set_ylabel("first critical compression −F at s = 1  [B/L²]")
    ax.set_title("Δ/L = 0.01, both ends clamped; tension positive", loc="left", fontsize=9.5)
    ax.legend(loc="upper left")
    return ax.figure, {"weightless": start, "double": double}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("envelope.png", dpi=150)
