"""Scene files with mistakes: one line with the file's name, and its line where Python knows it, or a scene."""

import io
import re
import tokenize

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tiny import WAVE, line_of, one_line, write

LINES = WAVE.splitlines(keepends=True)
SPANS = [(token.start, token.end) for token in tokenize.generate_tokens(io.StringIO(WAVE).readline) if token.string]
JUNK = [
    "return None", "raise ValueError('a\\nb')", "import nothing_of_this_name", "scenes = 3", "1 / 0", "(", "}", "\x00",
    "def scenes(nx): pass", "while", "raise SystemExit", "class scenes: pass", "del scenes", "é = ½", "\t\tx",
]  # fmt: skip


def offset(place: tuple[int, int]) -> int:
    """Where a line and a column lie in the text."""
    return sum(map(len, LINES[: place[0] - 1])) + place[1]


def exchanged(one, other) -> str:
    """The text with two of its tokens in each other's place."""
    (a, b), (c, d) = (tuple(map(offset, span)) for span in sorted((one, other)))
    return WAVE if b > c else WAVE[:a] + WAVE[c:d] + WAVE[b:c] + WAVE[a:b] + WAVE[d:]


place = st.integers(0, len(LINES) - 1)
span = st.sampled_from(SPANS)
MUTATED = st.one_of(
    st.builds(lambda k: "".join(LINES[:k] + LINES[k + 1 :]), place),
    st.builds(lambda k: "".join(LINES[:k]), place),
    st.builds(lambda k, junk: "".join([*LINES[:k], junk, "\n", *LINES[k:]]), place, st.sampled_from(JUNK)),
    st.builds(lambda k, junk: "".join([*LINES[:k], f"    {junk}\n", *LINES[k:]]), place, st.sampled_from(JUNK)),
    st.builds(exchanged, span, span),
    st.text(max_size=60),
)


@settings(max_examples=150)
@given(text=MUTATED)
def test_a_mutated_scene_file_is_a_scene_or_one_line_with_its_name(folder, text):
    """--frames 0 is refused last before anything is computed: whoever comes so far has a scene."""
    path = folder / "wave.py"
    path.write_text(text, encoding="utf-8", errors="surrogatepass")
    said = one_line("run", path, "--frames", "0", "--out", folder / "out", codes=(2,))
    assert "wave.py" in said or "--frames 0" in said


RETURNED = {
    "None": "scenes() returned NoneType",
    "[]": "scenes() returned list",
    "{}": "scenes() returned dict",
    "{1: bare}": "scenes() returned 1: Scene",
    "{'': bare}": "scenes() returned '': Scene",
    "{'a': 1}": "scenes() returned 'a': int",
    "{'a/b': bare, 'A-b': bare}": "give one file name",
}


@pytest.mark.parametrize("value", RETURNED)
def test_what_is_no_dict_of_scenes_is_told(tmp_path, value):
    scene = write(tmp_path, re.sub(r"return \{\"xi.*", f"return {value}", WAVE))
    assert RETURNED[value] in one_line("run", scene, "--frames", "0", codes=(2,))


ILL = {
    "no text": (b"\xff\xfe\x00scenes", "wave.py"),
    "a null byte": (WAVE.encode().replace(b"BOX =", b"\x00 BOX ="), "wave.py"),
    "nested too deeply": (b"x = " + b"(" * 150 + b")" * 150, "wave.py"),
    "a long chain of signs": (b"x = " + b"-" * 40000 + b"1", "wave.py"),
    "a mistake in a call": (
        WAVE.replace("hexagonal(BOX, nx)", "hexagonal(BOX, nx, 3)").encode(),
        f"wave.py, line {line_of(WAVE, 'positions=hexagonal')}: TypeError",
    ),
    "without end": (b"def scenes():\n    return scenes()\n", "wave.py, line 2: RecursionError"),
}


@pytest.mark.parametrize(("content", "says"), ILL.values(), ids=ILL)
def test_a_file_that_python_cannot_read_is_named(tmp_path, content, says):
    (tmp_path / "wave.py").write_bytes(content)
    assert says in one_line("run", tmp_path / "wave.py", "--frames", "0", codes=(2,))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("mutated")
