import rodwell

problem = rodwell.Problem(weight=15, alpha=90)  # both ends clamped, Δ/L = 0.01
state = rodwell.follow(problem, mode=1, until=-120).at(-120.0)  # buckled, not lifted off yet
print(f"end force at s = 1 kept at F = {state.force:g} B/L² (tension positive)")
for parameter, until in (("weight", 5.0), ("alpha", 30.0), ("clearance", 0.03), ("twist", 5.0)):
    branch = rodwell.follow(problem, start=state, parameter=parameter, until=until)
    print(f"{parameter} from {branch.values[0]:g} to {branch.values[-1]:g}:")
    for p in branch.special_points:
        print(f"    {p.kind:<12} at {p.value:.8g}   index {p.index_before} → {p.index_after}")
