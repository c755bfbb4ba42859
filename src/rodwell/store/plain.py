"""Which plain data, for JSON, belong to which result."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

from rodwell.answers.data.plain import answer_dict
from rodwell.answers.result.answer import Answer
from rodwell.studies.audit.audit import Audit
from rodwell.studies.audit.plain import audit_dict
from rodwell.studies.drag.drag import Drag
from rodwell.studies.drag.plain import drag_dict
from rodwell.studies.drag.sweep.study import DragStudy
from rodwell.studies.drag.sweep.tables import drag_study_dict
from rodwell.studies.maps.plain import map_dict
from rodwell.studies.maps.result import Map
from rodwell.studies.packer.packer import PackerAnswer
from rodwell.studies.packer.tables import packer_dict
from rodwell.studies.sweep.plain import study_dict
from rodwell.studies.sweep.study import Study


@singledispatch
def plain(result: object) -> dict[str, Any]:
    """Return a result as plain data: what the methods ``as_dict`` of results give."""
    raise TypeError(f"{type(result).__name__} has no plain data")


@plain.register
def _(result: Answer) -> dict[str, Any]:
    return answer_dict(result)


@plain.register
def _(result: Study) -> dict[str, Any]:
    return study_dict(result)


@plain.register
def _(result: Audit) -> dict[str, Any]:
    return audit_dict(result)


@plain.register
def _(result: Map) -> dict[str, Any]:
    return map_dict(result)


@plain.register
def _(result: Drag) -> dict[str, Any]:
    return drag_dict(result)


@plain.register
def _(result: DragStudy) -> dict[str, Any]:
    return drag_study_dict(result)


@plain.register
def _(result: PackerAnswer) -> dict[str, Any]:
    return packer_dict(result)
