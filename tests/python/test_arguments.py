"""Arguments of make are refused in one line before anything happens."""

import os
import subprocess

import pytest

from tests.python.conftest import ROOT
from workflow.environment.arguments import fault, unused


@pytest.mark.parametrize(
    "argument",
    ["QUALITY=smoke", "PANEL=fig02_upper", "JOBS=16", "FRESH=yes", "FRESH=", "SEED=0", "REPLICAS=200", "SAMPLE=1",
     "SAMPLE=.05", "FILE=a copy; of 'x'.pdf", "CRATE=../crate.zip", "FULL=no"],
)  # fmt: skip
def test_admitted(argument: str) -> None:
    assert fault(argument) is None


@pytest.mark.parametrize(
    ("argument", "words"),
    [
        ("quality=smoke", "did you mean QUALITY"),
        ("QUALTY=smoke", "did you mean QUALITY"),
        ("SEEDS=7", "did you mean SEED"),
        ("MAKEFLAGS=-k", "choose from QUALITY"),
        ("SHELL=/bin/sh", "is not an argument"),
        ("QUALITY=smok", "try QUALITY=smoke"),
        ("QUALITY=smoke paper", "one of smoke"),
        ("QUALITY=", "one of smoke"),
        ("PANEL=fig03;touch x", "the name of a panel"),
        ("PANEL=fig03\n", "the name of a panel"),
        ("PANEL=../fig03", "the name of a panel"),
        ("JOBS=0", "from 1 to 999"),
        ("JOBS=-1", "from 1 to 999"),
        ("JOBS=2.5", "from 1 to 999"),
        ("JOBS=٣", "from 1 to 999"),
        ("FRESH=maybe", "yes or no"),
        ("SEED=-1", "whole number"),
        ("SEED=1e3", "whole number"),
        ("REPLICAS=3", "from 4, as errors need some"),
        ("REPLICAS=100000001", "to 100000000"),
        ("JOBS=1000", "from 1 to 999"),
        ("SEED=007", "whole number"),
        ("SAMPLE=0", "a share"),
        ("SAMPLE=0.0", "a share"),
        ("SAMPLE=1.1", "a share"),
        ("SAMPLE=nan", "a share"),
        ("FILE=", "the path of a file"),
    ],
)
def test_refused(argument: str, words: str) -> None:
    said = fault(argument)
    assert said is not None
    assert words in said
    assert "\n" not in said


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["help", "QUALITY=smo\nke"], "no argument may hold a line break"),
        (["he\nlp", "QUALITY=smoke"], "no argument may hold a line break"),
        (["--touch", "help"], "make -t and -q are not admitted"),
        (["-sq", "help"], "make -t and -q are not admitted"),
        (["-o", "help", "help"], "make -o and -W are not admitted"),
        (["-sW", "help", "help"], "make -o and -W are not admitted"),
        (["--old-file=help", "help"], "make -o and -W are not admitted"),
        (["help", "PROFILE=slrum"], "there is no profiles/slrum/config.yaml"),
        (["figures", "PROFILE=default"], "there is no profiles/default/config.yaml for a cluster"),
    ],
)
def test_refused_by_make_itself(arguments: list[str], words: str) -> None:
    made = subprocess.run(
        ["/usr/bin/make", *arguments],
        cwd=ROOT,
        env={"PATH": os.defpath},
        capture_output=True,
        text=True,
        check=False,
    )
    assert made.returncode == 2
    assert made.stdout == ""
    assert words in made.stderr


def test_a_dash_in_front_makes_no_option_of_a_value() -> None:
    made = subprocess.check_output(
        ["/usr/bin/make", "-n", "audit", "CRATE=-x"], cwd=ROOT, env={"PATH": os.defpath}, text=True
    )
    assert "--crate='-x'" in made


@pytest.mark.parametrize(
    ("value", "words"),
    [("fig5", "the nearest is fig05"), ("-h", "there is fig01, "), ("fig04", "the nearest is")],
)
def test_an_unknown_panel_is_told_before_anything_is_installed(value: str, words: str) -> None:
    assert words in str(fault(f"PANEL={value}"))


@pytest.mark.parametrize(
    ("goals", "argument"),
    [
        ([], "QUALITY=smoke"),
        (["figures"], "QUALITY=smoke"),
        (["build", "panel"], "PANEL=fig05"),
        (["cost"], "PANEL=fig05"),
    ],
)
def test_used(goals: list[str], argument: str) -> None:
    assert unused(goals, argument) is None


@pytest.mark.parametrize(
    ("goals", "argument", "words"),
    [
        (["clean"], "QUALITY=smoke", "make clean does not use QUALITY; it uses no arguments"),
        (["clean", "panel"], "PANEL=fig05", "make clean does not use PANEL"),
        (["figures"], "PANEL=fig05", "make figures does not use PANEL"),
        (["status"], "FRESH=yes", "make status does not use FRESH"),
        (["audit"], "SAMPLE=1", "make audit does not use SAMPLE; it uses QUALITY"),
        (["cost"], "JOBS=2", "make cost does not use JOBS; it uses QUALITY, SEED, REPLICAS, PANEL"),
        (["build", "test"], "JOBS=2", "make build test does not use JOBS"),
    ],
)
def test_unused(goals: list[str], argument: str, words: str) -> None:
    assert words in str(unused(goals, argument))
