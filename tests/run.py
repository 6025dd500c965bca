"""Runs every test, C++ and Python, and ends with `N passed, N failed` (`, N skipped` where it applies); with --long also
those that take minutes.

Fails if a test fails, if a suite breaks off, or if one of the suites ran no test.
"""

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

REPORTS = Path("build/tests")
PYTEST = [sys.executable, "-m", "pytest", "-c", "tests/pytest.ini"]
# Files in alphabetical order: pytest-xdist would begin those with the fewest tests last, which take longest, and leave a worker idle.
PYTEST += ["-n", "2", "--dist", "loadfile", "--no-loadscope-reorder"]
SUITES = {
    "cpp": ["build/bin/cpp_tests", "--gtest_brief=1", "--gtest_output=xml:{report}"],
    "python": [*PYTEST, "--durations=25", "tests", "--junitxml={report}"],
}
LONG, SHORT = "--long", ["-m", "not long"]


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


def run_suite(name: str, command: list[str]) -> Count:
    report = REPORTS / f"{name}.xml"
    report.unlink(missing_ok=True)
    status = subprocess.run([part.format(report=report) for part in command], check=False).returncode
    count = count_report(report)
    if status != 0 and count.failed == 0:
        print(f"The {name} tests broke off with status {status}.")
        count.failed += 1
    if count.passed + count.failed == 0:
        print(f"No {name} test ran.")
        count.failed += 1
    return count


def main() -> int:
    REPORTS.mkdir(parents=True, exist_ok=True)
    total = Count()
    for name, command in SUITES.items():
        print(f"{name} tests", flush=True)
        chosen = SHORT if name == "python" and LONG not in sys.argv else []
        total.add(run_suite(name, [*command, *chosen]))
    print(total)
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main())
