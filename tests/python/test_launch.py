"""A module of the project is its own source file, whatever else lies there by its name."""

import os
import py_compile
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.python.conftest import ROOT

LAUNCH = "workflow/environment/launch.py"
FALSE = "raise SystemExit('another file was run')\n"


def write(path: str) -> Callable[[Path], object]:
    def put(root: Path) -> None:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(FALSE)

    return put


def compile_falsely(root: Path) -> None:
    """Byte code that Python believes without a look at the source."""
    false = root / "false.py"
    false.write_text(FALSE)
    compiled = root / f"workflow/lib/__pycache__/part.{sys.implementation.cache_tag}.pyc"
    mode = py_compile.PycInvalidationMode.UNCHECKED_HASH
    py_compile.compile(str(false), str(compiled), invalidation_mode=mode)


@pytest.mark.parametrize(
    "put",
    [
        write("workflow/lib/part/__init__.py"),
        write("workflow/lib/__init__.py"),
        write("workflow/__init__.py"),
        write("workflow.py"),
        write("json.py"),
        write(f"workflow/lib/part.{sys.implementation.cache_tag}-x86_64-linux-gnu.so"),
        compile_falsely,
    ],
)
def test_nothing_takes_the_place_of_a_module(tmp_path: Path, put: Callable[[Path], object]) -> None:
    for folder in ("workflow/lib", "workflow/environment"):
        (tmp_path / folder).mkdir(parents=True)
    shutil.copyfile(ROOT / LAUNCH, tmp_path / LAUNCH)
    (tmp_path / "workflow/lib/part.py").write_text("import json\nWORD = json.dumps('true')\n")
    (tmp_path / "workflow/lib/whole.py").write_text("from workflow.lib import part\nprint(part.WORD)\n")
    put(tmp_path)
    assert run(tmp_path, "workflow.lib.whole").stdout == '"true"\n'
    assert "workflow/lib/none.py is no file" in run(tmp_path, "workflow.lib.none").stderr


def run(root: Path, module: str, **variables: str) -> subprocess.CompletedProcess:
    command, variables = [sys.executable, "-P", LAUNCH, module], {"PATH": os.defpath, **variables}
    return subprocess.run(
        command, cwd=root, env=variables, capture_output=True, text=True, check=False, timeout=60
    )


def test_no_list_of_fonts_is_waited_for(tmp_path: Path) -> None:
    (tmp_path / "workflow/environment").mkdir(parents=True)
    shutil.copy(ROOT / LAUNCH, tmp_path / LAUNCH)
    (tmp_path / "workflow/a.py").write_text("import matplotlib.font_manager")
    fonts = tmp_path / "fontlist-v390.json"
    os.mkfifo(fonts)
    done = run(tmp_path, "workflow.a", MPLCONFIGDIR=str(tmp_path))
    assert (done.returncode, done.stderr.startswith(f"{fonts} is no file")) == (1, True)


@pytest.mark.parametrize(
    ("said", "status", "words"),
    [
        ("raise KeyboardInterrupt", 1, "Stopped.\n"),
        ("print(1, flush=True); raise BrokenPipeError(32, 'Broken pipe')", 141, ""),
        (
            "raise OSError(28, 'No space left on device')",
            1,
            "The system does not let this go on: No space left on device\n",
        ),
        ("raise MemoryError", 1, "The system does not let this go on: there is not enough memory\n"),
    ],
)
def test_what_a_user_does_is_no_traceback(tmp_path: Path, said: str, status: int, words: str) -> None:
    for path in (LAUNCH, "workflow/lib/places.py"):
        (tmp_path / path).parent.mkdir(parents=True)
        shutil.copy(ROOT / path, tmp_path / path)
    (tmp_path / "workflow/a.py").write_text(said)
    done = subprocess.run(
        [sys.executable, "-P", LAUNCH, "workflow.a"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (status, words)


def test_a_closed_output_is_said(tmp_path: Path) -> None:
    (tmp_path / "workflow/environment").mkdir(parents=True)
    shutil.copy(ROOT / LAUNCH, tmp_path / LAUNCH)
    (tmp_path / "workflow/a.py").write_text("print(1)")
    closed = ["sh", "-c", f"{shlex.quote(sys.executable)} -P {LAUNCH} workflow.a >&-"]
    done = subprocess.run(closed, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.startswith("Standard output is closed")) == (1, True)
