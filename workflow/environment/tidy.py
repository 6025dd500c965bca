"""Runs clang-tidy on every C++ source of the project; one that was clean is not looked at again until it differs.

A source differs when its compile command, one of the files that it includes, those of the system too, the rules or
clang-tidy differ. What was clean is noted in build/tidy, a file for a source: the digest of all these, then their names.
"""

import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from workflow.lib.places import require_place

ROOT = Path(__file__).resolve().parents[2]
BUILD, NOTES = ROOT / "build", ROOT / "build/tidy"
TIDY = Path(sys.executable).with_name("clang-tidy")
FOLDERS = (ROOT / "cpp", ROOT / "tests/cpp")
RULES = (ROOT / ".clang-tidy", ROOT / "tests/cpp/.clang-tidy")


def commands() -> dict[Path, str]:
    """How each source is compiled, without ccache, and without GCC's precompiled header, which is none for clang; what it
    holds is included anyway."""
    listed = json.loads(subprocess.check_output(["ninja", "-C", BUILD, "-t", "compdb"]))
    return {
        Path(each["file"]): of_the_compiler(each["command"])
        for each in listed
        if " -c " in each["command"] and any(Path(each["file"]).is_relative_to(one) for one in FOLDERS)
    }


def of_the_compiler(command: str) -> str:
    words = shlex.split(command)
    launchers = [place for place, word in enumerate(words, 1) if Path(word).name == "ccache"]
    words = words[max(launchers, default=0) :]
    if "-Winvalid-pch" in words:  # before -include and the header
        place = words.index("-Winvalid-pch")
        del words[place : place + 3]
    return shlex.join(words)


@cache
def digest_of(path: str) -> str:
    file = Path(path)
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else "missing"


def digest(command: str, files: list[str]) -> str:
    text = "\n".join([command, *(f"{name} {digest_of(name)}" for name in files)])
    return hashlib.sha256(text.encode()).hexdigest()


def included(command: str) -> list[str]:
    """All files that the compiler reads for a source."""
    words = shlex.split(command.partition(" -MD ")[0])
    rule = subprocess.check_output([*words, "-M", shlex.split(command)[-1]], cwd=BUILD, text=True)
    _, *names = re.split(r"(?<!\\)\s+", rule.replace("\\\n", " ").strip())
    return sorted({os.path.normpath(BUILD / name.replace("\\ ", " ")) for name in names})


def note_of(source: Path) -> Path:
    return NOTES / str(source.relative_to(ROOT)).replace("/", "__")


def is_clean(source: Path, command: str) -> bool:
    note = note_of(source)
    if not note.is_file():
        return False
    noted, *files = note.read_text("utf-8").splitlines()
    return noted == digest(command, files)


def look_at(source: Path, command: str) -> str:
    """What clang-tidy finds; empty if nothing, which is noted."""
    files = [*map(str, RULES), str(TIDY), *included(command)]
    before = digest(command, files)
    run = subprocess.run(
        [TIDY, "--quiet", f"-p={NOTES}", source], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if run.returncode == 0:
        note_of(source).write_text("\n".join([before, *files]), "utf-8")
        return ""
    return run.stdout or run.stderr


def main() -> None:
    database = require_place(NOTES / "compile_commands.json", ROOT)
    NOTES.mkdir(parents=True, exist_ok=True)
    compiled = commands()
    entries = [{"file": str(file), "command": compiled[file], "directory": str(BUILD)} for file in compiled]
    database.write_text(json.dumps(entries), "utf-8")
    changed = {source: command for source, command in compiled.items() if not is_clean(source, command)}
    if changed:
        print(f"clang-tidy looks at {len(changed)} of {len(compiled)} sources", flush=True)
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        found = [text for text in threads.map(look_at, changed, changed.values()) if text]
    print("\n".join(found), end="")
    if found:
        sys.exit(f"clang-tidy: {len(found)} of {len(compiled)} sources are not as .clang-tidy wants them")


if __name__ == "__main__":
    main()
