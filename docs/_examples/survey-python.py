import numpy as np

import rodwell

case = rodwell.Case.read("examples/well-string.toml")
md = np.array([0.0, 500.0, 1000.0, 1500.0, 2000.0])  # m
well = rodwell.Survey.of(md, [0.0, 2.0, 30.0, 60.0, 90.0])  # degrees from the vertical
found = rodwell.screen(case, well, bit_force=-150e3)  # N, tension positive
for i, depth in enumerate(well.md):
    limit, error = found.critical.values[i] / 1e3, found.critical.errors[i] / 1e3
    print(f"{depth:6.0f} m: buckles at {limit:6.2f} kN (± {error:.0e}), used {100 * found.utilisation[i]:5.1f} %")
