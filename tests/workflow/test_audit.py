"""Every tampering is found, and the first broken link is named; a clean run has none."""

import py_compile
import subprocess
import sys
from pathlib import Path

import pytest

from tests.workflow.conftest import Clone, Edit, replace, side_by_side
from tests.workflow.forgeries import APART, TAMPERINGS, UNCHECKED
from tests.workflow.tampering import PICTURE, audit, run_module, tampered
from workflow.lib.plan import load_plan

__all__ = ["tampered"]  # a fixture


@pytest.mark.parametrize("part", [["PANEL=fig08"], pytest.param([], marks=pytest.mark.long)])
def test_clean_run_has_no_broken_link(clean: Clone, part: list[str]) -> None:
    audited = clean.make("audit", "QUALITY=smoke", *part)
    assert audited.returncode == 0, audited.stdout
    assert "Every link holds" in audited.stdout


def test_what_is_not_asked_for_any_more_leaves_no_trace(kept: Clone) -> None:
    replace("workflow/config/paper.yaml", "sigma: [-0.99, -0.9, -0.75", "sigma: [-0.9, -0.75")(kept)
    made = kept.make("figures", "QUALITY=smoke")
    assert "fig05/dense_sigma=-0.99 is not asked for any more: moved to build/replaced" in made.stdout
    assert (kept.folder / "build/replaced/data/smoke/fig05/dense_sigma=-0.99.h5").is_file()
    audited = kept.make("audit", "QUALITY=smoke", "PANEL=fig05")
    assert "Nothing is broken" in audited.stdout
    assert "with uncommitted changes" in audited.stdout


def at_once(cases: dict[str, tuple[Edit, str]]) -> list:
    """Groups of those that touch neither the lock nor what an audit needs to go on, and the others; each by itself is long."""
    apart = {name for name in cases if any(word in name for word in APART)}
    groups = side_by_side({name: {words} for name, (_, words) in cases.items() if name not in apart})
    alone = [[name] for name in cases]
    kept_short = [names for names in alone if names[0] in apart]
    long = [pytest.param(names, marks=pytest.mark.long) for names in alone if names[0] not in apart]
    return [*groups, *kept_short, *long]


@pytest.mark.parametrize("names", at_once(TAMPERINGS), ids=", ".join)
def test_tampering_is_found_and_named(tampered: Clone, names: list[str]) -> None:
    for name in names:
        TAMPERINGS[name][0](tampered)
    audited = audit(tampered)
    assert audited.returncode == 1
    assert "Traceback" not in audited.stdout
    told = audited.stdout.splitlines()
    for name in names:
        assert any(line.startswith(TAMPERINGS[name][1]) for line in told), name
    first = [TAMPERINGS[name][1] for name in names]
    assert any(f"the first is {path}" in audited.stdout for path in first)


@pytest.mark.parametrize("names", at_once(UNCHECKED), ids=", ".join)
def test_what_cannot_be_checked_is_said(tampered: Clone, names: list[str]) -> None:
    for name in names:
        UNCHECKED[name][0](tampered)
    assert_unchecked(tampered, *(UNCHECKED[name][1] for name in names))


@pytest.mark.parametrize("shallow", [True, False])
def test_without_history_commits_are_not_checked(clean: Clone, shallow: bool) -> None:
    git, hidden = clean.folder / ".git", clean.folder / "build/git"
    if shallow:
        (git / "shallow").write_bytes(subprocess.check_output(["git", "rev-parse", "HEAD"], cwd=clean.folder))
    else:
        git.rename(hidden)
    try:
        reason = "the repository is shallow" if shallow else "this is no repository that git reads"
        assert_unchecked(clean, f"sources against their commits ({reason})")
    finally:
        if shallow:
            (git / "shallow").unlink()
        else:
            hidden.rename(git)


def assert_unchecked(clone: Clone, *cases: str) -> None:
    audited = audit(clone)
    assert audited.returncode == 3, audited.stdout
    for words in cases:
        assert f"not checked: {words}" in audited.stdout
    assert audited.stdout.endswith("Nothing is broken, but not every link could be checked\n")


def test_a_foreign_package_is_found(clean: Clone) -> None:
    folder = next((clean.folder / ".venv/lib").glob("python*/site-packages"))
    (folder / "numpy.pth").write_text("")
    try:
        audited = audit(clean)
    finally:
        (folder / "numpy.pth").unlink()
    assert audited.returncode == 1
    assert f"the first is {(folder / 'numpy.pth').relative_to(clean.folder)}" in audited.stdout


def test_packages_are_not_started_unless_they_are_as_installed(clean: Clone, tmp_path: Path) -> None:
    """They could switch off what checks them."""
    (place,) = (clean.folder / ".venv/lib").glob("python*/site-packages")
    (place / "a.pth").write_text(f"import pathlib; pathlib.Path({str(tmp_path / 'started')!r}).touch()\n")
    try:
        made = [clean.make(goal) for goal in ("audit", "verify", "status")]
        made.append(clean.make("provenance", f"FILE={PICTURE}"))
    finally:
        (place / "a.pth").unlink()
    for one in made:
        assert one.returncode != 0
        assert "a.pth' is not what was installed" in one.stdout
    assert not (tmp_path / "started").exists()


def test_byte_compiled_modules_of_the_project_are_not_used_to_draw(tampered: Clone, tmp_path: Path) -> None:
    false = tmp_path / "style.py"
    false.write_text("raise SystemExit(5)\n")
    compiled = tampered.folder / f"workflow/lib/__pycache__/style.{sys.implementation.cache_tag}.pyc"
    compiled.parent.mkdir(exist_ok=True)
    py_compile.compile(
        str(false), str(compiled), invalidation_mode=py_compile.PycInvalidationMode.UNCHECKED_HASH
    )
    audited = audit(tampered)
    assert audited.returncode == 0, audited.stdout


def test_the_summary_says_how_much_was_drawn_again(clean: Clone) -> None:
    panels = len(load_plan("smoke"))
    assert f"drew 1 of {panels} panels again" in audit(clean).stdout


def test_an_unknown_panel_is_refused_with_the_nearest(clean: Clone) -> None:
    refused = audit(clean, "--panel", "figg03")
    assert refused.returncode == 2
    assert refused.stdout.count("\n") == 1
    assert "fig03" in refused.stdout


def test_an_unknown_quality_is_refused(clean: Clone) -> None:
    refused = run_module(clean, "audit", quality="../smoke")
    assert refused.returncode == 2
    assert "QUALITY=../smoke is not known" in refused.stdout
