"""A job is run with its options word by word, in an environment of its own, and entered into the lock if it succeeds."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.lib.parents import file_hash
from workflow.provenance.build_id import IDENTITY
from workflow.provenance.execute import add_costs, require_parts
from workflow.provenance.node import linked

HOSTILE = {
    "name": "x; touch a",
    "other": "`touch a`$(touch a)'\"",
    "negative": -0.5,
    "flag": True,
    "off": False,
}
DATA = "data/smoke/fig99/all_gamma=1.h5"
COST = "build/costs/smoke/fig99/all_gamma=1.json"
RECORD = "build/records/smoke/fig99/all_gamma=1.json"
PROGRAM = """#!/usr/bin/python3
import json, os, signal, sys, time
options = dict(zip(sys.argv, sys.argv[1:]))
output = options["--output"]
signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
print("said", file=sys.stderr, flush=True)
if "--stuck" in sys.argv:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    print("stuck", file=sys.stderr, flush=True)
if "--wait" in sys.argv:
    time.sleep(60)
status = int(options.get("--status", 0))
if status in (0, 4):
    open(output, "w").write(json.dumps([sys.argv[1:], sorted(os.environ)]))
    open(output.removesuffix(".h5") + ".cost.json", "w").write("{}")
sys.exit(status)
"""


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A project with one program, `fake`, which writes down its words and its environment."""
    shutil.copytree(ROOT / "workflow", tmp_path / "workflow")
    for name in ("Makefile", "Snakefile"):
        (tmp_path / name).touch()
    for folder in ("bin", "id", "logs"):
        (tmp_path / "build" / folder).mkdir(parents=True)
    (tmp_path / ".snakemake").mkdir()
    (tmp_path / "build/bin/fake").write_text(PROGRAM)
    (tmp_path / "build/bin/fake").chmod(0o755)
    (tmp_path / "build/id/fake.json").write_text(
        json.dumps(dict.fromkeys(IDENTITY, "") | {"program": "fake", "build_id": "b" * 64, "sources": {}})
    )
    note_executable(tmp_path)
    return tmp_path


def note_executable(root: Path) -> None:
    """As the linker does."""
    digest = file_hash(root / "build/bin/fake")
    (root / "build/id/fake.sha256").write_text(f"{digest}  fake\n")


def start(
    root: Path, options: dict, redirection: str = "", where: Sequence[str] = ("--here",)
) -> subprocess.Popen:
    command = [
        sys.executable,
        "-I",
        "-S",
        "workflow/environment/launch.py",
        "workflow.provenance.execute",
        "simulate",
        "--log",
        "build/logs/log",
    ]
    command += ["--quality", "smoke", "--panel", "fig99", "--run", "all_gamma=1", "--program", "fake"]
    command += ["--options", json.dumps(options), "--threads", "3", "--replicated", *where]
    return subprocess.Popen(
        ["bash", "-c", f'exec "$@" {redirection}', "bash", *command],
        cwd=root,
        env={"PATH": os.defpath, "OMP_NUM_THREADS": "7", "HOSTILE": "1"},
    )


def jobs(root: Path) -> dict:
    record = root / RECORD
    return json.loads(record.read_text())["jobs"] if record.is_file() else {}


def test_standard_error_may_be_closed(root: Path) -> None:
    """As for what is started by a clock."""
    assert start(root, HOSTILE, "2>&-").wait() == 0
    assert jobs(root)


@pytest.mark.parametrize(("noted", "status"), [("", 0), ("libgsl.so.1\n", 1)])
def test_a_node_with_other_libraries_makes_nothing(root: Path, noted: str, status: int) -> None:
    """The program is a script, which is linked to none."""
    (root / "build/libraries").mkdir()
    (root / "build/libraries/fake").write_text(noted)
    assert start(root, {}, where=()).wait() == status
    assert (root / DATA).is_file() == (status == 0)
    said = (root / "build/logs/log").read_text()
    assert ("This node has nothing where the one that started the run has libgsl.so.1: " in said) == bool(
        status
    )


def test_libraries_are_known_by_their_versions() -> None:
    names = linked("persistence")
    assert any(re.fullmatch(r"libgsl\.so\.\d+\.\d+\.\d+", name) for name in names)


@pytest.mark.parametrize("status", [0, 4])
def test_options_reach_the_program_as_they_are(root: Path, status: int) -> None:
    options = HOSTILE | {"status": status}
    assert start(root, options).wait() == 0
    words, environment = json.loads((root / "data/smoke/fig99/all_gamma=1.h5").read_text())
    asked = ["--name", HOSTILE["name"], "--other", HOSTILE["other"], "--negative", "-0.5", "--flag"]
    assert words[: len(asked)] == asked
    assert "--off" not in words
    assert words[-5:] == ["--threads", "3", "--resume", "--progress", "log"]
    assert "HOSTILE" not in environment
    assert not (root / "a").exists()
    recorded = jobs(root)["fig99/all_gamma=1"]
    assert (recorded["tool"], recorded["options"], recorded["exit"]) == ("fake", options, status)
    assert recorded["executable"] == file_hash(root / "build/bin/fake")
    assert "workflow/provenance/execute.py" in recorded["pipeline"]
    assert (root / "build/logs/log").read_text() == "said\n"
    assert (root / "build/costs/smoke/fig99/all_gamma=1.json").is_file()


@pytest.mark.parametrize("status", [1, 3])
def test_what_fails_is_not_recorded(root: Path, status: int) -> None:
    assert start(root, {"status": status}).wait() == status
    assert jobs(root) == {}
    assert not list((root / "data").rglob("*.h5"))


def test_an_edited_program_does_not_run(root: Path) -> None:
    (root / "build/bin/fake").write_text(PROGRAM.replace('"{}"', '"{} "'))
    assert start(root, {}).wait() == 1
    assert jobs(root) == {}
    assert "not what was built" in (root / "build/logs/log").read_text()


def test_a_program_that_is_built_while_it_runs_is_not_recorded(root: Path) -> None:
    program = PROGRAM.replace("sys.exit(status)", "open(sys.argv[0], 'a').write('#')\nsys.exit(status)")
    (root / "build/bin/fake").write_text(program)
    note_executable(root)
    assert start(root, {}).wait() == 1
    assert jobs(root) == {}


def test_files_of_the_project_hide_no_module(root: Path) -> None:
    for place in (root, root / "workflow", root / "workflow/environment"):
        for module in ("json", "hashlib", "argparse"):
            (place / f"{module}.py").write_text("raise SystemExit('hidden')\n")
    assert start(root, {}).wait() == 0


def test_a_program_is_told_to_stop_and_waited_for(root: Path) -> None:
    running = start(root, {"wait": True})
    log = root / "build/logs/log"
    while not (log.is_file() and log.read_text()):
        time.sleep(0.05)
    running.send_signal(signal.SIGTERM)
    assert running.wait(timeout=10) == 143
    assert jobs(root) == {}


@pytest.mark.parametrize("second", [signal.SIGTERM, signal.SIGINT])
def test_a_second_signal_ends_a_program_that_does_not_stop(root: Path, second: signal.Signals) -> None:
    running = start(root, {"wait": True, "stuck": True})
    log = root / "build/logs/log"
    while not (log.is_file() and "stuck" in log.read_text()):
        time.sleep(0.05)
    running.send_signal(signal.SIGTERM)
    time.sleep(0.5)
    assert running.poll() is None
    running.send_signal(second)
    assert running.wait(timeout=10) == 128 + second
    program = [path for path in Path("/proc").glob("[0-9]*/cmdline") if str(root).encode() in content(path)]
    assert not program
    assert jobs(root) == {}


def content(path: Path) -> bytes:
    """Of a file of a process, which may end meanwhile."""
    try:
        return path.read_bytes()
    except OSError:
        return b""


def test_the_costs_of_parts_are_added(tmp_path: Path) -> None:
    keys = ("wall_seconds", "cpu_seconds", "peak_memory_bytes", "events")
    joined, parts = tmp_path / "joined.cost.json", tmp_path / "parts"
    parts.mkdir()
    for path, numbers in (
        (joined, (1.0, 0.5, 10, 900)),
        (parts / "0-3.part.cost.json", (20.0, 15.0, 70, 400)),
        (parts / "4-7.part.cost.json", (30.0, 25.0, 60, 500)),
    ):
        path.write_text(json.dumps(dict(zip(keys, numbers, strict=True))))
    add_costs(joined, parts)
    assert json.loads(joined.read_text()) == dict(zip(keys, (51.0, 40.5, 70, 900), strict=True))


@pytest.mark.parametrize("damaged", [False, True])
def test_a_result_that_could_not_be_entered_is_taken_unless_it_is_damaged(root: Path, damaged: bool) -> None:
    (root / RECORD).mkdir(parents=True)
    assert start(root, {}).wait() == 1
    (waiting,) = (root / "build/partial").rglob("*.exit0-*.h5")
    if damaged:
        waiting.write_text("forged")
    (root / RECORD).rmdir()
    assert start(root, {}).wait() == 0
    assert ("said" in (root / "build/logs/log").read_text()) == damaged  # by the program, which ran again
    assert json.loads((root / DATA).read_text())
    assert not [path for path in (root / "build/partial").rglob("*") if path.is_file()]


def test_a_damaged_part_is_removed_so_that_it_is_measured_again(tmp_path: Path) -> None:
    parts = {name: tmp_path / f"{name}.part" for name in ("0-3", "4-7", "8-9", "10-11")}
    for name, path in parts.items():
        path.write_text(name)
        cost = {"sha256": file_hash(path)}
        path.with_suffix(".part.cost.json").write_text(json.dumps(cost))
    require_parts(tmp_path)
    parts["4-7"].write_text("4-6")
    parts["8-9"].with_suffix(".part.cost.json").write_text("{")
    with pytest.raises(SystemExit, match=r"4-7.part, .*8-9.part: not what the job wrote, and removed"):
        require_parts(tmp_path)
    assert {path.name for path in tmp_path.glob("*.part")} == {"0-3.part", "10-11.part"}


PLACE = "a {} lies where a file belongs; move it away"


@pytest.mark.parametrize(
    ("path", "make", "words"),
    [
        ("build/id/fake.sha256", os.mkfifo, PLACE.format("pipe")),
        ("build/id/fake.json", os.mkfifo, PLACE.format("pipe")),
        ("build/bin/fake", os.mkfifo, PLACE.format("pipe")),
        (RECORD.replace(".json", ".tmp"), os.mkfifo, PLACE.format("pipe")),
        (RECORD.replace(".json", ".tmp"), Path.mkdir, PLACE.format("folder")),
        (RECORD, Path.mkdir, "all_gamma=1.json: Is a directory"),
        (DATA, Path.mkdir, "all_gamma=1.h5: a folder lies where a file belongs; move it away"),
        (COST, Path.mkdir, "all_gamma=1.json: Is a directory"),
        ("build/partial", Path.touch, "Not a directory"),
    ],
)
def test_what_lies_in_a_files_place_is_told_in_one_line(
    root: Path, path: str, make: Callable[[Path], object], words: str
) -> None:
    (root / path).parent.mkdir(parents=True, exist_ok=True)
    (root / path).unlink(missing_ok=True)
    make(root / path)
    assert start(root, {}).wait(timeout=10) == 1
    (line,) = (line for line in (root / "build/logs/log").read_text().splitlines() if line != "said")
    assert words in line
    assert not (root / DATA).is_file()


@pytest.mark.parametrize("status", [0, 4])
@pytest.mark.parametrize("path", [DATA, RECORD, RECORD.replace(".json", ".tmp"), COST])
def test_what_could_not_be_entered_is_not_simulated_again(root: Path, path: str, status: int) -> None:
    """Whatever stands in the way when the program has ended; a full disk and a folder fail at the same places."""
    (root / path).mkdir(parents=True)
    assert start(root, {"status": status}).wait(timeout=10) == 1
    assert "said" in (root / "build/logs/log").read_text()
    (root / path).rmdir()
    assert start(root, {"status": status}).wait(timeout=10) == 0
    assert (root / "build/logs/log").read_text() == ""
    job = jobs(root)["fig99/all_gamma=1"]
    assert (job["exit"], job["outputs"]) == (status, {DATA: file_hash(root / DATA)})
    assert (root / COST).is_file()
    assert list((root / "build/partial").rglob("*.*")) == []


def test_a_checkpoint_belongs_to_its_options(root: Path) -> None:
    for options in ({"sigma": 1}, {"sigma": 1}, {"sigma": 2}):
        assert start(root, options).wait() == 0
        words, _ = json.loads((root / "data/smoke/fig99/all_gamma=1.h5").read_text())
        (root / "seen").open("a").write(words[words.index("--output") + 1] + "\n")
    first, second, third = (root / "seen").read_text().split()
    assert first == second != third
