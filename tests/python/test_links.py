"""Links of the audit whose lack has no product that could be tampered with."""

from pathlib import Path

import pytest

from workflow.lib.plan import Panel, Run
from workflow.provenance import audit, product_links
from workflow.provenance.audit import Findings
from workflow.provenance.chain import Chain
from workflow.provenance.links import Link, unchecked
from workflow.provenance.lock import Lock


def test_what_is_broken_counts_more_than_what_is_not_checked() -> None:
    findings = Findings()
    findings.add([unchecked("a", "first"), Link("b", "second"), Link("a", "third"), Link("b", "fourth")])
    assert [link.message for link in findings.broken] == ["third", "second"]
    assert findings.unchecked == []


def test_what_no_job_made_is_named_also_where_it_is_empty(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(product_links, "ROOT", tmp_path)
    made, strange = "data/smoke/fig03/paper.h5", "data/smoke/fig03/more.h5"
    empty, begun = "figures/smoke/empty", "data/smoke/fig05"
    others = ["data/standard_seed=7_replicas=5", "data/deep", "figures/tradeoff"]
    unknown = ["data/smoke_seed=x", "data/x", "figures/best"]
    for folder in ("data/smoke/fig03", empty, begun, *others, unknown[0], unknown[2]):
        (tmp_path / folder).mkdir(parents=True)
    for file in (made, strange, unknown[1], "data/README.md", "figures/README.md", "figures/tradeoff/a.csv"):
        (tmp_path / file).write_text("")
    fig05 = Panel("fig05", "fig05", (Run("all", "persistence", {}),))
    lock = Lock("smoke")
    lock.outputs = {made: ""}.copy
    chain = Chain("smoke", {"fig05": fig05}, lock)
    assert {link.path for link in product_links.strangers(chain)} == {strange, empty}
    assert [link.path for link in product_links.of_no_quality(chain)] == unknown


@pytest.mark.parametrize(
    ("links", "status", "last"),
    [
        ([], 0, "Every link holds: all"),
        ([unchecked("a", "why")], 3, "Nothing is broken, but not every link could be checked"),
        ([unchecked("a", "why"), Link("b", "what")], 1, "make audit: 1 broken; the first is b"),
    ],
)
def test_the_last_line_and_the_status_tell_the_same(
    capsys: pytest.CaptureFixture, links: list[Link], status: int, last: str
) -> None:
    findings = Findings(looked_at="all")
    findings.add(links)
    assert audit.verdict(findings) == status
    said = capsys.readouterr()
    assert (said.out + said.err).splitlines()[-1] == last
