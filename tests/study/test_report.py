"""Report and gallery: complete, reproducible, self-contained."""

import base64
import csv
import json
import re
import shutil
import subprocess
from collections import defaultdict
from pathlib import Path

import pytest

from workflow.lib.identity import ROOT
from workflow.lib.load import load
from workflow.pipeline.plan import Plan
from workflow.study.judge import judge_all, read_claims
from workflow.study.report import write
from workflow.study.results import Results
from workflow.study.verdict import Outcome

PLAN = {panel.name: panel for panel in Plan("smoke").reported}
IDS = {
    *(row["number"].lower() for row in read_claims(ROOT)),
    *(f"{row['number'].lower()}-as-meant" for row in read_claims(ROOT) if row["kind"] == "as meant"),
    *PLAN,
}


def ids_and_links(text: str) -> tuple[set[str], list[str]]:
    """Ids, which are unique, and targets of links in a page, HTML or Markdown."""
    ids = re.findall(r'\bid="([^"]*)"', text) + [one.lower() for one in re.findall(r"^## (\w+)$", text, re.M)]
    assert len(ids) == len({*ids})
    return {*ids}, re.findall(r'<a [^>]*href="([^"]*)"', text) + re.findall(r"\]\(([^)]*)\)", text)


@pytest.fixture(scope="module")
def gallery(smoke: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The gallery of this project at smoke quality, in a folder with its products, over a former one."""
    folder = tmp_path_factory.mktemp("copy")
    for name in ("build", "data", "docs/gallery", "workflow/study"):
        (folder / name).mkdir(parents=True)
    (folder / "docs/gallery/removed_panel.png").touch()
    shutil.copy(smoke / "workflow/study/claims.csv", folder / "workflow/study")
    (folder / "data/smoke").symlink_to(smoke / "data/smoke")
    (folder / "figures").symlink_to(smoke / "figures")
    write("smoke", folder, gallery=True)
    return folder / "docs/gallery"


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
HEADLESS = [CHROMIUM, "--headless", "--no-sandbox", "--hide-scrollbars", "--virtual-time-budget=60000"]
FRAME = """<iframe src="report.html" width="{width}" height="844"></iframe>
<script>addEventListener("message", event => document.body.textContent = event.data)</script>"""
PROBE = """<script>addEventListener("load", () => {
const page = document.documentElement, shown = [...document.images].filter(one => one.offsetParent);
const figures = shown.map(one => [one.closest("figure").id, one.clientWidth,
  one.parentElement.scrollWidth - one.parentElement.clientWidth]);
parent.postMessage(JSON.stringify([page.scrollWidth - page.clientWidth, figures]), "*") })</script>"""


def laid_out(page: str, folder: Path, width: int) -> tuple[int, dict[str, list[float]]]:
    """A page in a frame, without scroll bars as on phones, read by a script: pixels beyond its width; for
    every visible picture its width and how far it scrolls."""
    allowed = re.sub(r"<meta http-equiv=.Content-Security-Policy.*?>", "", page)
    (folder / "report.html").write_text(allowed + PROBE)
    (folder / "frame.html").write_text(FRAME.format(width=width))
    command = [*HEADLESS, f"--window-size={width + 100},1000", "--dump-dom", folder / "frame.html"]
    dom = subprocess.check_output(command, text=True, stderr=subprocess.DEVNULL)
    beyond, figures = json.loads(re.search(r"\[.*\]", dom)[0])
    return beyond, {name: numbers for name, *numbers in figures}


@pytest.mark.long
@pytest.mark.skipif(not CHROMIUM, reason="needs chromium")
@pytest.mark.parametrize(("width", "least"), [(390, 300), (1400, 480)])
def test_the_report_fits_a_screen(smoke: Path, tmp_path: Path, width: int, least: int) -> None:
    """Detected mistakes: a picture or a table is wider than the screen, or scrolls; a picture is too small to
    read; details are open."""
    page = (smoke / "figures/smoke/report.html").read_text()
    beyond, figures = laid_out(page, tmp_path, width)
    assert beyond == 0
    assert {*figures} == {*PLAN}
    assert {scrolls for _, scrolls in figures.values()} == {0}
    assert min(shown for shown, _ in figures.values()) >= least
    wide = page.replace("<body>", '<body><div style="width: 1500px">wide</div>')
    assert laid_out(wide, tmp_path, width)[0] > 0


def test_the_gallery_has_every_panel_and_claim(gallery: Path) -> None:
    names = {path.name for path in gallery.iterdir()}
    assert names == {"README.md", "numbers.csv", *(f"{panel}.png" for panel in PLAN)}
    text = (gallery / "README.md").read_text()
    assert str(ROOT) not in text
    ids, links = ids_and_links(text)
    assert ids >= IDS
    assert ids >= {"claims", "figures", "symbols"}
    for link in [*links, *re.findall(r'<img [^>]*src="([^"]*)"', text)]:
        inside = link.strip("#") in ids if link.startswith("#") else (gallery / link).exists()
        assert inside or link.startswith("https://doi.org/"), link
    for panel in PLAN:
        original = ROOT / f"figures/smoke/{panel}.png"
        assert (gallery / f"{panel}.png").read_bytes() == original.read_bytes()


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
                key = judgement.row["number"], judgement.row["kind"]
                verdicts[key][quality] = judgement.verdict.outcome.value
    assert any("smoke" in of_row for of_row in verdicts.values())
    opposite = {Outcome.REPRODUCED.value, Outcome.CONTRADICTED.value}
    assert [row for row, of_row in verdicts.items() if opposite <= {*of_row.values()}] == []
