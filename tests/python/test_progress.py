"""Snakemake's display of a small workflow, in a file and on a terminal, and its answers to the failure of a group of jobs."""

import os
import pty
import re
import subprocess
import time
from contextlib import suppress
from pathlib import Path

from tests.python.conftest import ROOT

SNAKEFILE = """
from workflow.pipeline.environment.variables import stop_at_first_signal
onstart:
    stop_at_first_signal()
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
FILLING = "--cells 5 --start empty --relaxation-time 0 --observation-time 2 --replicas 64"
NOT_STATIONARY = f"'{ROOT}/build/bin/conductivity' {FILLING} --output {{output}} 2> {{log}}"
CONTROL = re.compile(r"\x1b\[[0-9;?]*[a-zA-Z]")


def command(folder: Path, simulate: str) -> list[str]:
    (folder / "Snakefile").write_text(SNAKEFILE + repr(simulate))
    return [str(ROOT / ".venv/bin/snakemake"), "--cores=8", "--logger=progress", f"--directory={folder}"]


def test_a_file_has_a_line_per_panel_and_doubtful_result(tmp_path: Path) -> None:
    shown = subprocess.check_output(command(tmp_path, NOT_STATIONARY), cwd=tmp_path, text=True)
    first, second, panel, last = shown.splitlines()
    assert {first[:8], second[:8]} == {"fig05/a:", "fig05/b:"}
    assert re.fullmatch(r"fig05/[ab]: not stationary; 1 of 4 jobs done, elapsed 0:00:\d\d", first)
    assert re.fullmatch(r"fig05: rendered; 3 of 4 jobs done, elapsed 0:00:\d\d", panel)
    assert last.startswith("4 of 4 jobs done")


def test_a_failure_has_the_end_of_its_log(tmp_path: Path) -> None:
    words = command(tmp_path, "seq -f '[bold] %g' 100 > {log}; exit 1")
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    heading, *lines, last = done.stdout.splitlines()
    run = heading[: len("fig05/a")]
    assert heading == f"{run} failed. The end of {run}.log:"
    assert lines == [f"  [bold] {k}" for k in range(89, 101)]
    assert last.startswith(f"Failed: {run}; 0 of 4 jobs done")


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
    assert re.search(r"━+\s*0 of 4 jobs done, elapsed 0:00:\d\d\s+fig05/[ab]  at work", shown)
    assert re.search(r"Stopped; 0 of 4 jobs done, elapsed 0:00:\d\d\.", shown)
    assert "failed" not in shown
    assert "Traceback" not in shown
