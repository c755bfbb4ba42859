import rodwell


def closer(state):  # zero where the ends have come closer by half a per mille of the length
    return state.number("end_shortening").value - 5e-4


problem = rodwell.Problem(weight=15, alpha=89)
branch = rodwell.follow(problem, until=-500, events={"half a per mille": closer})
for label, point in branch.labels.items():
    print(f"{label:<20} F = {point.force:.8g} B/L² at s = 1, tension positive")
steepest = branch.numbers(lambda state: state.largest("eta").value)  # radians, at each point of the branch
print(f"the steepest state climbs the wall at {steepest.max():.4f} rad")
