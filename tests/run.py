"""Runs every test, C++ and Python, and ends with `N passed, N failed` (`, N skipped` where it applies); with --long also
those that take minutes.

Fails if a test fails, if a suite breaks off, or if one of the suites ran no test.
"""

import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

REPORTS = Path("build/tests")
PYTEST = [sys.executable, "-m", "pytest", "-c", "tests/pytest.ini"]
# Files in alphabetical order: pytest-xdist would begin those with the fewest tests last, which take longest, and leave a worker idle.
PYTEST += ["-n", "2", "--dist", "loadfile", "--no-loadscope-reorder"]
PYTEST += ["--durations=25", "tests", f"--junitxml={REPORTS}/python.xml"]
LONG, SHORT = "--long", ["-m", "not long"]
SHARDS = 2  # of the C++ tests, beside each other


@dataclass
class Count:
    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def add(self, other: "Count") -> None:
        self.passed += other.passed
        self.failed += other.failed
        self.skipped += other.skipped

    def __str__(self) -> str:
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        return f"{self.passed} passed, {self.failed} failed{skipped}"


def count_report(report: Path) -> Count:
    """Test cases of a JUnit report; all zero if there is none."""
    count = Count()
    if not report.is_file():
        return count
    for case in ElementTree.parse(report).iter("testcase"):
        outcomes = {child.tag for child in case}
        if outcomes & {"failure", "error"}:
            count.failed += 1
        elif "skipped" in outcomes or case.get("status") == "notrun":
            count.skipped += 1
        else:
            count.passed += 1
    return count


def cpp_command(shard: int) -> list[str]:
    """GoogleTest takes from the environment which tests of how many shards it runs."""
    shards = [f"GTEST_TOTAL_SHARDS={SHARDS}", f"GTEST_SHARD_INDEX={shard}"]
    return [
        "env",
        *shards,
        "build/bin/cpp_tests",
        "--gtest_brief=1",
        f"--gtest_output=xml:{REPORTS}/cpp{shard}.xml",
    ]


def run_suite(name: str, commands: Sequence[Sequence[str]]) -> Count:
    """Beside each other; their reports are those of the name."""
    for report in REPORTS.glob(f"{name}*.xml"):
        report.unlink()
    running = [subprocess.Popen(command) for command in commands]
    statuses = [one.wait() for one in running]
    count = Count()
    for report in REPORTS.glob(f"{name}*.xml"):
        count.add(count_report(report))
    if any(statuses) and count.failed == 0:
        print(f"The {name} tests broke off with status {max(statuses, key=abs)}.")
        count.failed += 1
    if count.passed + count.failed == 0:
        print(f"No {name} test ran.")
        count.failed += 1
    return count


def main() -> int:
    REPORTS.mkdir(parents=True, exist_ok=True)
    python = PYTEST if LONG in sys.argv else [*PYTEST, *SHORT]
    total = Count()
    for name, commands in (("cpp", [cpp_command(shard) for shard in range(SHARDS)]), ("python", [python])):
        print(f"{name} tests", flush=True)
        total.add(run_suite(name, commands))
    print(total)
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main())
