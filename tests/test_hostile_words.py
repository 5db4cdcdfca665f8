"""Words that nobody means well with: parameters and commands either act or are refused in one line."""

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tiny import WAVE, one_line, write

from taichi_spmhd import InputError, library
from taichi_spmhd.cli.main import COMMANDS

NASTY = [
    "", " ", "=", "nan", "-nan", "inf", "1e400", "-1e400", "1/0", "0/0", "1/3", "1e-320", "0x10", "1_0", "١٢", "²",
    "½", "9" * 5000, "-" * 300, "True", "None", "[]", "{}", "1,2", "1;2", "__import__('os')", "../..", "\x00", "\n",
    "\u202e", "\ud800", "%s%n", "${HOME}", "🌀", "1e", "+5", "0", "-0", "-1", "0.0", "1e15", "999999999999999999999",
]  # fmt: skip
FEW = st.integers(-3, 24).map(str)  # a scene of a million particles is no mistake, but slow
TEXTS = st.one_of(FEW, st.sampled_from(NASTY), st.floats(-10, 10).map(repr), st.text("-+.e/ naif_x°ß", max_size=8))


def tried(scene: str, given: dict) -> None:
    """A scene loads, or says why not in one line of moderate length."""
    try:
        library.load_scene(scene, **given)
    except InputError as error:
        assert str(error) and str(error).isprintable() and len(str(error)) < 500, error


@pytest.mark.parametrize("name", sorted(library.shipped()))
@settings(max_examples=40)
@given(chance=st.data())
def test_any_text_for_a_parameter_gives_scenes_or_one_line(name, chance):
    known = [name for name in library.parameters_of(name) if name != "finer"]
    given = chance.draw(st.dictionaries(st.sampled_from(known), TEXTS, max_size=3))
    tried(name, {**({"nx": "12"} if "nx" in known else {}), **given})


@settings(max_examples=100)
@given(text=st.one_of(st.sampled_from(NASTY), st.text(max_size=20)), name=st.text(max_size=6))
@example(text="12", name="nx ")
def test_any_assignment_is_taken_or_refused_in_one_line(wave, text, name):
    for pair in (f"nx={text}", f"{name}={text}", f"lattice={text}", f"noisy={text}", text):
        one_line("run", wave, "--frames", "0", "--set", pair, codes=(2,))


OPTIONS = ["--set", "--variant", "--frames", "--movie", "--t-end", "--out", "--resume", "--arch", "--precision",
           "--threads", "--quiet", "--json", "--cases", "--sizes", "--vary", "--error", "--repeat", "--budget",
           "--jobs", "--cluster", "--effects", "--scale", "--port", "--host", "--scan", "--lattice", "--at", "--only",
           "--preset", "--quick", "--full", "--version", "--help",
           "-", "--"]  # fmt: skip
WORDS = st.one_of(st.sampled_from(NASTY), st.sampled_from(OPTIONS), st.sampled_from(COMMANDS), st.text(max_size=8))


@settings(max_examples=150)
@given(command=st.sampled_from(COMMANDS), words=st.lists(WORDS, max_size=5))
def test_any_words_behind_a_command_are_refused_in_one_line_or_act(command, words):
    """A scene that is not there comes first, so that nothing is computed; `bench` is given a case that is not there."""
    first = {"bench": ["--cases", "none"], "list": []}.get(command, ["no_such_scene"])
    one_line(command, *first, *words)


@settings(max_examples=150)
@given(words=st.lists(st.one_of(st.sampled_from(NASTY), st.sampled_from(OPTIONS), st.text(max_size=8)), max_size=4))
def test_any_words_without_a_command_are_refused_in_one_line(words):
    one_line(*words)


NUMBERS = st.one_of(st.sampled_from(NASTY), st.integers().map(str), st.floats().map(repr))
ASKED = {
    "run": ("--frames", "--t-end", "--movie", "--variant", "--threads", "--arch", "--precision"),
    "show": ("--variant", "--threads", "--arch", "--precision"),
    "dispersion": ("--scan", "--lattice", "--at", "--variant", "--threads", "--precision"),
    "cost": ("--vary", "--variant", "--error", "--t-end", "--repeat", "--budget", "--jobs", "--threads", "--precision"),
}


@pytest.mark.parametrize(("command", "option"), [(c, o) for c, options in ASKED.items() for o in options])
@settings(max_examples=15)
@given(text=NUMBERS)
def test_any_value_of_an_option_is_refused_in_one_line(wave, command, option, text):
    """Beside another that is wrong, so that nothing is computed where the value is right."""
    wrong = ["--variant", "no such variant"] if option != "--variant" else ["--set", "nothing=1"]
    one_line(command, wave, *wrong, f"{option}={text}", codes=(2,))


@pytest.fixture(scope="module")
def wave(tmp_path_factory):
    return write(tmp_path_factory.mktemp("scene"), WAVE)
