"""make crate: an independent validator accepts the crate, and rejects what is spoilt.

The validator fetches the JSON-LD context of RO-Crate 1.1. Here it runs offline and finds it in its own HTTP cache.
The rocrate library brings the context of 1.3; of the terms that our crates use, 1.1 maps one differently.
"""

import json
import shutil
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import pytest
from requests import Request
from requests.adapters import HTTPAdapter
from requests_cache import CachedSession
from rocrate.vocabs import RO_CRATE
from rocrate_validator.services import validate
from urllib3 import HTTPResponse

from tests.workflow.conftest import Clone
from tests.workflow.test_crate import ARCHIVE, FOLDER, METADATA

CONTEXT = "https://w3id.org/ro/crate/1.1/context"
TERMS_OF_1_1 = {"ComputationalWorkflow": "https://bioschemas.org/ComputationalWorkflow"}
WORKFLOW_RUN = "workflow-run-crate-0.5"  # with the profiles that it builds on
PROFILES = ("process-run-crate-0.5", WORKFLOW_RUN)

pytestmark = pytest.mark.filterwarnings("ignore:ConjunctiveGraph:DeprecationWarning")

Entities = dict[str, dict]


@pytest.fixture(scope="module")
def http_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache of the validator that holds the context and nothing else."""
    path = tmp_path_factory.mktemp("http") / "cache"
    content = json.dumps({"@context": RO_CRATE["@context"] | TERMS_OF_1_1}).encode()
    raw = HTTPResponse(BytesIO(content), {"Content-Type": "application/ld+json"}, 200, preload_content=False)
    with CachedSession(str(path), backend="sqlite") as session:
        session.cache.save_response(HTTPAdapter().build_response(Request("GET", CONTEXT).prepare(), raw))
    return path


def complaints(crate: Path, profile: str, http_cache: Path) -> list[str]:
    """What the validator says is wrong; it must have decided, not merely have skipped."""
    result = validate(
        {
            "rocrate_uri": str(crate),
            "profile_identifier": profile,
            "requirement_severity": "REQUIRED",
            "offline": True,
            "cache_path": http_cache,
        }
    )
    assert result.executed_checks
    assert not result.skipped_checks
    assert result.passed() == (not result.get_issues())
    return [issue.message for issue in result.get_issues()]


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("place", [FOLDER, pytest.param(ARCHIVE, marks=pytest.mark.long)])
def test_the_validator_accepts_it(packed: Clone, http_cache: Path, place: str, profile: str) -> None:
    assert complaints(packed.folder / place, profile, http_cache) == []


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [
        (lambda entities: entities["#job/fig03/paper"].pop("instrument"), "MUST have an instrument"),
        (lambda entities: entities["./"].pop("license"), "license"),
        pytest.param(
            lambda entities: entities["#workflow"].pop("instrument"),
            "MUST reference the root data entity's mainEntity",
            marks=pytest.mark.long,
        ),
        pytest.param(
            lambda entities: entities["./"].pop("mainEntity"), "`mainEntity`", marks=pytest.mark.long
        ),
        pytest.param(
            lambda entities: entities["./"].pop("datePublished"), "datePublished", marks=pytest.mark.long
        ),
        pytest.param(
            lambda entities: entities["./"]["conformsTo"].pop(1),
            "Workflow Run Crate profile",
            marks=pytest.mark.long,
        ),
    ],
)
def test_the_validator_rejects_a_spoilt_one(
    packed: Clone, http_cache: Path, tmp_path: Path, spoil: Callable[[Entities], object], complaint: str
) -> None:
    crate = shutil.copytree(packed.folder / FOLDER, tmp_path / "crate")
    content = json.loads((crate / METADATA).read_text())
    spoil({entity["@id"]: entity for entity in content["@graph"]})
    (crate / METADATA).write_text(json.dumps(content))
    assert any(complaint in found for found in complaints(crate, WORKFLOW_RUN, http_cache))


def test_the_validator_misses_a_file(packed: Clone, http_cache: Path, tmp_path: Path) -> None:
    crate = shutil.copytree(packed.folder / FOLDER, tmp_path / "crate")
    (crate / "data/standard/fig03/paper.h5").unlink()
    assert any("fig03/paper.h5" in found for found in complaints(crate, WORKFLOW_RUN, http_cache))
