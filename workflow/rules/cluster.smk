"""Runs as jobs of a cluster: parts of their replicas, joined on the login node to the result of a single execution.

Inputs of a run are not part of its identity (rerun-triggers): a joined result is fresh on one machine, too.
"""

import hashlib
import math
import re

from workflow.cluster.batches import divide

DIVISION = divide(PLAN.values(), 60 * float(config["batch"]), seconds_of_run)


localrules:
    join,
    draw,
    draw_extension,


ruleorder: join > single > simulate


def parts_of_run(wildcards):
    """Part files of a run; none if the run is not split."""
    run, name = run_of(wildcards), f"{wildcards.panel}/{wildcards.run}"
    parts = [part.name for part in DIVISION.get(name, [])]
    identity = hashlib.sha256(f"{run.options} {BUILDS[run.program]} {parts}".encode()).hexdigest()[:16]
    return [f"build/parts/{QUALITY}/{name}/{identity}/{part}.part" for part in parts]


def minutes(wildcards, attempt):
    """Twice the estimate, as machines differ, and one for the start."""
    part = DIVISION.get(f"{wildcards.panel}/{wildcards.run}", [None])[0]
    seconds = part.seconds if part else seconds_of_run(wildcards.panel, run_of(wildcards))
    return attempt * (1 + math.ceil(2 * seconds / 60))


use rule simulate as join with:
    input:
        parts_of_run,
    wildcard_constraints:
        run="|".join(sorted({re.escape(name.partition("/")[2]) for name in DIVISION})),
    priority: 10**9


use rule simulate as single with:
    group:
        "{panel}"
    resources:
        runtime=minutes,
        mem_mb=lambda wildcards, attempt: 500 * 2**attempt,
        slots=1,


use rule simulate as part with:
    output:
        temp("build/parts/{quality}/{panel}/{run}/{identity}/{batch}_{part}.part"),
    log:
        "build/logs/{quality}/{panel}/{run}/{identity}/{batch}_{part}.log",
    wildcard_constraints:
        batch="batch[0-9]+",
        part="[0-9]+-[0-9]+",
    group:
        "{batch}"
    resources:
        runtime=minutes,
        mem_mb=lambda wildcards, attempt: 500 * 2**attempt,
        slots=1,
    params:
        join=lambda wildcards: f"--part {wildcards.part} --checkpoint-interval 600",
