"""Who may come in: the token, the host, the origin. Whatever is wrong is refused before anything is read of it."""

import hmac
import ipaddress
import json
import re
from urllib.parse import parse_qsl, urlsplit

MOST_BODY = 16 * 1024
LOCAL = {"localhost"}
QUERY = {  # what may stand behind the ?, and between which bounds
    "state": {"after": (int, -1, 10**15), "row": (int, 0, 10**15)},
    "frame": {"panel": (int, 0, 1), "after": (int, -1, 10**15), "width": (int, 64, 1600), "height": (int, 64, 1600)},
    "particle": {"panel": (int, 0, 1), "x": (float, -1e9, 1e9), "y": (float, -1e9, 1e9)},
}
NUMBER = re.compile(r"[+-]?(\d{1,20}(\.\d{0,20})?|\.\d{1,20})([eE][+-]?\d{1,3})?")


class Refused(Exception):
    """An answer of 4xx or 5xx: code and one line."""

    def __init__(self, code: int, why: str):
        super().__init__(why)
        self.code, self.why = code, why


def admit(headers, path: str, token: str, method: str) -> tuple[str, dict]:
    """(what is asked for, its query) of a request that may come in. Raises Refused."""
    host(headers)
    split = urlsplit(path) if path.startswith("/") and not path.startswith("//") else None
    parts = split.path.split("/") if split else []
    if len(parts) != 3 or not hmac.compare_digest(parts[1].encode(), token.encode()):
        raise Refused(404, "nothing here; open the address that spmhd live printed")
    origin(headers, method)
    return parts[2], query(parts[2], split.query)


def single(headers, name: str) -> str | None:
    """A header that may come once."""
    found = headers.get_all(name) or []
    if len(found) > 1:
        raise Refused(400, f"{name} given twice")
    return found[0].strip() if found else None


def host(headers) -> None:
    """localhost or the number of an address: a name in the web that was pointed here is a trap."""
    name = single(headers, "Host") or ""
    bare = re.sub(r":\d{1,5}$", "", name)
    try:
        ipaddress.ip_address(bare.strip("[]"))
    except ValueError:
        if bare.lower() not in LOCAL:
            raise Refused(403, "open this page at localhost or at a numeric address") from None


def origin(headers, method: str) -> None:
    """Requests that another page makes are refused."""
    here = f"http://{single(headers, 'Host')}"
    if single(headers, "Origin") not in (None, here):
        raise Refused(403, "asked by a page from elsewhere")
    if single(headers, "Sec-Fetch-Site") not in (None, "same-origin", *(("none",) if method == "GET" else ())):
        raise Refused(403, "asked by a page from elsewhere")


def query(what: str, text: str) -> dict:
    """Numbers by name, each known, once, and within its bounds."""
    known = QUERY.get(what, {})
    if what == "" and re.fullmatch(r"(lang=[a-z]{2})?", text):
        return {}
    try:
        pairs = parse_qsl(text, keep_blank_values=True, strict_parsing=bool(text), max_num_fields=8)
    except ValueError:
        raise Refused(400, "the part behind ? cannot be read") from None
    found = {}
    for name, value in pairs:
        if name not in known or name in found:
            raise Refused(400, f"{name[:40]} is not asked here, or asked twice")
        found[name] = bounded(name, value, *known[name])
    missing = set(known) - set(found)
    if missing:
        raise Refused(400, f"{', '.join(sorted(missing))} missing")
    return found


def bounded(name: str, text: str, kind: type, low: float, high: float):
    """A number within its bounds."""
    if not NUMBER.fullmatch(text) or (kind is int and not re.fullmatch(r"-?\d+", text)):
        raise Refused(400, f"{name} is no {'whole ' if kind is int else ''}number")
    value = kind(text)
    if not low <= value <= high:
        raise Refused(400, f"{name} must lie in {low}..{high}")
    return value


def length(headers) -> int:
    """How long the body of a POST is."""
    if single(headers, "Transfer-Encoding") is not None:
        raise Refused(501, "send the whole body with Content-Length")
    text = single(headers, "Content-Length")
    if text is None:
        raise Refused(411, "Content-Length is missing")
    if not re.fullmatch(r"\d{1,12}", text):
        raise Refused(400, "Content-Length is no number")
    if int(text) > MOST_BODY:
        raise Refused(413, f"more than {MOST_BODY} bytes")
    if (single(headers, "Content-Type") or "").split(";")[0].strip().lower() != "application/json":
        raise Refused(415, "send application/json")
    return int(text)


def unique(pairs: list) -> dict:
    """An object without repeated keys."""
    made = dict(pairs)
    if len(made) < len(pairs):
        raise ValueError("a key stands twice")
    return made


def never(text: str):
    raise ValueError(f"{text} is no number")


def body(raw: bytes) -> dict:
    """The JSON object of a POST. Raises Refused."""
    try:
        made = json.loads(raw.decode("utf-8"), parse_constant=never, object_pairs_hook=unique)
    except (ValueError, RecursionError):
        raise Refused(400, "the body is no JSON") from None
    if not isinstance(made, dict):
        raise Refused(400, "the body must be a JSON object")
    return made
