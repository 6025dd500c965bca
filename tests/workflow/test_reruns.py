"""What runs again after a change: exactly what does not follow from it, and nothing after what changes nothing."""

import shutil
from collections.abc import Callable

import pytest

from tests.workflow.conftest import Clone, Edit, append, copy, delete, files_below, replace, side_by_side
from workflow.lib.plan import Panel, data_path, drawings_of, load_plan, with_used
from workflow.provenance.sources import sources_of

PLAN = load_plan("smoke")
Jobs = set[str]


def drawings(shows: Callable[[Panel], bool]) -> Jobs:
    return {name for name in PLAN if any(shows(panel) for panel in with_used(PLAN, name))}


def runs(asked: Callable[[str, str], bool]) -> Jobs:
    """Runs of which the panel's name and the program satisfy something."""
    return {
        f"{name}/{run.name}" for name, panel in PLAN.items() for run in panel.runs if asked(name, run.program)
    }


def of_panel(name: str) -> Jobs:
    return runs(lambda panel, _: panel == name) | drawings(lambda panel: panel.name == name)


def of_program(program: str) -> Jobs:
    shows = drawings(lambda panel: any(run.program == program for run in panel.runs))
    return runs(lambda _, used: used == program) | shows


def importing(module: str) -> Jobs:
    return {
        name for name, panel in PLAN.items() if module in sources_of(f"workflow/figures/{panel.script}.py")
    }


FIG07 = "decades: 6\n        fit-decades: 1\n"


def stamps(clone: Clone) -> dict[str, set[int]]:
    """The files that are each job's products."""
    files = {
        f"{name}/{run.name}": [data_path("smoke", name, run.name)] for name in PLAN for run in PLAN[name].runs
    }
    files |= {name: drawings_of("smoke", name) for name in PLAN}
    present = {job: [clone.folder / path for path in paths] for job, paths in files.items()}
    return {job: {path.stat().st_ino for path in paths if path.exists()} for job, paths in present.items()}


def remade(clone: Clone) -> Jobs:
    """Jobs whose products are other files after `make figures` than before."""
    before = stamps(clone)
    made = clone.make("figures", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    return {job for job, inodes in stamps(clone).items() if inodes != before[job]}


def touch(clone: Clone) -> None:
    for place in ("data", "figures", "workflow", "requirements.lock"):
        for file in files_below(clone.folder / place):
            file.touch()


def forget(clone: Clone) -> None:
    shutil.rmtree(clone.folder / ".snakemake")


CHANGES: dict[str, tuple[Edit, Jobs]] = {
    "C++ file of one program": (
        append("cpp/statistics/collapse.hpp", "// more\n"),
        of_program("energy_pulse") | of_program("correlation"),
    ),
    "script": (append("workflow/figures/fig06.py", "# more\n"), {"fig06"}),
    "module of many panels": (append("workflow/lib/fit.py", "# more\n"), importing("workflow/lib/fit.py")),
    "module of some panels": (
        append("workflow/lib/growth.py", "# more\n"),
        importing("workflow/lib/growth.py"),
    ),
    "parameter": (replace("workflow/config/paper.yaml", FIG07, FIG07.replace("6", "5")), of_panel("fig07")),
    "effort": (
        replace(
            "workflow/config/quality/smoke.yaml", "fig07: {all: {replicas: 4}}", "fig07: {all: {replicas: 5}}"
        ),
        of_panel("fig07"),
    ),
    "lock of Python packages": (append("requirements.lock", "# more\n"), set(PLAN)),
    "comment in a rule": (append("workflow/rules/draw.smk", "# more\n"), set()),
    "comment in the configuration": (append("workflow/config/paper.yaml", "# more\n"), set()),
    "commit": (Clone.commit, set()),
    "time stamps": (touch, set()),
    "no memory of Snakemake": (forget, set()),
    "table edited": (append("figures/smoke/fig03.csv", "1,2,3\n"), {"fig03"}),
    "picture replaced": (copy("figures/smoke/fig06.png", "figures/smoke/fig05.png"), {"fig05"}),
    "data edited": (append("data/smoke/fig03/paper.h5", "more"), {"fig03/paper", "fig03"}),
    "data deleted": (delete("data/smoke/fig03/paper.h5"), {"fig03/paper", "fig03"}),
    "figure deleted": (delete("figures/smoke/fig05.pdf"), {"fig05"}),
}

MANY = ("module of many panels", "lock of Python packages")  # of which each is drawn again


AT_ONCE = side_by_side({name: jobs for name, (_, jobs) in CHANGES.items() if name not in MANY})


@pytest.mark.parametrize(
    "changes", [*AT_ONCE, *(pytest.param([one], marks=pytest.mark.long) for one in CHANGES)], ids=", ".join
)
def test_exactly_what_is_affected_runs_again(kept: Clone, changes: list[str]) -> None:
    expected = set()
    for change in changes:
        edit, jobs = CHANGES[change]
        edit(kept)
        expected |= jobs
    assert remade(kept) == expected
    assert all(stamps(kept).values())  # nothing is missing
