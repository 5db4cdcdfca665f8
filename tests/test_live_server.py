"""The server of the sandbox, in front of a desk at which nobody simulates."""

import json
import threading
import time

import front
import numpy as np
import pytest
from front import SETUP
from hostile import catalogue, requests, send

from taichi_spmhd.errors import InputError
from taichi_spmhd.live import answers
from taichi_spmhd.live.actions import checked
from taichi_spmhd.live.desk import Desk
from taichi_spmhd.live.plots import MOST, Plots
from taichi_spmhd.live.wishes import MOST as MOST_WISHES


@pytest.fixture
def desk():
    return front.desk()


@pytest.fixture
def client(desk):
    with front.served(desk) as client:
        yield client


def test_a_wish_reaches_the_desk_with_its_number(client, desk):
    status, answer = client.post(do="number", panel=0, part="DivBSource", name="xi", value=0.25)
    assert status == 200 and answer["ok"]
    (wish,) = desk.take()
    assert time.monotonic() - wish.pop("at") < 5.0
    assert wish == {"do": "number", "panel": 0, "part": "DivBSource", "name": "xi", "value": 0.25, "id": answer["id"]}
    assert desk.take() == []


def test_too_many_wishes_are_answered_503(client, desk):
    for _ in range(MOST_WISHES):
        desk.put({"do": "step"})
    assert client.post(do="step")[0] == 503


def test_rows_stay_bounded_and_readers_start_anew_when_they_are_thinned():
    plots = Plots()
    for k in range(MOST):
        plots.add([[float(k)]])
    known = plots.since(MOST)
    assert known["first"] == MOST and known["panels"] == [[]]
    plots.add([[float(MOST)]])
    thinned = plots.since(MOST)
    assert thinned["first"] == 0 and len(thinned["panels"][0]) == MOST // 2 + 1 and thinned["panels"][0][1] == [2.0]
    assert plots.since(thinned["next"])["panels"] == [[]]
    plots.clear()
    assert plots.since(thinned["next"])["first"] == 0


def test_a_long_poll_answers_when_the_state_changes(client, desk):
    seq = client.state()["seq"]
    threading.Timer(0.2, desk.publish_state, [{"panels": [{"t": 1.0}]}]).start()
    clock = time.monotonic()
    state = client.get(f"state?after={seq}&row=0")
    assert state["seq"] == seq + 1 and 0.1 < time.monotonic() - clock < 5.0


def test_before_the_run_has_begun_there_is_no_news(monkeypatch):
    # a page that took "nothing yet" for the state did not know that the run plays, nor how many panels there are
    monkeypatch.setattr(answers, "PATIENCE", 0.2)
    empty = Desk()
    with front.served(empty) as client:
        assert client.get("state?after=-1&row=0")["seq"] == 0
        monkeypatch.setattr(answers, "PATIENCE", 10.0)
        threading.Timer(0.3, empty.publish_state, [{"panels": [{"t": 0.0}]}]).start()
        assert client.get("state?after=-1&row=0")["panels"] == [{"t": 0.0}]


def test_a_long_poll_of_a_paused_run_answers_after_a_while(client, monkeypatch):
    monkeypatch.setattr(answers, "PATIENCE", 0.2)
    assert client.get("state?after=99&row=0")["seq"] == 1


def test_frames_are_drawn_for_whoever_waits_and_once_for_all(client, desk):
    found, rgb = [], np.full((96, 128, 3), 200, np.uint8)
    readers = [threading.Thread(target=lambda: found.append(client.frame(size=(128, 96)))) for _ in range(3)]
    for reader in readers:
        reader.start()
    desk.wait(5.0)  # woken by the first
    while len(desk.frames.waiting) == 0 or sum(desk.frames.waiting.values()) < 3:
        time.sleep(0.01)
    assert desk.wanted() == [(0, 128, 96)]
    desk.publish_frame(0, (128, 96), 7, rgb)
    for reader in readers:
        reader.join(5.0)
    assert [number for number, _ in found] == [7, 7, 7] and found[0][1][:3] == b"\xff\xd8\xff"
    assert client.frame(after=6, size=(128, 96))[0] == 7  # no need to wait: it is there


def test_a_question_is_answered_by_the_main_thread_or_in_time_refused(client, desk, monkeypatch):
    def main_thread():
        desk.wait(5.0)
        for question, answer in desk.questions():
            answer({"id": 3, "asked": question})

    threading.Thread(target=main_thread).start()
    assert client.get("particle?panel=0&x=.5&y=-1e-2") == {"id": 3, "asked": {"panel": 0, "x": 0.5, "y": -0.01}}
    monkeypatch.setattr(answers, "ANSWER", 0.1)
    assert client.request("GET", "particle?panel=0&x=0&y=0")[0] == 503


def test_nobody_waits_for_a_panel_that_is_not_there(client):
    clock = time.monotonic()
    for what in ("frame?panel=1&after=-1&width=100&height=100", "particle?panel=1&x=0&y=0"):
        assert client.request("GET", what)[0] == 404
    assert time.monotonic() - clock < 1.0


def test_a_question_that_was_given_up_is_not_put_to_the_main_thread(client, desk, monkeypatch):
    monkeypatch.setattr(answers, "ANSWER", 0.05)
    assert client.request("GET", "particle?panel=0&x=0&y=0")[0] == 503
    assert desk.questions() == []


def test_the_page_and_its_files_come_with_strict_headers(client):
    status, headers, body = client.request("GET", "")
    assert status == 200 and b"<html" in body.lower() and headers["Cache-Control"] == "no-store"
    assert headers["Content-Security-Policy"].startswith("default-src 'none'; script-src 'self'")
    assert client.request("GET", "live.js")[1]["Content-Type"].startswith("text/javascript")
    assert client.request("GET", "?lang=ja")[0] == 200
    assert client.request("GET", "session.py")[0] == 404


def test_a_thousand_hostile_requests_reach_nobody(client, desk, capfd):
    before = threading.active_count()
    found, slowest = [], 0.0
    for k, request in enumerate(requests(client.token, 1000)):
        found.append((request, send(client.port, request)))
        if k % 50 == 0:  # good ones between them
            clock = time.monotonic()
            assert client.state()["seq"] == 1
            slowest = max(slowest, time.monotonic() - clock)
    assert slowest < 1.0
    for request, answer in found:
        lines = answer.split(b"\r\n")[0].split()
        assert not answer or (lines[0] == b"HTTP/1.1" and lines[1][:1] in b"245" and lines[1] != b"500"), request[:200]
        if lines and lines[1][:1] == b"2":  # a changed byte that leaves a sane request: it may read, and nothing else
            assert request.startswith(b"GET /"), request[:200]
    refused = sum(answer.split(b" ")[1:2] not in ([], [b"200"]) for _, answer in found)
    assert refused > 800  # the others are cut so short that they are no requests, or harmless
    assert desk.take() == [] and desk.questions() == []
    clock = time.monotonic()
    assert client.state()["seq"] == 1 and time.monotonic() - clock < 1.0
    time.sleep(0.3)
    assert threading.active_count() <= before + 2
    assert capfd.readouterr().err == ""


def test_whatever_is_known_to_be_wrong_is_answered_by_design(client, desk):
    for request in catalogue(client.token):
        status = send(client.port, request).split(b" ")[1:2]
        if request not in (b"\r\n\r\n", front.doubled(client.token)):  # no request; one slash too many, forgiven
            assert status and (status[0][:1] == b"4" or status[0] in (b"501", b"505")), (status, request[:200])
    assert desk.take() == [] and desk.questions() == []


@pytest.mark.parametrize(
    ("wish", "why"),
    [
        ({"do": "nunber"}, "not known; there are play, pause"),
        ({"do": "number", "part": "DivBSource", "name": "xi", "valu": 1}, "did you mean 'value'"),
        ({"do": "number", "part": "DivBSource", "name": "xi", "value": 2}, "xi: 2.* from 0 to 1"),
        ({"do": "switch", "part": "Stress", "on": False}, "cannot be switched off: nothing moves this gas"),
        ({"do": "draw", "axis": 2, "member": "rho"}, "rho has no component 2"),
        ({"do": "poke", "kind": "field", "x": 0, "radius": 0.1, "strength": 1}, "one of push, pressure"),
        ({"do": "poke", "kind": "push", "x": 0, "radius": 0.1}, "dx is missing"),
        ({"do": "choose", "variant": "xi = 2"}, "one of xi = 0, xi = 1"),
    ],
)
def test_what_is_wrong_with_a_wish_is_said_in_one_line(wish, why):
    with pytest.raises(InputError, match=why) as caught:
        checked(wish, SETUP)
    assert "\n" not in str(caught.value)


def test_good_wishes_pass_as_they_are():
    for wish in (
        {"do": "play"},
        {"do": "speed", "value": 10.0},
        {"do": "choose", "panel": 0, "scene": "alfven_tensile", "set": {"nx": 48, "beta": "1/10"}},
        {"do": "draw", "member": "B", "axis": None, "limits": [-1.0, 1.0], "log": False},
        {"do": "poke", "panel": 0, "kind": "push", "x": 0.5, "y": 1.5, "dx": 0.1, "dy": 0.0, "radius": 0.1},
        {"do": "record", "what": "png"},
    ):
        assert checked(json.loads(json.dumps(wish)), SETUP) == wish
