import rodwell

problem = rodwell.Problem(weight=15, alpha=89)  # both ends clamped, Δ/L = 0.01
result = rodwell.diagram(problem, until=-700, search=("unfolding", "deflation"))
for line in result.searched:
    print("searched:", line)
loop = next(branch for branch in result if branch.closed)
print(loop.name, "ended because", loop.ended_because)
for p in loop.special_points:
    index = f"index {p.index_before} → {p.index_after}"
    print(f"  {p.kind}: F = {p.force:.4f} ± {p.error:.0e}, {index}")
for state in loop.states_at(-500.0):
    end = state.fields(2)["omega2"][-1]
    print(f"F = {state.force:g}: ω₂(1) = {end:.4f}, index {state.stability_index}")
