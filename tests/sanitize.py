"""Runs all C++ tests, and each program shortly, under AddressSanitizer with UBSan and under ThreadSanitizer.

The first finding of a sanitizer ends the process. Ends with the count of the tests, a program's calls being one each.
"""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

from tests.instrumented import build
from tests.run import REPORTS, Count, count_report

# What each build watches. Beside addresses, the bounds of containers, within which memory may be allocated that is not
# in use. What toml++ calls unreachable is not: its search for blanks gets there for any letter, and answers no.
FLAGS = {
    "address": ["-D_GLIBCXX_ASSERTIONS", "-fsanitize=address,undefined", "-fno-sanitize=unreachable"],
    "thread": ["-fsanitize=thread"],
}
ENVIRONMENT = {
    # What is too large is refused by std::bad_alloc, as without the sanitizer.
    "ASAN_OPTIONS": "allocator_may_return_null=1:detect_stack_use_after_return=1",
    "TSAN_OPTIONS": "halt_on_error=1:allocator_may_return_null=1",
    "UBSAN_OPTIONS": "print_stacktrace=1",
}
THREADS = ["--threads", "2", "--progress", "none"]
SMALL = ["--replicas", "4", *THREADS]
CLOSED = ["--cells", "7", "--particles-per-cell", "4", "--gamma", "2"]
OPEN = ["--cells", "4", "--gamma", "2", "--relaxation-time", "10", "--observation-time", "20"]
ENDED = (0, 4)  # 4: so few replicas have no damping exponent
CALLS = {
    "persistence": [*CLOSED, *SMALL],
    "waiting_time": [*CLOSED, *SMALL],
    "displacement": [*CLOSED, *SMALL],
    "ageing": [*CLOSED, *SMALL],
    "energy_pulse": [*CLOSED, *SMALL],
    "correlation": [*CLOSED, *SMALL],
    "conductivity": [*OPEN, *SMALL],
    "momentum_flux": [*OPEN, *SMALL],
    "particle_count": ["--cells", "4", "--gamma", "2", *SMALL],
    "steady_profile": [*OPEN, *SMALL],
    "boltzmann": ["--cells", "2", "--coarsening", "3", "--progress", "none"],
}


def status_of(*command: str | Path) -> int:
    return subprocess.run(command, env=os.environ | ENVIRONMENT, check=False).returncode


def count_tests(programs: Path) -> Count:
    report = REPORTS / f"{programs.parent.name}.xml"
    report.unlink(missing_ok=True)
    status = status_of(programs / "cpp_tests", "--gtest_brief=1", f"--gtest_output=xml:{report}")
    count = count_report(report)
    if status != 0 and count.failed == 0:
        print(f"The tests broke off with status {status}.")
        count.failed += 1
    return count


def calls(programs: Path, folder: Path) -> Iterable[tuple[str, bool]]:
    """What was called, and whether it ended as it should."""
    for name, words in CALLS.items():
        yield name, status_of(programs / name, *words, "--output", folder / f"{name}.h5") in ENDED

    part = [programs / "persistence", *CALLS["persistence"]]
    for range_ in ("0-1", "2-3"):
        yield (
            f"--part {range_}",
            status_of(*part, "--part", range_, "--output", folder / f"{range_}.part") == 0,
        )
    yield "--join", status_of(*part, "--join", folder, "--output", folder / "joined.h5") == 0

    many = ["--replicas", "1000000"]  # longer than anybody waits
    whole = [programs / "persistence", *CLOSED, *THREADS, *many, "--output", folder / "long.h5"]
    for interruption, resumed in ((signal.SIGINT, []), (signal.SIGTERM, ["--resume"])):
        stopped = stopped_by(interruption, [*whole, *resumed], folder / "long.h5.checkpoint")
        yield f"{interruption.name} {' '.join(resumed)}".strip(), stopped


def stopped_by(interruption: signal.Signals, command: list[str | Path], checkpoint: Path) -> bool:
    """Whether a run that is interrupted says so and leaves a checkpoint."""
    with subprocess.Popen([*command, "--checkpoint-interval", "0.5"], env=os.environ | ENVIRONMENT) as run:
        try:
            run.wait(5)
        except subprocess.TimeoutExpired:
            run.send_signal(interruption)
    return run.returncode == 128 + interruption and checkpoint.is_file()


def main() -> int:
    REPORTS.mkdir(parents=True, exist_ok=True)
    total = Count()
    for name, flags in FLAGS.items():
        print(f"{name} sanitizer", flush=True)
        programs = build(name, flags, ["cpp_tests", "all"])
        total.add(count_tests(programs))
        with tempfile.TemporaryDirectory() as folder:
            for call, well in calls(programs, Path(folder)):
                total.add(Count(passed=int(well), failed=int(not well)))
                if not well:
                    print(f"{call} under the {name} sanitizer ended otherwise than it should")
    print(total)
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main())
