"""Changes one place of an estimator, of the engine or of a rule at a time, and sees whether a test fails.

python -m tests.mutants SHARE: that share of the places, always the same ones. A change that no test notices is printed
unless tests/mutants.yaml says why it changes nothing that could be seen. Ends with the count.
"""

import hashlib
import re
import shutil
import subprocess
import sys
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
EXPLAINED = ROOT / "tests/mutants.yaml"
BESIDE = re.compile(r'"""(?s:.*?)"""|"(?:\\.|[^"\\\n])*"|^\s*#.*$|(?://|# ).*$|\bassert\b.*$', re.MULTILINE)

Change = Callable[[re.Match], str]


def to(text: str) -> Change:
    return lambda _: text


def both_ways(*pairs: tuple[str, str]) -> list[tuple[str, Change]]:
    """Formatted sources have a blank on both sides of a binary operator."""
    return [
        (re.escape(f" {before} "), to(f" {after} "))
        for one, other in pairs
        for before, after in ((one, other), (other, one))
    ]


CHANGES: list[tuple[str, Change]] = [
    *both_ways(("+", "-"), ("*", "/"), ("+=", "-="), ("*=", "/=")),
    *both_ways(("<", ">="), (">", "<="), ("==", "!="), ("&&", "||"), ("and", "or")),
    (r"(?<=\w)\*\*(?=\w)", to("*")),
    (r"(?:std::|math\.|np\.)?(?:sqrt|cbrt|abs|fabs|hypot)\(", to("(")),
    (r"\bmin\(", to("max(")),
    (r"\bmax\(", to("min(")),
    (r"\bnot (?!in\b)", to("")),
    (r"(?<=[(\s])[-!](?=[a-z_(])", to("")),
    (r"(?<![\w.\"])\d+(?![\w.])", lambda found: str(int(found[0]) + 1)),
    (r"(?<![\w.])\d+\.\d+(?:e-?\d+)?(?![\w.])", lambda found: repr(2 * float(found[0]) or 1.0)),
]


@dataclass(frozen=True)
class Mutant:
    path: str
    source: str
    start: int
    end: int
    text: str

    @property
    def changed(self) -> str:
        return self.source[: self.start] + self.text + self.source[self.end :]

    def line(self, source: str) -> str:
        return source[source.rfind("\n", 0, self.start) + 1 :].split("\n", 1)[0].strip()

    @property
    def key(self) -> str:
        """Lines before and after, which stay what they are when other lines change."""
        return f"{self.line(self.source)}  →  {self.line(self.changed)}"

    @property
    def place(self) -> str:
        return f"{self.path}:{self.source.count(chr(10), 0, self.start) + 1}"

    def chosen(self, share: float) -> bool:
        digest = hashlib.sha256(f"{self.path} {self.key}".encode()).digest()
        return int.from_bytes(digest[:4]) < share * 2**32


def mutants(path: str) -> Iterator[Mutant]:
    source = (ROOT / path).read_text()
    code = BESIDE.sub(lambda found: " " * len(found[0]), source)
    for pattern, change in CHANGES:
        for found in re.finditer(pattern, code):
            yield Mutant(path, source, found.start(), found.end(), change(found))


class Lane(ABC):
    """A copy of the sources in which one mutant after the other is tried."""

    name: str
    sources: tuple[str, ...]

    def __init__(self) -> None:
        self.folder = ROOT / "build/mutants" / self.name
        shutil.rmtree(self.folder / "tests", ignore_errors=True)
        tracked = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
        for name in filter(None, tracked.split("\0")):
            target = self.folder / name
            if not (target.is_file() and target.read_bytes() == (ROOT / name).read_bytes()):
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(ROOT / name, target)

    def paths(self) -> list[str]:
        return sorted(str(path.relative_to(ROOT)) for pattern in self.sources for path in ROOT.glob(pattern))

    def runs(self, *command: str | Path, timeout: float = 120) -> bool:
        try:
            done = subprocess.run(
                command,
                cwd=self.folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=timeout,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return False
        return done.returncode == 0

    def prepare(self) -> None:
        if not self.passes(""):
            sys.exit(f"{self.name}: the tests fail without a change")

    @abstractmethod
    def passes(self, path: str) -> bool:
        """Whether no test notices what this source has become."""

    def survives(self, mutant: Mutant) -> bool:
        target = self.folder / mutant.path
        target.write_text(mutant.changed)
        try:
            return self.passes(mutant.path)
        finally:
            target.write_text(mutant.source)


class Workflow(Lane):
    """Laws that are fitted, numbers of the claims, and rules of the verdicts."""

    name = "workflow"
    sources = ("workflow/claims/*.py", "workflow/lib/fit.py", "workflow/lib/growth.py")
    tests = ("claim", "fit", "growth", "linear_response", "verdict")

    def passes(self, path: str) -> bool:
        chosen = [
            str(one) for name in self.tests for one in self.folder.glob(f"tests/python/test_{name}*.py")
        ]
        return self.runs(sys.executable, "-m", "pytest", "-x", "-c", "tests/pytest.ini", *chosen)


class Programs(Lane):
    """Engine, statistics and what the programs measure. First the tests beside the source, then all."""

    name = "cpp"
    sources = tuple(
        f"cpp/{place}/*.cpp" for place in ("boltzmann", "engine", "numerics", "runs", "statistics")
    )

    def __init__(self) -> None:
        super().__init__()
        instrumented = "-DINSTRUMENTATION=-O1;-D_GLIBCXX_ASSERTIONS"
        for command in (
            ["cmake", "-S", "cpp", "-B", "build", "-G", "Ninja", instrumented],
            ["ninja", "-C", "build", "cpp_tests"],
        ):
            if not self.runs(*command, timeout=3600):
                sys.exit(f"{self.name}: {' '.join(command)} failed")

    def passes(self, path: str) -> bool:
        if not self.runs("ninja", "-C", "build", "cpp_tests"):
            return False
        tests = self.folder / "tests" / Path(path).parent
        named = re.findall(r"^TEST\w*\((\w+),", "".join(one.read_text() for one in tests.glob("*.cpp")), re.M)
        near = ":".join(f"{suite}.*:*/{suite}.*" for suite in sorted({*named}))
        return all(
            self.runs("build/bin/cpp_tests", "--gtest_fail_fast", f"--gtest_filter={chosen}")
            for chosen in ((near, f"-{near}") if near else ("*",))
        )


def tried(lane: Lane, share: float, explained: dict[str, str]) -> tuple[int, list[Mutant]]:
    chosen = [one for path in lane.paths() for one in mutants(path) if one.chosen(share)]
    lane.prepare()
    survivors = []
    for one in chosen:
        if one.key not in explained and lane.survives(one):
            survivors.append(one)
            print(f"{one.place}: {one.key}", flush=True)
    return len(chosen), survivors


def main(share: float) -> int:
    explained = yaml.safe_load(EXPLAINED.read_text()) or {} if EXPLAINED.is_file() else {}
    lanes = [Workflow(), Programs()]
    with ThreadPoolExecutor() as pool:
        results = [*pool.map(lambda lane: tried(lane, share, explained), lanes)]
    tested, survivors = sum(count for count, _ in results), sum(len(some) for _, some in results)
    print(f"{tested} changes, {survivors} that no test noticed")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1])))
