"""What clang-tidy is given: the commands of the compiler itself, whatever it is launched by."""

import shlex
from pathlib import Path

from tests.python.conftest import ROOT
from workflow.environment.tidy import commands


def test_commands_are_those_of_the_compiler() -> None:
    found = commands()
    sources = {*(ROOT / "cpp").rglob("*.cpp"), *(ROOT / "tests/cpp").rglob("*_test.cpp")}
    fuzzed = {source for source in sources if "fuzz" in source.parts}
    assert sources - fuzzed <= found.keys()
    for source, command in found.items():
        compiler, *words = shlex.split(command)
        assert Path(compiler).name.endswith("++")
        assert words[-1] == str(source)
        assert "-Winvalid-pch" not in words
