"""Every figure of the paper: programs write data/<quality>/<panel>/<run>.h5, scripts render figures/<quality>/<panel>.*

Parameters decide what reruns (profiles/default): options and build id of a program, sources and configuration of a script. Time
stamps have no effect.
"""

import os
import shlex
import sys
from functools import cache

from workflow.cluster.cost import seconds_of_run
from workflow.lib.configuration import ConfigurationError, arguments
from workflow.lib.figure_metadata import PACKAGES, digest_of_files, sources_of
from workflow.lib.plan import data_of, drawing_command, drawings_of, load_plan, panel_named, with_used
from workflow.provenance.build_id import BuildError, built

shell.prefix("source workflow/environment/variables.sh; ")  # a bare `snakemake` gives the same bytes as make
QUALITY = config.get("quality", "standard")
try:
    PLAN = load_plan(QUALITY)
    PANEL = config.get("panel") and panel_named(PLAN, config["panel"]).name
    PROGRAMS = {run.program for panel in PLAN.values() for run in panel.runs}
    BUILDS = {program: built(program)["build_id"] for program in PROGRAMS}
except (ConfigurationError, BuildError) as error:
    sys.exit(str(error))


include: "workflow/rules/common.smk"


wildcard_constraints:
    quality=QUALITY,
    panel="[^/]+",
    run="[^/]+",


rule figures:
    input:
        [path for panel in PLAN for path in products_of(panel)],


rule panel:
    input:
        products_of(PANEL) if PANEL else [],


include: "workflow/rules/simulate.smk"
include: "workflow/rules/draw.smk"


if "batch" in config:

    include: "workflow/rules/cluster.smk"
