"""The commits that an audit compares with: named, not replaced, and signed by whom."""

import json
import subprocess
from pathlib import Path

import pytest

from tests.workflow.conftest import Clone, append
from tests.workflow.tampering import LOCK, audit, relock, tampered
from workflow.provenance import repository
from workflow.provenance.repository import signature

__all__ = ["tampered"]  # a fixture

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
    commit = json.loads((clean.folder / LOCK).read_text())["jobs"]["fig03"]["commit"]
    plain = "\ngpgsig" not in git_says(clean, "cat-file", "commit", commit)
    told = clean.make("audit", "QUALITY=smoke", "PANEL=fig03").stdout
    assert f"compared with commit {commit[:12]} ({'not signed)' if plain else 'signed'}" in told


AUTHOR = ("-c", "user.name=Nobody", "-c", "user.email=nobody@example.org")


def git_says(clone: Clone, *arguments: str) -> str:
    return subprocess.check_output(["git", *arguments], cwd=clone.folder, text=True).strip()


def test_a_replaced_commit_is_not_believed(tampered: Clone) -> None:
    """git would show the audit the commit as if it held the edited script."""
    script, head = "workflow/figures/fig03.py", git_says(tampered, "rev-parse", "HEAD")
    append(script, "# edited\n")(tampered)
    edited = git_says(tampered, "hash-object", "-w", script)
    tampered.git("update-index", "--cacheinfo", f"100644,{edited},{script}")
    forged = git_says(tampered, *AUTHOR, "commit-tree", git_says(tampered, "write-tree"), "-m", "forged")
    try:
        tampered.git("replace", head, forged)
        assert git_says(tampered, "status", "--porcelain", "--untracked-files=no") == ""
        assert tampered.make("panel", "PANEL=fig03", "QUALITY=smoke").returncode == 0
        relock(lambda content: content["jobs"]["fig03"].update(dirty=False))(tampered)
        audited = audit(tampered)
    finally:
        tampered.git("replace", "-d", head)
        tampered.git("reset", "--quiet")
    assert audited.returncode == 1
    assert f"commit {head[:12]}: does not hold the {script} that fig03 was made from" in audited.stdout


def test_signatures_are_told_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the settings of the user alone: the repository's own may accept any key."""
    monkeypatch.setattr(repository, "ROOT", tmp_path)
    signer = tmp_path / "signer"
    signer.write_text(SIGNER)
    signer.chmod(0o755)
    clone = Clone(tmp_path)
    clone.git("init", "--quiet")
    program = ("-c", f"gpg.program={signer}", "-c", "user.signingkey=0")
    clone.git(*program, "commit", "--quiet", "--allow-empty", "--message", "plain")
    assert signature(git_says(clone, "rev-parse", "HEAD")) == "not signed"
    clone.git(*program, "commit", "--quiet", "--allow-empty", "--message", "gpgsig x", "--gpg-sign")
    users = tmp_path / "users settings"
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(users))
    clone.git("config", "gpg.program", str(signer))
    assert signature(git_says(clone, "rev-parse", "HEAD")) == "signed, but git cannot verify it"
    clone.git("config", "gpg.program", "/bin/false")
    clone.git("config", "--file", str(users), "gpg.program", str(signer))
    assert signature(git_says(clone, "rev-parse", "HEAD")) == "signed by Nobody, key 0"
