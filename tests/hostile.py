"""Requests that nobody means well with: wrong in every layer from the bytes of HTTP to the wish inside."""

import json
import random
import socket

PATHS = [
    "/", "/{t}", "/x/", "/{t}x/", "/{t}/../../etc/passwd", "/{t}/..%2f..%2fetc%2fpasswd", "/{t}/%2e%2e/setup",
    "/{t}//setup", "//{t}/setup", "/{t}/setup/", "/{t}/page/index.html", "/{t}/live.js/../session.py",
    "/{t}/.git/config",
    "/{t}/setup?x=1", "/{t}/state", "/{t}/state?after=1", "/{t}/state?after=a&row=0", "/{t}/state?after=-9&row=0",
    "/{t}/state?after=1&after=2&row=0", "/{t}/state?after=1e3&row=0", "/{t}/state?after=nan&row=0", "/{t}/frame",
    "/{t}/frame?panel=7&after=0&width=100&height=100", "/{t}/frame?panel=0&after=0&width=99999&height=100",
    "/{t}/frame?panel=0&after=0&width=-1&height=100", "/{t}/frame?panel=0&after=0&width=100&height=100&x=1",
    "/{t}/particle?panel=0&x=inf&y=0", "/{t}/particle?panel=0&x=1e99&y=0", "/{t}/particle?panel=9&x=0&y=0",
    "/{t}/\x00", "/{t}/setup%00", "/{t}/\u202e", "http://evil.example/{t}/setup", "/{t}/do", "*", "",
    "/" + "a" * 70000, "/{t}/setup?" + "a=1&" * 500,
]  # fmt: skip
BODIES = [
    b"", b"{", b"[]", b"null", b"1", b'"do"', b'{"do": "play"', b'{"do": NaN}', b'{"do": "speed", "value": Infinity}',
    b'{"do": "speed", "value": 1e999}', b'{"do": "play", "do": "reset"}', b"[" * 16000,
    b'{"a":' * 3000 + b"1" + b"}" * 3000,
    b"\xff\xfe{}", b"\x00" * 64, b'{"do": "speed", "value": ' + b"9" * 8000 + b"}", b"<xml/>",
]  # fmt: skip
WISHES = [
    {}, {"do": None}, {"do": 3}, {"do": "fly"}, {"do": "__class__"}, {"do": "play", "x": 1}, {"do": ["play"]},
    {"do": "speed"}, {"do": "speed", "value": "9"}, {"do": "speed", "value": -1}, {"do": "speed", "value": True},
    {"do": "number"}, {"do": "number", "panel": 0, "part": "DivBSource", "name": "xi"},
    {"do": "number", "panel": 0, "part": "DivBSource", "name": "xi", "value": 99},
    {"do": "number", "panel": 0, "part": "DivBSource", "name": "xi", "value": "0.5"},
    {"do": "number", "panel": 0, "part": "DivBSource", "name": "__dict__", "value": 0.5},
    {"do": "number", "panel": 5, "part": "DivBSource", "name": "xi", "value": 0.5},
    {"do": "number", "panel": 0, "part": "Nothing", "name": "xi", "value": 0.5},
    {"do": "number", "panel": 0, "part": {"a": 1}, "name": "xi", "value": 0.5},
    {"do": "number", "panel": -1, "part": "DivBSource", "name": "xi", "value": 0.5},
    {"do": "switch", "panel": 0, "part": "Stress", "on": False}, {"do": "switch", "panel": 0, "part": "os", "on": True},
    {"do": "switch", "panel": 0, "part": "DivBSource", "on": 0}, {"do": "choose"},
    {"do": "choose", "scene": "../../x.py"},
    {"do": "choose", "scene": "/etc/passwd"}, {"do": "choose", "variant": "nope"}, {"do": "choose", "kernel": "eval"},
    {"do": "choose", "set": [1]}, {"do": "choose", "set": {"nx": {"a": 1}}}, {"do": "choose", "set": {"nx": "9" * 300}},
    {"do": "panels", "count": 3}, {"do": "panels", "count": 1.5}, {"do": "panels"}, {"do": "draw", "member": "nothing"},
    {"do": "draw", "limits": [1, 0]}, {"do": "draw", "limits": [0]}, {"do": "draw", "limits": ["a", "b"]},
    {"do": "draw", "axis": 7}, {"do": "draw", "draw": "exec"}, {"do": "draw", "log": "yes"}, {"do": "poke"},
    {"do": "poke", "kind": "push", "x": 0.5, "y": 0.5, "radius": 0},
    {"do": "poke", "kind": "bomb", "x": 0, "radius": 0.1},
    {"do": "poke", "kind": "push", "x": 1e300, "y": 0, "dx": 1, "dy": 0, "radius": 0.1}, {"do": "record", "what": "rm"},
    {"do": "record", "what": "png", "name": "../../x"}, {"do": "record"},
]  # fmt: skip
JSON = "application/json"


def raw(method: str, path: str, body: bytes = b"", **headers) -> bytes:
    """The bytes of a request; headers by name with _ for -, None for one that is left out."""
    given = {"Host": "127.0.0.1", "Content-Length": str(len(body)) if body or method == "POST" else None}
    given.update({name.replace("_", "-"): value for name, value in headers.items()})
    lines = [f"{method} {path} HTTP/1.1", *(f"{name}: {value}" for name, value in given.items() if value is not None)]
    return "\r\n".join(lines).encode("utf-8", "surrogateescape") + b"\r\n\r\n" + body


def catalogue(token: str) -> list[bytes]:
    """Every request that is known to be wrong."""
    do, setup = f"/{token}/do", f"/{token}/setup"
    play = b'{"do": "pause"}'
    found = [raw("GET", path.replace("{t}", token)) for path in PATHS]
    found += [raw("POST", do, body, Content_Type=JSON) for body in BODIES]
    found += [raw("POST", do, json.dumps(wish).encode(), Content_Type=JSON) for wish in WISHES]
    found += [raw(method, setup) for method in ("PUT", "DELETE", "HEAD", "OPTIONS", "TRACE", "PATCH", "get", "SPMHD")]
    found += [raw("POST", setup, play, Content_Type=JSON), raw("POST", f"/{token}/", play, Content_Type=JSON)]
    for name in ("evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "", "a" * 300, "[::1", None):
        found.append(raw("POST", do, play, Content_Type=JSON, Host=name))
    for name in ("http://evil.example", "null", "https://127.0.0.1", "http://127.0.0.1.evil.example"):
        found += [raw("POST", do, play, Content_Type=JSON, Origin=name), raw("GET", setup, Origin=name)]
    for site in ("cross-site", "same-site", "none", "?"):
        found.append(raw("POST", do, play, Content_Type=JSON, Sec_Fetch_Site=site))
    for kind in (None, "text/plain", "application/x-www-form-urlencoded", "multipart/form-data", "application/jsonp"):
        found.append(raw("POST", do, play, Content_Type=kind))
    for size in ("-1", "x", "1e3", "99999999999999999999", "17000000", "16385", None):
        found.append(raw("POST", do, play, Content_Type=JSON, Content_Length=size))
    found.append(raw("POST", do, b"5\r\nhello\r\n0\r\n\r\n", Content_Type=JSON, Transfer_Encoding="chunked"))
    found.append(raw("GET", setup, b"GET / HTTP/1.1\r\n\r\n"))
    found.append(raw("POST", do, play, Content_Type=JSON).replace(b"Host:", b"Host: localhost\r\nHost:", 1))
    found.append(raw("GET", setup, **{f"X-{n}": "y" for n in range(300)}))
    found.append(raw("GET", setup, X="y" * 70000))
    found += [
        b"\r\n\r\n",
        b"GET\r\n\r\n",
        b"GET / HTTP/9.9\r\n\r\n",
        b"GET / HTTX/1.1\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01",
    ]
    return found


def requests(token: str, count: int, seed: int = 0) -> list[bytes]:
    """`count` of them: the whole catalogue, then the same with bytes changed, cut and doubled at random."""
    random_ = random.Random(seed)
    known = catalogue(token)
    while len(known) < count:
        wrong = bytearray(random_.choice(known[:200]))
        for _ in range(random_.randint(1, 4)):
            if wrong:
                wrong[random_.randrange(len(wrong))] = random_.randrange(256)
        known.append(bytes(wrong[: random_.randint(0, len(wrong))]) + (b"\r\n\r\n" if random_.random() < 0.5 else b""))
    random_.shuffle(known)
    return known[:count]


def send(port: int, request: bytes, patience: float = 5.0) -> bytes:
    """All that comes back; the sender hangs up its half first, so that nobody waits for more of it."""
    with socket.create_connection(("127.0.0.1", port), timeout=patience) as line:
        answer = b""
        try:
            line.sendall(request)
            line.shutdown(socket.SHUT_WR)
            while piece := line.recv(65536):
                answer += piece
        except OSError:
            pass
        return answer
