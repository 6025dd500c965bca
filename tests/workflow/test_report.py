"""Report and gallery: complete, reproducible, self-contained, from unmodified results only."""

import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

import h5py
import pytest
from PIL import Image

from workflow.claims.judge import read_claims
from workflow.identity import ROOT, stated
from workflow.plan import data_of, load_plan, stem_of
from workflow.report.gallery import gallery
from workflow.report.questions import read_questions
from workflow.report.sources import ReportError

PLAN = load_plan("smoke")
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


def write(path: Path) -> Path:
    command = [sys.executable, "-m", "workflow.report.write", "--quality", "smoke", "--output", path]
    subprocess.run(command, cwd=ROOT, check=True)
    return path


@pytest.fixture(scope="module")
def html(smoke: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(tmp_path_factory.mktemp("report") / "report.html")


@pytest.fixture
def page(html: Path) -> Page:
    return Page.of(html)


def test_it_is_written_again_with_the_same_bytes(html: Path, tmp_path: Path) -> None:
    again = write(tmp_path / "report.html").read_bytes()
    assert again == html.read_bytes()
    assert str(ROOT).encode() not in again


def test_it_is_well_formed(page: Page) -> None:
    assert page.faults == []
    assert len(page.ids) == len({*page.ids})


def test_it_loads_nothing_and_runs_nothing(html: Path, page: Page) -> None:
    assert page.loaded
    assert all(address.startswith("data:image/svg+xml;base64,") for address in page.loaded)
    assert page.scripts == 0
    text = html.read_text()
    assert "default-src 'none'" in text
    assert re.findall(r"@import|url\(|javascript:", text) == []


def test_every_link_leads_somewhere(page: Page) -> None:
    folder = ROOT / "figures/smoke"
    assert page.links
    for link in page.links:
        assert link[1:] in page.ids if link.startswith("#") else (folder / link).is_file(), link


def test_every_claim_and_panel_is_there(page: Page) -> None:
    claims = [claim["id"] for claim in read_claims(ROOT)]
    assert {*claims, *PLAN} <= {*page.ids}


def test_pictures_are_described(page: Page) -> None:
    assert len(page.pictures) > len(PLAN)
    assert all(picture.get("alt") or picture.get("aria-label") for picture in page.pictures)


@pytest.fixture
def copy(smoke: Path, tmp_path: Path) -> Path:
    """A folder with the products of this project and front pages of its own."""
    for name in ("README.md", "docs/index.md", "CITATION.cff", "data/claims.csv"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(smoke / name, tmp_path / name)
    (tmp_path / "build").mkdir()
    for name in ("data/smoke", "build/figures"):
        (tmp_path / name).symlink_to(smoke / name)
    return tmp_path


def test_the_gallery_has_every_panel_and_claim(copy: Path) -> None:
    gallery("smoke", copy)
    folder = copy / "docs/gallery"
    page = (folder / "README.md").read_text()
    for panel in PLAN:
        small, original = folder / f"{panel}.png", ROOT / f"{stem_of(PLAN, panel, 'smoke')}.png"
        assert stated(small.read_bytes()) == stated(original.read_bytes())
        assert small.stat().st_size < original.stat().st_size
        with Image.open(small, formats=["PNG"]) as picture, Image.open(original, formats=["PNG"]) as large:
            assert picture.width == min(1440, large.width)
    assert all((folder / "claims" / f"{claim['id']}.svg").is_file() for claim in read_claims(ROOT))
    for link in re.findall(r"\]\(([^)]*)\)", page):
        heading = rf"^#+ {link[1:].replace('-', ' ')}$"
        anchored = f'id="{link[1:]}"' in page or re.search(heading, page, re.I | re.M)
        assert anchored if link.startswith("#") else (folder / link).is_file(), link
    for front in ("README.md", "docs/index.md"):
        table = (copy / front).read_text().split("<!-- questions, by make gallery -->")[1]
        rows = re.findall(r"^\| (.*\?) \| ", table, re.MULTILINE)
        assert len(rows) == len(read_questions())
        assert all(f"| {row} | " in page for row in rows)


def test_the_gallery_is_written_from_unmodified_results_only(copy: Path) -> None:
    (copy / "data/smoke").unlink()
    shutil.copytree(ROOT / "data/smoke", copy / "data/smoke")
    edited = copy / data_of(PLAN, "fig05", "smoke")[0]
    with h5py.File(edited, "r+") as file:
        file["results/mu/mean"][...] *= 1.001
    with pytest.raises(
        ReportError, match=r"is edited or damaged; remove it and run make figures QUALITY=smoke"
    ):
        gallery("smoke", copy)
    shutil.copy(ROOT / edited.relative_to(copy), edited)
    text = (copy / "README.md").read_text()
    (copy / "README.md").write_text(text.replace("<!-- end of the answer -->", ""))
    with pytest.raises(ReportError, match="has no line '<!-- end of the answer -->', which marks the answer"):
        gallery("smoke", copy)
    assert not (copy / "docs/gallery").exists()
