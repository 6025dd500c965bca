"""Makes what is missing: results, panels, report, gallery, by Snakemake, which is a child process."""

import argparse
import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from workflow.lib.identity import panel_of
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import PYTHON, Panel, Plan, runs_of, warnings_of
from workflow.pipeline.program import compile_programs, require_built, require_valid
from workflow.pipeline.queue import Queue
from workflow.pipeline.state import Fault, State, faults_of_files, faults_of_results
from workflow.render.files import missing

LOG = Path("build/logs/snakemake.log")
SECONDS = 60  # between two lines of progress, if they do not go to a terminal, and two looks at a queue
SIGNALLED = range(128, 256)  # exit statuses after a signal
REFUSED = re.compile(
    r"sbatch: error: ([^'\n]+)|SLURM status is: '(?!FAILED)(\w+)'|(Job submission failed .+)"
)
DONE = {  # of the targets of Snakemake
    "figures": "The figures are in figures/{quality}{except_}",
    "panel": "In figures/{quality}: {panels}.pdf and .png .svg .csv",
    "report": "The report is figures/{quality}/report.html{except_}",
    "gallery": "The gallery is docs/gallery{except_}",
}


def make(plan: Plan, target: str, names: Sequence[str], options: argparse.Namespace) -> int:
    """Makes what is missing of a target of DONE; with DRY=yes, lists it. names: of the panels of the target
    `panel`. Returns the exit status. Raises ConfigurationError, BuildError, OSError, CalledProcessError."""
    panels = requested(plan, target, names)
    products = [*panels, plan.report] if target == "report" and plan.report else [*panels]
    runs = runs_of(panels)
    results = missing(runs)
    if options.dry:
        unmade = [path for product in products if product.is_incomplete() for path in product.files]
        print("\n".join([*results, *unmade]) or "Nothing to be made")
        return 0
    lock_products()
    for panel in (panel for panel in panels if names and panel.replaced):
        listed = ", ".join(panel.replaced)
        print(f"{panel.name}: other {listed} in quality/{plan.quality.file}.yaml than in its block")
    unmade_products = [product for product in products if product.is_incomplete()]
    if unmade_products or target == "gallery":
        if results:  # rendering needs no compiler
            compile_programs()
            for program in {runs[path].program for path in results}:
                require_built(program)
            require_valid(runs[path] for path in results)
        for log in [*map(log_of, results), *(product.log for product in unmade_products)]:
            Path(log).unlink(missing_ok=True)  # of a former failure
        status = snakemake(names or [target], plan.quality.name, options, unmade_products, results)
        if status:
            if status not in SIGNALLED:
                report_failure(products)
            return status
    return report_products(plan, target, panels, products)


def requested(plan: Plan, target: str, names: Sequence[str]) -> list[Panel]:
    """The panels of a target. Raises ConfigurationError."""
    if target in ("report", "gallery") and not plan.report:
        raise ConfigurationError("there is no folder workflow/study, which makes the report")
    return [plan[name] for name in names] or (plan.paper if target == "figures" else plan.reported)


def log_of(result: str) -> str:
    """Path of what the program of a result prints."""
    return result.removesuffix("h5") + "log"


def snakemake(
    targets: Sequence[str],
    quality: str,
    options: argparse.Namespace,
    products: Sequence[Panel],
    results: Sequence[str],
) -> int:
    """Makes what is missing of the targets. Returns the exit status: 0, 1, or 128 and the number of a signal.
    What Snakemake prints goes to LOG."""
    what = ["--config", f"quality={quality}", "--", *targets]
    progress = Progress(products, results)
    if options.profile == "default":
        return execute([*([f"--cores={options.jobs}"] if options.jobs else []), *what], progress)
    if results:
        words = [f"--workflow-profile=profiles/{options.profile}"]
        words += [f"--jobs={options.jobs}"] if options.jobs else []
        slurm = {"slurm_account": options.account, "slurm_partition": options.partition}
        resources = [f"{name}={value}" for name, value in slurm.items() if value]
        words += ["--default-resources", *resources] if resources else []
        status = execute([*words, *what], progress, Queue(LOG))
        if status in (0, *SIGNALLED) or progress.results:
            return status
    return execute(what, progress)  # all results exist, whatever the queue says: the rest is made here


class Progress:
    """Prints every product that is made meanwhile, and how many results there are, in a terminal on one
    line."""

    def __init__(self, products: Iterable[Panel], results: Sequence[str]) -> None:
        self.products, self.results = [*products], [*results]  # that are missing
        self._number, self._begin, self._jobs = len(results), time.monotonic(), ""
        self._next = self._begin + SECONDS / 3  # early, as a queue may state why no job can run

    def update(self, queue: Queue | None = None) -> None:
        self.results = missing(self.results)
        for product in [product for product in self.products if not product.is_incomplete()]:
            self.products.remove(product)
            print(f"{product.name}: {printed_by(product.log) or 'rendered'}", flush=True)
        now = time.monotonic()
        is_due = now > self._next
        if is_due:
            self._next = now + SECONDS
            self._jobs = f"; jobs: {queue.look()}" if queue else ""
        made = self._number - len(self.results)
        minutes = (now - self._begin) / 60
        line = f"{made} of {self._number} results after {minutes:.1f} minutes{self._jobs}"
        if sys.stdout.isatty():
            print(line.ljust(79), end="\r", flush=True)
        elif self._number and is_due:
            print(line, flush=True)


def execute(words: Sequence[str], progress: Progress, queue: Queue | None = None) -> int:
    """Runs Snakemake in a process group of its own, to which signals are passed on, so that programs write
    checkpoints. With the queue of a cluster, it ends when all results exist. Returns its exit status, or 128
    and the number of a signal that has come."""
    LOG.parent.mkdir(parents=True, exist_ok=True)
    with LOG.open("w") as log:
        command = [PYTHON, "-m", "snakemake", *words]
        process = subprocess.Popen(
            command, stdout=log, stderr=log, start_new_session=True, pass_fds=[lock_products()]
        )
        with passing_signals(process) as received:
            status = None
            while status is None:
                try:
                    status = process.wait(1)
                except subprocess.TimeoutExpired:
                    if queue and (received or queue.is_lost or not progress.results):
                        status = end(process)
                        if queue.is_lost:
                            log.write("No job is left in the queue; the same command submits them again\n")
                if queue and status is not None:
                    queue.cancel()
                progress.update(queue)
    if received:
        print("Stopped; the same command resumes", file=sys.stderr)
        return SIGNALLED[received[0]]
    return int(status != 0)


def end(process: "subprocess.Popen[bytes]") -> int:
    """Ends Snakemake, which would first wait for its next look at a queue, up to three minutes. Returns 1."""
    os.killpg(process.pid, signal.SIGINT)
    try:
        process.wait(5)  # until scripts have ended and their panels have the former files
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    return 1


@contextmanager
def passing_signals(process: "subprocess.Popen[bytes]") -> Iterator[list[int]]:
    """Passes the first signal that would end this command on to the process group; yields those received."""
    received: list[int] = []

    def stop(number: int, _: object) -> None:
        if not received and process.poll() is None:
            os.killpg(process.pid, number)
        received.append(number)

    numbers = [
        n for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP) if signal.getsignal(n) != signal.SIG_IGN
    ]
    former = {number: signal.signal(number, stop) for number in numbers}
    try:
        yield received
    finally:
        for number, handler in former.items():
            signal.signal(number, handler)


def report_failure(products: Sequence[Panel]) -> None:
    """Prints a line for each product that is not made, with the reason from a log."""
    failed, without = [product for product in products if product.is_incomplete()], []
    for product in failed:
        logs = [log_of(path) for path in missing(product.parents) if path.endswith(".h5")]
        reasons = ((log, text) for log in [*logs, product.log] if (text := printed_by(log)))
        if first := next(reasons, None):
            print(f"{product.name}: {first[1].splitlines()[-1]} ({first[0]})", file=sys.stderr)
        else:
            without.append(product.name)
    slurm = [*dict.fromkeys("".join(found) for found in REFUSED.findall(printed_by(str(LOG))))]
    if without:
        alone = len(without) == len(failed) and not slurm  # otherwise the last line is on something else
        reason = f": {(printed_by(str(LOG)).splitlines() or ['?'])[-1]}" if alone else ""
        print(f"{', '.join(without)}: not made{reason} ({LOG})", file=sys.stderr)
    for reason in slurm:
        print(f"Slurm: {reason}", file=sys.stderr)
    if made := len(products) - len(failed):
        print(f"{made} other panel{'s are' if made > 1 else ' is'} made", file=sys.stderr)


def printed_by(log: str) -> str:
    """What the command with this log has printed, "" if there is no such log."""
    path = Path(log)
    return path.read_text().strip() if path.exists() else ""


def report_products(plan: Plan, target: str, panels: Sequence[Panel], products: Sequence[Panel]) -> int:
    """Prints where the products are, without those that were edited by hand, and the number of runs with
    warnings. Returns the exit status: 1 if one was edited."""
    edited = faults_by_edit(panels, products)
    for fault in {*edited.values()}:
        print(f"{fault.path}: {fault.reason}, then repeat the command", file=sys.stderr)
    unedited = [panel.name for panel in panels if panel.name not in edited]
    words = {"quality": plan.quality.name, "panels": " ".join(unedited)}
    except_ = f", except {', '.join(edited)}" if edited else ""
    if unedited and not (target == "report" and "report" in edited):
        print(DONE[target].format(**words, except_=except_))
    if found := Counter(map(panel_of, warnings_of(panels))):
        numbers = ", ".join(f"{number} of {name}" for name, number in found.items())
        few = "; at smoke few replicas are intended" if plan.quality.file == "smoke" else ""
        print(f"Runs with warnings: {numbers}{few}: make status {plan.quality.arguments}")
    return int(bool(edited))


def faults_by_edit(panels: Sequence[Panel], products: Sequence[Panel]) -> dict[str, Fault]:
    """Products whose files, or results, were edited by hand, by name."""
    faults = {name: fault for name, fault in faults_of_files(products).items() if fault.state is State.EDITED}
    results = faults_of_results(runs_of(panels))
    for panel in panels:
        for path in {*results} & {*panel.parents}:
            if results[path].state is State.EDITED:
                faults[panel.name] = results[path]
    return faults
