import rodwell
from rodwell.answers.words.verdict import verdict

case = rodwell.Case.from_dict(
    {
        "rod": {"pipe": "5 in 19.5 lb/ft drill pipe", "length": "300 ft", "grade": "S-135"},
        "mud": {"density": "10 lb/gal"},
        "hole": {"diameter": "8.5 in", "angle_from_vertical": "30 deg"},
        "load": {"applied": ["-20000 lbf", "-35000 lbf", "-45000 lbf"], "at": "bottom"},
    }
)
answer = rodwell.answer(case)
a = answer.assessment
print(verdict(a))
for at in a.applied:
    stress = None if at.state is None else a.stress(at.state)
    print(
        f"{at.load.given:.0f} N:",
        at.what,
        "" if stress is None else f"{stress.value / 1e6:.2f} MPa at s/L = {stress.s:.3f}",
    )
unit = case.scales.factor("force")
print(
    f"window: {a.window.width.value * unit:.0f} N, {a.window.percent:.1f} %; limits:",
    *(limit.name for limit in a.window.limits),
)
