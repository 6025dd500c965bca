"""Every figure of the paper: programs write data/<quality>/<panel>/<run>.<identity>.h5, scripts render build/figures/<quality>/
<panel>.<identity>.*, and these are copied to figures/<quality>/<panel>.*

Names contain a hash of their inputs; missing files are made. Neither time stamps nor Snakemake's own records decide.
"""

import os
import shlex
import sys
from pathlib import Path

from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.described import BuildError
from workflow.pipeline.environment.variables import clean, stop_at_first_signal
from workflow.lib.files import in_one_line
from workflow.pipeline.lock import lock_products
from workflow.lib.identity import IDENTITY
from workflow.pipeline.plan import (
    RENDERING,
    RESULT,
    SUFFIXES,
    data_of,
    default_panels,
    rendering_command,
    load_plan,
    panel_named,
    products_of,
    report_stem,
    runs_of,
    stem_of,
)
from workflow.pipeline.program import command_line, require_built, threads_of

clean()
QUALITY = config.get("quality", "standard")
if unknown := {*config} - {"quality", "panel"}:
    sys.exit(f"--config {unknown.pop()}= is unknown; give quality= or panel=")
try:
    PLAN = load_plan(QUALITY)
    PANELS = [
        panel_named(PLAN, name).name for name in str(config.get("panel", "")).split()
    ] or default_panels(PLAN)
    DATA = {name: data_of(PLAN, name, QUALITY) for name in PLAN}
    STEMS = {name: stem_of(PLAN, name, QUALITY) for name in PLAN}
    REPORT = report_stem(PLAN, QUALITY)
    if workflow.is_main_process:
        runs = runs_of(PLAN, PANELS, QUALITY).items()
        for program in {run.program for path, run in runs if not os.path.exists(path)}:
            require_built(program)
        if not workflow.output_settings.dryrun:
            lock_products()
except (ConfigurationError, BuildError) as error:
    sys.exit(str(error))
except OSError as error:  # a panel without a script, or another command
    sys.exit(in_one_line(error))


def inputs_of(panels):
    """Results too: Snakemake does not remake a missing result whose figure is there."""
    return [ancient(path) for path in products_of(PLAN, panels, QUALITY)]


wildcard_constraints:
    quality=QUALITY,
    panel="[^/.]+",
    run="[^/]+",
    identity=IDENTITY,


localrules:
    figures,
    render,
    report,
    report_page,
    gallery,


onstart:
    stop_at_first_signal()


# All panels, or --config panel="fig05 fig08". Without outputs it is always executed: it copies missing and edited files to
# figures/<quality>.
rule figures:
    input:
        inputs_of(PANELS),
    params:
        stems=[STEMS[name] for name in PANELS],
    shell:
        ".venv/bin/python -m workflow.pipeline.publish {params.stems:q}"


include: "workflow/pipeline/rules/simulate.smk"
include: "workflow/pipeline/rules/render.smk"
include: "workflow/pipeline/rules/report.smk"
