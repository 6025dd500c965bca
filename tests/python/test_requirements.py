"""What is imported is asked for, what is asked for is used, and all of it is locked by hash."""

import re
import sys
from collections.abc import Iterator
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from tests.python.test_imports import imported_modules

STARTED = {  # not imported
    "snakemake-executor-plugin-slurm": "by Snakemake, for PROFILE=slurm",
    "axe-playwright-python": "its script is read by the tests of the report",
    "clang-format": "make lint",
    "clang-tidy": "make tidy",
    "coverage": "make coverage",
    "gcovr": "make coverage",
    "mypy": "make lint",
    "pdoc": "make reference",
    "pytest-xdist": "by pytest",
    "roc-validator": "its program is run by the tests of the crate",
    "ruff": "make lint",
    "snakefmt": "make lint",
    "types-jsonschema": "by mypy",
    "types-PyYAML": "by mypy",
    "uv": "make lock",
}


def asked_for(name: str) -> set[str]:
    lines = (ROOT / f"workflow/environment/{name}.in").read_text().splitlines()
    found = (re.match(r"[A-Za-z0-9_.-]+", line) for line in lines if not line.startswith(("#", "-c")))
    return {one[0] for one in found if one}


def normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def imported(root: Path) -> Iterator[tuple[str, set[str]]]:
    """Modules of other projects, with the packages that may bring each."""
    brought = packages_distributions()
    for path in sorted(root.rglob("*.py")):
        for name in imported_modules(path.read_text()):
            module = name.split(".")[0]
            if module and module not in {*sys.stdlib_module_names, "workflow", "tests"}:
                yield f"{path.relative_to(ROOT)}: {module}", {normal(one) for one in brought.get(module, [])}


@pytest.mark.parametrize(
    ("folder", "names"), [("workflow", ["requirements"]), ("tests", ["requirements", "requirements-dev"])]
)
def test_what_is_imported_is_asked_for(folder: str, names: list[str]) -> None:
    asked = {normal(one) for name in names for one in asked_for(name)}
    found = dict(imported(ROOT / folder))
    assert len(found) > 20
    assert [place for place, packages in found.items() if not packages & asked] == []


@pytest.mark.parametrize(
    ("name", "folders"), [("requirements", ["workflow"]), ("requirements-dev", ["tests"])]
)
def test_what_is_asked_for_is_used(name: str, folders: list[str]) -> None:
    used = {one for folder in folders for _, packages in imported(ROOT / folder) for one in packages}
    assert {one for one in asked_for(name) if normal(one) not in used} <= STARTED.keys()


@pytest.mark.parametrize("name", ["requirements", "requirements-build", "requirements-dev"])
def test_what_is_asked_for_is_locked(name: str) -> None:
    blocks = (ROOT / f"{name}.lock").read_text().replace("\\\n", " ").splitlines()
    locked = {normal(line.split("==")[0]) for line in blocks}
    assert {normal(one) for one in asked_for(name)} <= locked
    assert [
        line
        for line in blocks
        if not re.fullmatch(r"\S+==\S+( ; .*?)?( +--hash=sha256:[0-9a-f]{64})+ *", line)
    ] == []


def test_an_import_that_nothing_brings_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(globals(), "ROOT", tmp_path)
    (tmp_path / "late.py").write_text("def late():\n    from snakemake_storage_plugin_s3 import x\n")
    assert dict(imported(tmp_path)) == {"late.py: snakemake_storage_plugin_s3": set()}
