"""The report: complete, the same again, whole without a network, noticed when it is changed, usable on narrow screens."""

import re
from collections.abc import Iterator

import h5py
import pytest

from tests.workflow.conftest import Clone, files_below, replace
from tests.workflow.webpage import Page
from workflow.lib.figure_metadata import embedded, read_panel
from workflow.lib.plan import load_plan

HTML, MARKDOWN = "figures/smoke/report.html", "figures/smoke/report.md"


def report(clone: Clone) -> None:
    clone.module("report.write", "--quality", "smoke")


@pytest.fixture(scope="module")
def clone(clean: Clone) -> Iterator[Clone]:
    report(clean)
    yield clean
    for path in (HTML, MARKDOWN):
        (clean.folder / path).unlink(missing_ok=True)


@pytest.fixture
def page(clone: Clone) -> Page:
    return Page.of(clone.folder / HTML)


def test_it_is_written_again_with_the_same_bytes(clone: Clone) -> None:
    before = [(clone.folder / path).read_bytes() for path in (HTML, MARKDOWN)]
    report(clone)
    assert [(clone.folder / path).read_bytes() for path in (HTML, MARKDOWN)] == before
    assert str(clone.folder).encode() not in b"".join(before)


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
    text = (clone.folder / MARKDOWN).read_text()
    for link in re.findall(r"\]\(([^)]*)\)", text):
        assert f'id="{link[1:]}"' in text if link.startswith("#") else (folder / link).is_file(), link


def test_every_claim_and_panel_is_there(clone: Clone, page: Page) -> None:
    claims = [f"C{number:02}" for number in range(1, 35)]
    assert {*claims, *load_plan("smoke")} <= {*page.ids}
    table = (clone.folder / MARKDOWN).read_text()
    assert [name for name in claims if f"| [{name}](#{name.lower()}) |" not in table] == []


def test_pictures_are_described(page: Page) -> None:
    assert len(page.pictures) > len(load_plan("smoke"))
    assert all(picture.get("alt") or picture.get("aria-label") for picture in page.pictures)


def gallery(clone: Clone, status: int = 0) -> str:
    return clone.module("report.gallery", "--quality", "smoke", status=status)


def test_the_gallery_has_every_panel(kept: Clone) -> None:
    gallery(kept)
    folder, panels = kept.folder / "docs/gallery", load_plan("smoke")
    assert {path.stem for path in folder.glob("*.png")} == {*panels, "summary"}
    page = (folder / "README.md").read_text()
    for panel in panels:
        small, original = folder / f"{panel}.png", kept.folder / f"figures/smoke/{panel}.png"
        assert embedded(small) == embedded(original)
        assert small.stat().st_size < original.stat().st_size
        assert read_panel(original.with_suffix(".json"))["caption"] in page
    answer = (kept.folder / "README.md").read_text().split("<!-- answer, by make gallery -->")[1]
    assert re.findall(r"^\d(?=\. )", answer, re.MULTILINE) == [*"12345"]


def test_the_gallery_shows_only_products_as_they_were_written(kept: Clone) -> None:
    folder = kept.folder / "docs/gallery"
    before = files_below(folder)
    edited = kept.folder / "data/smoke/fig05/paper_sigma=0.h5"
    whole = edited.read_bytes()
    with h5py.File(edited, "r+") as file:
        file["results/mu/mean"][...] *= 1.001
    assert f"{edited.name} is not as it was written" in gallery(kept, status=1)
    edited.write_bytes(whole)
    picture = kept.folder / "figures/smoke/fig07.png"
    kept_picture = picture.read_bytes()
    picture.unlink()
    assert "fig07: not made, or not as it was written" in gallery(kept, status=1)
    picture.write_bytes(kept_picture)
    replace("README.md", "<!-- end of the answer -->", "")(kept)
    assert "README.md has no place for the answer: restore the line" in gallery(kept, status=1)
    assert files_below(folder) == before
