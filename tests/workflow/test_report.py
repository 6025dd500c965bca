"""Report and gallery: complete, reproducible, self-contained, from unmodified products only."""

import re
from collections.abc import Iterator

import h5py
import pytest
from PIL import Image

from tests.workflow.conftest import ROOT, Clone, files_below, replace
from tests.workflow.webpage import Page
from workflow.claims.judge import read_claims
from workflow.lib.figure_metadata import embedded, read_panel
from workflow.lib.plan import load_plan

HTML = "figures/smoke/report.html"


def report(clone: Clone) -> None:
    clone.module("report.write", "--quality", "smoke")


@pytest.fixture(scope="module")
def clone(clean: Clone) -> Iterator[Clone]:
    report(clean)
    yield clean
    (clean.folder / HTML).unlink()


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


def gallery(clone: Clone, status: int = 0) -> str:
    return clone.module("report.gallery", "--quality", "smoke", status=status)


def test_the_gallery_has_every_panel_and_claim(kept: Clone) -> None:
    gallery(kept)
    folder, panels = kept.folder / "docs/gallery", load_plan("smoke")
    assert {path.stem for path in folder.glob("*.png")} >= panels.keys()
    page = (folder / "README.md").read_text()
    for panel in panels:
        small, original = folder / f"{panel}.png", kept.folder / f"figures/smoke/{panel}.png"
        assert embedded(small) == embedded(original)
        assert small.stat().st_size < original.stat().st_size
        with Image.open(small, formats=["PNG"]) as picture, Image.open(original, formats=["PNG"]) as large:
            assert picture.width == min(1440, large.width)
        assert read_panel(original.with_suffix(".json"))["caption"] in page
    assert all((folder / "claims" / f"{claim['id']}.svg").is_file() for claim in read_claims(ROOT))
    for link in re.findall(r"\]\(([^)]*)\)", page):
        anchored = f'id="{link[1:]}"' in page or re.search(
            rf"^#+ {link[1:].replace('-', ' ')}$", page, re.I | re.M
        )
        assert anchored if link.startswith("#") else (folder / link).is_file(), link
    readme = (kept.folder / "README.md").read_text()
    rows = re.findall(r"^\| (.*\?) \| ", readme.split("<!-- answer, by make gallery -->")[1], re.MULTILINE)
    assert len(rows) == 7
    assert all(f"| {row} | " in page for row in rows)
    assert len(readme.splitlines()) <= 130


def test_the_gallery_shows_unmodified_products_only(kept: Clone) -> None:
    folder = kept.folder / "docs/gallery"
    before = files_below(folder)
    edited = kept.folder / "data/smoke/fig05/paper_sigma=0.h5"
    whole = edited.read_bytes()
    with h5py.File(edited, "r+") as file:
        file["results/mu/mean"][...] *= 1.001
    assert f"{edited.name} was modified after it was written; run make audit" in gallery(kept, status=1)
    edited.write_bytes(whole)
    picture = kept.folder / "figures/smoke/fig07.png"
    kept_picture = picture.read_bytes()
    picture.unlink()
    assert "fig07.png is missing or damaged; run make figures QUALITY=smoke" in gallery(kept, status=1)
    picture.write_bytes(kept_picture)
    replace("README.md", "<!-- end of the answer -->", "")(kept)
    assert "has no line '<!-- end of the answer -->', which marks the answer; restore it" in gallery(
        kept, status=1
    )
    assert files_below(folder) == before
