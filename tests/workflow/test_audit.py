"""make audit, verify and provenance: detected faults, products that cannot be checked, and copies of products."""

import json
import re
import shlex
import shutil
import zipfile
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from tests.workflow.conftest import ROOT, Clone, Edit, append, copy, delete, delete_result, replace
from workflow.files import file_hash

RUN = "fig03/paper"
FIGURE = "figures/smoke/fig03"


def audit(clone: Clone, *arguments: str, status: int = 0) -> str:
    return clone.module("provenance.audit", "--quality", "smoke", *arguments, status=status)


def edit_value(clone: Clone) -> None:
    with h5py.File(clone.folder / clone.result(RUN), "r+") as file:
        file["results/particle_current/mean"][...] *= 1.001


def edit_option(clone: Clone) -> None:
    with h5py.File(clone.folder / clone.result("fig03/equal"), "r+") as file:
        file["parameters"].attrs["sigma"] = 0.25


def exchange(clone: Clone) -> None:
    source, target = clone.result("fig03/equal"), clone.result("fig03/exchange")
    shutil.copyfile(clone.folder / source, clone.folder / target)


def edit_table_and_record(clone: Clone) -> None:
    """Edits a value in a table, and its hash in the record, so that both agree."""
    append("figures/smoke/fig02_lower.csv", "1,2,3\n")(clone)
    path = clone.folder / clone.record("fig02_lower")
    record = json.loads(path.read_text())
    record["files"]["fig02_lower.csv"] = file_hash(clone.folder / "figures/smoke/fig02_lower.csv")
    path.write_text(json.dumps(record))


def halve(name: Callable[[Clone], str]) -> Edit:
    def edit(clone: Clone) -> None:
        path = clone.folder / name(clone)
        path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])

    return edit


# Edits, and the fault that make audit prints for each. {panel} and {panel/run} stand for the paths of record and result before the edit.
# Every edit changes another product, as only one fault per product is printed.
PRODUCTS: list[tuple[Edit, str]] = [
    (exchange, "{fig03/exchange}: stale: it has --"),
    (edit_option, "{fig03/equal}: stale: it has --sigma 0.25, the configuration 0.5"),
    (edit_value, "{fig03/paper}: edited or damaged: its values differ from those written"),
    (halve(lambda clone: clone.result("fig06/all_sigma=0")), "{fig06/all_sigma=0}: is damaged"),
    (delete_result("fig06/all_sigma=0.5"), "{fig06/all_sigma=0.5}: is missing"),
    (
        append("figures/smoke/fig05.csv", "1,2,3\n"),
        "figures/smoke/fig05.csv: edited or replaced: it differs from its hash in fig05.",
    ),
    (
        edit_table_and_record,
        "figures/smoke/fig02_lower.csv: rendering it again gives other bytes: compare build/audit/smoke/fig02_lower.csv",
    ),
    (
        copy("figures/smoke/fig05.png", "figures/smoke/fig04b.png"),
        "figures/smoke/fig04b.png: edited or replaced",
    ),
    (halve(lambda clone: clone.record("fig02_upper")), "{fig02_upper}: "),
    (delete("figures/smoke/fig01.svg"), "figures/smoke/fig01.svg: is missing"),
]
SOURCES: list[tuple[Edit, str]] = [
    (
        append("workflow/figures/fig05.py", "# more\n"),
        "figures/smoke/fig05.pdf: stale: workflow/figures/fig05.py has changed",
    ),
    (
        append("cpp/statistics/peak.hpp", "// more\n"),
        "{fig09a/gaussian}: stale: the sources of energy_pulse have changed",
    ),
    (
        replace("workflow/config/paper.yaml", "momentum-bins: 240", "momentum-bins: 238"),
        "{fig03/paper}: stale: it has --momentum-bins 240, the configuration 238",
    ),
]
LOCK = [(append("uv.lock", "# more\n"), f"{FIGURE}.pdf: stale: uv.lock has changed")]
EDITED = ("fig01", "fig02_lower", "fig02_upper", "fig03", "fig04b", "fig05", "fig06", "fig09a")


@pytest.mark.parametrize(
    ("edits", "in_status"),
    [
        (PRODUCTS, ("fig05.csv: edited or replaced", "fig04b.png: edited or replaced", ": is damaged")),
        (SOURCES, ("fig05.py has changed",)),
        (LOCK, ()),
    ],
)
def test_what_is_broken_is_named(
    kept: Clone, edits: list[tuple[Edit, str]], in_status: tuple[str, ...]
) -> None:
    paths = {panel: kept.record(panel) for panel in EDITED}
    paths |= {run: kept.result(run) for _, text in edits for run in re.findall(r"{(\w+/[^}]+)}", text)}
    for edit, _ in edits:
        edit(kept)
    printed = audit(kept, *(f"--panel={panel}" for panel in EDITED), status=1)
    expected = [re.sub(r"{([^}]+)}", lambda match: paths[match[1]], text) for _, text in edits]
    assert [text for text in expected if f"broken: {text}" not in printed] == []
    table = " ".join(kept.module("provenance.status", "--quality", "smoke").split())
    assert [text for text in in_status if text not in table] == []


@pytest.mark.long  # all panels; the next test checks four of them
def test_all_of_it_holds(clean: Clone) -> None:
    assert audit(clean).endswith("30 panels with results: 0 broken, 0 not checked, all else holds\n")


def test_four_panels_hold(kept: Clone) -> None:
    """The four panels plot their own results, those of other panels, or both."""
    kept.keep_only("fig01", "fig01_inset", "ext12", "ext09")
    printed = audit(kept)
    assert printed.endswith("4 panels with results: 0 broken, 0 not checked, all else holds\n")


def test_what_is_not_in_the_plan_is_named_and_what_the_user_named_is_not_removed(kept: Clone) -> None:
    kept.keep_only("fig03")
    former = "data/smoke/fig03/removed_sigma=0.1.0123456789ab.h5"
    own = [
        "data/smoke/fig03/mine.h5",
        "data/smoke/fig03/notes.txt",
        "figures/smoke/fig03.copy.png",
        "figures/smoke/My talk.pdf",
        "figures/smoke/.ipynb_checkpoints/a.png",
    ]
    for path in (former, *own):
        (kept.folder / path).parent.mkdir(exist_ok=True)
        copy(kept.result(RUN), path)(kept)
    for arguments in ((), ("--panel", "fig03")):
        printed = audit(kept, *arguments)
        assert f"obsolete: {former}: no plan names it; make prune QUALITY=smoke removes it" in printed
        assert "0 broken, 0 not checked, 1 obsolete" in printed
    printed = kept.module("provenance.status", "--quality", "smoke", "--panel", "fig03", "--panel", "fig05")
    (remedy,) = re.findall("make (prune .*) removes them", printed)
    assert former in kept.make(*shlex.split(remedy)).stdout
    assert "obsolete" not in audit(kept)
    assert all((kept.folder / path).exists() for path in own)


def test_a_panel_needs_the_results_that_it_plots_and_no_other_figure(kept: Clone) -> None:
    kept.keep_only("fig08", "ext09")
    for path in (kept.folder / "figures/smoke").glob("ext09.*"):
        path.unlink()
    printed = audit(kept, "--panel", "fig08")
    assert printed == "1 panel with results: 0 broken, 0 not checked, all else holds\n"


def test_other_packages_and_compilers_are_not_checked(kept: Clone) -> None:
    path, result = kept.folder / "build/id/boltzmann.json", kept.result(RUN)
    former = path.read_text()
    path.write_text(json.dumps(json.loads(former) | {"compiler": "another", "build_id": "0" * 64}))
    printed = audit(kept, "--panel", "fig03", status=3)
    path.write_text(former)
    assert f"not checked: {result}: by another compiler" in printed
    (metadata,) = kept.folder.glob(".venv/lib/python3*/site-packages/matplotlib-*.dist-info/METADATA")
    former = metadata.read_text()
    metadata.unlink()  # uv links installed files to its cache
    metadata.write_text(former.replace("\nVersion: ", "\nVersion: 1", 1))
    printed = audit(kept, "--panel", "fig03", status=3)
    metadata.write_text(former)
    assert f"not checked: {FIGURE}.pdf: other packages: matplotlib" in printed


def test_a_crate_unpacked_in_another_repository_holds(clean: Clone, tmp_path: Path) -> None:
    """The panel has runs with `=` in their names."""
    packed = ("--archive", "build/crate/fig06.zip")
    clean.module("provenance.crate", "--quality", "smoke", "--panel", "fig06", *packed)
    Clone(tmp_path).git("init", "--quiet")
    with zipfile.ZipFile(clean.folder / packed[1]) as archive:
        archive.extractall(tmp_path / "thesis")
    crate = Clone(tmp_path / "thesis")
    shutil.copytree(ROOT / ".cache", crate.folder / ".cache", ignore=shutil.ignore_patterns("mypy"))
    printed = crate.make("audit", "QUALITY=smoke").stdout
    assert printed.endswith("1 panel with results: 0 broken, 0 not checked, all else holds\n")
    assert "Not made at quality smoke: model, fig01, " in printed


def test_verify_reruns_a_panel(kept: Clone) -> None:
    """The programs of an existing build are used, so that nothing is compiled."""
    shutil.copytree(kept.folder / "build/bin", kept.folder / "build/fresh", dirs_exist_ok=True)
    command = ["provenance.verify", "--quality", "smoke", "--sample", "1", "--panel", "fig03"]
    command += ["--programs", "build/fresh"]
    edit_value(kept)
    printed = kept.module(*command, status=1)
    assert f"{kept.result(RUN)}: other bytes" in printed
    assert printed.count(": equal bytes") == 2


@pytest.mark.parametrize("kind", ["pdf", "png", "svg", "csv"])
def test_where_a_copy_comes_from(clean: Clone, tmp_path: Path, kind: str) -> None:
    copied = shutil.copyfile(clean.folder / f"{FIGURE}.{kind}", tmp_path / f"a copy.{kind}")
    printed = clean.module("provenance.tree", str(copied), "--full")
    identity = json.loads((clean.folder / "build/id/boltzmann.json").read_text())
    paths = (clean.result(RUN), "uv.lock", "workflow/figures/fig03.py", "workflow/lib/style.py")
    wanted = [identity["source_hash"], *(file_hash(clean.folder / path) for path in paths)]
    assert all(f"{digest[:16]}  same here" in printed for digest in wanted)
    assert printed.startswith(f"a copy.{kind} is {FIGURE}.{kind}, rendered at commit ")
    assert "(clean)" in printed
    with copied.open("ab") as file:
        file.write(b"\n")
    printed = clean.module("provenance.tree", str(copied), status=1)
    assert "belongs to no panel here" in printed
    assert "panel fig03 at quality smoke" in printed


def test_a_parent_that_differs_is_listed_first(kept: Clone) -> None:
    append("workflow/lib/units.py", "# more\n")(kept)
    edit_value(kept)
    first, _, _, *lines = kept.module("provenance.tree", f"{FIGURE}.pdf", status=1).splitlines()
    assert first.startswith("fig03.pdf is figures/smoke/fig03.pdf, rendered at commit")
    assert [line.split()[0] for line in lines[:2]] == ["workflow/lib/units.py", kept.result(RUN)]
    assert all("other here" in line for line in lines[:2])
    assert "other here" not in " ".join(lines[2:])
    assert lines[-1].startswith("Parents have changed: make panel PANEL=fig03 QUALITY=smoke makes")


def test_where_a_result_comes_from(kept: Clone) -> None:
    result = kept.result(RUN)
    printed = kept.module("provenance.tree", result)
    assert printed.startswith(f"{Path(result).name} is unmodified\n")
    assert "program boltzmann: " in printed
    edit_value(kept)
    assert "is edited or damaged" in kept.module("provenance.tree", result, status=1)


def test_what_states_no_parents_is_refused_in_a_line(clean: Clone, tmp_path: Path) -> None:
    (tmp_path / "x.pdf").write_text("nothing")
    (tmp_path / "x.txt").write_text("nothing")
    for name, status in (("x.pdf", 1), ("x.txt", 1), ("missing.pdf", 2)):
        printed = clean.module("provenance.tree", str(tmp_path / name), status=status)
        assert len(printed.splitlines()) == 1
        assert name in printed
