"""The folder in which a tool works, its messages after failures, and the effect of the printed remedies."""

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import h5py
import pytest

from tests.workflow.conftest import ROOT, Clone, replace, share_build
from tests.workflow.test_makefile import HOSTILE, names

TOOLS = sorted(
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in (ROOT / "workflow").rglob("*.py")
    if "__main__" in path.read_text() and path.name != "build_id.py"  # CMake runs build_id.py with paths
)
TOOLS = [
    name for name in TOOLS if ".figures." not in name or name.endswith("fig03")
]  # all figure scripts behave alike
RUN = "fig03/paper"


def test_variables_are_unset_by_prefix_and_those_of_the_network_are_kept(clean: Clone) -> None:
    kept = dict.fromkeys(
        names(
            "UV_DEFAULT_INDEX UV_INDEX_URL UV_CACHE_DIR UV_NATIVE_TLS UV_HTTP_TIMEOUT PIP_INDEX_URL PIP_CERT PIP_TRUSTED_HOST SSL_CERT_FILE "
            "https_proxy TMPDIR CMAKE_PREFIX_PATH SLURM_JOB_ID"
        ),
        "kept",
    )
    overridden = (
        "LC_ALL",
        "TZ",
        "SOURCE_DATE_EPOCH",
        "MPLBACKEND",
        "MPLCONFIGDIR",
        "PYTHONHASHSEED",
        "OMP_NUM_THREADS",
    )
    script = "source workflow/environment/variables.sh; /usr/bin/env"
    printed = clean.run("/bin/bash", "-c", script, **(HOSTILE | {"LD_PRELOAD": ""} | kept)).stdout
    after = dict(line.split("=", 1) for line in printed.splitlines() if "=" in line)
    assert kept.items() <= after.items()
    allowed = {
        *overridden,
        "QUALITY",
        "PANEL",
        "FRESH",
    }  # the last three are options, which the Makefile unsets
    assert {name for name in HOSTILE if name in after} == allowed
    assert not {name for name in overridden if after[name] == HOSTILE[name]}


def one_line(printed: str) -> str:
    lines = [line for line in printed.splitlines() if not line.startswith(("Using workflow", "make: ***"))]
    assert len(lines) == 1, printed
    return lines[0]


@pytest.mark.parametrize("tool", TOOLS)
def test_a_tool_refuses_another_folder(clean: Clone, tmp_path: Path, tool: str) -> None:
    command = [clean.folder / ".venv/bin/python", "-P", "-m", tool]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    expected = f"the working directory is {tmp_path}, not the project {clean.folder} of this program"
    assert one_line(done.stderr).startswith(expected)


@pytest.fixture
def linked(clean: Clone, tmp_path: Path) -> Clone:
    """A worktree whose environment is a link to that of the clean clone."""
    folder = tmp_path / "worktree"
    clean.git("worktree", "add", "--quiet", "--detach", str(folder))
    (folder / ".venv").symlink_to(clean.folder / ".venv")
    for name in ("build/bin", "build/id", "data/smoke/fig03"):
        shutil.copytree(clean.folder / name, folder / name)
    share_build(Clone(folder))
    yield Clone(folder)
    clean.git("worktree", "remove", "--force", str(folder))


def test_an_environment_reached_through_a_link_serves_and_is_never_changed(
    clean: Clone, linked: Clone, tmp_path: Path
) -> None:
    def state() -> dict[Path, int]:
        files = (clean.folder / ".venv").rglob("*")
        return {
            path: path.lstat().st_mtime_ns
            for path in files
            if not path.is_dir() and "__pycache__" not in path.parts
        }

    before = state()
    linked.make("setup")
    (linked.folder / linked.result(RUN)).unlink()
    printed = linked.make("audit", "QUALITY=smoke", "PANEL=fig03", status=2).stdout
    assert re.search(rf"broken: data/smoke/{RUN}\.\w+\.h5: is missing", printed)
    printed = linked.snakemake("--dry-run", "figures", status=1)
    assert f"the working directory is {linked.folder}, not the project {clean.folder}" in one_line(printed)
    assert linked.make("panel", "PANEL=fig03", "QUALITY=smoke", "DRY=yes", status=None).returncode in (0, 2)
    assert state() == before
    empty = tmp_path / "empty"
    subprocess.run(["python3", "-m", "venv", "--without-pip", empty], check=True)
    (linked.folder / ".venv").unlink()
    (linked.folder / ".venv").symlink_to(empty)
    files = {path for path in empty.rglob("*")} | {empty / ".lock"}  # lock file of uv
    advice = linked.make("setup", status=2).stdout
    assert "is not changed from here: run make setup there, or rm .venv" in advice
    assert files >= {*empty.rglob("*")}
    linked.run("rm", ".venv")
    linked.make("setup")
    assert "panel" in linked.make("status", "QUALITY=smoke").stdout


def remedy(printed: str) -> str:
    """The command after `run` in a message."""
    return re.findall(r"run (make [^;:,)\n]*)", printed)[0].strip()


def test_the_remedies_of_damaged_products_help(kept: Clone) -> None:
    """The damages are an edited value, a truncated result, and a table saved by a spreadsheet."""
    before = kept.products()
    edited, truncated, table = kept.result(RUN), kept.result("fig06/all_sigma=0"), "figures/smoke/fig05.csv"
    with h5py.File(kept.folder / edited, "r+") as file:
        next(iter(file["results"].values()))["mean"][...] *= 1.001
    (kept.folder / truncated).write_bytes(before[truncated][:-100])
    (kept.folder / table).write_bytes(before[table].replace(b",", b";").replace(b"\n", b"\r\n"))
    audit = ("provenance.audit", "--quality", "smoke", "--panel=fig03", "--panel=fig05", "--panel=fig06")
    printed = kept.module(*audit, status=1).splitlines()
    for path in (edited, truncated, table):
        line = next(line for line in printed if line.startswith(f"broken: {path}"))
        if "remove it" in line:
            (kept.folder / path).unlink()
        assert remedy(line) == "make figures QUALITY=smoke"
    kept.snakemake("figures")
    after = kept.products()
    records = {kept.record(panel) for panel in ("fig03", "fig05", "fig06")}  # a record contains the commit
    assert {name for name in after if after[name] != before.get(name)} <= records
    kept.module(*audit)


def test_the_remedy_of_missing_programs_helps(kept: Clone) -> None:
    share_build(kept)
    kept.make("build")
    missing = [kept.folder / "build" / name for name in ("bin/ageing", "id/ageing.json")]
    for path in missing:
        path.unlink()
    assert remedy(kept.snakemake("--dry-run", "figures", status=None)) == "make build"
    kept.make("build")
    assert all(path.is_file() for path in missing)
    assert kept.stale() == set()


def test_what_another_user_cannot_read_or_write_is_not_checked(clean: Clone, tmp_path: Path) -> None:
    if os.getuid():
        pytest.skip("needs root, to become another user")
    command = ["setpriv", "--reuid", "12345", "--clear-groups", "--regid", "12345", "env", "-i"]
    audit = [".venv/bin/python", "-P", "-m", "workflow.provenance.audit"]
    audit += ["--quality=smoke", "--panel=fig03"]
    for folder in clean.folder.parents:
        if folder.stat().st_uid == 0 and folder != Path("/"):
            folder.chmod(folder.stat().st_mode | 0o011)
    subprocess.run(["chmod", "-R", "a+rX", clean.folder], check=True)
    for hidden in (
        None,
        clean.result(RUN),
        "figures/smoke/fig03.csv",
        "data/smoke/fig03",
        "workflow/figures/fig03.py",
    ):
        mode = (clean.folder / (hidden or ".")).stat().st_mode
        try:
            (clean.folder / (hidden or ".")).chmod(0o555 if hidden is None else 0)
            done = subprocess.run(
                [*command, *audit], cwd=clean.folder, capture_output=True, text=True, check=False
            )
        finally:
            (clean.folder / (hidden or ".")).chmod(mode)
        assert done.returncode == 3, (hidden, done.stdout + done.stderr)
        assert "not checked: " in done.stdout
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize("stream", [">&-", "| head -n 1", "</dev/null >/dev/null 2>&1"])
def test_a_closed_output_is_no_error(clean: Clone, stream: str) -> None:
    command = f".venv/bin/python -P -m workflow.provenance.status --quality smoke --panel fig03 {stream}"
    assert "Traceback" not in clean.run("bash", "-c", command).stdout


def test_mistakes_in_a_panel_of_ones_own_name_the_step(kept: Clone) -> None:
    replace("workflow/figures/fig03.py", "    run(draw", "    dict(draw=draw) or run(draw")(kept)
    printed = kept.snakemake("figures", status=1)
    assert "no figure was written: end the script with run(draw, title)" in printed
    replace("workflow/config/paper.yaml", "program: conductivity", "program: own_program")(kept)
    assert "run make build" in kept.snakemake("figures", status=1)


def test_a_link_to_a_missing_folder_is_named(kept: Clone) -> None:
    data = kept.folder / "data"
    data.rename(kept.folder / "elsewhere")
    data.symlink_to("/nonexistent/data")
    try:
        printed = kept.snakemake("figures", status=1)
        table = kept.module("provenance.status", "--quality", "smoke")
    finally:
        data.unlink()
        (kept.folder / "elsewhere").rename(data)
    assert one_line(printed).startswith("data is a link to /nonexistent/data, which is missing: create")
    assert "Traceback" not in table


def test_an_early_termination_keeps_the_checkpoint(kept: Clone) -> None:
    """Snakemake removes an empty folder of outputs when it ends, before the program writes its checkpoint."""
    quality = "smoke_seed=3_replicas=100000"
    command = [".venv/bin/snakemake", "--config", f"quality={quality}", "panel=fig06", "--", "panel"]
    shutil.rmtree(kept.folder / "data/smoke/fig06")
    with subprocess.Popen(
        command, cwd=kept.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    ) as running:
        while not [*kept.folder.glob("data/smoke/fig06/*")]:
            time.sleep(0.1)
        time.sleep(2)
        os.killpg(running.pid, signal.SIGTERM)
        running.wait()
    deadline = time.time() + 20
    while time.time() < deadline and not [*kept.folder.glob("data/smoke/fig06/*.checkpoint")]:
        time.sleep(0.2)
    assert [*kept.folder.glob("data/smoke/fig06/*.checkpoint")]
