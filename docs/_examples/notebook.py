import matplotlib.pyplot as plt

import rodwell

branch = rodwell.follow(rodwell.Problem(weight=15, alpha=90))
figure, (left, right) = plt.subplots(1, 2, layout="constrained")
branch.plot(left)
branch.lift_off.solution.plot(right, field="contact_pressure").set_title("at lift-off")
