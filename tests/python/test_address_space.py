"""A limit of address space is told in one line, by whatever of the project is started."""

import resource
import subprocess
import sys

import pytest

from tests.python.conftest import ROOT
from workflow.environment.address_space import require_address_space


@pytest.mark.parametrize(
    ("limit", "enough"),
    [(250 << 20, False), ((1 << 30) - 1, False), (1 << 30, True), (resource.RLIM_INFINITY, True)],
)
def test_too_few_addresses_are_told_beforehand(
    monkeypatch: pytest.MonkeyPatch, limit: int, enough: bool
) -> None:
    """With 250 MB libraries would try again without end, with 330 Snakemake would end in a traceback."""
    monkeypatch.setattr(resource, "getrlimit", lambda _: (limit, limit))
    if enough:
        require_address_space()
        return
    with pytest.raises(SystemExit, match=rf"{limit >> 20} MB .* needs 1024: .* ulimit -v 1048576"):
        require_address_space()


@pytest.mark.parametrize("module", ["workflow.provenance.audit", "workflow.report.gallery"])
def test_every_reader_tells_it(module: str) -> None:
    command = (
        f"ulimit -v 300000; exec {sys.executable} -P workflow/environment/launch.py {module} --quality smoke"
    )
    done = subprocess.run(["bash", "-c", command], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.startswith("A process may have 292 MB of address space here")
    assert done.stderr.count("\n") == 1
