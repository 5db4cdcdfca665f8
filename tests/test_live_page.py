"""The static page of the sandbox, without a browser: nothing from elsewhere, text stays text, two languages."""

import re
from pathlib import Path

import pytest

import taichi_spmhd

PAGE = Path(taichi_spmhd.__file__).parent / "live" / "page"
SVG = "http://www.w3.org/2000/svg"  # a name, never fetched


def text(pattern: str) -> str:
    return "\n".join(path.read_text(encoding="utf-8") for path in sorted(PAGE.glob(pattern)))


def words(language: str) -> dict[str, str]:
    """The dictionary as it stands in its file, one key a line."""
    lines = (PAGE / f"{language}.js").read_text(encoding="utf-8").splitlines()
    found = [re.fullmatch(r'  "([^"]+)": "(.*)",', line) for line in lines]
    pairs = [match.groups() for match in found if match]
    assert len(dict(pairs)) == len(pairs)  # no key twice
    return dict(pairs)


def test_nothing_is_fetched_from_elsewhere():
    everything = text("*.html") + text("*.js") + text("*.css")
    assert not re.findall(r"""(?:https?:)?//[\w-]+\.[\w.]+""", everything.replace(SVG, ""))


@pytest.mark.parametrize(
    "trap", ["innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval(", "new Function"]
)
def test_text_never_becomes_markup_or_code(trap):
    assert trap not in text("*.js")


def test_the_page_obeys_its_own_content_security_policy():
    page = text("*.html")
    assert not re.search(r"<script(?![^>]*\bsrc=)", page)  # no inline script
    assert not re.search(r"<style|\sstyle=|\son\w+=", page)
    assert not re.search(r"setAttribute\(\s*[\"']style", text("*.js"))


def test_both_languages_have_the_same_keys_and_blanks():
    english, japanese = words("english"), words("japanese")
    assert len(english) > 100
    assert english.keys() == japanese.keys()
    for key, said in english.items():
        assert set(re.findall(r"\{\w+\}", said)) == set(re.findall(r"\{\w+\}", japanese[key])), key


def test_every_word_that_is_asked_for_is_known():
    known = words("english")
    asked = set(re.findall(r'\bword\("([\w.]+)"', text("*.js")))
    asked |= set(re.findall(r'data-(?:word|label|tip)="([\w.]+)"', text("*.html")))
    assert asked
    assert asked <= known.keys()


def test_no_word_is_left_over():
    code = text("*.html") + "".join(path.read_text(encoding="utf-8") for path in PAGE.glob("*.js"))
    lists = {
        "tool",
        "draw",
        "limits",
        "record",
        "plot",
        "line",
        "read",
        "busy",
        "name",
        "part",
    }  # put together: `name.${x}`
    alone = {key for key in words("english") if key.split(".")[0] not in lists}
    assert not {key for key in alone if len(re.findall(rf'"{re.escape(key)}"', code)) < 3}  # two dictionaries and a use


def test_every_module_that_is_imported_stands_beside():
    for path in PAGE.glob("*.js"):
        for name in re.findall(r'from "\./([\w.]+)"', path.read_text(encoding="utf-8")):
            assert (PAGE / name).is_file(), f"{path.name}: {name}"


def test_every_term_has_a_name_in_both_languages():
    from taichi_spmhd import terms
    from taichi_spmhd.terms import Term, XiRule

    made = [getattr(terms, name) for name in terms.__all__ if isinstance(getattr(terms, name), type)]
    names = {one.__name__ for one in made if issubclass(one, Term) and one is not Term and not issubclass(one, XiRule)}
    assert {f"part.{name}" for name in names} <= words("english").keys()
