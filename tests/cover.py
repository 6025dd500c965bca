"""Lines of the programs and of the workflow that tests execute; less than SHARE of the lines fails.

C++ by its own tests and by a short call of every program. The workflow by the Python tests; what they start in a folder of its
own, as make does, runs without the packages that could count, so that its lines are missing here.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from tests.instrumented import build
from tests.run import REPORTS
from tests.sanitize import calls, count_tests

SHARE = 95  # percent
FLAGS = ["--coverage"]  # threads may lose counts of each other, but not all of a line
IN_PROCESS = ["-m", "pytest", "-c", "tests/pytest.ini", "-m", "not long", "tests/python"]


def covers(*command: str | Path) -> bool:
    return subprocess.run([sys.executable, "-m", *command], check=False).returncode == 0


def programs_are_covered() -> bool:
    programs = build("coverage", FLAGS, ["cpp_tests", "all"])
    for counted in programs.parent.rglob("*.gcda"):
        counted.unlink()
    print(count_tests(programs))
    with tempfile.TemporaryDirectory() as folder:
        wrong = [call for call, well in calls(programs, Path(folder)) if not well]
    print(*(f"{call} ended otherwise than it should" for call in wrong), sep="\n")
    which = ["--root", "cpp", "--object-directory", programs.parent, "--exclude", "cpp/bench/"]
    return covers("gcovr", *which, "--exclude-throw-branches", "--fail-under-line", str(SHARE))


def workflow_is_covered() -> bool:
    covers("coverage", "run", "--source=workflow", "--data-file=build/tests/coverage", *IN_PROCESS)
    return covers(
        "coverage", "report", "--data-file=build/tests/coverage", "--show-missing", f"--fail-under={SHARE}"
    )


def main() -> int:
    REPORTS.mkdir(parents=True, exist_ok=True)
    covered = [programs_are_covered(), workflow_is_covered()]
    return 0 if all(covered) else 1


if __name__ == "__main__":
    sys.exit(main())
