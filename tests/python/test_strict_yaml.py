"""YAML that two readers could take for different things is refused, in one line that says where."""

import os
from pathlib import Path

import pytest
import yaml

from workflow.lib.plan import FOLDER, QUALITIES, ConfigurationError, load_plan
from workflow.lib.strict_yaml import read


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "paper.yaml"


def refusal(path: Path) -> str:
    with pytest.raises(ConfigurationError) as raised:
        read(path)
    message = str(raised.value)
    assert message.startswith("paper.yaml")
    assert "\n" not in message
    return message


AMBIGUOUS = (
    *(
        "011",
        "08",
        "+0_7",
        "0o7",
        "0x1F",
        "0b1",
        "5:00",
        "1_000",
        "+5",
        ".5",
        "1.",
        ".nan",
        ".NaN",
        ".inf",
        "-.inf",
    ),
    *("yes", "No", "on", "OFF", "True", "FALSE", "Null", "~", "2009-01-01", "=", "!!str 5", "!x y"),
)


@pytest.mark.parametrize("text", AMBIGUOUS)
def test_what_versions_read_differently_is_refused_with_its_place(path: Path, text: str) -> None:
    path.write_text(f"panels:\n  fig05: {{cells: {text}}}\n")
    message = refusal(path)
    for word in ("panels.fig05.cells = ", "(line 2, column 18)", "(allowed: a decimal number, true, false"):
        assert word in message


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        *(
            ("0", 0),
            ("-1", -1),
            ("100", 100),
            ("0.5", 0.5),
            ("-0.25", -0.25),
            ("1e3", 1000.0),
            ("1.5e-3", 0.0015),
        ),
        *(("1.0E+2", 100.0), ("true", True), ("false", False), ("null", None), ("", None)),
        *(("10N", "10N"), ("1/N", "1/N"), ("'011'", "011"), ('"yes"', "yes"), ("1,2", "1,2"), ("nan", "nan")),
    ],
)
def test_plain_words_mean_one_thing(path: Path, text: str, meaning: object) -> None:
    path.write_text(f"key: {text}\n")
    value = read(path).content["key"]
    assert value == meaning
    assert type(value) is type(meaning)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a: 1\nb: 2\na: 3\n", "a (line 3, column 1): the key stands here twice"),
        ("a: {yes: 1}\n", "= yes (line 1, column 5)"),
        ("a: {1: 2}\n", "a key is a name"),
        ("a: {[1]: 2}\n", "= a sequence (line 1, column 5): a key is a name"),
        ("a: {{b: 1}: 2}\n", "= a mapping (line 1, column 5): a key is a name"),
        (
            f"a: {'1' * 5000}\n",
            "(line 1, column 4): the number is too long (allowed: at most 100 characters)",
        ),
        ("a: &b 1\nc: *b\n", "c = *b (line 2, column 4): only a flat mapping can be shared"),
        ("a: &b {c: {d: 1}}\ne: *b\n", "only a flat mapping can be shared"),
        ("a: &b {c: 1}\nd: {<<: [*b, *b]}\n", "only a mapping can be merged"),
        ("a: &b {c: *b}\n", "only a flat mapping can be shared"),
        ("a: *b\n", "there is no such anchor above"),
        ("a: {<<: 1}\n", "only a mapping can be merged"),
        ("", "is empty"),
        ("- 1\n", "holds a list"),
        ("5\n", "holds one value"),
        ("a: [\n", "is not valid YAML: line 2"),
        ("a: 1\n---\nb: 1\n", "is not valid YAML"),
        ("a: \x07\n", "is not valid YAML"),
        ("a: " + "[" * 100_000, "nested too deeply"),
    ],
)
def test_other_refusals(path: Path, text: str, words: str) -> None:
    path.write_text(text)
    assert words in refusal(path)


def test_what_is_shared_may_be_completed(path: Path) -> None:
    path.write_text("a: &one {b: 1, c: 2}\nd: {<<: *one, c: 3}\ne: *one\n")
    assert read(path).content == {"a": {"b": 1, "c": 2}, "d": {"b": 1, "c": 3}, "e": {"b": 1, "c": 2}}


def test_what_is_no_file_of_text_is_refused(path: Path) -> None:
    assert "is missing" in refusal(path)
    path.mkdir()
    assert "is not a file" in refusal(path)
    path.rmdir()
    os.mkfifo(path)
    assert "is not a file" in refusal(path)
    path.unlink()
    path.write_bytes(b"a: \xff\n")
    assert "is not UTF-8 text: invalid start byte, byte 3" in refusal(path)


@pytest.mark.parametrize("name", ["paper", "schema", *(f"quality/{quality}" for quality in QUALITIES)])
def test_the_files_mean_what_yaml_says(name: str) -> None:
    path = FOLDER / f"{name}.yaml"
    assert read(path).content == yaml.safe_load(path.read_text())


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "effort:",
            "efort:",
            "schema.yaml: efort (line 4, column 8): there is no such key here; the nearest is effort",
        ),
        ("minimum: 1,", "minimum: one,", 'cells.minimum = "one"'),
        ("programs:", "programs: {}\nprograms:", "programs (line"),
    ],
)
def test_the_schema_is_checked_too(tmp_path: Path, old: str, new: str, words: str) -> None:
    for file in ("paper.yaml", "quality/smoke.yaml", "schema.yaml"):
        (tmp_path / file).parent.mkdir(exist_ok=True)
        (tmp_path / file).write_text((FOLDER / file).read_text())
    schema = tmp_path / "schema.yaml"
    assert old in schema.read_text()
    schema.write_text(schema.read_text().replace(old, new, 1))
    with pytest.raises(ConfigurationError) as raised:
        load_plan("smoke", tmp_path)
    assert words in str(raised.value)
