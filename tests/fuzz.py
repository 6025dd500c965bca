"""Runs every fuzzer for some seconds: python -m tests.fuzz SECONDS. What is found is kept, and found first the next time.

Inputs that led further are kept in build/fuzz/NAME and begin the next run; inputs with a finding lie beside them.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

from tests.instrumented import build

FLAGS = [
    "-D_GLIBCXX_ASSERTIONS",
    "-fsanitize=fuzzer-no-link,address,undefined",
    "-fno-sanitize=unreachable",  # where toml++ looks for blanks and meets any letter; it answers no
    "-w",  # warnings are the business of GCC
]
SEEDS = Path("tests/cpp/fuzz/corpus")
NAMES = ("options", "config_file", "record_file", "hdf5_reader")
LIMITS = ["-rss_limit_mb=2048", "-timeout=20", "-close_fd_mask=1"]  # the last: --help is not shown
HDF5 = (
    "record_file",
    "hdf5_reader",
)  # the library does not free all that it had read of a file it then refuses


def fuzz(programs: Path, name: str, seconds: str) -> bool:
    """Whether nothing was found. Prints the number of inputs and what of the code they reached."""
    kept = Path("build/fuzz") / name
    kept.mkdir(parents=True, exist_ok=True)
    seeds = [SEEDS / name] if (SEEDS / name).is_dir() else []
    options = [
        *LIMITS,
        f"-max_total_time={seconds}",
        f"-artifact_prefix={kept}.",
        f"-detect_leaks={int(name not in HDF5)}",
    ]
    command = [programs / f"fuzz_{name}", *options, kept, *seeds]
    run = subprocess.run(
        command, env=os.environ, stderr=subprocess.PIPE, text=True, errors="replace", check=False
    )
    reached = re.findall(r"^#(\d+).* cov: (\d+) ft: (\d+)", run.stderr, re.MULTILINE)[-1:]
    for inputs, edges, features in reached:
        print(f"{name}: {inputs} inputs, {edges} edges, {features} features", flush=True)
    if run.returncode != 0:
        print(run.stderr[-6000:])
    return run.returncode == 0


def main(seconds: str) -> int:
    programs = build("fuzz", FLAGS, [f"fuzz_{name}" for name in NAMES], "clang++")
    found = [name for name in NAMES if not fuzz(programs, name, seconds)]
    print(f"Findings in {', '.join(found)}" if found else "Nothing found")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
