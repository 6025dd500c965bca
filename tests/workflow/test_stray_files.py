"""Files of no commit that lie among the sources take the place of none of them."""

import os
import shutil
import subprocess
from pathlib import Path

from tests.workflow.conftest import ROOT, configure

STRAY = ("sleef.h", "numerics/cmath", "engine/Copy of open_start.cpp", "numerics/more.cpp")


def test_only_what_is_named_is_compiled(tmp_path: Path) -> None:
    """No header of the project is found in the place of a library's, and no source is linked that CMake is not told."""
    for folder in ("cpp", "tests/cpp"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    for path in STRAY:
        (tmp_path / "cpp" / path).write_text("#error a stray file was compiled\n")
    configure(tmp_path)
    command = ["ninja", "-C", "build", "--quiet", "numerics", "engine"]
    subprocess.run(command, cwd=tmp_path, env={"PATH": os.defpath}, check=True)
