"""What a product was made from, whether it can be made again, and what is known of every panel."""

import json
import re
import shutil
from pathlib import Path

import pytest

from tests.workflow.conftest import Clone, append, replace
from workflow.lib.parents import file_hash
from workflow.lib.plan import load_plan

FIGURE = "figures/smoke/fig03"


@pytest.mark.parametrize("kind", ["pdf", "png", "svg", "csv"])
def test_copy_elsewhere_tells_the_whole_chain(clean: Clone, tmp_path: Path, kind: str) -> None:
    copied = shutil.copyfile(clean.folder / f"{FIGURE}.{kind}", tmp_path / f"a copy.{kind}")
    told = clean.make("provenance", f"FILE={copied}").stdout
    identity = json.loads((clean.folder / "build/id/boltzmann.json").read_text())
    data = clean.folder / "data/smoke/fig03/paper.h5"
    wanted = [file_hash(copied), identity["build_id"], identity["source_hash"], file_hash(data)]
    wanted += [file_hash(clean.folder / path) for path in ("requirements.lock", "workflow/figures/fig03.py")]
    wanted += [file_hash(clean.folder / f"cpp/{path}") for path in identity["sources"]]
    assert all(digest[:16] in told for digest in wanted)
    for word in ("panel fig03 at quality smoke", "seed 0", "numpy==", identity["compiler"], "parameters"):
        assert word in told
    assert "not found" not in told


def test_run_tells_its_chain(clean: Clone) -> None:
    told = clean.make("provenance", "FILE=data/smoke/fig05/dense_sigma=-0.25.h5").stdout
    assert re.search(r"seed \d+, streams Philox", told)
    assert "program persistence" in told
    assert "cpp/model/collision.hpp" in told


def test_parents_that_have_changed_are_found_in_history(kept: Clone) -> None:
    for path in ("workflow/figures/fig03.py", "cpp/numerics/gmres.cpp", "requirements.lock"):
        append(path, "\n")(kept)
    replace("workflow/config/paper.yaml", "fig03:", "fig03x:")(kept)
    told = kept.make("provenance", f"FILE={FIGURE}.pdf").stdout
    assert told.count("as in commit") == 4
    assert "not found" not in told


@pytest.mark.parametrize(("file", "words"), [("README.md", "names no parents"), ("none.pdf", "No such file")])
def test_files_without_parents_are_refused(clean: Clone, file: str, words: str) -> None:
    told = clean.make("provenance", f"FILE={file}")
    assert told.returncode != 0
    assert words in told.stdout
    assert "Traceback" not in told.stdout


def test_products_can_be_made_again_to_the_last_byte(kept: Clone) -> None:
    for panel in ("fig03", "fig07"):
        verified = kept.make("verify", "QUALITY=smoke", f"PANEL={panel}", "SAMPLE=1")
        assert verified.returncode == 0, verified.stdout
        jobs = len(load_plan("smoke")[panel].runs) + 1
        assert verified.stdout.count("the same bytes") == jobs
    record = json.loads((kept.folder / "data/smoke/verification.json").read_text())
    assert record["fig07/all"]["same"] is True


def test_what_cannot_be_made_again_is_said(kept: Clone) -> None:
    append("figures/smoke/fig03.csv", "1,2\n")(kept)
    verified = kept.make("verify", "QUALITY=smoke", "PANEL=fig03", "SAMPLE=1")
    assert verified.returncode != 0
    assert "fig03: other bytes in figures/smoke/fig03.csv" in verified.stdout


def test_status_says_what_is_stale_and_why(kept: Clone) -> None:
    def states() -> dict[str, str]:
        told = kept.make("status", "QUALITY=smoke").stdout
        rows = [[cell.strip() for cell in line.split("│")[1:-1]] for line in told.splitlines() if "│" in line]
        return {row[0]: row[1] for row in rows if row[0]}

    assert states().keys() >= load_plan("smoke").keys()
    assert set(states().values()) == {"fresh"}
    append("workflow/figures/fig06.py", "\n")(kept)
    replace(
        "workflow/config/quality/smoke.yaml", "fig07: {all: {replicas: 4}}", "fig07: {all: {replicas: 5}}"
    )(kept)
    stale = {panel: state for panel, state in states().items() if state != "fresh"}
    assert stale.keys() == {"fig06", "fig07"}
    assert stale["fig06"] == "workflow/figures/fig06.py changed"
    assert stale["fig07"] == "parameters changed: --replicas from 4 to 5"
