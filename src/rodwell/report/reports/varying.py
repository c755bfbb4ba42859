"""The report on a case whose clearance varies along its rod."""

from __future__ import annotations

import datetime

from rodwell._version import __version__
from rodwell.answers.result.varying import Varying
from rodwell.answers.words.varying import (
    lifts_off,
    stress_sentences,
    varying_limits,
    varying_sentences,
    varying_statuses,
)
from rodwell.answers.words.wording import forces_of
from rodwell.report.reports.content import Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.texts import conversions, derived, inputs

PICTURE = "modes"
"""Name of the picture."""


def varying_report(found: Varying) -> Report:
    """Return the content of the report."""
    case, text, today = found.case, varying_sentences(found), datetime.date.today().isoformat()
    said, forces = varying_limits(), forces_of(found.case)
    lift = () if found.lift_off is None else (Number(f"Lift-off{forces.at_end}", forces.size(found.lift_off.load)),)
    rows = tuple((f"{mode.number}", forces.size(mode.load)) for mode in found.critical)
    facts = [(label, value, note) for label, value, note in conversions(case)]
    return Report(
        title=case.title,
        subtitle=f"Rod on a wall whose clearance varies · rodwell {__version__} · {today}",
        front=Front(text[0], varying_statuses(found),
                    (Number(f"Buckling load{forces.at_end}", forces.size(found.critical[0].load)), *lift),
                    Picture(PICTURE, "The first buckling modes", "Angle around the hole in the first modes, "
                            "each scaled to a largest one of 1."),
                    " ".join(said), tuple(text[1 : -len(said)]), "What else was found"),
        sections=(
            ReportSection("Critical loads", (Grid(("Mode", "Load"), rows, numeric=(0, 1)),
                                             Words(f"{forces.convention}.", "small"))),
            ReportSection("After it has buckled", (Items((lifts_off(found), *stress_sentences(found))),)),
            ReportSection("What is computed, and what is not", (Items(said),)),
            ReportSection("Inputs", (Grid(("Key of the case file", "As given"), tuple(inputs(case))),
                                     Grid(("What follows", "", ""), tuple(facts)),
                                     Grid(("Without dimensions", ""), tuple(derived(case))))),
        ),
        footer=f"Computed by rodwell {__version__} from {case.source}.",
        paper="us-letter" if case.scales is not None and case.scales.system.name == "field" else "a4",
        about=case.about.lines,
    )  # fmt: skip
