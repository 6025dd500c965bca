"""Every figure of the paper: programs write data/<quality>/<panel>/<run>.<identity>.h5, scripts render
figures/<quality>/<panel>.*

`.venv/bin/snakemake`, or a panel by its name, `report`, or a file: `.venv/bin/snakemake fig05 --config
quality=smoke`. Names contain a hash of their inputs, that of a figure the name of its record,
<panel>.<identity>.json; missing files are made. Neither time stamps nor Snakemake's own records decide.
"""

import os
import shlex
import signal
import sys
from pathlib import Path

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # no traceback before onstart

from snakemake.jobs import GroupJob
from snakemake.logging import logger

from workflow.lib.identity import IDENTITY, ROOT
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.environment.variables import clean, stop_at_first_signal
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import PYTHON, RESULT, Plan
from workflow.pipeline.program import BuildError, command_line, require_built, threads_of
from workflow.pipeline.quality import DEFAULT_QUALITY
from workflow.render.files import format_os_error, write_atomically

if not os.path.samefile(".", ROOT):
    sys.exit(f"{os.getcwd()} is not the project's folder: run snakemake in {ROOT}, without -d")
clean()
if unknown := {*config} - {"quality"}:
    sys.exit(f"--config {unknown.pop()}= is unknown; give quality=")
try:
    PLAN = Plan(config.get("quality", DEFAULT_QUALITY))
    # A panel of the user may not have its script yet.
    PRODUCTS = [panel for panel in PLAN if panel in PLAN.reported or os.path.exists(panel.script)]
    PRODUCTS += filter(None, [PLAN.report])
    FILES = {product.name: product.files for product in PRODUCTS}
    PARENTS = {product.name: product.parents for product in PRODUCTS}
    if workflow.is_main_process and not workflow.output_settings.dryrun:
        lock_products()
except ConfigurationError as error:
    sys.exit(str(error))
except OSError as error:  # another command
    sys.exit(format_os_error(error))


def log_error(group, msg=None, log=GroupJob.log_error, **information):
    """Snakemake drops the message, which is why sbatch refuses a group of jobs, or how the group ended."""
    logger.error(msg)
    log(group, msg, **information)


GroupJob.log_error = log_error


wildcard_constraints:
    panel="[^/.]+",
    run="[^/]+",
    identity=IDENTITY,


onstart:
    stop_at_first_signal()
    write_atomically(
        {Path(panel.job_path): panel.job().encode() for panel in PRODUCTS if panel != PLAN.report}
    )


def whole(products):
    """Files of products and what they are made from, which are made if missing, whatever their times."""
    names = [product.name for product in products]
    return [ancient(path) for name in names for path in [*PARENTS[name], *FILES[name]]]


def run_of(wildcards):
    return PLAN[wildcards.panel].run(wildcards.run)


def command(wildcards, threads):
    """Command of a run. A program that is not built from the present sources would write another result."""
    run = run_of(wildcards)
    try:
        require_built(run.program)
    except BuildError as error:
        sys.exit(str(error))
    return shlex.join(command_line(run, threads))


rule figures:
    input:
        whole(PLAN.paper),
    localrule: True


for product in PRODUCTS:

    rule:
        name:
            product.name
        input:
            whole([product]),
        localrule: True

    # A panel whose script fails keeps its former files: update() restores them. Its record has another name.
    rule:
        name:
            f"render_{product.name}"
        input:
            [ancient(path) for path in PARENTS[product.name]],
        output:
            [update(path) for path in FILES[product.name][:-1]],
            FILES[product.name][-1],
        log:
            product.log,
        priority: 10**9  # before any run
        localrule: True
        params:
            command=product.command,
        shell:
            "{params.command} 2> {log:q}"


if PLAN.report:

    rule gallery:
        input:
            whole(PLAN.reported),
        localrule: True
        shell:
            "{PYTHON} -m workflow.study.report {PLAN.quality.name} --gallery"


# One run of a program. Exit status 4: stopped before the target error; the result and the figure are marked.
# --resume continues from the checkpoint of an interrupted program. The log is beside the result: otherwise
# Snakemake deletes the empty folder before the checkpoint is written.
rule simulate:
    output:
        f"data/{PLAN.quality.name}/{RESULT}",
    log:
        f"data/{PLAN.quality.name}/{RESULT}".removesuffix("h5") + "log",
    priority: lambda wildcards: -[*PLAN.panels].index(wildcards.panel)  # earlier panels first
    # On a cluster several short runs share a job.
    group:
        lambda wildcards: "short" if threads_of(run_of(wildcards)) == 1 else None
    threads: lambda wildcards: threads_of(run_of(wildcards))
    params:
        command=command,
    shell:
        "{params.command} --progress log --output {output:q} 2> {log:q} || [ $? = 4 ]"
