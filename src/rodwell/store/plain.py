"""Which plain data, for JSON, belong to which result."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

from rodwell.practice.answer import Answer
from rodwell.practice.answer_plain import answer_dict
from rodwell.practice.audit import Audit
from rodwell.practice.audit_plain import audit_dict
from rodwell.practice.study import Study
from rodwell.practice.study_plain import study_dict


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
