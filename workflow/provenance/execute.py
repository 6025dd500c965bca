"""Runs one job and enters it into the lock: a program, which makes data, or a script, which draws a figure.

Run by the rules: python -I -S workflow/environment/launch.py workflow.provenance.execute simulate|draw. No shell sees an option's value, and no
variable of the caller's environment reaches the job. Standard library only, as it starts for every job.
"""

import argparse
import contextlib
import glob
import hashlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from workflow.lib.locks import hold_as_job
from workflow.lib.options import Options, arguments
from workflow.lib.parents import PACKAGES, Parents, file_hash
from workflow.lib.places import move, regular
from workflow.provenance.lock import LockError, record
from workflow.provenance.node import difference_of_node
from workflow.provenance.repository import ROOT
from workflow.provenance.scratch import scratch

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
TOGETHER = 0.3  # seconds, as of a signal to all processes of a group
LAUNCH = "workflow/environment/launch.py"
UNCONVERGED = 4  # exit status of a program that wrote its result and says that the target was not reached
STATUSES = (0, UNCONVERGED)  # of a program that wrote its result
COST_OF_PART = ".part.cost.json"
ENVIRONMENT = {
    "PATH": "/usr/local/bin:/usr/bin:/bin",
    "LC_ALL": "C.UTF-8",
    "TZ": "UTC",
    "PYTHONHASHSEED": "0",
    "PYTHONNOUSERSITE": "1",
    "PYTHONDONTWRITEBYTECODE": "1",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MPLBACKEND": "Agg",
    "MPLCONFIGDIR": str(ROOT / ".cache/matplotlib"),
}


def program_command(program: str, options: Options, output: Path) -> list[str]:
    return [str(ROOT / "build/bin" / program), *arguments(options), "--output", str(output)]


def script_command(
    script: str, configuration: str, sources: Iterable[str], data: Iterable[str], stem: Path
) -> list[str]:
    """Draws a panel; sources are the script and what it imports."""
    module = script.removesuffix(".py").replace("/", ".")
    command = [sys.executable, "-P", LAUNCH, module, "--configuration", configuration, "--output", str(stem)]
    return [*command, "--lock", PACKAGES, "--sources", *sources, "--data", *data]


def call(command: list[str], allowed: tuple[int, ...] = (0,)) -> int:
    """Exit status; leaves with it if it is not among the allowed ones. On SIGINT, SIGTERM and SIGHUP a program writes its
    checkpoint, which this process waits for; a terminal sends SIGINT to both. A second signal ends both at once, but not one that
    follows so closely that it has the same cause."""
    # Its files stay open in the child, which so holds the lock of the jobs too.
    child = subprocess.Popen(command, cwd=ROOT, env=ENVIRONMENT, close_fds=False)
    first: list[float] = []

    def stop(number: int, _: object) -> None:
        now = time.monotonic()
        if first and now - first[0] > TOGETHER:
            child.kill()
            sys.exit(128 + number)
        first.append(now)
        if number != signal.SIGINT:
            child.send_signal(number)

    for number in ENDING:
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:  # as nohup has it
            signal.signal(number, stop)
    status = child.wait()
    if status not in allowed:
        sys.exit(status if status > 0 else 128 - status)
    return status


def built(program: str) -> tuple[dict[str, Any], str]:
    """What the program was built from, and the hash of its file. Leaves if it is not the file that was built."""
    build = json.loads(regular(ROOT / f"build/id/{program}.json").read_text())
    executable = file_hash(ROOT / "build/bin" / program)
    if executable not in regular(ROOT / f"build/id/{program}.sha256").read_text(errors="replace").split():
        sys.exit(
            f"build/bin/{program} is not what was built: edited or replaced. `make build` builds it again."
        )
    return build, executable


def identity_of(program: str, options: Options) -> str:
    """Changes with build and options. Partial results, checkpoints and parts have it in their name, so that an interrupted
    run goes on and one with other parameters starts anew."""
    build, _ = built(program)
    return hashlib.sha256(json.dumps([options, build["build_id"]]).encode()).hexdigest()[:16]


def run_program(job: argparse.Namespace, partial: Path, *more: str) -> tuple[dict[str, Any], str, int, Path]:
    """Build, executable, exit status and the result, which waits for its entry in the lock. One that an earlier job could not
    enter, as on a full disk, is taken. Leaves if the program is not what was built, before and after."""
    build, executable = built(job.program)
    if not job.here and (difference := difference_of_node(job.program)):
        sys.exit(difference)
    for status in STATUSES:
        if result := waiting(partial, status):
            return build, executable, status, result
    partial.parent.mkdir(parents=True, exist_ok=True)
    with contextlib.nullcontext(partial) if job.here else scratch(partial) as output:
        command = program_command(job.program, job.options, output)
        status = call([*command, *more, "--progress", "log"], STATUSES)
    if built(job.program) != (build, executable):
        sys.exit(f"build/bin/{job.program} was built again while it ran; run make again")
    result = partial.with_name(f"{ended(partial, status)}{file_hash(partial)}{partial.suffix}")
    move(partial, result)
    return build, executable, status, result


def ended(partial: Path, status: int) -> str:
    """How the name of a result begins that waits for its entry in the lock; its hash follows, as renaming needs no space on
    the disk."""
    return f"{partial.stem}.exit{status}-"


def waiting(partial: Path, status: int) -> Path | None:
    """A result whose program has ended with this status, if one waits; what is not as it was written is removed."""
    start = ended(partial, status)
    for path in partial.parent.glob(f"{glob.escape(start)}*{partial.suffix}"):
        if file_hash(regular(path)) == path.stem.removeprefix(start):
            return path
        path.unlink()
    return None


def measure_part(job: argparse.Namespace) -> None:
    """Some replicas of a run, on any machine that sees this folder."""
    output = Path(job.output)
    partial = Path("build/partial", *output.parts[2:])
    *_, result = run_program(job, partial, "--threads", "1", "--resume", "--part", job.part)
    output.parent.mkdir(parents=True, exist_ok=True)
    costs = partial.with_suffix(COST_OF_PART)
    cost = json.loads(costs.read_text()) | {"sha256": file_hash(result)}
    output.with_suffix(COST_OF_PART).write_text(json.dumps(cost) + "\n")
    move(result, output)
    costs.unlink()  # last, as a job that is killed before takes the waiting result, and needs its costs


def require_parts(folder: Path) -> None:
    """Removes the parts that are not what their jobs wrote, so that they are measured again, and leaves if there are any."""
    damaged = [path for path in sorted(folder.glob("*.part")) if not whole(path)]
    for path in damaged:
        path.unlink()
    if damaged:
        names = ", ".join(map(str, damaged))
        sys.exit(f"{names}: not what the job wrote, and removed; the same command measures it again")


def whole(part: Path) -> bool:
    try:
        known: object = json.loads(part.with_suffix(COST_OF_PART).read_text())["sha256"]
        return known == file_hash(regular(part))
    except (OSError, ValueError, KeyError, TypeError):
        return False


def simulate(job: argparse.Namespace) -> None:
    name = f"{job.quality}/{job.panel}/{job.run}"
    partial = Path(f"build/partial/{name}-{identity_of(job.program, job.options)}.h5")
    more = ["--threads", str(job.threads), "--resume"] if job.replicated else []
    if job.parts:
        require_parts(Path(job.parts))
    joined = ["--join", job.parts] if job.parts else []
    build, executable, status, result = run_program(job, partial, *more, *joined)
    cost = partial.with_suffix(".cost.json")
    made_by = {"tool": job.program, "options": job.options, "exit": status}
    made_by |= {"build_id": build["build_id"], "executable": executable}
    output = f"data/{name}.h5"
    record(job.quality, f"{job.panel}/{job.run}", {output: file_hash(result)}, made_by, build)
    entered = Path(f"build/costs/{name}.json")
    for path in (entered, Path(output)):
        path.parent.mkdir(parents=True, exist_ok=True)
    if cost.exists():
        move(cost, entered)
        if job.parts:
            add_costs(entered, Path(job.parts))
    move(result, Path(output))


def add_costs(joined: Path, parts: Path) -> None:
    """Those of the parts in a folder to that of joining them, which knows the events of all. The memory is the largest."""
    costs = [json.loads(path.read_text()) for path in (joined, *sorted(parts.glob("*.cost.json")))]
    total = {key: sum(cost[key] for cost in costs) for key in ("wall_seconds", "cpu_seconds")}
    total["peak_memory_bytes"] = max(cost["peak_memory_bytes"] for cost in costs)
    joined.write_text(json.dumps(costs[0] | total) + "\n")


def draw(job: argparse.Namespace) -> None:
    script, stem = job.sources[0], Path(f"figures/{job.quality}/{job.panel}")
    status = call(script_command(script, job.configuration, job.sources, job.data, stem))
    parents = Parents.of(stem.with_suffix(".csv"))
    made_by = {"tool": script, "options": {"configuration": job.configuration}, "exit": status}
    inputs = parents.inputs()
    order = [*job.sources, PACKAGES, *job.data]
    made_by |= {"inputs": {path: inputs[path] for path in order}, "python": parents.python}
    outputs = {
        f"{stem}.{kind}": file_hash(stem.with_suffix(f".{kind}")) for kind in ("csv", "pdf", "png", "svg")
    }
    record(job.quality, job.panel, outputs, made_by)


def main() -> None:
    parser = argparse.ArgumentParser(description="Runs a job and enters it into the lock")
    kinds = parser.add_subparsers(required=True)
    run, part, drawing = (kinds.add_parser(kind) for kind in ("simulate", "part", "draw"))
    for kind, function in ((run, simulate), (part, measure_part), (drawing, draw)):
        kind.set_defaults(function=function)
        kind.add_argument("--log", required=True)
        kind.add_argument("--here", action="store_true", help="on the machine of the make that starts it")
    for kind in (run, drawing):
        kind.add_argument("--quality", required=True)
        kind.add_argument("--panel", required=True)
    for kind in (run, part):
        kind.add_argument("--program", required=True)
        kind.add_argument("--options", type=json.loads, required=True, help="JSON object")
    run.add_argument("--run", required=True)
    run.add_argument("--threads", type=int, required=True)
    run.add_argument("--replicated", action="store_true", help="the program takes --threads and --resume")
    run.add_argument("--parts", default="", help="folder of the parts that are joined")
    part.add_argument("--part", required=True, help="first and last replica, as 0-23")
    part.add_argument("--output", required=True)
    drawing.add_argument("--configuration", required=True, help="hash of the panel's configuration")
    drawing.add_argument("--sources", nargs="+", required=True, help="the script and what it imports")
    drawing.add_argument("--data", nargs="+", required=True)
    job = parser.parse_args()
    if job.here:
        hold_as_job()
    with regular(Path(job.log)).open("w") as log:
        os.dup2(log.fileno(), sys.stderr.fileno())
    try:
        job.function(job)
    except LockError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
