"""The two front doors, from outside: no environment in front, nothing done twice, clear refusals."""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from tests.workflow.conftest import ROOT, Clone, clone_into
from workflow.lib.load import load
from workflow.lib.plan import load_plan

NOBODY = 65534  # a user who owns nothing
SIGMA = "data/smoke/fig05/dense_sigma="
HOSTILE = {
    "LC_ALL": "de_DE.UTF-8",
    "TZ": "Asia/Kathmandu",
    "OMP_NUM_THREADS": "7",
    "PYTHONPATH": "/nonexistent",
    "PYTHONHASHSEED": "12345",
    "PYTHONHOME": "/nonexistent",
    "CXXFLAGS": "-Ofast",
    "CFLAGS": "-Ofast",
    "CXX": "false",
    "LDFLAGS": "-nonsense",
    "CMAKE_GENERATOR": "Unix Makefiles",
    "MPLBACKEND": "TkAgg",
    "MATPLOTLIBRC": "/nonexistent",
    "SOURCE_DATE_EPOCH": "1",
    "SNAKEMAKE_PROFILE": "/nonexistent",
    "QUALITY": "deep",
    "PANEL": "none",
    "FRESH": "1",
    "BASH_ENV": "/nonexistent",
    "SHELL": "/bin/false",
    "HOME": "/dev/null",
}


@pytest.mark.parametrize(
    "goal",
    [("panel", "PANEL=fig07"), pytest.param(("figures",), marks=pytest.mark.long)],
    ids=lambda goal: goal[0],
)
def test_hostile_environment_and_path_with_spaces(
    clean: Clone, tmp_path: Path, goal: tuple[str, ...]
) -> None:
    clone = clone_into(tmp_path / "a path with spaces")
    environment = {"PATH": os.defpath, "HOME": os.environ.get("HOME", "/"), **HOSTILE}
    umask = os.umask(0o077)
    try:
        made = clone.make(*goal, "QUALITY=smoke", "JOBS=1", environment=environment)
    finally:
        os.umask(umask)
    assert made.returncode == 0, made.stdout
    products, expected = clone.products(), clean.products()
    assert products.items() <= expected.items()
    panels = load_plan("smoke")
    asked = [panels["fig07"]] if "panel" in goal else panels.values()
    assert len(products) == sum(len(panel.runs) + 4 for panel in asked)
    # Copies of what was made elsewhere, with other time stamps and programs built here, are as good.
    for place in ("data", "figures"):
        shutil.rmtree(clone.folder / place)
        shutil.copytree(clean.folder / place, clone.folder / place, copy_function=shutil.copyfile)
    made = clone.make("figures", "QUALITY=smoke", environment=environment)
    assert "Nothing to be done" in made.stdout


def seconds_of_children() -> float:
    """Computing time, which waiting does not change."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def test_second_time_there_is_nothing_to_do(clean: Clone) -> None:
    """In a few times what the imports alone cost, measured here and now (3 times on an idle machine)."""
    before = {path: path.stat().st_mtime_ns for path in (clean.folder / "data").rglob("*.h5")}
    start = seconds_of_children()
    subprocess.run([sys.executable, "-c", "import snakemake.cli, pandas, matplotlib.pyplot"], check=True)
    imported = seconds_of_children()
    made = clean.make("figures", "QUALITY=smoke")
    assert seconds_of_children() - imported < 6 * (imported - start)
    assert made.returncode == 0
    assert "Nothing to be done" in made.stdout
    assert before == {path: path.stat().st_mtime_ns for path in before}


def test_fresh_panel_is_simulated_anew_with_the_same_bytes(clean: Clone) -> None:
    products = clean.products()
    data = clean.folder / "data/smoke/fig05"
    before = {path: path.stat().st_mtime_ns for path in data.iterdir()}
    made = clean.make("panel", "PANEL=fig05", "QUALITY=smoke", "FRESH=yes")
    assert made.returncode == 0, made.stdout
    assert all(path.stat().st_mtime_ns > stamp for path, stamp in before.items())
    assert clean.products() == products
    assert made.stdout.count(": the same bytes") == len(before)


def test_fresh_panel_resumes_nothing_and_says_what_differs(kept: Clone) -> None:
    """With a leftover of other numbers, and products of other numbers."""
    shutil.copyfile(kept.folder / f"{SIGMA}-0.5.h5", kept.folder / f"{SIGMA}0.5.h5")
    for leftover in partial_of(kept):
        leftover.parent.mkdir(parents=True, exist_ok=True)
        leftover.write_text("what an interrupted run left")
    made = kept.make("panel", "PANEL=fig05", "QUALITY=smoke", "FRESH=yes")
    assert "fig05/dense_sigma=0.5: other bytes, not within errors" in made.stdout
    assert "fig05/dense_sigma=-0.5: the same bytes" in made.stdout
    assert not any(leftover.exists() for leftover in partial_of(kept))


def partial_of(clone: Clone) -> list[Path]:
    """Under names that a run of another build would use; none may stay."""
    folder = clone.folder / "build/partial/smoke/fig05"
    return [
        folder / f"dense_sigma=0.5-{name}"
        for name in ("0123456789abcdef.h5", "0123456789abcdef.h5.checkpoint")
    ]


def test_another_seed_and_number_of_replicas_have_a_folder_of_their_own(kept: Clone) -> None:
    made = kept.make("panel", "PANEL=fig03_inset", "QUALITY=smoke", "SEED=7", "REPLICAS=5", "JOBS=1")
    assert made.returncode == 0, made.stdout
    runs = (kept.folder / "data/smoke_seed=7_replicas=5/fig03_inset").iterdir()
    in_turn = [path.stem for path in sorted(runs, key=lambda path: path.stat().st_mtime_ns)]
    assert {name.split("_")[0] for name in in_turn[:4]} == {"simulation"}  # which takes longest
    run = "fig03_inset/simulation_cells=2.h5"
    own = load(kept.folder / "data/smoke_seed=7_replicas=5" / run).parameters
    standard = load(kept.folder / "data/smoke" / run).parameters
    assert own["replicas"] == 5
    assert own["seed"] != standard["seed"]
    assert {name for name in own if own[name] != standard[name]} == {"replicas", "seed"}
    assert "Compared with data/smoke:" in made.stdout
    assert "within errors" in made.stdout
    assert (kept.folder / "figures/smoke_seed=7_replicas=5/fig03_inset.pdf").is_file()
    audited = kept.make("audit", "QUALITY=smoke", "SEED=7", "REPLICAS=5", "PANEL=fig03_inset")
    assert "Every link holds" in audited.stdout


def test_time_stamps_hide_nothing(kept: Clone) -> None:
    """A source, an executable and the locked packages, each edited under the time stamp that it had or an older one."""
    program, source = kept.folder / "build/bin/persistence", kept.folder / "cpp/observables/persistence.cpp"
    identity, executable = (kept.folder / "build/id/persistence.json").read_bytes(), program.read_bytes()
    source.write_text(source.read_text() + "// edited\n")
    os.utime(source, (0, 0))
    assert kept.make("build").returncode == 0
    assert (kept.folder / "build/id/persistence.json").read_bytes() != identity
    kept.git("checkout", "--quiet", "--", "cpp")
    status = program.stat()
    program.write_bytes(executable[:-1] + b"x")
    os.utime(program, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert kept.make("build").returncode == 0
    assert program.read_bytes() == executable
    assert (kept.folder / "build/id/persistence.json").read_bytes() == identity


def test_files_in_the_project_hide_no_package(kept: Clone) -> None:
    products = kept.products()
    for name in ("pandas.py", "json.py", "workflow/numpy.py", "sitecustomize.py", "usercustomize.py"):
        (kept.folder / name).write_text("raise SystemExit('hidden')\n")
    for kind in ("csv", "pdf", "png", "svg"):
        (kept.folder / f"figures/smoke/fig03.{kind}").unlink()
    made = kept.make("panel", "PANEL=fig03", "QUALITY=smoke")
    for name in ("pandas.py", "json.py", "sitecustomize.py", "usercustomize.py"):
        (kept.folder / name).unlink()
    assert made.returncode == 0, made.stdout
    assert kept.products() == products


def test_a_damaged_lock_is_kept_and_said(kept: Clone) -> None:
    lock = kept.folder / "data/smoke/lock.json"
    lock.write_text(lock.read_text()[:1000])
    made = kept.make("panel", "PANEL=fig03", "QUALITY=smoke")
    assert "data/smoke/lock.json is damaged" in made.stdout
    assert (kept.folder / "build/replaced/data/smoke/lock.json").stat().st_size == 1000


def test_logs_and_costs_carry_the_names_of_the_products(clean: Clone) -> None:
    names = {path.stem for path in (clean.folder / "data/smoke/fig05").iterdir()}
    for place in ("logs", "benchmarks", "costs"):
        assert {path.stem for path in (clean.folder / f"build/{place}/smoke/fig05").iterdir()} == names


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("figures", "QUALITY=best"), ["QUALITY='best'", "smoke, standard, paper, deep"]),
        (("figures", "quality=smoke"), ["did you mean QUALITY"]),
        (("figures", "JOBS=0"), ["JOBS='0'", "from 1 to 999"]),
        (("-e", "figures"), ["make -e is not admitted"]),
        (("-i", "audit"), ["make -i is not admitted"]),
        (("--eval=QUALITY:=smoke", "status"), ["make --eval and MAKEFILES are not admitted"]),
        (("status", "GIVEN=", "QUALITY=$(shell touch x)"), ["'GIVEN' is not an argument"]),
        (("clean", "PANEL=fig03"), ["make clean does not use PANEL"]),
        (("panel", "QUALITY=smoke"), ["PANEL is missing", "make panel PANEL=fig05"]),
        (("panel", "PANEL=fig5", "QUALITY=smoke"), ["PANEL=fig5 is not known; the nearest is fig05"]),
    ],
)
def test_refusals(clean: Clone, arguments: tuple[str, ...], words: list[str]) -> None:
    made = clean.make(*arguments)
    assert made.returncode != 0
    assert "Traceback" not in made.stdout
    for word in words:
        assert word in made.stdout


@pytest.mark.parametrize(
    "text", ["fig03;touch {0};`touch {0}`$(shell touch {0})$$(touch {0})';touch {0};'", "fig03\ntouch {0}"]
)
@pytest.mark.parametrize(
    ("target", "option"),
    [
        ("panel", "PANEL"),
        ("panel", "JOBS"),
        ("figures", "QUALITY"),
        ("audit", "PANEL"),
        ("verify", "SAMPLE"),
        ("provenance", "FILE"),
        ("crate", "PANEL"),
        ("status", "QUALITY"),
        ("provenance", "UNKNOWN"),
        ("provenance", "http_proxy"),
    ],
)
def test_options_are_text(clean: Clone, tmp_path: Path, target: str, option: str, text: str) -> None:
    options = {"QUALITY": "smoke", "PANEL": "fig03", "FILE": "README.md", option: text.format(tmp_path / "x")}
    made = clean.make(target, *(f"{name}={value}" for name, value in options.items()))
    assert not (tmp_path / "x").exists(), made.stdout
    assert made.returncode != 0


@pytest.mark.parametrize("closed", [".", "build"])
def test_who_may_not_write_is_told_in_one_line(closed: str) -> None:
    with tempfile.TemporaryDirectory() as name:  # where others than the owner may look
        folder = Path(name)
        folder.chmod(0o777)
        (folder / "build").mkdir()
        (folder / "workflow/environment").mkdir(parents=True)
        for file in ("Makefile", "workflow/environment/arguments.py"):
            shutil.copyfile(ROOT / file, folder / file)
        (folder / closed).chmod(0o555)
        made = subprocess.run(
            ["/usr/bin/make", "panel", "PANEL=fig05"],
            cwd=folder,
            env={"PATH": os.defpath},
            user=None if os.getuid() else NOBODY,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        looked = [*folder.rglob("*")]
        (folder / closed).chmod(0o755)
    assert made.returncode == 2
    assert made.stdout.count("\n") == 1
    assert f"you may not write in {folder} ({closed}" in made.stdout
    assert "copy the project to a folder of your own; make audit, verify" in made.stdout
    assert len(looked) == 5


@pytest.mark.parametrize("name", ["a{b}", 'a"b', "a#b", "a\\b", "a[b", "a]b", "a$b", "a\nb", "a b:'%=*ä"])
def test_a_folder_whose_name_means_something_to_the_tools_is_refused(tmp_path: Path, name: str) -> None:
    folder = tmp_path / name
    environment = (f"environment/{name}" for name in ("arguments", "launch", "packages"))
    for file in (
        "Makefile",
        *(f"workflow/{module}.py" for module in (*environment, "lib/locks", "lib/places")),
    ):
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / file, folder / file)
    made = subprocess.run(
        ["/usr/bin/make", "clean"],
        cwd=folder,
        env={"PATH": os.defpath},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if name.startswith("a b"):
        assert made.returncode == 0, made.stdout
    else:
        assert made.returncode == 2
        assert "the path of this folder has one of" in made.stdout
        assert made.stdout.count("\n") == 1


def test_bad_configuration_is_refused_before_anything_runs(clean: Clone) -> None:
    config = clean.folder / "workflow/config/paper.yaml"
    text = config.read_text()
    config.write_text(text.replace("cells: 11", "cells: 0", 1))
    try:
        made = clean.make("figures", "QUALITY=smoke")
    finally:
        config.write_text(text)
    assert made.returncode != 0
    assert "paper.yaml: panels.fig05.common.cells = 0" in made.stdout
    assert "persistence does not accept it (allowed: integer at least 1" in made.stdout


def test_missing_system_packages_are_named_for_those_without_rights(tmp_path: Path) -> None:
    # A PATH with no more than the script's own tools: compiler, cmake and ninja are missing.
    for tool in ("bash", "cat", "mktemp"):
        (tmp_path / tool).symlink_to(f"/bin/{tool}")
    (tmp_path / "id").write_text("#!/bin/bash\necho 1000\n")
    (tmp_path / "id").chmod(0o755)
    pid = os.posix_spawn(
        "/bin/bash",
        ["bash", "-c", f"bash '{ROOT}/workflow/environment/system_packages.sh' 2> '{tmp_path}/said'"],
        {"PATH": str(tmp_path)},
    )
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 1
    said = (tmp_path / "said").read_text()
    for command in ("sudo apt-get install", "sudo dnf install", "brew install"):
        line = next(line for line in said.splitlines() if command in line)
        assert "cmake" in line
        assert "hdf5" in line
