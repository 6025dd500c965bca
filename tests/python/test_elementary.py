"""Elementary functions of the C library depend on the processor: programs and GSL use those of
cpp/numerics/elementary.cpp instead."""

import os
import re
import subprocess
from pathlib import Path

import pytest

from tests.python.described import described

ROOT = Path(__file__).parents[2]
EXACT = {  # correctly rounded, or without rounding
    *("sqrt", "fabs", "fmod", "frexp", "ldexp", "modf", "scalbn", "logb", "ilogb", "floor", "ceil", "trunc"),
    *("round", "lround", "llround", "rint", "nearbyint", "fmin", "fmax", "fma", "copysign", "nextafter"),
}


@pytest.mark.parametrize("program", described())
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
