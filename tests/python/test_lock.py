"""The lock holds what its jobs name, and nothing else."""

from pathlib import Path

import pytest

from workflow.provenance import repository, stale
from workflow.provenance.lock import Job, Lock, changing


def test_a_build_leaves_with_the_last_run_of_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (repository, stale):
        monkeypatch.setattr(module, "ROOT", tmp_path)
    with changing("smoke") as lock:
        lock.builds = {"kept": {}, "replaced": {}}
        lock.jobs["fig05/all"] = Job({}, {"build_id": "kept"}, {}, None, None, "")
    assert Lock.read("smoke").builds == {"kept": {}}
    stale.retire("smoke", {})
    assert Lock.read("smoke").builds == {}
