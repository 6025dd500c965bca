"""Results do not depend on the instruction set of the processor."""

import os
import subprocess
from pathlib import Path

import h5py
import pytest

from tests.python.conftest import ROOT
from workflow.lib.configuration import arguments
from workflow.lib.plan import Run, load_plan

# Processor features by which the C library selects its functions at run time.
WITHOUT = ",".join(
    f"-{feature}{form}"
    for feature in ("FMA", "FMA4", "AVX", "AVX2", "AVX512F", "SSE4_1", "SSE4_2")
    for form in ("", "_Usable")
)
# One run of every program for each gamma.
RUNS = {
    (run.program, run.options.get("gamma", "N")): run
    for panel in load_plan("smoke").values()
    for run in reversed(panel.runs)
}
FUNCTIONS = {"exp", "expm1", "log", "log1p", "log10", "log2", "pow", "sin", "cos", "erf", "erfc"}


def data_of(run: Run, output: Path, environment: dict[str, str]) -> dict[str, bytes]:
    words = [str(ROOT / "build/bin" / run.program), *arguments(run.options)]
    subprocess.run(
        [*words, "--progress", "none", "--output", str(output)],
        env={"PATH": os.defpath} | environment,
        check=True,
    )
    found = {}
    with h5py.File(output) as file:
        file.visititems(
            lambda name, item: found.update(
                {name: item[()].tobytes()} if isinstance(item, h5py.Dataset) else {}
            )
        )
    return found


@pytest.mark.parametrize(
    "run", RUNS.values(), ids=lambda run: f"{run.program}-{run.options.get('gamma', 'N')}"
)
def test_without_fused_multiply_add(run: Run, tmp_path: Path) -> None:
    full = data_of(run, tmp_path / "full.h5", {})
    plain = data_of(run, tmp_path / "plain.h5", {"GLIBC_TUNABLES": f"glibc.cpu.hwcaps={WITHOUT}"})
    assert len(full) > 5
    assert [name for name in full if full[name] != plain[name]] == []


@pytest.mark.parametrize("program", sorted({run.program for run in RUNS.values()}))
def test_no_elementary_function_of_the_c_library(program: str) -> None:
    symbols = subprocess.run(
        ["nm", "-D", str(ROOT / "build/bin" / program)], capture_output=True, text=True, check=True
    ).stdout
    imported = {line.split()[-1].partition("@")[0] for line in symbols.splitlines() if " U " in line}
    assert "Sleef_cinz_logd1_u35purec" in imported
    assert imported & FUNCTIONS == set()
