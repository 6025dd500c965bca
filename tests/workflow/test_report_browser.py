"""The report in a browser: on narrow and wide screens, light and dark, by keyboard, for a screen reader, without a network."""

import shutil
from collections.abc import Iterator

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, sync_playwright

from tests.workflow.conftest import Clone
from workflow.lib.plan import load_plan

REPORT = "figures/smoke/report.html"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
WIDTHS = (360, 800, 1400)

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")


@pytest.fixture(scope="module")
def address(clean: Clone) -> Iterator[str]:
    clean.module("report.write", "--quality", "smoke")
    yield (clean.folder / REPORT).as_uri()
    for name in ("report.html", "report.md"):
        (clean.folder / "figures/smoke" / name).unlink()


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with sync_playwright() as player:
        chromium = player.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield chromium
        chromium.close()


def opened(browser: Browser, address: str, width: int = 1400, scheme: str = "light") -> Page:
    page = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme).new_page()
    page.goto(address)
    return page


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", WIDTHS)
def test_nothing_bars_a_reader(browser: Browser, address: str, width: int, scheme: str) -> None:
    found = Axe().run(opened(browser, address, width, scheme)).response
    assert len(found["passes"]) > 20
    assert [(one["id"], one["nodes"][0]["html"]) for one in found["violations"]] == []


def test_what_bars_a_reader_is_found(browser: Browser) -> None:
    page = browser.new_page()
    page.set_content(
        "<html lang=en><title>x</title><main><h1>x</h1><p style='color:#ccc'>pale</p><img src=x></main>"
    )
    assert {one["id"] for one in Axe().run(page).response["violations"]} == {"color-contrast", "image-alt"}


@pytest.mark.parametrize("width", WIDTHS)
def test_nothing_is_wider_than_the_screen(browser: Browser, address: str, width: int) -> None:
    page = opened(browser, address, width)
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_it_complains_of_nothing_and_asks_for_nothing(browser: Browser, address: str) -> None:
    page, said, asked = browser.new_page(), [], []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(address)
    assert said == []
    assert {url for url in asked if not url.startswith("data:")} == {address}


def test_the_first_screen_has_the_answer(browser: Browser, address: str) -> None:
    page = opened(browser, address)
    for sentence in page.locator("ol.answer > li").all():
        box = sentence.bounding_box()
        assert box["y"] + box["height"] <= 900


def test_every_picture_can_be_enlarged_by_keyboard(browser: Browser, address: str) -> None:
    page = opened(browser, address, 800)
    for panel in load_plan("smoke"):
        picture = page.locator(f"#enlarged-{panel} img")
        small = picture.bounding_box()["width"]
        page.locator(f"#enlarged-{panel} a.enlarge").press("Enter")
        assert picture.bounding_box()["width"] >= small
        assert picture.evaluate("one => one.complete && one.naturalWidth > 0")
        page.locator(f"#enlarged-{panel} a.close").press("Enter")
        assert picture.bounding_box()["width"] == small


def test_numbers_can_be_had(browser: Browser, address: str) -> None:
    page = opened(browser, address)
    with page.expect_download() as download:
        page.locator("#fig08 a[href='fig08.csv']").click()
    assert download.value.suggested_filename == "fig08.csv"
