"""A bare snakemake gives the products of make, and its options work as documented."""

from tests.workflow.conftest import Clone, append
from workflow.lib.plan import load_plan

PLAN = load_plan("smoke")


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


def test_the_report_shows_every_figure(clean: Clone) -> None:
    clean.snakemake("--report", "build/report.html", "figures")
    report = (clean.folder / "build/report.html").read_text()
    assert all(f"figures/smoke/{panel}.png" in report for panel in PLAN)


def test_lint_and_unlock(clean: Clone) -> None:
    """The environment of all rules is that of uv.lock, not one of conda."""
    lints = [line for line in clean.snakemake("--lint", status=1).splitlines() if line.startswith("    * ")]
    assert {*lints} == {"    * Specify a conda environment or container for each rule.:"}
    clean.snakemake("--unlock")
