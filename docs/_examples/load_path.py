import rodwell

problem = rodwell.Problem(weight=15, alpha=90)
path = rodwell.load_path(problem, until=-150, unload_to=-100)
for sentence in path.meaning:
    print(sentence)
(state,) = path.at(-146.9)[:1]
print(state.state)
for point in state.state.point_forces:
    print(f"force {point.force.value:.6f} B/L² at s/L = {point.s.value:.6f}")
