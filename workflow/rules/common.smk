"""Inputs of the rules. What is stale is found where a job enters the DAG, and moved where the run starts."""

STALE = {}  # job: reason
HERE = "" if REQUEST.batch else "--here"
BEFORE_ANY_RUN = 10**9  # as priority; that of a run is its core seconds


def say(text):
    logger.info(text, extra={OF_PROJECT: True})


def force_if_stale(job):
    if workflow.is_main_process and job not in STALE and (reason := or_leave(made_anew, job)):
        STALE[job] = reason
        workflow.dag.forcefiles.update(CHAIN.outputs(job))
        if not REQUEST.fresh and any(CHAIN.hashes[path] for path in CHAIN.outputs(job)):
            say(f"{job} is stale: {reason}")


def made_anew(job):
    return "everything is asked for anew" if REQUEST.fresh else CHAIN.reason(job)


def run_of(wildcards):
    return PANELS[wildcards.panel].run(wildcards.run)


def build_id_of_run(wildcards):
    force_if_stale(f"{wildcards.panel}/{wildcards.run}")
    return f"build/id/{run_of(wildcards).program}.json"


def threads_of_run(wildcards):
    return 1 if REQUEST.batch else max(1, workflow.cores // len(PANELS[wildcards.panel].runs))


def at_once():
    """Cores on this machine, jobs on a cluster."""
    return workflow.resource_settings.nodes if REQUEST.batch else workflow.cores


def work_of_run(wildcards):
    """Core seconds that are foretold, its priority: with the longest first no run is left alone at the end."""
    job = f"{wildcards.panel}/{wildcards.run}"
    return BATCHES.seconds[job] if BATCHES else work_here()[job]


@cache
def work_here():
    """By run, from the shipped timings and what was executed here."""
    return or_leave(
        foretold, PANELS, [f"{name}/{run.name}" for name, panel in PANELS.items() for run in panel.runs]
    )


def group_of_run(wildcards):
    """On a cluster short runs share a job."""
    return BATCHES.groups.get(f"{wildcards.panel}/{wildcards.run}") if BATCHES else None


def minutes_of_run(wildcards, attempt):
    """Twice what is foretold, as machines and timings differ; what is lost with a job that takes longer is not much."""
    seconds = BATCHES.seconds[f"{wildcards.panel}/{wildcards.run}"] if BATCHES else 0
    return max(1, attempt * math.ceil(2 * seconds / 60))


def memory(wildcards, attempt):
    """MB: Python and Snakemake, and half as much again as an execution of the series took. Without one, enough for the
    longest chains of paper, which take 50."""
    taken = peak_memory(wildcards.panel, run_of(wildcards)) / 1e6 if BATCHES else math.nan
    return 2 ** (attempt - 1) * (1000 if math.isnan(taken) else 500 + math.ceil(1.5 * taken))


def data_of_panel(wildcards):
    """Ancient but for a stale panel: Snakemake drops a forced job whose inputs from jobs that run are all ancient."""
    force_if_stale(wildcards.panel)
    paths = data_of(PANELS, wildcards.panel, QUALITY)
    return paths if wildcards.panel in STALE else [ancient(path) for path in paths]


def all_figures(wildcards):
    """Jobs that are not asked for any more leave when all is made, also where nothing else is to be done."""
    leaving = unasked(QUALITY, PANELS) if workflow.is_main_process else []
    executing = workflow.executor_plugin and not (workflow.dryrun or workflow.touch)
    for job in leaving:
        say(f"{job} is not asked for any more{f': moved to {REPLACED}' if executing else ''}")
    if executing and leaving:
        or_leave(hold_as_make)
        or_leave(retire, QUALITY, leaving)
    return [path for panel in PANELS for path in drawings_of(QUALITY, panel)]


def leave_if_stale():
    """Something else may have written a product or a source meanwhile, as a job of a make that was killed."""
    stale = or_leave(Chain(QUALITY, PANELS).stale, [panel for panel in PANELS if panel in STALE])
    for job, reason in stale.items():
        sys.exit(f"{job} was made, and is stale already: {reason}. The same command makes it again")


def or_leave(act, *arguments):
    """What it returns; an error of a file is told in one line."""
    try:
        return act(*arguments)
    except OSError as error:
        sys.exit(in_one_line(error))


# On one machine no run is split, and none shares a job.
BATCHES = divide(PANELS, 60 * REQUEST.batch, or_leave(read_timings)) if REQUEST.batch else None


onstart:
    if workflow.is_main_process and not workflow.touch:
        or_leave(hold_as_make)  # as Snakemake may have been called without make
        if REQUEST.batch:
            or_leave(note_libraries, {run.program for panel in PANELS.values() for run in panel.runs})
        for handler in workflow.logger_manager.get_log_handlers():
            if isinstance(handler, LogHandler):
                or_leave(handler.begin, QUALITY, PANELS, STALE, at_once())
        if reason := or_leave(prepare, CHAIN, STALE, REQUEST.fresh):
            say(f"{reason}: moved to {REPLACED}, and all is made again")


onsuccess:
    if workflow.is_main_process:
        collect(QUALITY)
        leave_if_stale()


onerror:
    if workflow.is_main_process:
        collect(QUALITY)
