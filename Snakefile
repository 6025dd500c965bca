"""Every figure of the paper: programs write data/<quality>/<panel>/<run>.<identity>.h5, scripts render figures/<quality>/<panel>.*
and their record <panel>.<identity>.json

What determines a product is in its name. A missing name is made; neither time stamps nor Snakemake's own records decide.
"""

import os
import shlex
import signal
import sys
from pathlib import Path

from workflow.cluster.cost import PARTS, seconds_of_run
from workflow.lib.configuration import ConfigurationError
from workflow.lib.figure_metadata import panel_identity, read_panel
from workflow.lib.files import refuse_another_folder
from workflow.lib.identity import IDENTITY
from workflow.lib.plan import Quality, build_id, data_of, drawing_command, load_plan, panel_named, with_used
from workflow.lib.program import command_line
from workflow.lib.record import is_whole, record_path
from workflow.provenance.build_id import BuildError

refuse_another_folder()  # by a link .venv
for name in ("data", "figures"):
    if Path(name).is_symlink() and not Path(name).exists():
        sys.exit(
            f"{name} is a link to {os.readlink(name)}, which is missing: create that folder, or remove the link"
        )
shell.prefix("source workflow/environment/variables.sh; ")  # a bare `snakemake` gives the same bytes as make
QUALITY = config.get("quality", "standard")
try:
    EFFORT = Quality.of(QUALITY)
    PLAN = load_plan(QUALITY)
    PANELS = [panel_named(PLAN, name).name for name in str(config.get("panel", "")).split()]
    DATA = {name: data_of(PLAN, name, QUALITY) for name in PLAN}
except (ConfigurationError, BuildError) as error:
    sys.exit(str(error))


include: "workflow/rules/common.smk"


wildcard_constraints:
    quality=f"{EFFORT.base}|{QUALITY}",
    panel="[^/.]+",
    run="[^/]+",
    identity=IDENTITY,


if workflow.is_main_process and not workflow.dryrun:
    redrawn = [name for name in PANELS or PLAN if not without_foreign_parents(valid(RECORDS[name])).exists()]
    for path in {path for name in redrawn for path in DATA[name]}:
        set_aside(path)


onstart:
    # Snakemake's own handler waits for a lock that the interrupted code may hold.
    signal.signal(signal.SIGTERM, signal.default_int_handler)


rule figures:
    input:
        [path for panel in PLAN for path in products_of(panel)],


rule panel:
    input:
        [path for panel in PANELS for path in products_of(panel)],


include: "workflow/rules/simulate.smk"
include: "workflow/rules/draw.smk"
include: "workflow/rules/products.smk"


if "batch" in config:

    include: "workflow/rules/cluster.smk"
