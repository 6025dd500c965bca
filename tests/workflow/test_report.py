"""Report and gallery: complete, reproducible, self-contained."""

import base64
import csv
import re
import shutil
import subprocess
from collections import defaultdict
from pathlib import Path

import pytest
from PIL import Image

from workflow.lib.identity import ROOT
from workflow.lib.load import load
from workflow.pipeline.plan import Plan
from workflow.render.record import read_identity_line
from workflow.study.judge import judge_all, read_claims
from workflow.study.report import write
from workflow.study.results import Results
from workflow.study.verdict import Outcome

PLAN = Plan("smoke").panels
IDS = {
    *(number.lower() for row in read_claims(ROOT) for number in row["numbers"].split()),
    *(f"{row['numbers'].lower()[:3]}-intended" for row in read_claims(ROOT) if row["kind"] == "intended"),
    *PLAN,
}


def ids_and_links(text: str) -> tuple[set[str], list[str]]:
    """Ids, which are unique, and targets of links in a page."""
    ids = re.findall(r'\bid="([^"]*)"', text)
    assert len(ids) == len({*ids})
    return {*ids}, re.findall(r'<a [^>]*href="([^"]*)"', text)


@pytest.fixture(scope="module")
def copy(smoke: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the products of this project."""
    folder = tmp_path_factory.mktemp("copy")
    for name in ("build", "data", "docs/gallery"):
        (folder / name).mkdir(parents=True)
    (folder / "workflow/study").mkdir(parents=True)
    shutil.copy(smoke / "workflow/study/claims.csv", folder / "workflow/study")
    shutil.copytree(smoke / "data/smoke", folder / "data/smoke")
    (folder / "figures").symlink_to(smoke / "figures")
    return folder


@pytest.fixture(scope="module")
def gallery(copy: Path) -> Path:
    """The gallery of this project at smoke quality, written over a former one."""
    folder = copy / "docs/gallery"
    (folder / "removed_panel.png").touch()
    write("smoke", copy, gallery=True)
    return folder


def test_the_report_is_complete_and_loads_nothing(smoke: Path) -> None:
    text = (smoke / "figures/smoke/report.html").read_text()
    ids, links = ids_and_links(text)
    assert ids >= IDS
    assert text.count('src="data:image/svg+xml;base64,') == text.count("<img ") == len(PLAN)
    pictures = [base64.b64decode(one) for one in re.findall(r'svg\+xml;base64,([^"]*)"', text)]
    assert not any(b"<text" in picture for picture in pictures)  # outlines: browsers have no fonts of TeX
    assert re.findall(r"<script|<link|@import|url\(|javascript:", text) == []
    words = re.sub(r"<style.*?</style>|<[^>]*>", "", text, flags=re.DOTALL)
    assert re.findall(r".*[:(,]\s*[.;)].*", words) == []  # a list of numbers without numbers
    for link in links:
        inside = (
            link.removeprefix("#") in ids if link.startswith("#") else link.startswith("https://doi.org/")
        )
        assert inside or (ROOT / "figures/smoke" / link).is_file(), link


CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
FRAME = """<iframe src="report.html" width="390" height="844"></iframe>
<script>addEventListener("message", event => document.body.textContent = event.data)</script>"""
PROBE = """<script>addEventListener("load", () => parent.postMessage(
  document.documentElement.scrollWidth - document.documentElement.clientWidth + " " + (
    [...document.images].every(one => one.complete && one.naturalWidth > 0 && Math.abs(one.clientWidth - one.naturalWidth) < 2) &&
    [...document.querySelectorAll(".narrow .picture")].every(one => one.scrollWidth <= one.clientWidth)), "*"))</script>"""


@pytest.mark.long
@pytest.mark.skipif(not CHROMIUM, reason="needs chromium")
def test_the_report_on_a_narrow_screen(smoke: Path, tmp_path: Path) -> None:
    """In a frame of 390 pixels, without scroll bars as on phones, with a script that reads what is beyond its width. Detected mistakes: a
    picture or a table is wider than the screen; a picture has another scale; a narrow one does not fit."""
    page = (smoke / "figures/smoke/report.html").read_text()
    allowed = re.sub(r"<meta http-equiv=.Content-Security-Policy.*?>", "", page)
    found = []
    wide = allowed.replace("<body>", '<body><div style="width: 500px">wide</div>')
    scaled = allowed.replace("</style>", ".wide img { width: 100%; }</style>")
    for text in (allowed, wide, scaled):
        (tmp_path / "report.html").write_text(text + PROBE)
        (tmp_path / "frame.html").write_text(FRAME)
        command = [
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--hide-scrollbars",
            "--virtual-time-budget=60000",
            "--dump-dom",
        ]
        found.append(
            subprocess.check_output([*command, tmp_path / "frame.html"], text=True, stderr=subprocess.DEVNULL)
        )
    assert ">0 true<" in found[0]
    assert ">0 true<" not in found[1]
    assert ">0 true<" not in found[2]


def test_the_gallery_has_every_panel_and_claim(gallery: Path) -> None:
    names = {path.name for path in gallery.iterdir()}
    assert names == {"README.md", "numbers.csv", *(f"{panel}.png" for panel in PLAN)}
    text = (gallery / "README.md").read_text()
    assert str(ROOT) not in text
    ids, links = ids_and_links(text)
    assert ids >= IDS
    for link in [*links, *re.findall(r'<img [^>]*src="([^"]*)"', text)]:
        assert link.startswith("https://doi.org/") or link in names or link.strip("#") in ids, link
    for panel in PLAN:
        small, original = gallery / f"{panel}.png", ROOT / f"figures/smoke/{panel}.png"
        assert read_identity_line(small.read_bytes()) == read_identity_line(original.read_bytes())
        with Image.open(small, formats=["PNG"]) as picture, Image.open(original, formats=["PNG"]) as large:
            assert picture.width == min(1440, large.width)


def test_no_quality_contradicts_another(smoke: Path, gallery: Path) -> None:
    """The same row is not reproduced at one quality and contradicted at another, among the release and the
    qualities made here."""
    verdicts = defaultdict(dict)
    for quality, folder in (("release", ROOT / "docs/gallery"), ("smoke", gallery)):
        with (folder / "numbers.csv").open(newline="") as file:
            for line in csv.DictReader(file):
                verdicts[line["claim"], line["kind"]][quality] = line["claim_verdict"]
    for quality in ("standard", "paper"):
        parents = [smoke / path for path in Plan(quality)["verdicts"].parents]
        if all(path.exists() for path in parents):
            for judgement in judge_all(Results(map(load, parents))):
                key = judgement.row["numbers"], judgement.row["kind"]
                verdicts[key][quality] = judgement.verdict.outcome.value
    assert any("smoke" in of_row for of_row in verdicts.values())
    opposite = {Outcome.REPRODUCED.value, Outcome.CONTRADICTED.value}
    assert [row for row, of_row in verdicts.items() if opposite <= {*of_row.values()}] == []
