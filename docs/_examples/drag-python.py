import rodwell

well = rodwell.Well.read("examples/wells/coiled-tubing.toml")
found = rodwell.drag(well)
for one in found.operations:
    load = one.ends.hook_load
    said = "locks up" if load is None else f"{load.value / 1e3:8.3f} ± {load.error / 1e3:.0e} kN"
    print(f"{one.operation.name:22} {said}")

into = found.operations[0]
for rule, reach in into.reach.items():  # both bounds: the helix early, and late
    print(f"helix {rule:5}: locks up with the bit at {reach.lock_up.value:.2f} m")
for low, high, state in found.operations[2].run.buckled:
    print(f"state {state} from {high:.1f} m to {low:.1f} m")
