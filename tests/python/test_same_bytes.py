"""Results do not depend on the processor: x86-64 with and without FMA, AVX and SSE 4."""

import os
import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from tests.python.conftest import ROOT, planned
from workflow.pipeline.configuration import arguments
from workflow.pipeline.plan import Run

# Processor features by which the C library selects its functions at run time.
WITHOUT = ",".join(
    f"-{feature}{form}"
    for feature in ("FMA", "FMA4", "AVX", "AVX2", "AVX512F", "SSE4_1", "SSE4_2")
    for form in ("", "_Usable")
)
MASKED = {"GLIBC_TUNABLES": f"glibc.cpu.hwcaps={WITHOUT}"}
PROGRAMS = sorted(path.stem for path in (ROOT / "cpp/observables").glob("*.cpp"))


def shortened(run: Run) -> Run:
    """A run with its options and sizes, but few replicas and short times. Times of peaks stay."""
    options = dict(run.options)
    is_open = "nu-left" in options
    for name in ("relaxation-time", "observation-time"):
        if name in options:
            options[name] /= 1000 if is_open else 200
    times = [float(time) for time in str(options.get("times", 0)).split(",")]
    if "observation-time" in options:
        options["observation-time"] = max(times[-1], options["observation-time"])
    if "times" in options and is_open:
        options["times"] = ",".join(str(time / 1000) for time in times)
    # Control variates need 27 replicas.
    options |= {"replicas": 32 if is_open else 3} if "replicas" in options else {}
    options |= {"pairs-per-replica": 1} if "pairs-per-replica" in options else {}
    return replace(run, options=options)


# One run of every program for each gamma.
SMALL = {
    f"{run.program}-{run.options.get('gamma', 'N')}": shortened(run)
    for panel in planned("smoke")
    for run in reversed(panel.runs)
}


def result_of(command: list[str], options: dict, output: Path, environment: dict[str, str]) -> bytes:
    done = subprocess.run(
        [*command, *arguments(options), "--progress", "none", "--output", str(output)],
        env={"PATH": os.defpath} | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 4), done.stderr  # 4: the target error was not reached
    return output.read_bytes()


def test_every_program_has_a_case() -> None:
    assert {run.program for run in SMALL.values()} == {*PROGRAMS}


@pytest.mark.parametrize("name", SMALL)
def test_without_fused_multiply_add(name: str, tmp_path: Path) -> None:
    run = SMALL[name]
    program = [str(ROOT / "build/bin" / run.program)]
    full = result_of(program, run.options, tmp_path / "full.h5", {})
    assert result_of(program, run.options, tmp_path / "masked.h5", MASKED) == full


@pytest.mark.long
@pytest.mark.parametrize("program", PROGRAMS)
def test_no_instruction_depends_on_the_processor(program: str) -> None:
    """Programs use no 80-bit arithmetic, and query neither caches nor instruction sets."""
    command = ["objdump", "-d", "-C", "--no-show-raw-insn", ROOT / "build/bin" / program]
    function, functions = "", set()
    for line in subprocess.check_output(command, text=True).splitlines():
        if line.endswith(">:"):
            function = line
        elif re.search(r"\t(fld|fadd|fmul|fild|fst|cpuid|xgetbv|vfmadd)", line):
            functions.add(function)
    assert not functions
