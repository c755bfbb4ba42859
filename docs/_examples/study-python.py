import rodwell

result = rodwell.study({"dimensionless": {"weight": [5, 15, 50], "alpha": "60..90 in 2"}})
for point in result.points:
    print(f"{result.inputs(point)}: F = {point.critical.value:.4f} ± {point.critical.error:.0e} B/L² at buckling,")
    print(f"    {point.lift_off.value:.4f} ± {point.lift_off.error:.0e} B/L² at lift-off (end s = 1, tension positive)")
print("worst case:", result.inputs(result.worst()))
