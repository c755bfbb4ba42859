import rodwell

horizontal = rodwell.Problem(weight=15, alpha=90)  # both ends clamped, Δ/L = 0.01; the range sets the weight
first = rodwell.secondary_curve(horizontal, limits=(15.0, 8.0))
print(first.ended_because, f"at weight {first.x[-1]:.6f}, F = {first.values[-1]:.4f} B/L²")
lift = rodwell.lift_off_curve(horizontal, "weight", limits=(16.0, 20.0))
for mark in lift.marks:
    print(mark.kind, f"at weight {mark.x:.6f} ± {mark.x_error:.0e}:", mark.note)
