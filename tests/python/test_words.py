"""Sources and documents use standard terms instead of words in a private sense."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TEXT = (
    "*.md",
    "*.py",
    "*.smk",
    "*.yaml",
    "*.toml",
    "*.sh",
    "*.hpp",
    "*.cpp",
    "*.rst",
    "*.j2",
    "*.csv",
    "Makefile",
    "Snakefile",
)
NOT = ("tests", "docs/gallery")  # tests quote; the gallery is written from templates
STANDARD = {  # pattern of a private word, and the standard terms for it
    "foretold|foretells?": "estimated, predicted",
    "(?:is|are|was|were) told": "is reported, printed",
    "admitted|(?:claims?|band|it) admits?": "acceptance band, accepts; supported (of an option)",
    "in substance": "by its intended meaning",
    "(?:written|there|made) by half": "partially written",
    "asked for|unasked": "requested, configured",
    "from nothing|asked anew": "from scratch",
    "knows (?:nobody|nothing|no|of|only)": "depends on nothing, has no",
    "testimony": "record",
    "(?:stands?|lies?) (?:beside|there)": "is",
    "what is (?:not|no|asked|there) (?:any|in|on|here|made|for)": "a noun",
    "nobody here|no one here|nobody's": "unknown",
    "or_leave|forget_errors_of_nothing": "exit_on_oserror, mask_errors_of_empty_bins",
}


def uses(word: str, text: str) -> list[str]:
    return re.findall(rf"\b(?:{word})\b", text, re.IGNORECASE)


@pytest.mark.parametrize("word", STANDARD)
def test_standard_terms(word: str) -> None:
    pathspec = [*TEXT, *(f":!{folder}" for folder in NOT)]
    listed = subprocess.run(
        ["git", "ls-files", *pathspec], cwd=ROOT, capture_output=True, text=True, check=True
    )
    lines = [
        f"{path}:{number}: {line.strip()}"
        for path in filter(lambda path: (ROOT / path).is_file(), listed.stdout.splitlines())
        for number, line in enumerate((ROOT / path).read_text("utf-8").splitlines(), 1)
        if uses(word, line)
    ]
    assert not lines, f"write: {STANDARD[word]}\n" + "\n".join(lines)


def test_words_are_found_whole_and_in_any_case() -> None:
    assert uses("admitted|claims? admits?", "Admitted: a claim admits x") == ["Admitted", "claim admits"]
    assert not uses("admitted", "readmitted")
