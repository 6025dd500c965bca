"""Runs as jobs of a cluster: parts of their replicas, joined on the login node to the result of a single execution.

Parts are not part of the identity of a run: a joined result has the name and the bytes of a single execution.
"""

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
    name = f"{wildcards.panel}/{wildcards.run}"
    folder = f"{PARTS}/{wildcards.quality}/{name}.{wildcards.identity}"
    return [f"{folder}/{part.name}.part" for part in DIVISION.get(name, [])]


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
        temp(f"{PARTS}/{{quality}}/{{panel}}/{{run}}.{{identity}}/{{batch}}_{{part}}.part"),
    log:
        "build/logs/{quality}/{panel}/{run}.{identity}/{batch}_{part}.log",
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
