import rodwell

branch = rodwell.follow(rodwell.Problem(weight=15, alpha=89), until=-150)
rodwell.save_branch(branch, "results/branch.nc")
again = rodwell.load_branch("results/branch.nc")  # the same to the last bit, also in another process
longer = rodwell.extended(again, -200)
print(longer, "" if longer.reached_end else longer.ending)
heavier = rodwell.follow(again.problem, start=again.labelled("lift_off 1"), parameter="weight", until=17)
print(heavier)
