import math

import rodwell

rod = rodwell.Problem(weight=15, alpha=90)  # both ends clamped, Δ/L = 0.01
state = rodwell.follow(rod, until=-118).at(-118)
path = {
    "alpha": lambda t: 90 - 60 * t,  # degrees: the hole becomes steeper
    "force": lambda t: -118 - 20 * math.sin(math.pi * t / 2),  # at s = 1 in B/L², tension positive
    "weight": (15, 18),  # a straight line
}
branch = rodwell.follow(rod, start=state, parameter=path)
for label, point in branch.labels.items():
    p = point.solution.problem
    print(f"{label:<12} t = {point.value:.8f}: γ = {p.weight:.5g}, α = {p.alpha:.5g}°, F = {point.force:.6f} B/L²")

curve = rodwell.lift_off_curve(rod, {"alpha": (90, 60), "clearance": (0.01, 0.02)}, (0, 1))
print(f"lift-off at α = 60°, Δ/L = 0.02: F = {curve.values[-1]:.8f} B/L² at s = 1, ± {curve.errors[-1]:.0e}")
