"""Links from products to the report that an audit checks: it is written again, with the costs that it states, and compared."""

import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from workflow.provenance.chain import Chain
from workflow.provenance.execute import ENVIRONMENT, LAUNCH
from workflow.provenance.links import Link
from workflow.provenance.repository import ROOT

JOB = "report"
WRITER = "workflow.report.write"


def paths(quality: str) -> list[str]:
    """The page first: it names what both were written from."""
    return [f"figures/{quality}/report.html", f"figures/{quality}/report.md"]


def report(chain: Chain) -> Iterator[Link]:
    """What is wrong with the report, if there is one."""
    there = [path for path in paths(chain.quality) if chain.hashes[path]]
    if len(there) < len(paths(chain.quality)):
        lacking = (path for path in paths(chain.quality) if there and path not in there)
        yield from (
            Link(path, "is missing beside the other part of the report: run make report", JOB)
            for path in lacking
        )
        return
    if foreign := _no_module():
        for path in there:
            yield Link(path, f"cannot be written again: {foreign} is no file", JOB)
        return
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-P", LAUNCH, WRITER, "--quality", chain.quality, "--output", folder]
        command += ["--costs-of", str(ROOT / paths(chain.quality)[0])]
        done = subprocess.run(command, cwd=ROOT, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        for path in paths(chain.quality):
            again = Path(folder, Path(path).name)
            if done.returncode:
                reason = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
                yield Link(path, f"cannot be written again: {reason}", JOB)
            elif again.read_bytes() != (ROOT / path).read_bytes():
                yield Link(
                    path, "does not follow from the products and sources that are there: run make report", JOB
                )


def _no_module() -> str | None:
    """What lies in the place of a module and is no file. Its import could wait for ever."""
    modules = sorted((ROOT / "workflow").rglob("*.py"))
    return next((str(path.relative_to(ROOT)) for path in modules if not path.is_file()), None)
