import rodwell

problem = rodwell.Problem(weight=15, alpha=90)  # γ = mg L³/B; horizontal; Δ/L = 0.01
loads = rodwell.critical_loads(problem, 3)
print("critical:", [round(float(force), 6) for force in loads.forces], "B/L²")
branch = rodwell.follow(problem, mode=1, until=-400)  # end force at s = 1, tension positive
for p in branch.special_points:
    print(f"{p.kind:12} {p.force:.6f} ± {p.error:.0e} B/L²  index {p.index_after}")
state = branch.at(-120.0)
print("stable:", state.stable, " max p:", round(state.highest_pressure[0], 6), "B/L³")
print("T₂ at mid-length:", round(float(state.fields([0.5])["T2"][0]), 9), "B/L")
