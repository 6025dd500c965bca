"""Reruns after a change: exactly the affected jobs, by the names of products, in any copy of the folder."""

import json
import os
import shutil
from collections.abc import Callable

import pytest
from workflow.lib.closure import sources_of

from tests.workflow.conftest import Clone, Edit, append, delete, delete_result, files_below, replace
from workflow.plan import Panel, load_plan, with_used

PLAN = load_plan("smoke")
Jobs = set[str]


def drawings(shows: Callable[[Panel], bool]) -> Jobs:
    return {name for name in PLAN if any(shows(panel) for panel in with_used(PLAN, name))}


def of_panel(name: str) -> Jobs:
    return {f"{name}/{run.name}" for run in PLAN[name].runs} | drawings(lambda panel: panel.name == name)


def of_program(program: str) -> Jobs:
    runs = {
        f"{name}/{run.name}" for name, panel in PLAN.items() for run in panel.runs if run.program == program
    }
    return runs | drawings(lambda panel: any(run.program == program for run in panel.runs))


def importing(module: str) -> Jobs:
    return {
        name for name, panel in PLAN.items() if module in sources_of(f"workflow/figures/{panel.script}.py")
    }


def another_build(program: str) -> Edit:
    """Changes the build id but not the sources, as another compiler does."""

    def edit(clone: Clone) -> None:
        path = clone.folder / f"build/id/{program}.json"
        identity = json.loads(path.read_text())
        path.write_text(json.dumps(identity | {"build_id": "0" * 64, "compiler": "another"}))

    return edit


def touch(clone: Clone) -> None:
    for place in ("data", "figures", "workflow", "uv.lock"):
        for file in files_below(clone.folder / place):
            file.touch()


def forget(clone: Clone) -> None:
    shutil.rmtree(clone.folder / ".snakemake", ignore_errors=True)


def other_times(clone: Clone) -> None:
    """Sets the modification times in the order of a copy, as rsync without --times does."""
    for number, file in enumerate(
        sorted(files_below(clone.folder / "data") + files_below(clone.folder / "figures"))
    ):
        os.utime(file, (1e9 + 97 * number % 1000, 1e9 + 97 * number % 1000))


def results_of_others(clone: Clone) -> None:
    """Results of another seed, of another build and of former options beside the planned ones."""
    for number, path in enumerate(sorted((clone.folder / "data/smoke").glob("*/*.h5"))):
        shutil.copy(
            path, path.with_name(f"{path.name.rpartition('.')[0].rpartition('.')[0]}.{number:012x}.h5")
        )


FIG07 = "decades: 6\n        fit-decades: 1\n"
EFFORT = "fig06: {all: {replicas: 8}}"
CHANGES: dict[str, tuple[Edit, Jobs]] = {
    "commit": (Clone.commit, set()),
    "another build of a program": (another_build("energy_pulse"), of_program("energy_pulse")),
    "script": (append("workflow/figures/ext01.py", "# more\n"), {"ext01"}),
    "module of many panels": (append("workflow/lib/fit.py", "# more\n"), importing("workflow/lib/fit.py")),
    "module of some panels": (
        append("workflow/lib/growth.py", "# more\n"),
        importing("workflow/lib/growth.py"),
    ),
    "parameter": (replace("workflow/config/paper.yaml", FIG07, FIG07.replace("6", "5")), of_panel("fig07")),
    "effort": (
        replace("workflow/config/quality/smoke.yaml", EFFORT, EFFORT.replace("8", "9")),
        of_panel("fig06"),
    ),
    "lock of Python packages": (append("uv.lock", "# more\n"), set(PLAN)),
    "comment in a rule": (append("workflow/rules/draw.smk", "# more\n"), set()),
    "comment in the configuration": (append("workflow/config/paper.yaml", "# more\n"), set()),
    "time stamps": (touch, set()),
    "other time stamps": (other_times, set()),
    "no memory of Snakemake": (forget, set()),
    "results of others": (results_of_others, set()),
    "result deleted": (delete_result("fig03/paper"), {"fig03/paper", "fig03"}),
    "figure deleted": (delete("figures/smoke/fig05.pdf"), {"fig05"}),
    "table edited": (append("figures/smoke/fig02_lower.csv", "1,2,3\n"), {"fig02_lower"}),
}


# Changes that affect every panel, or that multiply the results. The others affect different jobs.
APART = ("module of many panels", "lock of Python packages", "results of others")


@pytest.mark.parametrize("changes", [CHANGES.keys() - APART, *({change} for change in APART)])
def test_exactly_what_is_affected_reruns(kept: Clone, changes: set[str]) -> None:
    affected = []
    for change in (change for change in CHANGES if change in changes):
        edit, jobs = CHANGES[change]
        edit(kept)
        affected += jobs
    assert len({*affected}) == len(affected)
    assert kept.stale() == {*affected}


def test_what_is_stale_is_made_again_and_nothing_else(kept: Clone) -> None:
    before = kept.products()
    for change in ("script", "result deleted", "figure deleted"):
        CHANGES[change][0](kept)
    inodes = {path: (kept.folder / path).stat().st_ino for path in before if (kept.folder / path).exists()}
    profile, *lines = kept.snakemake("figures").splitlines()
    assert profile.startswith("Using workflow specific profile profiles/default")
    rendered = {line.partition(" from ")[0] for line in lines if not line.endswith("; extensions follow")}
    assert rendered == {f"{panel}: rendered" for panel in ("fig03", "fig05", "ext01")}
    assert kept.stale() == set()
    after = kept.products()
    remade = {path for path in after if inodes.get(path) != (kept.folder / path).stat().st_ino}
    figures = {
        f"figures/smoke/{panel}.{kind}"
        for panel in ("fig03", "fig05", "ext01")
        for kind in ("pdf", "png", "svg", "csv")
    }
    assert {path for path in remade if not path.endswith(".json")} == figures | {kept.result("fig03/paper")}
    assert {path for path in after if before.get(path) != after[path] and path.endswith((".pdf", ".h5"))} == {
        "figures/smoke/ext01.pdf"
    }


def test_going_back_costs_nothing_and_prune_removes_the_rest(kept: Clone) -> None:
    former = kept.products()
    edit, _ = CHANGES["effort"]
    edit(kept)
    kept.snakemake(kept.stale_path("fig06"))
    assert len([*(kept.folder / "data/smoke/fig06").glob("*.h5")]) == 4
    replace("workflow/config/quality/smoke.yaml", EFFORT.replace("8", "9"), EFFORT)(kept)
    assert kept.stale() == {"fig06"}  # only the figure is rendered again, from the former results
    printed = kept.module("provenance.audit", "--quality", "smoke", "--panel", "fig06", status=1)
    assert printed.count("obsolete: data/smoke/fig06/all_sigma=0") == 2
    kept.snakemake("figures")
    prune = ("provenance.obsolete", "--quality", "smoke")
    assert "To remove: 2 results" in kept.module(*prune, "--dry")
    assert "Removed: 0 results" in kept.module(*prune, "--panel", "fig05")
    printed = kept.module(*prune, "--panel", "fig06")
    assert printed.count("data/smoke/fig06/all_sigma=0") == 4
    assert "and 2 other files" in printed
    after = kept.products()
    assert {path for path in former if former[path] != after.get(path)} <= {kept.record("fig06")}


def test_programs_that_are_older_than_their_sources_are_refused(kept: Clone) -> None:
    append("cpp/statistics/peak.hpp", "// more\n")(kept)
    printed = kept.snakemake("figures", status=1)
    assert printed.strip().splitlines()[-1].endswith("is not built from the present sources: run make build")
