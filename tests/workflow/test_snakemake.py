"""Snakemake by itself does what make does, and its own reports work."""

import html
import json
import os
import shutil
import subprocess
from collections.abc import Callable

import pytest

from tests.workflow.conftest import Clone, append, copy, delete, replace
from tests.workflow.running import processes, running, soon
from tests.workflow.test_reruns import stamps
from workflow.lib.locks import ANOTHER
from workflow.lib.parents import caption_of
from workflow.lib.plan import load_plan

PLAN = load_plan("smoke")


BY_HAND = (".venv/bin/python", "-m", "snakemake", "--config", "quality=smoke")


def snakemake(clone: Clone, *arguments: str, status: int = 0) -> str:
    """What it prints; run by hand, with a PATH and nothing else."""
    command = [*BY_HAND, *arguments]
    environment = {"PATH": os.defpath, "HOME": os.environ.get("HOME", "/"), "OMP_NUM_THREADS": "2"}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    done = subprocess.run(command, cwd=clone.folder, env=environment, timeout=900, check=False, **pipes)
    assert done.returncode == status, done.stdout
    return done.stdout


def test_what_is_fresh_is_not_made_again(clean: Clone) -> None:
    places = stamps(clean)
    assert "Nothing to be done" in snakemake(clean, "--", "figures")
    assert stamps(clean) == places


def test_a_dry_run_names_what_is_stale_and_moves_nothing(kept: Clone) -> None:
    append("workflow/figures/fig06.py", "# more\n")(kept)
    append("data/smoke/fig03/paper.h5", "more")(kept)
    replace("workflow/config/quality/smoke.yaml", "dense: {replicas: 2}", "dense: {replicas: 0}")(kept)
    before, places = kept.products(), stamps(kept)
    shutil.rmtree(kept.folder / "build/replaced", ignore_errors=True)
    for arguments in (("--dry-run",), ("--summary",), ("--list-changes", "code")):
        told = snakemake(kept, *arguments, "--", "figures")
        assert "fig06 is stale: workflow/figures/fig06.py changed" in told
        assert "fig03/paper is stale: data/smoke/fig03/paper.h5 is not what the job wrote" in told
        assert "fig03 is stale: data/smoke/fig03/paper.h5 has to be made again" in told
        assert "fig05/dense_sigma=-0.25 is not asked for any more\n" in told
        assert (kept.products(), stamps(kept)) == (before, places)
    assert not (kept.folder / "build/replaced").exists()


def test_a_target_concerns_its_own_jobs_only(kept: Clone) -> None:
    append("workflow/lib/style.py", "# more\n")(kept)
    places = stamps(kept)
    snakemake(kept, "--", "figures/smoke/fig03.pdf")
    assert {job for job, inodes in stamps(kept).items() if inodes != places[job]} == {"fig03"}
    assert (kept.folder / "build/replaced/figures/smoke/fig03.csv").is_file()


def test_it_does_not_run_beside_make(kept: Clone) -> None:
    products = kept.products()
    append("data/smoke/fig03/paper.h5", "more")(kept)
    with running(kept, "panel", "PANEL=fig05", "QUALITY=smoke", "FRESH=yes", "JOBS=1") as making:
        soon(lambda: processes(making.pid, "build/bin/persistence"))
        assert ANOTHER in snakemake(kept, "--", "figures/smoke/fig03.pdf", status=1)
    with running(kept, "panel=fig05", "fresh=yes", "--cores", "1", "--", "panel", tool=BY_HAND) as making:
        soon(lambda: processes(making.pid, "build/bin/persistence"))
        made = kept.make("panel", "PANEL=fig03", "QUALITY=smoke")
    assert made.returncode != 0
    assert ANOTHER in made.stdout
    made = kept.make("figures", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    assert kept.products() == products


def test_another_quality_is_no_target(clean: Clone) -> None:
    with pytest.raises(AssertionError, match="No rule to produce figures/standard/fig03"):
        snakemake(clean, "--", "figures/standard/fig03.pdf")


def test_the_report_shows_every_figure(clean: Clone) -> None:
    snakemake(clean, "--report", "build/report.html", "--", "figures")
    report = (clean.folder / "build/report.html").read_text()
    assert all(f"figures/smoke/{panel}.png" in report for panel in PLAN)
    captions = [caption_of(clean.folder / f"figures/smoke/{panel}.csv") for panel in PLAN]
    assert all(json.dumps(caption)[1:-1] in html.unescape(report) for caption in captions)


def test_the_summary_knows_every_file(clean: Clone) -> None:
    told = snakemake(clean, "--summary", "--", "figures")
    rows = {row[0]: row for line in told.splitlines() if len(row := line.split("\t")) == 6}
    assert rows.keys() - {"output_file"} == clean.products().keys()
    said = {path: tuple(row[4:]) for path, row in rows.items() if path != "output_file"}
    assert {update for _, update in said.values()} == {"no update"}
    assert {said[path] for path in said if "/ext10" in path} == {
        ("ok", "no update")
    }  # which no test makes again


@pytest.mark.parametrize(
    ("change", "edit", "listed"),
    [
        ("code", append("workflow/rules/draw.smk", "# more\n"), False),
        ("code", replace("workflow/rules/draw.smk", "--panel", " --panel"), True),
        ("input", append("workflow/figures/fig06.py", "# more\n"), False),
        ("input", append("workflow/figures/fig06.py", "import workflow.lib.costs\n"), True),
        ("params", append("workflow/config/paper.yaml", "# more\n"), False),
        (
            "params",
            replace(
                "workflow/config/quality/smoke.yaml",
                "fig06: {all: {replicas: 8}}",
                "fig06: {all: {replicas: 9}}",
            ),
            True,
        ),
    ],
)
def test_changes_are_listed(kept: Clone, change: str, edit: Callable, listed: bool) -> None:
    """Of the parameters, Snakemake 9 lists the last output of every job, changed or not; the first is to be trusted."""
    edit(kept)
    told = snakemake(kept, "--list-changes", change, "--", "figures").splitlines()
    assert ("figures/smoke/fig06.pdf" in told) == listed


def test_stale_products_are_made_again(kept: Clone) -> None:
    before = kept.products()
    copy("figures/smoke/fig06.png", "figures/smoke/fig05.png")(kept)
    append("workflow/figures/fig06.py", "# more\n")(kept)
    append("data/smoke/fig03/paper.h5", "more")(kept)
    delete("figures/smoke/fig08.pdf")(kept)
    places = stamps(kept)
    snakemake(kept, "--", "figures")
    remade = {job for job, inodes in stamps(kept).items() if inodes != places[job]}
    assert remade == {"fig05", "fig06", "fig03/paper", "fig03", "fig08"}
    after = kept.products()
    other = {path for path in before.keys() | after.keys() if before.get(path) != after.get(path)}
    assert other == {
        f"figures/smoke/fig06.{suffix}" for suffix in ("csv", "pdf", "png", "svg")
    }  # name their script
