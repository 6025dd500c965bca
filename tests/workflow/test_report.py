"""Report and gallery: complete, reproducible, self-contained, from unmodified products only. In a browser the report is
accessible on narrow and wide screens, light and dark."""

import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

import h5py
import pytest
from axe_playwright_python.sync_playwright import Axe
from PIL import Image
from playwright.sync_api import Browser, sync_playwright
from playwright.sync_api import Page as Tab
from workflow.lib.figure_metadata import embedded, read_panel

from tests.workflow.conftest import ROOT, Clone, files_below, replace
from workflow.claims.judge import read_claims
from workflow.plan import load_plan
from workflow.report.gallery import gallery
from workflow.report.questions import read_questions
from workflow.report.sources import ReportError

HTML = "figures/smoke/report.html"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
# Elements without an end: those of HTML, and those of SVG that end themselves.
VOID = {"meta", "img", "link", "br", "hr", "input"}


@dataclass
class Page(HTMLParser):
    """Ids, links, loaded files, pictures and unclosed elements of an HTML page."""

    ids: list[str] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    loaded: list[str] = field(default_factory=list)  # fetched by a browser to show the page
    pictures: list[dict[str, str]] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    open: list[str] = field(default_factory=list)
    scripts: int = 0

    def __post_init__(self) -> None:
        super().__init__()

    @classmethod
    def of(cls, path: Path) -> "Page":
        page = cls()
        page.feed(path.read_text())
        page.close()
        page.faults += [f"{tag} is not closed" for tag in page.open]
        return page

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_startendtag(tag, attrs)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if len(given) < len(attrs):
            self.faults.append(f"{tag} repeats an attribute")
        self.ids += [given["id"]] if "id" in given else []
        self.links += [given["href"]] if tag == "a" else []
        self.loaded += [given[name] for name in ("src", "srcset", "data", "poster") if name in given]
        self.loaded += [given["href"]] if tag in ("link", "image", "use", "base") else []
        self.pictures += [given] if tag == "img" or given.get("role") == "img" else []
        self.scripts += tag == "script" and given.get("type") != "application/json"

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> without a start tag")


def report(clone: Clone) -> None:
    clone.module("report.write", "--quality", "smoke", "--identity", "0" * 12)


@pytest.fixture(scope="module")
def clone(clean: Clone) -> Iterator[Clone]:
    report(clean)
    yield clean
    for path in (clean.folder / HTML).parent.glob("report.*"):
        path.unlink()


@pytest.fixture
def page(clone: Clone) -> Page:
    return Page.of(clone.folder / HTML)


def test_it_is_written_again_with_the_same_bytes(clone: Clone) -> None:
    before = (clone.folder / HTML).read_bytes()
    report(clone)
    assert (clone.folder / HTML).read_bytes() == before
    assert str(clone.folder).encode() not in before


def test_it_is_well_formed(page: Page) -> None:
    assert page.faults == []
    assert len(page.ids) == len({*page.ids})


def test_it_loads_nothing_and_runs_nothing(clone: Clone, page: Page) -> None:
    assert page.loaded
    assert all(address.startswith("data:image/svg+xml;base64,") for address in page.loaded)
    assert page.scripts == 0
    text = (clone.folder / HTML).read_text()
    assert "default-src 'none'" in text
    assert re.findall(r"@import|url\(|javascript:", text) == []


def test_every_link_leads_somewhere(clone: Clone, page: Page) -> None:
    folder = (clone.folder / HTML).parent
    assert page.links
    for link in page.links:
        assert link[1:] in page.ids if link.startswith("#") else (folder / link).is_file(), link


def test_every_claim_and_panel_is_there(page: Page) -> None:
    claims = [claim["id"] for claim in read_claims(ROOT)]
    assert {*claims, *load_plan("smoke")} <= {*page.ids}


def test_pictures_are_described(page: Page) -> None:
    assert len(page.pictures) > len(load_plan("smoke"))
    assert all(picture.get("alt") or picture.get("aria-label") for picture in page.pictures)


def test_the_gallery_has_every_panel_and_claim(kept: Clone) -> None:
    kept.snakemake("gallery")
    assert "Nothing to be done" in kept.snakemake("gallery")
    folder, panels = kept.folder / "docs/gallery", load_plan("smoke")
    assert {path.stem for path in folder.glob("*.png")} >= panels.keys()
    page = (folder / "README.md").read_text()
    for panel in panels:
        small, original = folder / f"{panel}.png", kept.folder / f"figures/smoke/{panel}.png"
        assert embedded(small) == embedded(original)
        assert small.stat().st_size < original.stat().st_size
        with Image.open(small, formats=["PNG"]) as picture, Image.open(original, formats=["PNG"]) as large:
            assert picture.width == min(1440, large.width)
        assert read_panel(kept.folder / kept.record(panel))["caption"] in page
    traced = kept.module("provenance.tree", "docs/gallery/fig05.png")
    assert traced.startswith("fig05.png is docs/gallery/fig05.png, rendered")
    assert "panel fig05 at quality smoke" in traced
    assert all((folder / "claims" / f"{claim['id']}.svg").is_file() for claim in read_claims(ROOT))
    for link in re.findall(r"\]\(([^)]*)\)", page):
        anchored = f'id="{link[1:]}"' in page or re.search(
            rf"^#+ {link[1:].replace('-', ' ')}$", page, re.I | re.M
        )
        assert anchored if link.startswith("#") else (folder / link).is_file(), link
    for front in ("README.md", "docs/index.md"):
        text = (kept.folder / front).read_text()
        table = text.split("<!-- questions, by make gallery -->")[1]
        rows = re.findall(r"^\| (.*\?) \| ", table, re.MULTILINE)
        assert len(rows) == len(read_questions())
        assert all(f"| {row} | " in page for row in rows)
    assert len((kept.folder / "README.md").read_text().splitlines()) <= 130


def test_the_gallery_shows_unmodified_products_only(kept: Clone) -> None:
    def refused(reason: str) -> None:
        with pytest.raises(ReportError, match=re.escape(reason)):
            gallery("smoke", "0" * 12, kept.folder)

    folder = kept.folder / "docs/gallery"
    before = files_below(folder)
    edited = kept.folder / kept.result("fig05/paper_sigma=0")
    whole = edited.read_bytes()
    with h5py.File(edited, "r+") as file:
        file["results/mu/mean"][...] *= 1.001
    refused(f"{edited.name} was modified after it was written; remove it and run make figures QUALITY=smoke")
    edited.write_bytes(whole)
    picture = kept.folder / "figures/smoke/fig07.png"
    kept_picture = picture.read_bytes()
    picture.unlink()
    refused("fig07.png is missing or damaged; remove it and run make figures QUALITY=smoke")
    picture.write_bytes(kept_picture)
    replace("README.md", "<!-- end of the answer -->", "")(kept)
    printed = kept.module("report.gallery", "--quality", "smoke", "--identity", "0" * 12, status=1)
    assert "has no line '<!-- end of the answer -->', which marks the answer; restore it" in printed
    assert files_below(folder) == before


def address(clone: Clone) -> str:
    return (clone.folder / HTML).as_uri()


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    if CHROMIUM is None:
        pytest.skip("no Chromium")
    with sync_playwright() as player:
        chromium = player.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield chromium
        chromium.close()


def opened(browser: Browser, clone: Clone, width: int = 1440, scheme: str = "light") -> Tab:
    page = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme).new_page()
    page.goto(address(clone))
    return page


@pytest.mark.parametrize(("width", "scheme"), [(400, "light"), (900, "dark"), (1440, "light")])
def test_it_is_accessible_and_no_wider_than_the_screen(
    browser: Browser, clone: Clone, width: int, scheme: str
) -> None:
    page = opened(browser, clone, width, scheme)
    response = Axe().run(page).response
    assert len(response["passes"]) > 20
    assert [(violation["id"], violation["nodes"][0]["html"]) for violation in response["violations"]] == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_there_are_no_messages_and_no_requests(browser: Browser, clone: Clone) -> None:
    page, messages, requests = browser.new_page(), [], []
    page.on("console", lambda message: messages.append(message.text))
    page.on("pageerror", lambda error: messages.append(str(error)))
    page.on("request", lambda request: requests.append(request.url))
    page.goto(address(clone))
    assert messages == []
    assert {url for url in requests if not url.startswith("data:")} == {address(clone)}


def test_the_first_screen_has_the_answer_beside_its_picture(browser: Browser, clone: Clone) -> None:
    page = opened(browser, clone)
    rows, picture = page.locator(".questions tbody tr"), page.locator("#answer img").bounding_box()
    assert rows.count() == len(read_questions())
    table = page.locator(".questions").bounding_box()
    assert max(box["y"] + box["height"] for box in (table, picture)) <= 900
    assert picture["x"] > table["x"] + table["width"]


def test_every_picture_is_shown(browser: Browser, clone: Clone) -> None:
    page = opened(browser, clone)
    for panel in load_plan("smoke"):
        assert page.locator(f"#{panel} img").evaluate("one => one.complete && one.naturalWidth > 0")
