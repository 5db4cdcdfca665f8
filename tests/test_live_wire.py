"""The sandbox's sockets: quick answers, slow and silent senders, full houses, ports and addresses."""

import json
import socket
import statistics
import threading
import time
from http.client import HTTPConnection

import front
import pytest
from client import Client
from hostile import raw, send
from tiny import spmhd

from taichi_spmhd.errors import InputError
from taichi_spmhd.live import answers, server
from taichi_spmhd.live.desk import Desk
from taichi_spmhd.live.server import Server


@pytest.fixture
def desk():
    return front.desk()


@pytest.fixture
def client(desk):
    with front.served(desk) as client:
        yield client


def opened(client) -> socket.socket:
    return socket.create_connection(("127.0.0.1", client.port), timeout=10)


def test_answers_on_one_connection_come_at_once(client):
    # head and body as two packets waited 44 ms for a receipt; in one piece 0.3 ms, on the same busy machine
    line, spent = HTTPConnection("127.0.0.1", client.port, timeout=10), []
    for _ in range(20):
        clock = time.perf_counter()
        line.request("GET", f"/{client.token}/state?after=-1&row=0")
        json.loads(line.getresponse().read())
        spent.append(time.perf_counter() - clock)
    line.close()
    assert statistics.median(spent) < 0.03


def test_half_a_request_holds_up_nobody(client):
    lines = [opened(client) for _ in range(20)]
    for line in lines:
        line.sendall(b"POST /" + client.token.encode() + b"/do HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Le")
    clock = time.monotonic()
    assert client.state()["seq"] == 1 and time.monotonic() - clock < 1.0
    for line in lines:
        line.close()


@pytest.mark.parametrize("part", ["head", "body"])
def test_a_request_that_trickles_in_has_one_deadline(client, desk, monkeypatch, part):
    monkeypatch.setattr(answers, "SLOWEST", 0.5)
    whole = raw("POST", f"/{client.token}/do", b'{"do": "play"}' + b" " * 200, Content_Type="application/json")
    begin = 4 if part == "head" else len(whole) - 150
    with opened(client) as line:
        line.sendall(whole[:begin])
        clock = time.monotonic()
        with pytest.raises(ConnectionError):
            for k in range(begin, begin + 100):  # each byte well within the limit; 10 s if nobody ends it
                line.sendall(whole[k : k + 1])
                time.sleep(0.1)
        assert time.monotonic() - clock < 5.0
    assert desk.take() == []


def test_beyond_its_connections_the_server_says_503_and_recovers(client):
    lines = [opened(client) for _ in range(server.MOST_CONNECTIONS)]
    for line in lines:
        line.sendall(b"GET ")
    assert Client.request(client, "GET", "setup")[0] == 503
    for line in lines:
        line.close()
    time.sleep(0.3)
    assert client.request("GET", "setup")[0] == 200


def test_a_page_that_is_reloaded_often_finds_its_place(client, desk):
    # a run at rest: nothing else ends a long poll before its ten seconds
    for _ in range(2):
        lines = [opened(client) for _ in range(server.MOST_CONNECTIONS - 2)]
        for k, line in enumerate(lines):
            frame = "frame?panel=0&after=9&width=100&height=100"
            line.sendall(raw("GET", f"/{client.token}/{frame if k % 2 else 'state?after=9&row=0'}"))
        while sum(desk.frames.waiting.values()) < len(lines) // 2:
            time.sleep(0.01)
        for line in lines:
            line.close()
        time.sleep(1.2)  # twice as long as it takes to see that nobody is there
        assert client.request("GET", "setup")[0] == 200


def test_who_is_refused_while_still_sending_reads_why(client):
    body = b"x" * 20_000_000  # more than the sockets hold: without reading on, the answer is lost with a reset
    status, _, answer = client.request("POST", "do", body, {"Content-Type": "application/json"})
    assert status == 413 and "16384" in json.loads(answer)["error"]


def test_nobody_asks_before_sending(client):
    request = raw(
        "POST", f"/{client.token}/do", b'{"do": "play"}', Content_Type="application/json", Expect="100-continue"
    )
    assert send(client.port, request).startswith(b"HTTP/1.1 417 ")


def test_a_port_that_is_taken_is_one_clear_line(client):
    with pytest.raises(InputError, match=r"cannot listen.*take another --port"):
        Server(Desk(), port=client.port)


def test_the_port_of_a_run_that_just_ended_is_free(desk):
    with front.served(desk) as client:
        port = client.port
        with opened(client) as line:
            line.sendall(raw("GET", "/wrong"))
            while line.recv(65536):  # the server hangs up first: its end lingers for a minute
                pass
    with front.served(front.desk(), port=port) as again:
        assert again.port == port and again.state()["seq"] == 1


def test_addresses_of_both_kinds_can_be_opened(desk):
    open_to_all = Server(desk, host="0.0.0.0")
    open_to_all.stop()
    assert not open_to_all.address.is_loopback and "0.0.0.0" not in open_to_all.url
    try:
        six = Server(desk, host="::1")
    except InputError:
        pytest.skip("this machine has no IPv6")
    six.start()
    host = f"[::1]:{six.server_address[1]}"
    assert six.url == f"http://{host}/{six.token}/"
    line = HTTPConnection("::1", six.server_address[1], timeout=10)
    line.request("GET", f"/{six.token}/setup", headers={"Host": host, "Origin": f"http://{host}"})
    assert line.getresponse().status == 200
    line.close()
    six.stop()


def test_stopping_lets_go_who_waits(desk):
    server = Server(desk)
    server.start()
    found = []
    reader = threading.Thread(target=lambda: found.append(Client(server.url).get("state?after=99&row=0")))
    reader.start()
    time.sleep(0.2)
    clock = time.monotonic()
    server.stop()
    reader.join(5.0)
    assert found and time.monotonic() - clock < 2.0


@pytest.mark.timeout(60)
def test_a_server_that_never_began_can_be_stopped(desk):
    Server(desk).stop()


def test_what_cannot_be_written_to_is_seen_at_the_door(tmp_path, capsys):
    taken = tmp_path / "taken"
    taken.write_text("a file")
    assert spmhd("live", "alfven_tensile", "--no-browser", "--out", str(taken)) == 2
    assert "is a file; give a folder" in capsys.readouterr().err


@pytest.mark.timeout(60)
def test_a_command_that_fails_before_it_serves_ends(capsys):
    assert spmhd("live", "alfven_tensile", "--no-browser", "--arch", "abacus") == 2
    assert "unknown --arch 'abacus'" in capsys.readouterr().err
