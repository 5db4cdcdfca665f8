"""`spmhd cost` with several runs side by side, and on a Dask cluster: the errors of one after another, to the bit."""

import json
import sys

import pytest
from tiny import spmhd

from taichi_spmhd import InputError
from taichi_spmhd.cost import cluster, places
from taichi_spmhd.cost.cluster import connected, on_cluster
from taichi_spmhd.cost.plan import planned

SMALL = ("sound_wave", "--vary", "nx=24,32,40", "--t-end", "0.1", "--threads", "1", "--repeat", "2", "--quiet")


def study(folder, *words) -> dict:
    """What a study on its way by these options has written."""
    assert spmhd("cost", *SMALL, *words, "--out", str(folder)) == 0
    return json.loads((folder / "cost.json").read_text())


def bits(made: dict) -> list:
    """What may not depend on where a run was: setting, repetitions, final state, errors."""
    return [(row["setting"], row["repeats"], row["digest"], row["errors"]) for row in made["rows"]]


def todo() -> list:
    """The runs of such a study."""
    rest = {"arch": "cpu", "precision": "f64", "threads": 1, "repeat": 2, "budget": None}
    return places.tasks(planned("sound_wave", {}, ["nx=24,32,40"], None, None, 0.1, **rest), set())


@pytest.fixture(scope="module")
def one_by_one(tmp_path_factory):
    """The study without a cluster."""
    return bits(study(tmp_path_factory.mktemp("alone")))


@pytest.fixture
def local():
    """A Dask cluster of two processes on this machine."""
    distributed = pytest.importorskip("distributed")
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**options) as there:
        yield there


@pytest.mark.slow
def test_runs_side_by_side_give_the_same_bits(tmp_path, one_by_one):
    assert bits(study(tmp_path / "jobs", "--jobs", "2")) == one_by_one


@pytest.mark.slow
def test_a_cluster_gives_the_same_bits_and_an_interrupted_study_resumes(tmp_path, one_by_one, local):
    out, address = tmp_path / "cluster", local.scheduler_address
    assert len(study(out, "--cluster", address, "--budget", "1e-9")["runs"]) < len(todo())
    assert bits(study(out, "--cluster", address, "--resume")) == one_by_one


@pytest.mark.slow
def test_the_run_of_a_lost_worker_is_repeated(local, one_by_one):
    """One of two workers is killed when the first result is there, with runs of its own on their way."""
    made, lost = {}, []
    for task, result in on_cluster(todo(), "cpu", local.scheduler_address, lambda task: True, lambda: None):
        made.setdefault(task.setting.key, set()).add(result["digest"])
        if not lost:
            lost.append(local.workers[0].process.pid)
            local.workers[0].process.process.kill()
    assert sorted(digest for (digest,) in made.values()) == sorted(digest for _, _, digest, _ in one_by_one)


@pytest.mark.slow
def test_where_no_cluster_answers_the_cure_is_said(monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr(cluster, "PATIENCE", 0.5)
    with pytest.raises(InputError, match="give one like tcp://host:8786"):
        connected("tcp://127.0.0.1:1")


def test_without_dask_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'taichi-spmhd\[cluster\]'"):
        connected("tcp://127.0.0.1:8786")
