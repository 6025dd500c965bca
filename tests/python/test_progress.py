"""The display of Snakemake's events."""

import errno
import io
import logging
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

import snakemake_logger_plugin_progress as progress
from snakemake_logger_plugin_progress import LAST, LogHandler, last_lines, outcome
from tests.python.conftest import Program

Captured = pytest.CaptureFixture[str]


def emit(
    handler: LogHandler, event: LogEvent | None, message: str = "", level: int = logging.INFO, **fields: Any
) -> None:
    record = logging.LogRecord("snakemake", level, "", 0, message, (), None)
    vars(record).update(event=event, **fields)
    handler.emit(record)


def handler_of(**output: bool) -> LogHandler:
    settings = dict.fromkeys(("dryrun", "verbose", "debug_dag", "printshellcmds"), False) | output
    return LogHandler(SimpleNamespace(**settings), None)


@pytest.fixture
def handler(monkeypatch: pytest.MonkeyPatch) -> LogHandler:
    """Handler for two runs of 8 s and a panel on one core."""
    monkeypatch.setattr(progress, "estimated_seconds", lambda *_: 8)
    monkeypatch.setattr(
        progress, "outcome", lambda path: ("mu = 0.3289(30)", ["not stationary"] * (path.stem == "b"))
    )
    return begun(handler_of())


def begun(handler: LogHandler, command: str = "snakemake --config panel=fig05") -> LogHandler:
    emit(handler, LogEvent.WORKFLOW_STARTED, cmd=command)
    emit(handler, LogEvent.RESOURCES_INFO, cores=1)
    emit(handler, LogEvent.RUN_INFO, stats={"simulate": 2, "draw": 1, "panel": 1, "total": 4})
    return handler


def start(
    handler: LogHandler, number: int, run: str = "", log: str = "none.log", panel: str = "fig05"
) -> None:
    wildcards = {"quality": "smoke", "panel": panel} | ({"run": run} if run else {})
    drawing = "draw_extension" if panel.startswith("ext") else "draw"
    rule, inputs = ("simulate", []) if run else (drawing, ["a.h5", "b.h5"])
    emit(handler, LogEvent.JOB_INFO, jobid=number, rule_name=rule, wildcards=wildcards, input=inputs, output=[f"{run}.h5"],
         log=[log], threads=1)  # fmt: skip


def finish(handler: LogHandler, *numbers: int) -> None:
    for number in numbers:
        emit(handler, LogEvent.JOB_FINISHED, job_id=number)


def interrupt(handler: LogHandler) -> None:
    emit(handler, None, "Terminating processes on user request, this might take some time.")
    emit(handler, LogEvent.ERROR, "RuleException: CalledProcessError", logging.ERROR)
    emit(handler, LogEvent.JOB_ERROR, jobid=1, log=["a.log"])


def test_a_pipe_has_a_line_per_panel_and_per_doubt(handler: LogHandler, capsys: Captured) -> None:
    for number, run in enumerate(["a", "b", ""]):
        start(handler, number, run)
    finish(handler, 0, 1, 2)
    emit(handler, LogEvent.JOB_FINISHED, job_id=99)  # the job of the target, which is not counted
    handler.close()
    shown = capsys.readouterr().out.splitlines()
    assert shown[0].startswith("fig05/b: mu = 0.3289(30), not stationary, 2 of 3 done, about 0:00:")
    assert shown[1:] == ["fig05: rendered from 2 runs, 3 of 3 done"]


def test_the_end_of_the_papers_figures_is_reported(handler: LogHandler, capsys: Captured) -> None:
    emit(handler, LogEvent.RUN_INFO, stats={"draw": 2, "draw_extension": 1, "figures": 1, "total": 4})
    for number, panel in enumerate(["fig05", "ext07", "fig06"]):
        start(handler, number, panel=panel)
        finish(handler, number)
    handler.close()
    shown = capsys.readouterr().out.splitlines()
    assert [line.partition(":")[0] for line in shown[:3]] == ["fig05", "ext07", "fig06"]
    assert shown[3:] == ["The paper's figures are in figures/smoke; extensions follow"]


def test_time_left_follows_what_finished_jobs_took(
    handler: LogHandler, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = time.time()
    start(handler, 0, "a")
    monkeypatch.setattr(time, "time", lambda: now + 16)
    monkeypatch.setattr(progress, "DRAWING", 4)
    handler._costs = {"fig05/a": 8, "fig05/b": 8}
    finish(handler, 0)  # this machine takes twice as long
    assert handler._state == "1 of 3 done, about 0:00:24 left"


@pytest.mark.parametrize("lines", [["[bold] disk full"], []])
def test_a_failure_is_shown_with_the_end_of_its_log(
    handler: LogHandler, capsys: Captured, tmp_path: Path, lines: list
) -> None:
    """The messages of Snakemake itself are not shown."""
    log = tmp_path / "a.log"
    log.write_text("\n".join(lines))
    start(handler, 1, "a", str(log))
    emit(handler, LogEvent.ERROR, "RuleException: CalledProcessError in file", logging.ERROR)
    emit(handler, LogEvent.JOB_ERROR, jobid=1, log=[str(log)])
    emit(handler, None, "Exiting because a job execution failed.", logging.ERROR)
    handler.close()
    handler.close()
    first, *log_lines, last = capsys.readouterr().out.splitlines()
    assert first.endswith("ends with:" if lines else "is empty: the job was killed, or did not start")
    assert log_lines == [f"  {line}" for line in lines]
    assert last == "Failed: fig05/a; 0 of 3 done. Fix the cause; the same command resumes."


def test_a_retry_has_not_failed(handler: LogHandler, capsys: Captured) -> None:
    start(handler, 1, "a")
    emit(handler, LogEvent.JOB_ERROR, jobid=1, log=["none.log"])
    start(handler, 1, "a")
    capsys.readouterr()
    handler.close()
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("restarted", "last"),
    [
        (False, "Stopped: 2 of 3 done. The same command resumes."),
        (True, "fig05: rendered from 2 runs, 3 of 3 done"),
    ],
)
def test_a_job_that_a_cluster_interrupts_has_not_stopped_the_others(
    handler: LogHandler, capsys: Captured, tmp_path: Path, restarted: bool, last: str
) -> None:
    """A job at its time limit is restarted; a later failure of another one is shown."""
    handler._cores = 0
    (tmp_path / "a.log").write_text("interrupted after 4 replicas; --resume continues")
    start(handler, 0, "a", str(tmp_path / "a.log"))
    emit(handler, LogEvent.JOB_ERROR, jobid=0, log=[str(tmp_path / "a.log")])
    start(handler, 1, "b")
    (tmp_path / "b.log").write_text("disk full")
    emit(handler, LogEvent.JOB_ERROR, jobid=1, log=[str(tmp_path / "b.log")])
    assert capsys.readouterr().out.startswith("fig05/b failed after")
    start(handler, 1, "b")
    start(handler, 2)
    if restarted:
        start(handler, 0, "a")
        finish(handler, 0)
    finish(handler, 1, 2)
    handler.close()
    assert capsys.readouterr().out.splitlines()[-1] == last


def test_other_errors_are_shown(handler: LogHandler, capsys: Captured) -> None:
    emit(handler, LogEvent.ERROR, "MissingInputException", logging.ERROR)
    emit(handler, None, "Nothing to be done (all requested files are present and up to date).")
    emit(handler, None, "Select jobs to execute...")
    assert capsys.readouterr().out.splitlines() == [
        "MissingInputException",
        "Nothing to be done (all requested files are present and up to date).",
    ]


@pytest.mark.parametrize(
    ("command", "advice"),
    [
        ("snakemake figures", "The same command resumes."),
        ("snakemake --forceall figures", "The same command starts again; without FRESH=yes it resumes."),
    ],
)
def test_ctrl_c(capsys: Captured, command: str, advice: str) -> None:
    """Jobs also exit before Snakemake reports it: with or without a line in their log."""
    handler = begun(handler_of(), command)
    start(handler, 0, "b")
    emit(handler, LogEvent.JOB_ERROR, jobid=0, log=["none.log"])
    start(handler, 1, "a")
    interrupt(handler)
    handler.close()
    assert capsys.readouterr().out == f"Stopped: 0 of 3 done. {advice}\n"


def test_without_a_workflow_messages_are_those_of_snakemake(capsys: Captured) -> None:
    for start_workflow, expected in ((lambda _: None, "Unlocked working directory.\n"), (begun, "")):
        handler = handler_of()
        emit(handler, None, "Unlocked working directory.")
        start_workflow(handler)
        handler.close()
        assert capsys.readouterr().err == expected


@pytest.mark.parametrize("output", ["dryrun", "verbose", "debug_dag", "printshellcmds"])
def test_other_output_is_left_to_snakemake(capsys: Captured, output: str) -> None:
    handler = begun(handler_of(**{output: True}))
    emit(handler, LogEvent.ERROR, "wrong", logging.ERROR)
    handler.close()
    assert not handler.writes_to_stream
    assert capsys.readouterr().out == ""


def test_the_jobs_go_on_where_stdout_is_full(handler: LogHandler, monkeypatch: pytest.MonkeyPatch) -> None:
    class Full(io.StringIO):
        def write(self, _: str) -> int:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("sys.stdout", Full())
    emit(handler, LogEvent.ERROR, "wrong", logging.ERROR)
    interrupt(handler)
    handler.close()


FILLING = {"relaxation_time": 0, "observation_time": 2, "replicas": 128}


@pytest.mark.parametrize(
    ("name", "options", "expected"),
    [
        ("persistence", {"observation_time": 50, "replicas": 8}, (0, "mu = 0.", [])),
        (
            "persistence",
            {"target_error": 1e-6, "time_limit": 1e-9},
            (4, "mu = 0.", ["target error not reached"]),
        ),
        ("conductivity", {"start": "empty", **FILLING}, (0, "kappa = ", ["not stationary"])),
        ("boltzmann", {}, (0, "error of currents ", [])),
    ],
)
def test_outcome(
    program: Program, tmp_path: Path, name: str, options: dict, expected: tuple[int, str, list]
) -> None:
    status, value, doubts = expected
    assert program(name, **options).returncode == status
    shown = outcome(tmp_path / "out.h5")
    assert shown[0].startswith(value)
    assert shown[1] == doubts


def test_last_lines(tmp_path: Path) -> None:
    log = tmp_path / "a.log"
    assert last_lines(str(log)) == []
    log.write_bytes(b"".join(b"%d \xff\n" % number for number in range(100)))
    assert last_lines(str(log)) == [f"{number} \ufffd" for number in range(100 - LAST, 100)]
