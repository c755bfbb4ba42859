import rodwell

problem = rodwell.Problem(weight=15, alpha=60, ends="clamped-pinned")  # s = 0 clamped, s = 1 pinned
lift = rodwell.follow(problem).lift_off
print(f"lift-off at F = {lift.force:.4f} B/L² (end force at s = 1, tension positive), s = {lift.s[0]:.4f}")
for name, (value, error) in lift.solution.end_reactions.items():
    print(f"{name} at s = 1: {round(value, 6) + 0.0:.6f} ± {error:.0e}")
