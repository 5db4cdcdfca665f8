"""A file takes its place whole: what is on the disk before the new name is, and what a system without links does."""

import errno
import os

import pytest

from taichi_spmhd import replacing as module
from taichi_spmhd.replacing import replacing


@pytest.fixture
def calls(monkeypatch):
    """The names of all calls that wait for the disk or change a name, with the file or folder they are about."""
    made, opened = [], {}
    own = {name: getattr(os, name) for name in ("open", "fsync", "replace", "link")}

    def call_open(path, *given, **more):
        number = own["open"](path, *given, **more)
        opened[number] = os.path.basename(path)
        return number

    monkeypatch.setattr(os, "open", call_open)
    monkeypatch.setattr(os, "fsync", lambda number: made.append(("fsync", opened[number])))
    for name in ("replace", "link"):
        monkeypatch.setattr(
            os, name, lambda a, b, name=name: made.append((name, os.path.basename(b))) or own[name](a, b)
        )
    return made


def write(path, text: str, **more) -> None:
    with replacing(path, **more) as part:
        part.write_text(text)


def test_a_file_is_synced_before_it_is_renamed_and_its_folder_after(tmp_path, calls):
    write(tmp_path / "a", "new")
    part = f".a.{os.getpid()}.part"
    assert calls == [("fsync", part), ("replace", "a"), ("fsync", tmp_path.name)]


def test_the_file_that_was_there_stays_under_another_name(tmp_path, calls):
    for text in ("one", "two", "three"):
        write(tmp_path / "a", text, previous=tmp_path / "b")
    assert (tmp_path / "a").read_text() == "three" and (tmp_path / "b").read_text() == "two"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]
    linked = [k for k, (name, _) in enumerate(calls) if name == "link"]
    assert all(calls[k + 1 : k + 3] == [("replace", "b"), ("replace", "a")] for k in linked) and len(linked) == 2


def test_two_names_of_one_file_are_no_obstacle(tmp_path):
    """What a kill leaves between keeping the old state and putting the new one in its place."""
    (tmp_path / "a").write_text("one")
    os.link(tmp_path / "a", tmp_path / "b")
    write(tmp_path / "a", "two", previous=tmp_path / "b")
    assert (tmp_path / "a").read_text() == "two" and (tmp_path / "b").read_text() == "one"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]


def test_without_hard_links_the_file_moves(tmp_path, monkeypatch):
    def link(*_):
        raise OSError(errno.EPERM, os.strerror(errno.EPERM))

    monkeypatch.setattr(os, "link", link)
    for text in ("one", "two"):
        write(tmp_path / "a", text, previous=tmp_path / "b")
    assert (tmp_path / "a").read_text() == "two" and (tmp_path / "b").read_text() == "one"


def refusing(monkeypatch, number: int):
    """A system whose folders cannot be synced."""
    own = os.fsync

    def fsync(file):
        if os.path.isdir(f"/proc/self/fd/{file}"):
            raise OSError(number, os.strerror(number))
        own(file)

    monkeypatch.setattr(module.os, "fsync", fsync)


def test_a_system_that_cannot_sync_folders_is_no_obstacle(tmp_path, monkeypatch):
    refusing(monkeypatch, errno.EINVAL)
    write(tmp_path / "a", "one")
    assert (tmp_path / "a").read_text() == "one"


def test_a_disk_that_fails_to_sync_a_folder_is_told(tmp_path, monkeypatch):
    refusing(monkeypatch, errno.EIO)
    with pytest.raises(OSError, match=os.strerror(errno.EIO)):
        write(tmp_path / "a", "one")
