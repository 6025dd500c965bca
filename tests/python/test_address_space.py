"""A limit of address space is told in one line, by whatever of the project is started."""

import shlex
import subprocess
import sys

import pytest

from tests.python.conftest import ROOT


def limited(kilobytes: int, module: str) -> subprocess.CompletedProcess:
    command = f"ulimit -v {kilobytes}; exec {shlex.quote(sys.executable)} -P workflow/environment/launch.py {module} --quality smoke"
    return subprocess.run(["bash", "-c", command], cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    "module", ["workflow.provenance.audit", "workflow.report.gallery", "workflow.execution.alone"]
)
@pytest.mark.parametrize("kilobytes", [300_000, (1 << 20) - 1])
def test_too_little_is_told_beforehand(module: str, kilobytes: int) -> None:
    """With 250 MB libraries would try again without end, with 330 Snakemake would end in a traceback."""
    done = limited(kilobytes, module)
    assert done.returncode == 1
    assert done.stderr.startswith(f"A process may have {kilobytes >> 10} MB of address space here")
    assert "needs 1024: raise the limit, as by ulimit -v 1048576" in done.stderr
    assert done.stderr.count("\n") == 1


def test_enough_is_enough() -> None:
    done = limited(1 << 20, "workflow.environment.arguments")
    assert "address space" not in done.stderr
