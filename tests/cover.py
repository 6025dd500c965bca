"""Lines of the programs and of the workflow that tests execute; less than SHARE of either fails.

All tests, but for those that take minutes, run in a copy of the project. Its programs count their lines, and its launcher starts
to count those of every module that it runs, also in the copies that tests make of the project in their turn.
"""

import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from tests.instrumented import COMMON
from tests.workflow.conftest import ROOT, clone_into

SHARE = 95  # percent
COPY = ROOT / "build/instrumented/coverage"
COUNTS = COPY / "build/counts"
FLAGS = ";".join([*COMMON, "--coverage"])  # threads may lose counts of each other, but not all of a line
# Runs in every process; what is started by -I -S lacks the packages.
START = f"""
import atexit, sys
sys.path.append({sysconfig.get_path("purelib")!r})
import coverage
sys.path.pop()
_counter = coverage.Coverage(data_file={str(COUNTS / "lines")!r}, data_suffix=True, messages=False,
                             include="*/workflow/*", omit=["*/site-packages/*", "*/tests/*"])
_counter.start()
atexit.register(lambda: (_counter.stop(), _counter.save()))
"""
PLACES = f"""[paths]
workflow =
    {COPY}/workflow
    */workflow
[report]
show_missing = True
skip_covered = True
ignore_errors = True
"""


def run(*command: str | Path) -> bool:
    return subprocess.run(command, cwd=COPY, check=False).returncode == 0


def make_copy() -> None:
    shutil.rmtree(COPY, ignore_errors=True)
    COPY.mkdir(parents=True)
    clone = clone_into(COPY)
    COUNTS.mkdir()
    launcher, first = COPY / "workflow/environment/launch.py", "ROOT = Path("
    text = launcher.read_text()
    launcher.write_text(text.replace(first, f"exec({START!r})\n{first}", 1))
    (COPY / "tests/conftest.py").write_text(START)
    clone.git("init", "--quiet")
    clone.commit()
    (COPY / "build/ccache").symlink_to(ROOT / "build/ccache")
    quietly = ["-S", "cpp", "-B", "build", "-G", "Ninja", "--log-level=WARNING"]
    run("cmake", *quietly, f"-DINSTRUMENTATION={FLAGS}")
    if not run("ninja", "-C", "build", "--quiet", "cpp_tests", "all"):
        sys.exit("the copy was not built")


def main() -> int:
    make_copy()
    python = COPY / ".venv/bin/python"
    run(python, "-P", "workflow/environment/launch.py", "tests.run")
    (COUNTS / "settings").write_text(PLACES)
    settings = [f"--rcfile={COUNTS}/settings", f"--data-file={COUNTS}/lines"]
    run(python, "-m", "coverage", "combine", *settings, "--quiet", "--keep")
    programs = ["--root", "cpp", "--object-directory", "build", "--exclude", "cpp/bench/", "--exclude-throw-branches",
                "--gcov-ignore-parse-errors=negative_hits.warn_once_per_file", "--gcov-suspicious-hits-threshold=0", "--fail-under-line", str(SHARE)]  # fmt: skip
    covered = [
        run(python, "-m", "gcovr", *programs),
        run(python, "-m", "coverage", "report", *settings, f"--fail-under={SHARE}"),
    ]
    return 0 if all(covered) else 1


if __name__ == "__main__":
    sys.exit(main())
