"""Results do not depend on the processor: x86-64 with and without FMA, AVX and SSE 4."""

import os
import re
import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import ROOT, command_line
from tests.python.described import described

# Processor features by which the C library selects its functions at run time.
WITHOUT = ",".join(
    f"-{feature}{form}"
    for feature in ("FMA", "FMA4", "AVX", "AVX2", "AVX512F", "SSE4_1", "SSE4_2")
    for form in ("", "_Usable")
)
MASKED = {"GLIBC_TUNABLES": f"glibc.cpu.hwcaps={WITHOUT}"}
# The programs and GSL use the elementary functions of cpp/numerics/elementary.cpp.
EXACT = {  # correctly rounded, or without rounding
    *("sqrt", "fabs", "fmod", "frexp", "ldexp", "modf", "scalbn", "logb", "ilogb", "floor", "ceil", "trunc"),
    *("round", "lround", "llround", "rint", "nearbyint", "fmin", "fmax", "fma", "copysign", "nextafter"),
}
PROGRAMS = sorted(path.stem for path in (ROOT / "cpp/observables").glob("*.cpp"))


@pytest.mark.parametrize("gamma", ["N", 1.3])
@pytest.mark.parametrize("program", PROGRAMS)
def test_without_fused_multiply_add(program: str, gamma: str | float, tmp_path: Path) -> None:
    """Control variates are used from 27 replicas on."""
    options = {"gamma": gamma, "replicas": 32, "progress": "none"}
    given = {name: options[name] for name in options if name in described()[program]["options"]}
    command = command_line(program, given | ({"cells": 5} if program == "boltzmann" else {}))

    def result(environment: dict[str, str]) -> bytes:
        output = [*command, "--overwrite", "--output", "out.h5"]
        subprocess.run(output, cwd=tmp_path, env={"PATH": os.defpath} | environment, check=True)
        return (tmp_path / "out.h5").read_bytes()

    assert result(MASKED) == result({})


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


@pytest.mark.parametrize("program", PROGRAMS)
def test_no_program_uses_an_inexact_function_of_libm(program: str) -> None:
    """Neither the program nor libgsl is bound to one."""
    environment = os.environ | {"LD_BIND_NOW": "1", "LD_DEBUG": "bindings"}
    command = [ROOT / "build/bin" / program, "--version"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    bound = re.findall(r"binding file (\S.*) \[0\] to \S*libm\S* \[0\]: normal symbol `(\w+)'", done.stderr)
    own = (f"/{program}", "libgsl.so")
    found = {name for file, name in bound if any(part in f"/{file}" for part in own)}
    assert found & EXACT  # the linker has printed what is bound
    assert found - EXACT == set()
