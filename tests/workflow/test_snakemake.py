"""A bare snakemake does what make does, and its options work as its manual says."""

import pytest

from tests.workflow.conftest import Clone, append, replace
from workflow.lib.plan import load_plan

PLAN = load_plan("smoke")


def test_what_is_fresh_is_not_made_again(clean: Clone) -> None:
    assert "Nothing to be done" in clean.snakemake("figures")


def test_it_gives_the_bytes_of_make_in_any_environment(kept: Clone) -> None:
    before = kept.products()
    paths = [path for path in before if "fig03/" in path or "fig03." in path]
    for path in paths:
        (kept.folder / path).unlink()
    settings = {
        "OMP_NUM_THREADS": "2",
        "PYTHONHASHSEED": "7",
        "MATPLOTLIBRC": "/nonexistent",
        "TZ": "Asia/Kathmandu",
    }
    kept.run(".venv/bin/snakemake", "--config", "quality=smoke", "--", "figures/smoke/fig03.pdf", **settings)
    after = kept.products()
    assert {path for path in before if before[path] != after[path]} <= {"figures/smoke/fig03.json"}


def test_a_dry_run_names_what_would_run_and_changes_nothing(kept: Clone) -> None:
    append("workflow/figures/fig06.py", "# more\n")(kept)
    before = kept.products()
    assert kept.stale() == {"fig06"}
    assert kept.products() == before


def test_a_file_is_a_target(kept: Clone) -> None:
    append("workflow/lib/style.py", "# more\n")(kept)
    assert kept.stale("figures/smoke/fig03.pdf") == {"fig03"}
    assert "No rule to produce figures/standard/fig03" in kept.snakemake(
        "figures/standard/fig03.pdf", status=1
    )


def test_the_summary_has_every_file(clean: Clone) -> None:
    rows = [line.split("\t") for line in clean.snakemake("--summary", "figures").splitlines()]
    states = {row[0]: row[5] for row in rows if len(row) > 5 and row[0] != "output_file"}
    assert states.keys() == clean.products().keys()
    assert all(state.startswith("no update") for state in states.values())


@pytest.mark.parametrize(
    ("change", "old", "new", "path"),
    [
        (
            "params",
            "fig06: {all: {replicas: 8}}",
            "fig06: {all: {replicas: 9}}",
            "workflow/config/quality/smoke.yaml",
        ),
        ("code", "{params.command} 2>", "{params.command}  2>", "workflow/rules/draw.smk"),
    ],
)
def test_changes_are_listed(kept: Clone, change: str, old: str, new: str, path: str) -> None:
    assert "figures/smoke/fig06.pdf" not in kept.snakemake("--list-changes", change, "figures").split()
    replace(path, old, new)(kept)
    assert "figures/smoke/fig06.pdf" in kept.snakemake("--list-changes", change, "figures").split()


def test_the_report_shows_every_figure(clean: Clone) -> None:
    clean.snakemake("--report", "build/report.html", "figures")
    report = (clean.folder / "build/report.html").read_text()
    assert all(f"figures/smoke/{panel}.png" in report for panel in PLAN)


def test_lint_and_unlock(clean: Clone) -> None:
    """The environment of all rules is that of uv.lock, not one of conda."""
    lints = [line for line in clean.snakemake("--lint", status=1).splitlines() if line.startswith("    * ")]
    assert {*lints} == {"    * Specify a conda environment or container for each rule.:"}
    clean.snakemake("--unlock")
