"""Links of the audit whose lack has no product that could be tampered with."""

import pytest

from workflow.provenance import audit
from workflow.provenance.audit import Findings
from workflow.provenance.links import Link, unchecked


def test_what_is_broken_counts_more_than_what_is_not_checked() -> None:
    findings = Findings()
    findings.add([unchecked("a", "first"), Link("b", "second"), Link("a", "third"), Link("b", "fourth")])
    assert [link.message for link in findings.broken] == ["third", "second"]
    assert findings.unchecked == []


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
