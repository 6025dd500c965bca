"""The files that a script is made of are found from its imports."""

from pathlib import Path

import pytest

from workflow.config.plan import load_plan
from workflow.provenance import sources
from workflow.provenance.sources import sources_of


def test_imports_are_followed() -> None:
    found = sources_of("workflow/scripts/ext02.py")
    assert found[0] == "workflow/scripts/ext02.py"
    modules = {
        f"workflow/scripts/{module}.py"
        for module in ("columns", "fig08", "figure", "fit", "load", "save", "style", "units")
    }
    assert set(found[1:]) == modules | {"workflow/provenance/parents.py"}


def test_every_form_of_import(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "workflow/scripts"
    folder.mkdir(parents=True)
    (folder / "a.py").write_text("import os\nimport workflow.scripts.b\nfrom workflow.scripts import c\n")
    (folder / "b.py").write_text("from workflow.scripts.d import x\nfrom workflow.scripts import a\n")
    for name in "cde":
        (folder / f"{name}.py").write_text("")
    monkeypatch.setattr(sources, "ROOT", tmp_path)
    assert sources_of("workflow/scripts/a.py") == [f"workflow/scripts/{name}.py" for name in "abcd"]


def test_every_panel_has_its_sources() -> None:
    for panel in load_plan("smoke").values():
        assert "workflow/scripts/load.py" in sources_of(f"workflow/scripts/{panel.script}.py")


def test_a_missing_script_is_an_error() -> None:
    with pytest.raises(FileNotFoundError, match="nothing"):
        sources_of("workflow/scripts/nothing.py")
