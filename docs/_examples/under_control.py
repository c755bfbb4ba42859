import rodwell

branch = rodwell.follow(rodwell.Problem(weight=15, alpha=89), until=-500)
held = branch.under("shortening")  # 1 − z(1) in L is held, not the end force
folds = [f"{point.force:.6g}" for point in branch.special_points if point.kind == "fold"]
print(f"the load turns back at F = {' and '.join(folds)} B/L² (s = 1, tension positive)")
for point in held.folds:
    print(f"the shortening turns back at F = {point.force:.6g}, index {point.index_before} → {point.index_after}")
for state in held.states_at(0.002):
    print(f"shortened by 0.002 L: F = {state.force:.8g}, index under a dead load {state.stability_index}")
