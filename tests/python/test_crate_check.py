"""A crate that is damaged or forged is refused in words."""

import json
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from workflow.provenance.crate_check import COMPARED, METADATA, CrateError, Deposit

LOCK = "data/standard/lock.json"


def contents() -> tuple[list, dict]:
    graph = [
        {"@id": LOCK, "@type": "File", "sha256": "0"},
        {"@id": "#job", "@type": "CreateAction", "name": "fig03"},
    ]
    return graph, {"quality": "standard", "jobs": {"fig03": dict.fromkeys(COMPARED)}}


def written(path: Path, graph: list, lock: dict) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(METADATA, json.dumps({"@graph": graph}))
        archive.writestr(LOCK, json.dumps(lock))
    return path


def test_what_is_whole_is_read(tmp_path: Path) -> None:
    assert Deposit.read(written(tmp_path / "crate.zip", *contents())).jobs.keys() == {"fig03"}


@pytest.mark.parametrize(
    "forge",
    [
        lambda graph, lock: lock.update(jobs=[]),
        lambda graph, lock: lock.update(jobs={"fig03": 5}),
        lambda graph, lock: lock["jobs"]["fig03"].pop("options"),
        lambda graph, lock: graph[0].update({"@id": 5}),
        lambda graph, lock: graph.append(5),
        lambda graph, lock: lock.update(jobs={}),
        lambda graph, lock: graph.pop(),
    ],
)
def test_a_forged_one_is_refused(tmp_path: Path, forge: Callable[[list, dict], object]) -> None:
    graph, lock = contents()
    forge(graph, lock)
    with pytest.raises(CrateError, match="is no crate of this project"):
        Deposit.read(written(tmp_path / "crate.zip", graph, lock))


def test_a_flipped_bit_is_refused_wherever_it_is(tmp_path: Path) -> None:
    path = written(tmp_path / "crate.zip", *contents())
    whole = path.read_bytes()
    refused = 0
    for place in range(len(whole)):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
        try:
            Deposit.read(path)
        except CrateError:
            refused += 1
    assert refused > len(whole) / 2  # others concern times and rights, which nobody reads
