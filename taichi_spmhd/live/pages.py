"""The static files of the page, read once: what is not in this table does not exist."""

from importlib.resources import files

TYPES = {
    "html": "text/html; charset=utf-8",
    "js": "text/javascript; charset=utf-8",
    "css": "text/css; charset=utf-8",
    "svg": "image/svg+xml",
}


def table() -> dict[str, tuple[str, bytes]]:
    """{name: (type, bytes)}; the empty name is index.html."""
    folder = files(__package__) / "page"
    found = {
        entry.name: (TYPES[entry.name.rsplit(".", 1)[-1]], entry.read_bytes())
        for entry in folder.iterdir()
        if entry.name.rsplit(".", 1)[-1] in TYPES
    }
    return {"": found["index.html"], **found}
