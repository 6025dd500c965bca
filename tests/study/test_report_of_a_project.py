"""The report of a small project: state, origin and panels."""

import shutil

from tests.workflow.conftest import Project


def test_status_covers_the_report(project: Project) -> None:
    """Detected mistakes: a report of former sources is unmodified; an edited one is fresh."""
    project.entry("report")
    project.entry("status")
    page = project.folder / "figures/smoke/report.html"
    (project.folder / "talk.html").write_bytes(page.read_bytes())
    printed = project.workflow("provenance", f"FILE={project.folder / 'talk.html'}")
    assert printed.startswith("unmodified, current\npanel report, quality smoke: make report QUALITY=smoke\n")
    page.write_bytes(content := page.read_bytes() + b"mine")
    assert "edited: figures/smoke/report.html" in project.entry("status", status=1)
    printed = project.entry("report", status=1)
    assert "figures/smoke/report.html" in printed
    assert "The report is" not in printed
    assert page.read_bytes() == content  # edited files are kept
    project.edit("workflow/study/claims.csv", lambda text: text.replace("fig. 1", "fig. 2"))
    assert "stale: figures/smoke/report.html" in project.entry("status", status=1)
    project.entry("report")
    project.entry("status")


def test_panels_of_the_user_are_not_in_the_report(project: Project) -> None:
    own = project.folder / "own"
    own.mkdir()
    (own / "panels.yaml").write_text("panels:\n  mine: {uses: [mu]}\n")
    shutil.copy(project.folder / "workflow/figures/mu.py", own / "mine.py")
    assert "mine" not in project.entry("report", "DRY=yes")
