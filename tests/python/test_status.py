"""What is in the queue of a cluster is said of this folder alone."""

from pathlib import Path

import pytest

from workflow.provenance import status
from workflow.provenance.repository import ROOT


@pytest.mark.parametrize(
    ("says", "text"),
    [
        (
            f"RUNNING {ROOT}\nPENDING {ROOT}\nRUNNING {ROOT}\nRUNNING {ROOT} other\nRUNNING /elsewhere\n",
            "1 pending, 2 running",
        ),
        ("RUNNING /elsewhere\n", ""),
        ("", ""),
        ("slurm_load_jobs error: Unable to contact slurm controller\n", ""),
    ],
)
def test_the_queue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, says: str, text: str) -> None:
    (tmp_path / "said").write_text(says)
    squeue = tmp_path / "squeue"
    squeue.write_text(f"#!/bin/sh\nexec cat '{tmp_path}/said'\n")
    squeue.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin")
    assert status.queue() == text


def test_without_a_cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert status.queue() == ""
