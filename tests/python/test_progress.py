"""What make figures shows: what came out, what is left, what went wrong."""

import errno
import io
from pathlib import Path

import pytest
from workflow.execution.display import Display, Running
from workflow.execution.outcome import LAST, Outcome, last_lines, outcome
from workflow.execution.remaining import BESIDE, Remaining, clock, foretold

from tests.python.conftest import Program
from workflow.lib.plan import load_plan

PLAN = load_plan("standard")


@pytest.mark.parametrize(
    ("seconds", "text"), [(0, "0:00"), (0.2, "0:01"), (59.5, "1:00"), (61, "1:01"), (3723, "1:02:03")]
)
def test_clock(seconds: float, text: str) -> None:
    assert clock(seconds) == text


def test_remaining_time_follows_what_finished_jobs_took() -> None:
    remaining = Remaining({"a": 10.0, "b": 10.0, "c": 20.0, "d": 20.0}, cores=2)
    assert remaining.seconds({}) == 30
    remaining.finish("a", 20.0)  # this machine takes twice as long
    assert remaining.seconds({}) == 50
    assert remaining.seconds({"b": (4.0, 2)}) == 46  # 12 core seconds of b, 40 of c and of d
    remaining.finish("c", 40.0)
    remaining.finish("d", 40.0)
    assert remaining.seconds({"b": (4.0, 1)}) == 16  # no core helps the last job
    assert remaining.seconds({"b": (400.0, 1)}) == 0
    remaining.finish("b", 20.0)
    assert remaining.seconds({}) == 0


def test_every_job_of_the_plan_is_foretold() -> None:
    jobs = [f"{panel.name}/{run.name}" for panel in PLAN.values() for run in panel.runs] + list(PLAN)
    costs = foretold(PLAN, jobs)
    assert list(costs) == jobs
    assert sum(cost == BESIDE for cost in costs.values()) == 0


def test_outcome_of_a_run(program: Program, tmp_path: Path) -> None:
    assert program("persistence", observation_time=50, replicas=8).returncode == 0
    assert outcome(tmp_path / "out.h5").text.startswith("mu = 0.")
    assert outcome(tmp_path / "out.h5").doubts == ()
    assert program("persistence", target_error=1e-6, max_replicas=4).returncode == 4
    assert outcome(tmp_path / "out.h5").doubts == ("target error not reached",)
    filling = {"particles_per_cell": None, "relaxation_time": 0, "observation_time": 2, "replicas": 128}
    assert program("conductivity", start="empty", **filling).returncode == 0
    assert outcome(tmp_path / "out.h5").doubts == ("not stationary",)
    computed = dict.fromkeys(("particles_per_cell", "relaxation_time", "observation_time", "replicas"))
    assert program("boltzmann", **computed).returncode == 0
    assert outcome(tmp_path / "out.h5").text.startswith("error of currents ")
    (tmp_path / "out.h5").write_bytes(b"no result")
    assert outcome(tmp_path / "out.h5") == Outcome("")


def test_last_lines(tmp_path: Path) -> None:
    log = tmp_path / "a.log"
    assert last_lines(log) == []
    log.write_bytes(b"".join(b"%d \xff\n" % number for number in range(100)))
    assert last_lines(log) == [f"{number} \ufffd" for number in range(100 - LAST, 100)]


def running(job: str) -> Running:
    return Running(job, 0.0, 1, Path("a.log"))


def begun() -> Display:
    display = Display()
    costs = {"fig05/a": 1.0, "fig05/b": 1.0, "fig05": 1.0}
    display.begin(costs, Remaining(costs, cores=1))
    return display


def test_in_a_pipe_there_is_a_line_per_panel(capsys: pytest.CaptureFixture) -> None:
    display = begun()
    display.finish_run(running("fig05/a"), Outcome("mu = 0.3289(30)"))
    display.finish_run(running("fig05/b"), Outcome("mu = 0.3289(30)", ("not stationary",)))
    display.finish_panel(running("fig05"), 2)
    display.end()
    assert capsys.readouterr().out.splitlines() == [
        "fig05: drawn from 2 runs, 3 of 3 done",
        "fig05/b: not stationary: marked in the figure",
    ]


def test_a_job_that_was_not_foretold_counts(capsys: pytest.CaptureFixture) -> None:
    display = begun()
    for job in ("fig05/a", "fig05/b", "fig06/a", "fig06/a", "fig05"):  # one of them twice
        display.start(running(job))
        display.finish_run(running(job), Outcome(""))
    display.finish_panel(running("fig06"), 1)
    assert capsys.readouterr().out == "fig06: drawn from 1 run, 5 of 5 done\n"


def test_a_failure_is_shown_with_the_end_of_its_log(capsys: pytest.CaptureFixture) -> None:
    display = begun()
    display.fail(running("fig05/a"), ["[bold] disk full"])
    display.end()
    display.end()
    _, line, end = capsys.readouterr().out.splitlines()
    assert line == "  [bold] disk full"
    assert end.startswith("Failed: fig05/a; 0 of 3 done. When the cause is mended, the same command goes on")


def test_a_failure_that_left_no_word_says_so(capsys: pytest.CaptureFixture) -> None:
    display = begun()
    display.fail(running("fig05/a"), [])
    assert capsys.readouterr().out.endswith("a.log is empty: it was killed, or never began\n")


def test_what_is_stopped_says_how_to_go_on(capsys: pytest.CaptureFixture) -> None:
    display = begun()
    display.finish_run(running("fig05/a"), Outcome(""))
    display.end()
    assert capsys.readouterr().out == "Stopped: 1 of 3 done. The same command goes on.\n"


def test_nothing_is_said_where_nothing_began(capsys: pytest.CaptureFixture) -> None:
    Display().end()
    assert capsys.readouterr().out == ""


def test_nobody_reads_what_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    """The jobs go on."""

    class Full(io.StringIO):
        def write(self, _: str) -> int:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("sys.stdout", Full())
    display = Display()
    display.say("once")
    display.say("twice")
