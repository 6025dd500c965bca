"""The report: complete, the same again, whole without a network, noticed when it is changed, usable on narrow screens."""

import json
import os
import re
import subprocess
from collections.abc import Callable

import pytest

from tests.workflow.conftest import Clone, append, delete, files_below, replace
from tests.workflow.tampering import in_place_of, run_module, tampered
from tests.workflow.webpage import Page
from workflow.lib.parents import Parents, caption_of
from workflow.lib.plan import load_plan

HTML, MARKDOWN = "figures/smoke/report.html", "figures/smoke/report.md"
LITTLE = ("--panel", "fig03")  # the panel that an audit draws again, beside the report

__all__ = ["tampered"]  # a fixture


@pytest.fixture(scope="module")
def clone(clean: Clone) -> Clone:
    made = clean.make("report", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    yield clean
    for path in (HTML, MARKDOWN):
        (clean.folder / path).unlink(missing_ok=True)


@pytest.fixture
def page(clone: Clone) -> Page:
    return Page.of(clone.folder / HTML)


def test_it_is_written_again_with_the_same_bytes(clone: Clone) -> None:
    before = [(clone.folder / path).read_bytes() for path in (HTML, MARKDOWN)]
    assert clone.make("report", "QUALITY=smoke").returncode == 0
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


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (replace(HTML, "</h1>", "!</h1>"), f"{HTML}: does not follow from"),
        pytest.param(replace(HTML, '"fig05/', '"fig00/'), f"{HTML}: does not follow from", marks=pytest.mark.long),
        pytest.param(append(MARKDOWN, "more\n"), f"{MARKDOWN}: does not follow from", marks=pytest.mark.long),
        pytest.param(delete(MARKDOWN), f"{MARKDOWN}: is missing beside", marks=pytest.mark.long),
        pytest.param(append("data/claims.csv", "\n"), f"{HTML}: does not follow from", marks=pytest.mark.long),
        (append("figures/smoke/fig05.csv", "0"), f"{HTML}: cannot be written again: make report: figures/smoke/fig05.csv"),
        pytest.param(
            in_place_of("workflow/figures/fig05.py", os.mkfifo), f"{HTML}: cannot be written again: workflow/figures/fig05.py is no file",
            marks=pytest.mark.long,
        ),
    ],
    ids=["page", "costs", "table", "missing", "claims", "panel", "queue"],
)  # fmt: skip
def test_an_audit_notices_changes(clone: Clone, tampered: Clone, edit: Callable, message: str) -> None:
    edit(clone)
    audited = run_module(clone, "audit", *LITTLE)
    assert audited.returncode == 1, audited.stdout
    assert message in audited.stdout


def test_an_audit_of_a_new_report_finds_nothing(clone: Clone) -> None:
    audited = run_module(clone, "audit", *LITTLE)
    assert audited.returncode == 0, audited.stdout


def test_the_gallery_has_every_panel_and_knows_when_it_is_old(kept: Clone) -> None:
    made = kept.make("gallery", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    folder, panels = kept.folder / "docs/gallery", load_plan("smoke")
    assert {path.stem for path in folder.glob("*.png")} == {*panels, "summary"}
    for panel in panels:
        small, original = folder / f"{panel}.png", kept.folder / f"figures/smoke/{panel}.png"
        assert Parents.of(small) == Parents.of(original)
        assert small.stat().st_size < original.stat().st_size
        assert caption_of(original.with_suffix(".csv")) in (folder / "README.md").read_text()
    answer = (kept.folder / "README.md").read_text().split("<!-- answer, by make gallery -->")[1]
    assert re.findall(r"^\d(?=\. )", answer, re.MULTILINE) == [*"12345"]
    assert "docs/gallery" not in kept.make("status", "QUALITY=smoke").stdout
    forged = next((kept.folder / "data/smoke/fig05").iterdir())
    content, before = forged.read_bytes(), files_below(folder)
    forged.write_bytes(content + b"\0")
    made = kept.make("gallery", "QUALITY=smoke")
    assert (made.returncode, f"{forged.name} is not what its job wrote" in made.stdout) == (2, True)
    assert files_below(folder) == before
    forged.write_bytes(content)
    picture = kept.folder / "figures/smoke/fig07.png"
    kept_picture = picture.read_bytes()
    picture.unlink()
    made = kept.make("gallery", "QUALITY=smoke")
    assert (made.returncode, "fig07 not made, or not as the lock says" in made.stdout) == (2, True)
    assert files_below(folder) == before
    picture.write_bytes(kept_picture)
    append("workflow/figures/fig06.py", "# more\n")(kept)
    assert (
        "docs/gallery: drawn by former code: fig06; make gallery"
        in kept.make("status", "QUALITY=smoke").stdout
    )
    replace("README.md", "<!-- end of the answer -->", "")(kept)
    made = kept.make("gallery", "QUALITY=smoke")
    assert (made.returncode, "README.md has no place for the answer: restore the line" in made.stdout) == (
        2,
        True,
    )


PACK = """
from workflow.provenance import crate
crate.DRAFT = "none"  # packs the quality that is here
try:
    print(crate.pack("smoke", None))
except crate.CrateError as error:
    print(error)
"""


def test_the_crate_holds_the_report_if_it_follows_from_the_products(kept: Clone) -> None:
    assert kept.make("report", "QUALITY=smoke").returncode == 0
    (kept.folder / "workflow/pack.py").write_text(PACK)
    pack = [".venv/bin/python", "-P", "workflow/environment/launch.py", "workflow.pack"]
    settings = {"PATH": os.defpath, "SOURCE_DATE_EPOCH": "0"}
    subprocess.run(pack, cwd=kept.folder, env=settings, check=True)
    graph = json.loads((kept.folder / "build/crate/smoke/ro-crate-metadata.json").read_text())["@graph"]
    report = next(one for one in graph if one["@id"] == "#report")
    assert [one["@id"] for one in report["result"]] == [HTML, MARKDOWN]
    assert {"@id": "data/claims.csv"} in report["object"]
    assert {"@id": "figures/smoke/fig08.csv"} in report["object"]
    for path in (HTML, MARKDOWN):
        assert (kept.folder / "build/crate/smoke" / path).read_bytes() == (kept.folder / path).read_bytes()
    append(MARKDOWN, "more")(kept)
    told = subprocess.check_output(pack, cwd=kept.folder, env=settings, text=True)
    assert f"{MARKDOWN} does not follow from the products and sources that are there: run make report" in told
