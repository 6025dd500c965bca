"""Every figure of the paper: programs write data/<quality>/<panel>/*.h5, scripts draw them.

What runs again is decided by content (workflow/provenance/chain.py): all inputs are `ancient`, so that their times do
not count, and a job that is stale is forced when it enters the DAG. When the run starts, stale products are moved to
build/replaced; a dry run only names them.
"""

import json
import math
import re
import runpy
import sys
from functools import cache
from pathlib import Path

from snakemake.logging import logger

runpy.run_path(f"{workflow.basedir}/workflow/environment/launch.py")  # no other file is taken for a module
FOLDERS_HERE = {workflow.basedir, f"{workflow.basedir}/workflow", ""}  # where Snakemake looks first
sys.path[:] = [folder for folder in sys.path if folder not in FOLDERS_HERE]
from workflow.lib.costs import peak_memory
from workflow.lib.locks import hold_as_make
from workflow.lib.parents import caption_of
from workflow.lib.places import in_one_line, require_place
from workflow.lib.plan import ConfigurationError, data_of, drawings_of
from workflow.tradeoff.batches import divide
from workflow.execution.handler import OF_PROJECT, LogHandler
from workflow.execution.remaining import foretold
from workflow.provenance.chain import Chain
from workflow.provenance.execute import identity_of
from workflow.provenance.node import note_libraries
from workflow.provenance.repository import ROOT
from workflow.provenance.lock import collect
from workflow.provenance.request import Request
from workflow.provenance.stale import REPLACED, prepare, retire, unasked
from workflow.tradeoff.timings import read_timings

try:
    REQUEST = Request.of(config)
    for place in ("data", "figures"):  # in which Snakemake looks before a run starts
        require_place(ROOT / place / REQUEST.quality / "any", ROOT)
except ConfigurationError as error:
    sys.exit(str(error))
except OSError as error:
    sys.exit(in_one_line(error))
QUALITY, PANELS = REQUEST.quality, REQUEST.panels
CHAIN = Chain(QUALITY, PANELS)


include: "workflow/rules/common.smk"


wildcard_constraints:
    quality=QUALITY,
    panel="|".join(PANELS),
    run="|".join({re.escape(run.name) for panel in PANELS.values() for run in panel.runs}),


rule figures:
    input:
        all_figures,


rule panel:
    input:
        [path for name in REQUEST.asked for path in drawings_of(QUALITY, name)],


include: "workflow/rules/simulate.smk"


if REQUEST.batch:

    include: "workflow/rules/cluster.smk"


include: "workflow/rules/draw.smk"
