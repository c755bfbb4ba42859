import rodwell
from rodwell.report.folders.case import write_results

answer = rodwell.answer(rodwell.Case.read("examples/field-drill-pipe.toml"))
files = write_results(answer, "results/field-drill-pipe", with_pdf=True)
print(*files, sep=", ")
