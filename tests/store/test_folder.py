"""Results folders: one takes the place of another, other files survive, what is left behind is found."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest
from result_files import POSIX, texts

from rodwell.errors import InputError
from rodwell.store import swap
from rodwell.store.folder import check_writable, whole_folder
from rodwell.store.staging import LOCK, NEW, OLD, PART, PREFIX, write_plan


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """A folder with results of an earlier run, and a file of the user's."""
    folder = tmp_path / "results"
    folder.mkdir()
    for name, text in {"a.txt": "old", "b.txt": "old", "notes.txt": "mine"}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def write(out: Path, *names: str) -> None:
    with whole_folder(out) as folder:
        for name in names or ("a.txt", "b.txt"):
            (folder / name).write_text("new", encoding="utf-8")


NEW_ONES = {"a.txt": "new", "b.txt": "new", "notes.txt": "mine"}


def test_one_folder_takes_the_place_of_another(out: Path) -> None:
    before = out.stat().st_ino
    out.chmod(0o750)
    write(out)
    assert texts(out) == NEW_ONES
    assert out.stat().st_ino != before, "not swapped"
    assert out.stat().st_mode & 0o777 == 0o750
    assert [file.name for file in out.parent.iterdir()] == ["results"]


def test_where_the_system_has_no_exchange(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(swap, "_exchanged", lambda *_: False)
    before = out.stat().st_ino
    write(out)
    assert texts(out) == NEW_ONES
    assert out.stat().st_ino != before, "not swapped"


def test_where_folders_cannot_be_renamed(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise OSError(18, "Invalid cross-device link")

    monkeypatch.setattr(swap, "_exchanged", lambda *_: False)
    rename = Path.rename
    monkeypatch.setattr(Path, "rename", lambda self, to: refuse() if self.is_dir() else rename(self, to))
    before = out.stat().st_ino
    write(out)
    assert texts(out) == NEW_ONES
    assert out.stat().st_ino == before


def test_where_the_second_of_two_steps_fails(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rename = Path.rename

    def refuse(self: Path, to: Path) -> Path:
        if self.name == NEW:
            raise OSError(18, "Invalid cross-device link")
        return rename(self, to)

    monkeypatch.setattr(swap, "_exchanged", lambda *_: False)
    monkeypatch.setattr(Path, "rename", refuse)
    before = out.stat().st_ino
    write(out)
    assert texts(out) == NEW_ONES
    assert out.stat().st_ino == before


def test_other_files_come_along_in_the_same_step(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    exchanged, seen = swap._exchanged, []

    def watched(new: Path, target: Path) -> bool:
        done = exchanged(new, target)
        seen.append(texts(target if done else new))
        return done

    monkeypatch.setattr(swap, "_exchanged", watched)
    write(out)
    assert seen == [NEW_ONES]


def test_where_files_cannot_be_linked(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", refuse)
    write(out)
    assert texts(out) == NEW_ONES


def test_folders_of_the_user_stay_what_they_are(out: Path) -> None:
    (out / "mine").mkdir()
    (out / "mine" / "deep.txt").write_text("mine", encoding="utf-8")
    numbers = out.stat().st_ino, (out / "mine").stat().st_ino
    write(out)
    assert texts(out) == NEW_ONES | {f"mine{os.sep}deep.txt": "mine"}
    assert (out.stat().st_ino, (out / "mine").stat().st_ino) == numbers


def test_the_current_folder_stays_what_it_is(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(out)
    write(Path())
    assert texts(Path()) == NEW_ONES


def test_links_lead_to_the_folder(out: Path) -> None:
    link = out.parent / "link"
    link.symlink_to(out, target_is_directory=True)
    write(link)
    assert link.is_symlink()
    assert texts(out) == NEW_ONES
    (out / "other").symlink_to(out / "notes.txt")
    write(link)
    assert (out / "other").is_symlink()
    assert texts(out) == NEW_ONES | {"other": "mine"}


def test_a_file_that_comes_late_is_kept(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between the look into the folder and the exchange."""
    exchanged = swap._exchanged

    def late(new: Path, target: Path) -> bool:
        (target / "late.txt").write_text("mine", encoding="utf-8")
        return exchanged(new, target)

    monkeypatch.setattr(swap, "_exchanged", late)
    write(out)
    assert texts(out) == NEW_ONES | {"late.txt": "mine"}


def test_files_that_are_one_file(out: Path) -> None:
    """A single result replaces its forerunner; the folder stays, whatever is in it."""
    before = out.stat().st_ino
    write(out, "a.txt")
    assert texts(out) == {"a.txt": "new", "b.txt": "old", "notes.txt": "mine"}
    assert out.stat().st_ino == before


# What killed runs leave


@POSIX
def test_what_a_living_run_needs_is_left_alone(out: Path) -> None:
    with whole_folder(out) as folder:
        (folder / "a.txt").write_text("slow", encoding="utf-8")
        (folder / "b.txt").write_text("slow", encoding="utf-8")
        write(out)
        check_writable(out)
        assert texts(out) == NEW_ONES
    assert texts(out) == NEW_ONES | {"a.txt": "slow", "b.txt": "slow"}


def left_behind(out: Path, name: str = ".rodwell-results-x") -> Path:
    place = out.parent / name
    (place / NEW).mkdir(parents=True)
    (place / LOCK).write_text(str(out), encoding="utf-8")
    (place / NEW / "a.txt").write_text("half", encoding="utf-8")
    return place


@POSIX
def test_what_is_left_behind_goes(out: Path) -> None:
    left_behind(out)
    check_writable(out)
    assert [file.name for file in out.parent.iterdir()] == ["results"]
    assert texts(out) == {"a.txt": "old", "b.txt": "old", "notes.txt": "mine"}


@POSIX
def test_what_is_left_behind_goes_with_the_next_results(out: Path) -> None:
    """Also where nobody asks before whether they can be written."""
    left_behind(out)
    write(out)
    assert [file.name for file in out.parent.iterdir()] == ["results"]


@POSIX
def test_an_absent_folder_comes_back(out: Path) -> None:
    """Killed between the two steps of a system without exchange."""
    place = left_behind(out)
    write_plan(place, "swap", ["a.txt", "b.txt"])
    out.rename(place / OLD)
    check_writable(out)
    assert texts(out) == {"a.txt": "old", "b.txt": "old", "notes.txt": "mine"}
    assert not place.exists()


@POSIX
def test_moves_that_were_begun_are_ended(out: Path) -> None:
    place = left_behind(out)
    write_plan(place, "files", ["a.txt", "b.txt"])
    (out / "b.txt").write_text("half", encoding="utf-8")
    check_writable(out)
    assert texts(out) == {"a.txt": "half", "b.txt": "half", "notes.txt": "mine"}
    assert not place.exists()


@POSIX
@pytest.mark.parametrize("kind", ["of another target", "without lock", "with a strange file"])
def test_what_may_be_somebodys_is_left_alone(out: Path, kind: str) -> None:
    place = left_behind(out)
    if kind == "of another target":
        (place / LOCK).write_text("/elsewhere", encoding="utf-8")
    else:
        (place / LOCK).unlink()
    if kind == "with a strange file":
        (place / "thesis.txt").write_text("mine", encoding="utf-8")
        os.utime(place, (0, 0))
    check_writable(out)
    assert (place / NEW / "a.txt").exists()


@POSIX
@pytest.mark.parametrize("names", [(), (PART,)])
def test_empty_ones_go_after_a_day(out: Path, names: tuple[str, ...]) -> None:
    place = out.parent / f"{PREFIX}results-y"
    place.mkdir()
    for name in names:
        (place / name).write_text("", encoding="utf-8")
    check_writable(out)
    assert place.exists()
    os.utime(place, (time.time() - 90_000.0,) * 2)
    check_writable(out)
    assert not place.exists()


def test_a_file_in_place_of_a_folder_changes_nothing(out: Path) -> None:
    (out / "b.txt").unlink()
    (out / "b.txt").mkdir()
    with pytest.raises(InputError, match=r"holds a folder 'b\.txt'"):
        write(out)
    assert texts(out) == {"a.txt": "old", "notes.txt": "mine"}
    assert [file.name for file in out.parent.iterdir()] == ["results"]
