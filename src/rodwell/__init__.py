"""rodwell: slender rods inside cylinders.

When a heavy rod (drill string, coiled tubing, guidewire, pipe robot) pushed into a borehole, vessel or pipe
buckles, what shape it takes, when it lifts off the wall, and what the wall must bear.

>>> import rodwell
>>> problem = rodwell.Problem(weight=15, alpha=90)        # γ = mg L³/B, horizontal cylinder
>>> branch = rodwell.follow(problem, mode=1, until=-200)  # end force in B/L², tension positive
>>> round(branch.lift_off.force, 6)
-123.173074

Names are loaded when first used, so ``import rodwell`` itself is quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rodwell._version import __version__
from rodwell.faces import Face, fill

_HOME = {
    "Branch": "rodwell.analysis.branch.branch",
    "Certificate": "rodwell.analysis.state.certificate",
    "Case": "rodwell.case.case",
    "CertifiedLoads": "rodwell.analysis.proof.certify",
    "Answer": "rodwell.answers.result.answer",
    "Assessment": "rodwell.answers.result.assessment",
    "Audit": "rodwell.studies.audit.audit",
    "answer": "rodwell.answers.result.answer",
    "audit": "rodwell.studies.audit.audit",
    "CriticalLoads": "rodwell.analysis.straight.critical",
    "Curve": "rodwell.analysis.curves.curve",
    "Diagram": "rodwell.analysis.branch.diagram",
    "Drag": "rodwell.studies.drag.drag",
    "DragStudy": "rodwell.studies.drag.sweep.study",
    "Endless": "rodwell.analysis.endless.endless",
    "InputError": "rodwell.errors",
    "JointedString": "rodwell.analysis.endless.jointed",
    "LocalState": "rodwell.analysis.endless.local",
    "LoadPath": "rodwell.analysis.path.load_path",
    "LyingRod": "rodwell.analysis.loads.lying_rod",
    "LoadsWithoutWall": "rodwell.analysis.straight.without_wall",
    "Map": "rodwell.studies.maps.result",
    "Mode": "rodwell.analysis.straight.critical",
    "NotConvergedError": "rodwell.errors",
    "PackerAnswer": "rodwell.studies.packer.packer",
    "ParameterPath": "rodwell.problem.varying",
    "Problem": "rodwell.problem.problem",
    "RodwellError": "rodwell.errors",
    "Screening": "rodwell.studies.well.screening",
    "Solution": "rodwell.analysis.branch.solution",
    "Sensitivity": "rodwell.analysis.loads.derivatives",
    "SpecialPoint": "rodwell.analysis.branch.special",
    "SpatialMode": "rodwell.analysis.straight.without_wall",
    "Study": "rodwell.studies.sweep.study",
    "Survey": "rodwell.survey.survey",
    "Torsion": "rodwell.analysis.loads.torsion",
    "Well": "rodwell.studies.drag.well_case",
    "WallTouch": "rodwell.analysis.straight.without_wall",
    "branch_off": "rodwell.analysis.branch.follow",
    "certify": "rodwell.analysis.proof.certify",
    "coil": "rodwell.analysis.branch.coiled",
    "critical_curves": "rodwell.analysis.curves.critical",
    "critical_loads": "rodwell.analysis.straight.critical",
    "diagram": "rodwell.analysis.branch.diagram",
    "drag": "rodwell.studies.drag.drag",
    "drag_study": "rodwell.studies.drag.sweep.study",
    "endless": "rodwell.analysis.endless.endless",
    "equilibrium": "rodwell.analysis.branch.minimum",
    "export": "rodwell.report.folders.export",
    "extended": "rodwell.analysis.branch.follow",
    "follow": "rodwell.analysis.branch.follow",
    "follow_contact": "rodwell.analysis.path.elsewhere",
    "jointed_string": "rodwell.analysis.endless.jointed",
    "lift_off_curve": "rodwell.analysis.curves.states",
    "local_state": "rodwell.analysis.endless.local",
    "save_branch": "rodwell.store.restart",
    "screen": "rodwell.studies.well.screening",
    "sensitivities": "rodwell.analysis.path.bridged_slopes",
    "load_path": "rodwell.analysis.path.follow",
    "load_branch": "rodwell.store.restart",
    "lying_rod": "rodwell.analysis.loads.lying_rod",
    "loads_without_wall": "rodwell.analysis.straight.without_wall",
    "map": "rodwell.store.mapping",
    "mode_pairs": "rodwell.analysis.straight.modes",
    "ramp": "rodwell.problem.sections",
    "read_surveys": "rodwell.survey.survey",
    "packer": "rodwell.studies.packer.packer",
    "paper_values": "rodwell.analysis.proof.paper_values",
    "secondary_curve": "rodwell.analysis.curves.states",
    "special_curve": "rodwell.analysis.curves.special",
    "switching_table": "rodwell.analysis.straight.modes",
    "study": "rodwell.studies.sweep.study",
    "tensile_loads": "rodwell.analysis.straight.critical",
    "torsion": "rodwell.analysis.loads.torsion",
    "twist_curve": "rodwell.analysis.curves.states",
    "turns_of_least_energy": "rodwell.analysis.loads.turns",
    "verify": "rodwell.analysis.branch.verifying.verify",
}

__all__ = ["__version__", *sorted(_HOME)]  # noqa: PLE0604 - names served by __getattr__

if TYPE_CHECKING:
    from rodwell.analysis.branch.branch import Branch
    from rodwell.analysis.branch.coiled import coil
    from rodwell.analysis.branch.diagram import Diagram, diagram
    from rodwell.analysis.branch.follow import branch_off, extended, follow
    from rodwell.analysis.branch.minimum import equilibrium
    from rodwell.analysis.branch.solution import Solution
    from rodwell.analysis.branch.special import SpecialPoint
    from rodwell.analysis.branch.verifying.verify import verify
    from rodwell.analysis.curves.critical import critical_curves
    from rodwell.analysis.curves.curve import Curve
    from rodwell.analysis.curves.special import special_curve
    from rodwell.analysis.curves.states import lift_off_curve, secondary_curve, twist_curve
    from rodwell.analysis.endless.endless import Endless, endless
    from rodwell.analysis.endless.jointed import JointedString, jointed_string
    from rodwell.analysis.endless.local import LocalState, local_state
    from rodwell.analysis.loads.derivatives import Sensitivity
    from rodwell.analysis.loads.lying_rod import LyingRod, lying_rod
    from rodwell.analysis.loads.torsion import Torsion, torsion
    from rodwell.analysis.loads.turns import turns_of_least_energy
    from rodwell.analysis.path.bridged_slopes import sensitivities
    from rodwell.analysis.path.elsewhere import follow_contact
    from rodwell.analysis.path.follow import load_path
    from rodwell.analysis.path.load_path import LoadPath
    from rodwell.analysis.proof.certify import CertifiedLoads, certify
    from rodwell.analysis.proof.paper_values import paper_values
    from rodwell.analysis.state.certificate import Certificate
    from rodwell.analysis.straight.critical import CriticalLoads, Mode, critical_loads
    from rodwell.analysis.straight.modes import mode_pairs, switching_table
    from rodwell.analysis.straight.without_wall import LoadsWithoutWall, SpatialMode, WallTouch, loads_without_wall
    from rodwell.answers.result.answer import Answer, answer
    from rodwell.answers.result.assessment import Assessment
    from rodwell.case.case import Case
    from rodwell.errors import InputError, NotConvergedError, RodwellError
    from rodwell.problem.problem import Problem
    from rodwell.problem.sections import ramp
    from rodwell.problem.varying import ParameterPath
    from rodwell.report.folders.export import export
    from rodwell.store.mapping import map  # noqa: A004
    from rodwell.store.restart import load_branch, save_branch
    from rodwell.studies.audit.audit import Audit, audit
    from rodwell.studies.drag.drag import Drag, drag
    from rodwell.studies.drag.sweep.study import DragStudy, drag_study
    from rodwell.studies.drag.well_case import Well
    from rodwell.studies.maps.result import Map
    from rodwell.studies.packer.packer import PackerAnswer, packer
    from rodwell.studies.sweep.study import Study, study
    from rodwell.studies.well.screening import Screening, screen
    from rodwell.survey.survey import Survey, read_surveys


def _late(module: str, name: str) -> Face:
    """A function of a module that is imported at the first call."""

    def call(result: object, *arguments: Any, **options: Any) -> Any:
        return getattr(import_module(module), name)(result, *arguments, **options)

    return call


fill(
    html=_late("rodwell.report.pages.notebook", "html"),
    plot=_late("rodwell.plots.methods", "plot"),
    plot_in_space=_late("rodwell.plots.methods", "plot_in_space"),
    animation=_late("rodwell.report.folders.path", "write_animation"),
    dataset=_late("rodwell.store.datasets", "dataset"),
    plain=_late("rodwell.store.plain", "plain"),
)


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'rodwell' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*globals(), *__all__]
