"""make in unusual environments and moved folders, with other Pythons, without file locks, and with mistyped options."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.workflow.conftest import ROOT, Clone, clone_into, copy_made, share_build
from workflow.lib.load import load
from workflow.plan import data_path, load_plan


def names(text: str) -> list[str]:
    return text.split()


HOSTILE = {
    **dict.fromkeys(
        names(
            "PYTHONPATH PYTHONHOME PYTHONSTARTUP PYTHONPYCACHEPREFIX PYTHONPLATLIBDIR VIRTUAL_ENV CONDA_PREFIX UV_PROJECT UV_CONFIG_FILE "
            "UV_PROJECT_ENVIRONMENT UV_PYTHON UV_WORKING_DIR UV_CONSTRAINT PIP_TARGET PIP_PREFIX PIP_CONFIG_FILE GIT_DIR GIT_WORK_TREE "
            "GIT_INDEX_FILE GIT_CONFIG_GLOBAL SNAKEMAKE_PROFILE SNAKEMAKE_OUTPUT_CACHE MATPLOTLIBRC MPLCONFIGDIR FONTCONFIG_FILE "
            "HDF5_PLUGIN_PATH LD_LIBRARY_PATH LD_PRELOAD CMAKE_TOOLCHAIN_FILE CCACHE_DIR GCC_EXEC_PREFIX CPATH C_INCLUDE_PATH LIBRARY_PATH "
            "COMPILER_PATH PKG_CONFIG_PATH fmt_ROOT fmt_DIR Eigen3_ROOT"
        ),
        "/nonexistent",
    ),
    **dict.fromkeys(
        names(
            "PYTHONINSPECT PYTHONOPTIMIZE PYTHONVERBOSE PYTHONDONTWRITEBYTECODE UV_NO_EDITABLE UV_NO_CACHE UV_NO_BINARY UV_EXACT PIP_USER "
            "SOURCE_DATE_EPOCH NPY_DISABLE_CPU_FEATURES POSIXLY_CORRECT"
        ),
        "1",
    ),
    **{
        "LC_ALL": "de_DE.UTF-8",
        "TZ": "Asia/Kathmandu",
        "PYTHONHASHSEED": "12345",
        "OMP_NUM_THREADS": "7",
        "OPENBLAS_CORETYPE": "Prescott",
        "CXXFLAGS": "-Ofast",
        "CCC_OVERRIDE_OPTIONS": "+-ffast-math",
        "LDFLAGS": "-nonsense",
        "CMAKE_GENERATOR": "none",
        "MPLBACKEND": "TkAgg",
        "QUALITY": "deep",
        "PANEL": "none",
        "FRESH": "yes",
    },
}
OFFLINE = {"UV_OFFLINE": "1", "http_proxy": "http://localhost:9"}


@pytest.fixture(scope="module")
def moved(clean: Clone, tmp_path_factory: pytest.TempPathFactory) -> Clone:
    """A built copy of the project in a folder with a space in its name, to which it was moved."""
    first = clone_into(tmp_path_factory.mktemp("first") / "project")
    share_build(first)
    copy_made(clean.folder, first.folder)
    first.make("build")
    folder = tmp_path_factory.mktemp("second") / "a path with spaces"
    first.folder.rename(folder)
    return Clone(folder)


def test_a_moved_folder_and_an_unusual_environment_change_nothing(clean: Clone, moved: Clone) -> None:
    """This holds without a network, and packages that the user has installed are kept."""
    products = moved.products()
    assert products == clean.products()
    printed = moved.make("figures", "QUALITY=smoke", **HOSTILE, **OFFLINE).stdout
    assert "Nothing to be done" in printed
    (packages,) = moved.folder.glob(".venv/lib/python3*/site-packages")
    (packages / "mine.py").write_text("x = 1\n")
    for path in products:
        if "fig03/" in path or "fig03." in path:
            (moved.folder / path).unlink()
    moved.make("panel", "PANEL=fig03", "QUALITY=smoke", **HOSTILE, **OFFLINE)
    assert (packages / "mine.py").is_file()
    after = moved.products()
    assert {path for path in after if after[path] != products[path]} <= {
        moved.record("fig03")
    }  # its record contains the commit


def test_an_environment_has_no_path_of_its_folder(moved: Clone) -> None:
    """A copy of an environment, or a link to it, thus works for the folder that contains it."""
    found = subprocess.run(
        ["grep", "-rlI", "-e", "/first[^/]*/project", "--exclude=*.pyc", moved.folder / ".venv"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert found.stdout == ""
    where = (".venv/bin/python", "-P", "-c", "from workflow.files import ROOT; print(ROOT)")
    assert moved.run(*where).stdout.strip() == str(moved.folder)


def test_a_source_restored_with_its_old_time_is_compiled_again(moved: Clone) -> None:
    share_build(moved)
    source, identity = moved.folder / "cpp/statistics/fit.hpp", moved.folder / "build/id/ageing.json"
    moved.make("build")
    built, former, time = identity.read_text(), source.read_bytes(), source.stat().st_mtime_ns
    source.write_bytes(former + b"// edited\n")
    moved.make("build")
    edited = identity.read_text()
    source.write_bytes(former)
    os.utime(source, ns=(time, time))
    assert "run make build" in moved.snakemake("--dry-run", "figures", status=1) or edited == built
    moved.make("build")
    assert identity.read_text() == built
    assert "is not built from" not in moved.snakemake("--dry-run", "figures")


def test_a_link_to_the_folder_changes_nothing(moved: Clone, tmp_path: Path) -> None:
    moved.make("build")
    (compiler,) = moved.folder.glob(
        "build/CMakeFiles/*/CMakeCXXCompiler.cmake"
    )  # file that a new configuration would write again
    files = [compiler, *(moved.folder / ".venv" / name for name in ("pyvenv.cfg", "bin/snakemake"))]
    before = [file.stat().st_mtime_ns for file in files]
    (tmp_path / "link").symlink_to(moved.folder)
    linked = Clone(tmp_path / "link")
    linked.make("build", PWD=str(linked.folder))
    assert "panel" in linked.make("status", "QUALITY=smoke", PWD=str(linked.folder)).stdout
    assert [file.stat().st_mtime_ns for file in files] == before


def test_an_environment_without_interpreter_is_renewed(moved: Clone) -> None:
    """The interpreter is missing after an upgrade of the system's Python."""
    python = moved.folder / ".venv/bin/python"
    python.unlink()
    python.symlink_to("/nonexistent/python3")
    assert "panel" in moved.make("status", "QUALITY=smoke").stdout


def test_sources_from_the_future_are_compiled_once(moved: Clone) -> None:
    future = 2 * 86400 + (moved.folder / "Makefile").stat().st_mtime
    os.utime(moved.folder / "cpp/CMakeLists.txt", (future, future))
    moved.make("build")
    assert "dirty" not in moved.make("build").stdout


def test_a_user_without_name_and_home(moved: Clone) -> None:
    if os.getuid():
        pytest.skip("needs root, to become another user")
    subprocess.run(["chmod", "-R", "a+rwX", moved.folder], check=True)
    for folder in moved.folder.parents:
        if folder.stat().st_uid == 0 and folder != Path("/") and not folder.stat().st_mode & 0o001:
            folder.chmod(folder.stat().st_mode | 0o011)
    command = ["setpriv", "--reuid", "12345", "--clear-groups", "--regid", "12345"]
    environment = {"PATH": f"{os.defpath}:{moved.folder}/uv", "HOME": "/nonexistent"}
    for target in (("status",), ("panel", "PANEL=fig03")):
        done = subprocess.run(
            [*command, "/usr/bin/make", *target, "QUALITY=smoke"],
            cwd=moved.folder, env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("flock", "line", "status"),
    [
        ("exit 75", "Another make is running in this folder", 1),
        (
            "echo 'flock: 9: No locks available' >&2; exit 71",
            "File locks do not work here (No locks available)",
            0,
        ),
    ],
)
def test_locks(clean: Clone, tmp_path: Path, flock: str, line: str, status: int) -> None:
    (tmp_path / "flock").write_text(f"#!/bin/sh\n{flock}\n")
    (tmp_path / "flock").chmod(0o755)
    command = ("bash", "workflow/environment/one_at_a_time.sh", "true")
    done = clean.run(*command, status=status, PATH=f"{tmp_path}:{os.defpath}")
    assert line in done.stdout
    assert len(done.stdout.splitlines()) == 1


def test_two_at_once_are_refused(clean: Clone) -> None:
    command = ["bash", "workflow/environment/one_at_a_time.sh"]
    holder = [*command, "bash", "-c", "echo held; exec sleep 60"]
    with subprocess.Popen(holder, cwd=clean.folder, stdout=subprocess.PIPE, text=True) as first:
        assert first.stdout
        assert first.stdout.readline() == "held\n"
        clean.run(*command, "true", status=1)
        for target in ("setup", "build", "clean"):  # before anything is changed
            assert "Another make is running" in clean.make(target, status=2).stdout
        first.kill()
    clean.run(*command, "true")  # the lock has ended with its process


def test_rerun_from_scratch_is_compared_in_a_line(kept: Clone) -> None:
    kept.module("provenance.compare", "--quality", "smoke", "--panel", "fig03", "--keep")
    kept.snakemake("--forceall", kept.record("fig03"))
    printed = kept.module("provenance.compare", "--quality", "smoke", "--panel", "fig03")
    assert printed == "3 of 3 results agree with those in build/before/data/smoke, smallest p = 1\n"


def test_another_seed_has_figures_of_its_own_and_is_compared(kept: Clone) -> None:
    quality = "smoke_seed=7_replicas=5"
    kept.run(".venv/bin/snakemake", "--config", f"quality={quality}", "panel=fig06", "--", "panel")
    printed = kept.module("provenance.compare", "--quality", quality, "--panel", "fig06")
    assert printed.startswith("2 of 2 results agree with those in data/smoke, smallest p = 0.")
    run = load_plan(quality)["fig06"].runs[0]
    assert run.options["replicas"] == 5
    path = data_path(quality, "fig06", run)
    assert f"seed {run.options['seed']}" in kept.module("provenance.tree", path)
    assert (kept.folder / f"figures/{quality}/fig06.pdf").is_file()


def test_an_error_is_reached_or_the_time_is_bounded(kept: Clone) -> None:
    quality = "smoke_error=0.02"
    kept.run(".venv/bin/snakemake", "--config", f"quality={quality}", "panel=fig06", "--", "panel")
    printed = kept.module("provenance.errors", "--quality", quality, "--panel", "fig06")
    assert printed == "2 of 2 runs have reached an error of 0.02\n"
    for run in load_plan(quality)["fig06"].runs:
        assert load(kept.folder / data_path(quality, "fig06", run)).provenance["achieved_error"] < 0.02
    bounded = f"{quality[:-4]}1e-5_hours=0.0002"
    kept.run(".venv/bin/snakemake", "--config", f"quality={bounded}", "panel=fig06", "--", "panel")
    printed = kept.module("provenance.errors", "--quality", bounded, "--panel", "fig06")
    assert printed.startswith("0 of 2 runs have reached an error of 1e-05\n  fig06/all_sigma=0: error ")
    assert "of exponent, requested 1e-05" in printed


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (("figures", "QUALTY=smoke"), "QUALTY is not an option; did you mean QUALITY?"),
        (("figures", "panel=fig05"), "panel is not an option; did you mean PANEL?"),
        (("panel",), "PANEL is missing; try make panel PANEL=fig05"),
        (("provenance",), "FILE is missing; try make provenance FILE=figures/standard/fig05.pdf"),
        (("audit", "PANEL=fig5"), "fig5 is not a panel; did you mean fig05?"),
        (("audit", "PANEL=3"), "3 is not a panel; choose one of model, "),
        (("figures", "PANEL=fig03"), "PANEL has no effect on this target; try make panel PANEL=fig03"),
        (("figures", "FRESH=0"), "FRESH=0 is invalid; give FRESH=yes, or leave it out"),
        (("figures", "FRESH=yes no"), "FRESH=yes no is invalid; give FRESH=yes, or leave it out"),
        (("cost", "BATCH=0"), "BATCH=0 is invalid; give a whole number of at least 1"),
        (("figures", "JOBS=1'"), "JOBS=1' is invalid; give a whole number of at least 1"),
        (("figures", "JOBS=0"), "JOBS=0 is invalid; give a whole number of at least 1"),
        (("figures", "PROFILE=slrm"), "slrm is not a profile; did you mean slurm?"),
        (("status", "SEED=-1"), "SEED=-1 is invalid; allowed: a whole number from 0 to 10^18 - 1"),
        (("status", "QUALITY=best"), "best is not a quality; choose one of smoke, standard, paper, deep"),
        (("status", "ERROR=no"), "ERROR=no is invalid; allowed: a number greater than 0"),
    ],
)
def test_mistyped_options_get_a_line(clean: Clone, arguments: tuple[str, ...], line: str) -> None:
    printed = clean.make(*arguments, status=2).stdout
    assert line in printed
    assert "Traceback" not in printed
    assert len(printed.splitlines()) <= 2  # the second line is from make itself


def test_an_unknown_panel_gets_a_line(clean: Clone) -> None:
    command = (".venv/bin/snakemake", "--config", "quality=smoke", "panel=fig5", "--", "panel")
    assert clean.run(*command, status=1).stdout.strip().endswith("did you mean fig05?")


def test_missing_system_packages_are_named_for_those_without_rights(tmp_path: Path) -> None:
    for tool in ("bash", "cat", "mktemp", "awk", "grep"):  # no compiler, cmake or ninja
        (tmp_path / tool).symlink_to(shutil.which(tool) or "")
    (tmp_path / "id").write_text("#!/bin/bash\necho 1000\n")
    (tmp_path / "id").chmod(0o755)
    done = subprocess.run(
        ["/bin/bash", ROOT / "workflow/environment/system_packages.sh"],
        env={"PATH": str(tmp_path)}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 1
    for command in ("sudo apt-get install", "sudo dnf install", "brew install"):
        line = next(line for line in done.stderr.splitlines() if command in line)
        assert {"cmake", "hdf5"} <= {
            word
            for name in line.split()
            for word in (name, name.removeprefix("lib"), "hdf5" if "hdf5" in name else "")
        }


def test_several_panels_and_a_dry_run(kept: Clone) -> None:
    for name in ("fig03", "fig06"):
        (kept.folder / f"figures/smoke/{name}.csv").unlink()
    names = "PANEL=fig03 fig06"
    share_build(kept)
    made = {
        line
        for line in kept.make("panel", names, "QUALITY=smoke", "DRY=yes").stdout.splitlines()
        if line.startswith(("data/", "figures/"))
    }
    assert {line.partition(".")[0] for line in made} == {"figures/smoke/fig03", "figures/smoke/fig06"}
    assert not (kept.folder / "figures/smoke/fig03.csv").exists()
    assert "In figures/smoke: fig03.pdf fig06.pdf and" in kept.make("panel", names, "QUALITY=smoke").stdout
    (kept.folder / kept.result("fig06/all_sigma=0")).unlink()
    printed = kept.make("audit", names, "QUALITY=smoke", status=2).stdout
    assert "2 panels with results: 2 broken" in printed  # the result, and the figure without it


def test_slurm_without_its_commands_is_refused(clean: Clone, tmp_path: Path) -> None:
    for tool in Path("/usr/bin").iterdir():
        if tool.name != "sbatch":
            (tmp_path / tool.name).symlink_to(tool)
    printed = clean.make("figures", "PROFILE=slurm", status=2, PATH=str(tmp_path)).stdout
    assert "sbatch is not in PATH" in printed


def test_help_names_every_target(clean: Clone) -> None:
    printed = clean.make("help").stdout
    assert all(
        f"make {target}" in printed
        for target in ("figures", "panel", "report", "audit", "verify", "status", "crate")
    )
