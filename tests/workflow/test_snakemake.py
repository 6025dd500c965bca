"""A bare snakemake gives the products of make, and its options work as documented."""

from tests.workflow.conftest import Clone, delete, delete_result
from workflow.plan import load_plan

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
    command = (".venv/bin/snakemake", "--config", "quality=smoke", "panel=fig03", "--", "panel")
    kept.run(*command, **settings)
    after = kept.products()
    assert {path for path in before if before[path] != after[path]} <= {
        kept.record("fig03")
    }  # its record contains the commit


def test_a_file_is_a_target(kept: Clone) -> None:
    result, record = kept.result("fig03/paper"), kept.record("fig03")
    delete_result("fig03/paper")(kept)
    assert kept.stale(result) == {"fig03/paper"}
    delete("figures/smoke/fig03.png")(kept)  # a record without its files does not count
    assert kept.stale(record) == {"fig03/paper", "fig03"}
    assert "MissingRuleException" in kept.snakemake(record.replace("smoke", "standard"), status=1)


def test_the_summary_has_every_result_and_record(clean: Clone) -> None:
    rows = [line.split("\t") for line in clean.snakemake("--summary", "figures").splitlines()]
    states = {row[0]: row[5] for row in rows if len(row) > 5 and row[0] != "output_file"}
    assert states.keys() == {path for path in clean.products() if path.endswith((".h5", ".json"))}
    assert all(state.startswith("no update") for state in states.values())


def test_lint_and_unlock(clean: Clone) -> None:
    """The environment of all rules is that of uv.lock, not one of conda."""
    lints = [line for line in clean.snakemake("--lint", status=1).splitlines() if line.startswith("    * ")]
    assert {*lints} == {"    * Specify a conda environment or container for each rule.:"}
    clean.snakemake("--unlock")
