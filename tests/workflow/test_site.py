"""The documentation in a browser: whole, without messages, and no wider than a narrow screen."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, sync_playwright

from tests.python.conftest import ROOT

pytestmark = pytest.mark.long
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
NARROW = 390  # width in pixels
HEADING = re.compile(r'<h[1-6][^>]*\bid="([^"]+)"')
EQUATIONS = """[...document.querySelectorAll("mjx-container[display]")].filter(
  equation => equation.scrollWidth > equation.parentElement.clientWidth + 1 && getComputedStyle(equation).overflowX !== "auto").map(equation => equation.textContent)"""


@pytest.fixture(scope="module")
def site() -> Path:
    subprocess.run(["make", "docs"], cwd=ROOT, check=True)
    return ROOT / "build/docs"


@pytest.fixture(scope="module")
def tab() -> Iterator[Page]:
    with sync_playwright() as player:
        browser = player.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser.new_context(viewport={"width": NARROW, "height": 844}).new_page()
        browser.close()


def faults(tab: Page, messages: list[str], path: Path) -> list[str]:
    messages.clear()
    tab.goto(path.as_uri(), timeout=180_000)  # of the formulas of a long page on a busy machine
    tab.evaluate("window.MathJax?.startup?.promise")
    headings = HEADING.findall(path.read_text("utf-8"))
    if headings and not tab.evaluate("id => document.getElementById(id) !== null", headings[-1]):
        messages.append(f"the heading {headings[-1]} is not in the document")
    if (width := tab.evaluate("document.documentElement.scrollWidth")) > NARROW:
        messages.append(f"{width} pixels wide")
    return [*messages, *(f"wide equation: {text}" for text in tab.evaluate(EQUATIONS))]


def test_the_report_on_a_narrow_screen(smoke: Path, tab: Page) -> None:
    tab.goto((smoke / "figures/smoke/report.html").as_uri())
    assert tab.evaluate("document.documentElement.scrollWidth") <= NARROW
    assert tab.evaluate("[...document.images].every(one => one.complete && one.naturalWidth > 0)")


def test_every_page(site: Path, tab: Page) -> None:
    """Detected mistakes: an unescaped <template> in a docstring; a missing script; a table or a signature that is wider than the page; a wide
    equation that does not scroll."""
    pages = [path for path in site.rglob("*.html") if path.name != "404.html"]  # it works on a server only
    assert len(pages) > 100
    messages: list[str] = []
    tab.on("console", lambda message: messages.append(message.text))
    tab.on("pageerror", lambda error: messages.append(str(error)))
    messages_by_page = {str(path.relative_to(site)): faults(tab, messages, path) for path in pages}
    assert {name: messages for name, messages in messages_by_page.items() if messages} == {}
