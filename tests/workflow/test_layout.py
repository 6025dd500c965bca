"""Every result of the pipeline follows the documented layout."""

from tests.workflow.conftest import Clone
from workflow.lib.layout import faults
from workflow.lib.plan import load_plan


def test_every_file_of_the_smoke_run_has_no_fault(clean: Clone) -> None:
    files = sorted((clean.folder / "data/smoke").rglob("*.h5"))
    assert len(files) == sum(len(panel.runs) for panel in load_plan("smoke").values())
    assert [fault for path in files for fault in faults(path)] == []
