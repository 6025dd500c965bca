"""Elementary functions of the C library depend on the processor: programs and GSL use those of cpp/numerics/elementary.cpp instead."""

import os
import re
import subprocess
from pathlib import Path

import pytest

from workflow.lib.described import described

ROOT = Path(__file__).parents[2]
EXACT = {  # correctly rounded, or without rounding
    *("sqrt", "fabs", "fmod", "frexp", "ldexp", "modf", "scalbn", "logb", "ilogb", "floor", "ceil", "trunc"),
    *("round", "lround", "llround", "rint", "nearbyint", "fmin", "fmax", "fma", "copysign", "nextafter"),
}


def inexact(program: Path) -> set[str]:
    """Functions of libm that are not exact and to which the program or libgsl is bound."""
    environment = os.environ | {"LD_BIND_NOW": "1", "LD_DEBUG": "bindings"}
    done = subprocess.run(
        [program, "--version"], env=environment, capture_output=True, text=True, check=False
    )
    bound = re.findall(r"binding file (\S.*) \[0\] to \S*libm\S* \[0\]: normal symbol `(\w+)'", done.stderr)
    own = (f"/{program.name}", "libgsl.so")
    return {name for file, name in bound if any(part in f"/{file}" for part in own)} - EXACT


@pytest.mark.parametrize("program", described())
def test_no_program_uses_an_inexact_function_of_libm(program: str) -> None:
    assert inexact(ROOT / "build/bin" / program) == set()


@pytest.mark.long
def test_a_program_without_elementary_functions_of_its_own_is_found(tmp_path: Path) -> None:
    (tmp_path / "plain.cpp").write_text(
        "#include <gsl/gsl_sf.h>\nint main() { return gsl_sf_expint_E1(2) > 1; }\n"
    )
    subprocess.run(["c++", "plain.cpp", "-o", "plain", "-lgsl", "-lgslcblas"], cwd=tmp_path, check=True)
    assert {"exp", "log"} <= inexact(tmp_path / "plain")
