"""Every tampering is found, and the first broken link is named; a clean run has none."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from tests.workflow.conftest import Clone, Edit, append, copy, delete, replace
from workflow.lib.parents import file_hash
from workflow.provenance import repository
from workflow.provenance.lock import checksum_of
from workflow.provenance.repository import signature

DATA = "data/smoke/fig03/paper.h5"
TABLE = "figures/smoke/fig03.csv"
LOCK = "data/smoke/lock.json"


def flip_bit(clone: Clone) -> None:
    content = bytearray((clone.folder / DATA).read_bytes())
    content[-5] ^= 1
    (clone.folder / DATA).write_bytes(content)


def forge_attribute(clone: Clone) -> None:
    with h5py.File(clone.folder / DATA, "r+") as file:
        file["provenance"].attrs["source_hash"] = "0" * 64


def forge_value(clone: Clone) -> None:
    with h5py.File(clone.folder / DATA, "r+") as file:
        file["results/energy_current/mean"][()] *= 1.001


def relock(change: Callable[[dict], None] = lambda _: None) -> Edit:
    """A lock that fits what is there, with its checksum: only the links between the products can tell."""

    def edit(clone: Clone) -> None:
        content = json.loads((clone.folder / LOCK).read_text())
        del content["checksum"]
        for job in content["jobs"].values():
            job["outputs"] = {path: file_hash(clone.folder / path) for path in job["outputs"]}
        change(content)
        content["checksum"] = checksum_of(content)
        (clone.folder / LOCK).write_text(json.dumps(content))

    return edit


def other_commit(content: dict) -> None:
    content["jobs"]["fig03"]["commit"] = "0" * 40


def other_flags(content: dict) -> None:
    for build in content["builds"].values():
        build["flags"] = "-Ofast"


def other_quality(content: dict) -> None:
    content["quality"] = "paper"


def both(first: Edit, second: Edit) -> Edit:
    def edit(clone: Clone) -> None:
        first(clone)
        second(clone)

    return edit


TAMPERINGS = {
    "bit flipped": (flip_bit, DATA),
    "table edited": (replace(TABLE, ",", ", "), TABLE),
    "table edited, lock too": (both(replace(TABLE, "0.", "1."), relock()), TABLE),
    "picture edited": (append("figures/smoke/fig03.png", "x"), "figures/smoke/fig03.png"),
    "figure of another panel": (
        copy("figures/smoke/fig05.pdf", "figures/smoke/fig03.pdf"),
        "figures/smoke/fig03.pdf",
    ),
    "figure of another panel, lock too": (
        both(copy("figures/smoke/fig05.svg", "figures/smoke/fig03.svg"), relock()),
        "figures/smoke/fig03.svg",
    ),
    "data of another run": (copy("data/smoke/fig03/equal.h5", DATA), DATA),
    "data of another run, lock too": (both(copy("data/smoke/fig03/equal.h5", DATA), relock()), DATA),
    "attribute forged": (forge_attribute, DATA),
    "attribute forged, lock too": (both(forge_attribute, relock()), DATA),
    "value forged, lock too": (both(forge_value, relock()), "figures/smoke/fig03.pdf"),
    "parameter": (
        replace("workflow/config/paper.yaml", "decades: 6", "decades: 5"),
        "workflow/config/paper.yaml",
    ),
    "effort": (
        replace("workflow/config/quality/smoke.yaml", "{replicas: 4}", "{replicas: 5}"),
        "workflow/config/quality/smoke.yaml",
    ),
    "configuration deleted": (
        delete("workflow/config/quality/smoke.yaml"),
        "workflow/config/quality/smoke.yaml",
    ),
    "configuration spoilt": (append("workflow/config/paper.yaml", "}\n"), "workflow/config/paper.yaml"),
    "script": (append("workflow/figures/fig03.py", "# x\n"), "workflow/figures/fig03.py"),
    "shared module deleted": (delete("workflow/lib/fit.py"), "workflow/lib/fit.py"),
    "C++ source": (append("cpp/numerics/gmres.cpp", "// x\n"), "cpp/numerics/gmres.cpp"),
    "C++ source deleted": (delete("cpp/numerics/gmres.cpp"), "cpp/numerics/gmres.cpp"),
    "Python packages": (append("requirements.lock", "# x\n"), "requirements.lock"),
    "data deleted": (delete(DATA), DATA),
    "figure deleted": (delete("figures/smoke/fig03.svg"), "figures/smoke/fig03.svg"),
    "data without parents": (copy(DATA, "data/smoke/fig03/more.h5"), "data/smoke/fig03/more.h5"),
    "figure without parents": (copy(TABLE, "figures/smoke/fig99.csv"), "figures/smoke/fig99.csv"),
    "lock edited": (replace(LOCK, "GNU", "gnu"), LOCK),
    "lock deleted": (delete(LOCK), LOCK),
    "lock of another quality": (relock(other_quality), LOCK),
    "commit forged": (relock(other_commit), "commit 000000000000"),
    "flags forged": (relock(other_flags), "build "),
}


def test_clean_run_has_no_broken_link(clean: Clone) -> None:
    audited = clean.make("audit", "QUALITY=smoke")
    assert audited.returncode == 0, audited.stdout
    assert "Every link holds" in audited.stdout


def test_what_is_not_asked_for_any_more_leaves_no_trace(kept: Clone) -> None:
    replace("workflow/config/paper.yaml", "sigma: [0, 0.5]", "sigma: [0.5]")(kept)
    made = kept.make("figures", "QUALITY=smoke")
    assert "fig06/all_sigma=0 is not asked for any more: moved to build/replaced" in made.stdout
    assert (kept.folder / "build/replaced/data/smoke/fig06/all_sigma=0.h5").is_file()
    audited = kept.make("audit", "QUALITY=smoke", "PANEL=fig06")
    assert "Every link holds" in audited.stdout


@pytest.mark.parametrize("tampering", TAMPERINGS)
def test_tampering_is_found_and_named(kept: Clone, tampering: str) -> None:
    edit, first = TAMPERINGS[tampering]
    edit(kept)
    audited = kept.make("audit", "QUALITY=smoke", "PANEL=fig03")
    assert audited.returncode != 0
    assert "Traceback" not in audited.stdout
    assert f"the first is {first}" in audited.stdout


SIGNER = r"""#!/bin/bash
# A stand-in for gpg: signs anything, and accepts what it has signed.
cat >/dev/null
case "$*" in
  *--verify*) printf '\n%s\n' '[GNUPG:] GOODSIG 0 Nobody' ;;
  *) echo '[GNUPG:] SIG_CREATED ' >&2
     printf -- '-----BEGIN PGP SIGNATURE-----\n\nx\n-----END PGP SIGNATURE-----\n' ;;
esac
"""


def test_the_commit_that_is_compared_is_named(clean: Clone) -> None:
    commit = subprocess.check_output(
        ["git", "rev-list", "--max-parents=0", "HEAD"], cwd=clean.folder, text=True
    )
    told = clean.make("audit", "QUALITY=smoke", "PANEL=fig03").stdout
    assert f"compared with commit {commit[:12]} (not signed)" in told


def test_signatures_are_told_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(repository, "ROOT", tmp_path)
    signer = tmp_path / "signer"
    signer.write_text(SIGNER)
    signer.chmod(0o755)
    clone = Clone(tmp_path)
    clone.git("init", "--quiet")
    program = ("-c", f"gpg.program={signer}", "-c", "user.signingkey=0")
    clone.git(*program, "commit", "--quiet", "--allow-empty", "--message", "plain")
    assert signature("HEAD") == "not signed"
    clone.git(*program, "commit", "--quiet", "--allow-empty", "--message", "gpgsig x", "--gpg-sign")
    clone.git("config", "gpg.program", str(signer))
    assert signature("HEAD") == "signed"
    clone.git("config", "gpg.program", "/bin/false")
    assert signature("HEAD") == "signed, but git cannot verify it"
