"""Snakemake's display of a small workflow, in a file and on a terminal, and its answers to single events."""

import errno
import io
import logging
import os
import pty
import re
import subprocess
import time
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_progress import LogHandler
from tests.python.conftest import ROOT

SNAKEFILE = """
rule panel:
    input: "fig05.svg"
rule draw:
    input: "fig05/a.h5", "fig05/b.h5"
    output: "{panel}.svg"
    log: "{panel}.log"
    shell: "touch {output}"
rule simulate:
    output: "{panel}/{run}.h5"
    log: "{panel}/{run}.log"
    threads: 8
    shell: """
FILLING = "conductivity --cells 5 --start empty --relaxation-time 0 --observation-time 2 --replicas 64"
NOT_STATIONARY = f"{ROOT}/build/bin/{FILLING} --output {{output}} 2> {{log}}"
CONTROL = re.compile(r"\x1b\[[0-9;?]*[a-zA-Z]")


def command(folder: Path, simulate: str) -> list[str]:
    (folder / "Snakefile").write_text(SNAKEFILE + repr(simulate))
    return [str(ROOT / ".venv/bin/snakemake"), "--cores=8", "--logger=progress", f"--directory={folder}"]


def test_a_file_has_a_line_per_panel_and_doubtful_result(tmp_path: Path) -> None:
    shown = subprocess.check_output(command(tmp_path, NOT_STATIONARY), cwd=tmp_path, text=True)
    first, second, panel = shown.splitlines()
    assert {first[:8], second[:8]} == {"fig05/a:", "fig05/b:"}
    assert re.fullmatch(r"fig05/[ab]: not stationary; 1 of 4 done, 0:00:\d\d", first)
    assert re.fullmatch(r"fig05: rendered; 3 of 4 done, 0:00:\d\d", panel)


def test_a_terminal_has_a_bar_and_the_running_jobs_until_ctrl_c(tmp_path: Path) -> None:
    words = command(tmp_path, "echo at work > {log}; exec sleep 60")
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(tmp_path)
        os.execve(words[0], words, os.environ | {"TERM": "xterm"})
    shown, keys = "", 3
    with suppress(OSError):  # raised when the terminal is closed
        while True:
            shown += CONTROL.sub("", os.read(terminal, 65536).decode(errors="replace"))
            while keys and "at work" in shown:
                os.write(terminal, b"\x03")
                time.sleep(0.2)
                keys -= 1
    os.waitpid(process, 0)
    assert re.search(r"━+\s*0 of 4 done, 0:00:\d\d\s+fig05/[ab]  at work", shown)
    assert re.search(r"Stopped; 0 of 4 done, 0:00:\d\d\.", shown)
    assert "failed" not in shown
    assert "Traceback" not in shown


class Full(io.StringIO):
    def write(self, _: str) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")


def handler_of(**output: bool) -> LogHandler:
    options = dict.fromkeys(("dryrun", "verbose", "debug_dag", "printshellcmds"), False) | output
    return LogHandler(SimpleNamespace(**options), None)


def emit(handler: LogHandler, event: LogEvent | None, message: str = "", **fields: Any) -> None:
    record = logging.LogRecord("snakemake", logging.ERROR, "", 0, message, (), None)
    vars(record).update(event=event, **fields)
    handler.emit(record)


def start(handler: LogHandler, log: Path, number: int = 1) -> None:
    fields = {"wildcards": {"panel": "fig05", "run": log.stem}, "output": [f"{log}.h5"], "log": [str(log)]}
    emit(handler, LogEvent.JOB_INFO, jobid=number, **fields)


def fail(handler: LogHandler, log: Path, number: int = 1, in_group: bool = False) -> None:
    emit(handler, LogEvent.ERROR, "RuleException: CalledProcessError in file")
    emit(handler, LogEvent.JOB_ERROR, jobid=number, log=[str(log)], indent=in_group)


def test_a_failure_has_the_end_of_its_log(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The messages of Snakemake that follow from it are not shown. A job that is restarted has not failed."""
    handler, a, b = handler_of(), tmp_path / "a.log", tmp_path / "b.log"
    a.write_text("".join(f"[bold] {k}\n" for k in range(100)))
    for log in (a, b):
        start(handler, log)
        fail(handler, log)
    start(handler, b)
    emit(handler, None, "Exiting because a job execution failed.")
    handler.close()
    handler.close()
    heading, *lines, missing, empty, last = capsys.readouterr().out.splitlines()
    assert heading == f"fig05/a failed. The end of {a}:"
    assert lines == [f"  [bold] {k}" for k in range(88, 100)]
    assert missing.startswith("fig05/b failed")
    assert "empty" in empty
    assert last.startswith("Failed: fig05/a; 0 of 0 done")


def test_a_group_of_a_cluster_fails_without_its_finished_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The log of the group is that of Slurm, which says why a run has none."""
    handler, logs = handler_of(), [tmp_path / f"{name}.log" for name in "ab"]
    for number, log in enumerate(logs):
        start(handler, log, number)
    (tmp_path / "slurm.log").write_text("no space left")
    (tmp_path / "a.log.h5").touch()
    emit(handler, LogEvent.GROUP_ERROR, aux_logs=[str(tmp_path / "slurm.log")])
    for number, log in enumerate(logs):
        fail(handler, log, number, in_group=True)
    handler.close()
    shown = capsys.readouterr().out
    assert "fig05/a" not in shown
    assert "no space left" in shown
    assert "Failed: fig05/b;" in shown


def test_a_job_that_a_signal_ends_has_not_failed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    handler, log = handler_of(), tmp_path / "a.log"
    log.write_text("interrupted after 4 replicas; --resume continues")
    start(handler, log)
    emit(handler, LogEvent.JOB_ERROR, jobid=1, log=[str(log)], indent=False)
    handler.close()
    assert capsys.readouterr().out == ""


def test_other_errors_are_shown_and_a_full_disk_stops_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    emit(handler_of(), LogEvent.ERROR, "MissingInputException")
    assert capsys.readouterr().out == "MissingInputException\n"
    monkeypatch.setattr("sys.stdout", Full())
    emit(handler_of(), LogEvent.ERROR, "MissingInputException")


def test_a_dry_run_is_shown_by_snakemake(capsys: pytest.CaptureFixture[str]) -> None:
    handler = handler_of(dryrun=True)
    emit(handler, LogEvent.ERROR, "wrong")
    assert not handler.writes_to_stream
    assert capsys.readouterr().out == ""
