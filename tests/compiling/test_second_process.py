"""The second process of a first run: it compiles what is really called, and nothing hangs without it."""

from __future__ import annotations

import os
import subprocess
from types import SimpleNamespace

import pytest

import rodwell
from rodwell.analysis.discrete import first_run
from rodwell.compiling import second_process


@pytest.fixture
def no_helper(monkeypatch):
    monkeypatch.setattr(second_process, "_helper", None)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)


def test_kernels_are_compiled_for_the_arguments_with_which_they_are_called():
    rodwell.follow(rodwell.Problem(weight=15, alpha=90), until=-400)
    for kernel, arguments in (*first_run.KERNELS, *first_run.MEANWHILE):
        in_use = len(kernel.signatures)
        kernel.compile(arguments)
        assert len(kernel.signatures) == in_use  # compiling ahead added none


def test_each_kernel_is_announced(capsys):
    first_run.main()
    assert capsys.readouterr().out.split() == ["state_numbers", "newton", "variation"]


def test_no_kernel_is_announced_that_is_not_on_disk(capsys, monkeypatch):
    monkeypatch.setattr(first_run, "on_disk", lambda _kernel, _arguments: False)
    first_run.main()
    assert capsys.readouterr().out == ""


def test_waiting_ends_with_the_name_and_when_the_other_process_dies(no_helper, tmp_path, monkeypatch):
    (tmp_path / "short_lived.py").write_text("print('one', flush=True)\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    second_process.begin("short_lived")
    second_process.wait_for("one")
    assert "one" in second_process._helper.ready
    second_process.wait_for("never printed")
    assert second_process._helper.process is None


class Patient(second_process._Helper):
    """Has printed "one", and prints "two" once something has been done meanwhile."""

    def __init__(self, meanwhile):
        self.process, self.said, self.meanwhile = SimpleNamespace(kill=list), b"one\n", meanwhile

    def _speaks(self):
        return len(self.meanwhile) == 1

    def _listen(self):
        self.said += b"two\n"


def test_what_is_needed_soon_is_done_while_waiting_and_not_where_there_is_nothing_to_wait_for():
    done = []
    helper = Patient([lambda: done.append("first"), lambda: done.append("second")])
    helper.wait_for("one")
    assert done == []
    helper.wait_for("two")
    assert done == ["first"]


def test_without_permission_to_start_processes_there_is_no_helper(no_helper, monkeypatch):
    def refused(*_args, **_options):
        raise PermissionError

    monkeypatch.setattr(subprocess, "Popen", refused)
    second_process.begin("anything")
    assert second_process._helper is None
    second_process.wait_for("newton")


def test_helper_starts_on_the_first_run_only(no_helper, monkeypatch):
    begun = []
    fresh = SimpleNamespace(overloads={}, stats=first_run.newton.stats)
    monkeypatch.setattr(first_run, "newton", fresh)
    monkeypatch.setattr(second_process, "begin", lambda module, _meanwhile: begun.append(module))
    monkeypatch.setattr(first_run, "done", lambda: False)
    first_run.begin()
    assert begun == ["rodwell.analysis.discrete.first_run"]
    monkeypatch.setattr(first_run, "done", lambda: True)
    first_run.begin()
    monkeypatch.setattr(first_run, "done", lambda: False)
    fresh.overloads["its types"] = "machine code"
    first_run.begin()
    assert len(begun) == 1
