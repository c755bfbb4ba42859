"""A whole well, station by station: where does the string buckle first?

Inclination on the left. On the right the exact limit lines of a long local rod with their errors, the
formulas beside them, and the force in the string when the bit carries 120 kN.
"""

from pathlib import Path

import numpy as np

import rodwell
from rodwell.plots.wells.survey import plot_screening


def main():
    examples = Path(__file__).parents[1]
    case = rodwell.Case.read(examples / "well-string.toml")
    survey = rodwell.Survey.read(examples / "well-survey.csv")
    found = rodwell.screen(case, survey, bit_force=-120e3)  # N, tension positive
    flat = np.argmin(np.abs(survey.inclination - 90.0))
    values = {
        "inclination": survey.inclination[flat],
        "exact": found.critical.values[flat],
        "formula": found.formulas["dawson_paslay"][flat],
    }
    return plot_screening(found), values


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("well.png", dpi=150)
