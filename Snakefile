"""Every figure of the paper: programs write data/<quality>/<panel>/<run>.<identity>.h5, scripts render figures/<quality>/<panel>.*

`.venv/bin/snakemake figures`, or a panel by its name, or a file: `.venv/bin/snakemake fig05 --config quality=smoke`. Names contain a hash of
their inputs, that of a figure the name of its record, <panel>.<identity>.json; missing files are made. Neither time stamps nor Snakemake's own
records decide.
"""

import os
import shlex
import signal
import sys

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # no traceback before onstart

from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.described import BuildError
from workflow.pipeline.environment.variables import clean, stop_at_first_signal
from workflow.lib.files import format_os_error, missing
from workflow.pipeline.lock import lock_products
from workflow.lib.identity import IDENTITY, ROOT
from workflow.pipeline.plan import (
    DEFAULT_QUALITY,
    REPORT,
    RESULT,
    data_of,
    default_panels,
    files_of,
    load_plan,
    panel_named,
    rendering_of,
    runs_of,
)
from workflow.pipeline.program import command_line, require_built, threads_of

if not os.path.samefile(".", ROOT):
    sys.exit(f"{os.getcwd()} is not the project's folder: run snakemake in {ROOT}, without -d")
clean()
QUALITY = config.get("quality", DEFAULT_QUALITY)
if unknown := {*config} - {"quality", "panel"}:
    sys.exit(f"--config {unknown.pop()}= is unknown; give quality= or panel=")
try:
    PLAN = load_plan(QUALITY)
    PANELS = [
        panel_named(PLAN, name).name for name in str(config.get("panel", "")).split()
    ] or default_panels(PLAN)
    DATA = {name: data_of(PLAN, name, QUALITY) for name in PLAN}
    FILES = {name: files_of(PLAN, name, QUALITY) for name in (*PLAN, REPORT)}
    JOBS = {name: rendering_of(PLAN, name, QUALITY).json for name in PLAN}
    if workflow.is_main_process:
        runs = runs_of(PLAN, PANELS, QUALITY)
        for program in {runs[path].program for path in missing(runs)}:
            require_built(program)
        if not workflow.output_settings.dryrun:
            lock_products()
except (ConfigurationError, BuildError) as error:
    sys.exit(str(error))
except OSError as error:  # a panel without a script, or another command
    sys.exit(format_os_error(error))


wildcard_constraints:
    quality=QUALITY,
    panel="[^/.]+",
    run="[^/]+",
    identity=IDENTITY,


localrules:
    figures,
    results,
    report,


onstart:
    stop_at_first_signal()


def present(files):
    """Inputs that are remade if they are missing, whatever their times."""
    return [ancient(path) for path in files]


rule figures:
    input:
        [present([*DATA[name], *FILES[name]]) for name in PANELS],


# All that the panels plot. python -m workflow renders them by one process.
rule results:
    input:
        [present(DATA[name]) for name in PANELS],


for panel_name in PLAN:

    rule:
        name:
            panel_name
        input:
            present(DATA[panel_name]),
        output:
            FILES[panel_name],
        priority: 10**9  # before any run
        localrule: True
        params:
            job=JOBS[panel_name],
        shell:
            ".venv/bin/python -m workflow.lib.render {params.job:q}"


rule report:
    input:
        [present([*DATA[name], *FILES[name]]) for name in PLAN],
    output:
        FILES[REPORT],
    shell:
        ".venv/bin/python -m workflow.report.write --quality {QUALITY:q}"


def run_of(wildcards):
    return PLAN[wildcards.panel].run(wildcards.run)


# One run of a program. Exit status 4: stopped before the target error; the result and the figure are marked. --resume continues from the
# checkpoint of an interrupted program. The log is beside the result: otherwise Snakemake deletes the empty folder before the checkpoint is
# written.
rule simulate:
    output:
        RESULT,
    log:
        RESULT.removesuffix("h5") + "log",
    priority: lambda wildcards: -[*PLAN].index(wildcards.panel)  # earlier panels first
    group:
        lambda wildcards: "short" if threads_of(run_of(wildcards)) == 1 else None  # on a cluster, several in a job
    threads: lambda wildcards: threads_of(run_of(wildcards))
    params:
        command=lambda wildcards, threads: shlex.join(command_line(run_of(wildcards), threads)),
    shell:
        "{params.command} --progress log --output {output:q} 2> {log:q} || [ $? = 4 ]"
