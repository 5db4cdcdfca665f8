"""A run of `spmhd live` with its page in a headless Chromium, for the tests that drive it like a person."""

import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parent.parent
WAIT = 30.0  # seconds for anything to happen on a machine with two busy cores; compiling is the slowest
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
SHOW = """
    for (let box = arguments[0].closest("details"); box; box = box.parentElement.closest("details")) box.open = true;
    arguments[0].scrollIntoView({block: "center"});
"""
FLAGS = ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--force-device-scale-factor=1")


def missing() -> str | None:
    """What is not installed, in words, or None."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "selenium is not installed (pip install selenium)"
    if CHROMIUM is None or shutil.which("chromedriver") is None:
        return "chromium and chromedriver are not installed (apt-get install chromium chromium-driver)"
    return None


class Server:
    """`spmhd live SCENE ...` in a process of its own; `url` is what its first line says."""

    def __init__(self, out: Path, *words: str):
        command = [sys.executable, "-m", "taichi_spmhd", "live", *words, "--no-browser", "--out", str(out)]
        self.process = subprocess.Popen(
            command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1
        )
        line = self.process.stdout.readline()
        found = re.search(r"http://\S+/", line)
        assert found, f"no address in the first line: {line}{self.process.stdout.read() if not line else ''}"
        self.url, self.out = found[0], out

    def stop(self) -> None:
        self.process.terminate()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()


def browser(width: int = 1280, height: int = 800):
    """A headless Chromium that keeps what the console says."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (*FLAGS, f"--window-size={width},{height}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    driver.set_script_timeout(WAIT)
    return driver


class Page:
    """What a person does with the page, and what they see."""

    def __init__(self, driver, url: str):
        self.driver, self.url = driver, url

    def open(self, language: str = "en") -> None:
        self.driver.get(f"{self.url}?lang={language}")
        self.until("window.live && live.state && live.setup && live.frames.shown > 0")

    def js(self, code: str, *given):
        """The value of an expression in the page."""
        return self.driver.execute_script(f"return {code}", *given)

    def until(self, condition: str, seconds: float = WAIT):
        """Wait until an expression is true in the page; its value."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.js(condition)
            if value:
                return value
            time.sleep(0.02)
        raise AssertionError(
            f"not within {seconds} s: {condition}; state {self.js('JSON.stringify(live.state)')[:1500]}"
        )

    def find(self, name: str):
        """The element with this id."""
        return self.driver.find_element("id", name)

    def click(self, name: str) -> None:
        """Press a button, or tick a box, as a pointer does, and wait until the run has done it."""
        asked = self.js("live.timings.length ? live.timings.at(-1).id : 0")
        element = self.find(name)
        self.driver.execute_script(SHOW, element)
        element.click()
        self.until(f"live.timings.at(-1)?.id > {asked} && live.timings.every((one) => one.applied !== null)")

    def slide(self, name: str, value: float) -> None:
        """Move a slider as dragging does, and wait until it acts."""
        move = "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input', {bubbles: true}))"
        asked = self.js("live.timings.length ? live.timings.at(-1).id : 0")
        self.driver.execute_script(move, self.find(name), str(value))
        self.until(f"live.timings.at(-1)?.id > {asked} && live.timings.every((one) => one.applied !== null)")

    def pause(self) -> None:
        if self.js("live.state.playing"):
            self.click("play")
            self.until("!live.state.playing")

    def play_to_the_end(self) -> None:
        """On until the run rests at its t_end."""
        self.click("play")
        self.until("!live.state.playing && live.state.panels[0].t >= live.setup.t_end")

    def panel(self, number: int = 0) -> dict:
        """The state of a panel."""
        return self.js(f"live.state.panels[{number}]")

    def picture_is_drawn(self, number: int = 0) -> bool:
        """Whether the canvas holds more than one colour."""
        return self.js(
            f"(() => {{ const c = document.getElementById('picture-{number}');"
            " const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
            " return new Set(d.filter((_, k) => k % 4 === 0)).size > 8 })()"
        )
