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
WIDTHS = (400, 900, 1440)

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")


@pytest.fixture(scope="module")
def address(clean: Clone) -> Iterator[str]:
    clean.module("report.write", "--quality", "smoke")
    yield (clean.folder / REPORT).as_uri()
    (clean.folder / REPORT).unlink()


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with sync_playwright() as player:
        chromium = player.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield chromium
        chromium.close()


def opened(browser: Browser, address: str, width: int = 1440, scheme: str = "light") -> Page:
    page = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme).new_page()
    page.goto(address)
    return page


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", WIDTHS)
def test_the_report_is_accessible(browser: Browser, address: str, width: int, scheme: str) -> None:
    found = Axe().run(opened(browser, address, width, scheme)).response
    assert len(found["passes"]) > 20
    assert [(one["id"], one["nodes"][0]["html"]) for one in found["violations"]] == []


def test_inaccessible_pages_are_found(browser: Browser) -> None:
    page = browser.new_page()
    page.set_content(
        "<html lang=en><title>x</title><main><h1>x</h1><p style='color:#ccc'>pale</p><img src=x></main>"
    )
    assert {one["id"] for one in Axe().run(page).response["violations"]} == {"color-contrast", "image-alt"}


@pytest.mark.parametrize("width", WIDTHS)
def test_nothing_is_wider_than_the_screen(browser: Browser, address: str, width: int) -> None:
    page = opened(browser, address, width)
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_there_are_no_messages_and_no_requests(browser: Browser, address: str) -> None:
    page, said, asked = browser.new_page(), [], []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(address)
    assert said == []
    assert {url for url in asked if not url.startswith("data:")} == {address}


def test_the_first_screen_has_the_answer_beside_its_picture(browser: Browser, address: str) -> None:
    page = opened(browser, address)
    rows, picture = page.locator(".questions tbody tr"), page.locator("#answer img").bounding_box()
    assert rows.count() == 7
    table = page.locator(".questions").bounding_box()
    assert max(box["y"] + box["height"] for box in (table, picture)) <= 900
    assert picture["x"] > table["x"] + table["width"]


def test_claims_unfold_by_keyboard(browser: Browser, address: str) -> None:
    page = opened(browser, address, 900)
    criterion = page.locator("#C05 > p").first
    assert not criterion.is_visible()
    page.locator("#C05 > summary").press("Enter")
    assert criterion.is_visible()


def test_every_picture_is_shown(browser: Browser, address: str) -> None:
    page = opened(browser, address)
    for panel in load_plan("smoke"):
        assert page.locator(f"#{panel} img").evaluate("one => one.complete && one.naturalWidth > 0")


def test_numbers_can_be_downloaded(browser: Browser, address: str) -> None:
    page = opened(browser, address)
    with page.expect_download() as download:
        page.locator("#fig08 a[href='fig08.csv']").click()
    assert download.value.suggested_filename == "fig08.csv"
