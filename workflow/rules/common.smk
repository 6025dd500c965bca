"""What the rules share: products and runs of panels."""


def products_of(panel):
    """Results too: Snakemake does not remake a missing intermediate whose products are there."""
    return [*data_of(PLAN, panel, QUALITY), *drawings_of(QUALITY, panel)]


def run_of(wildcards):
    return PLAN[wildcards.panel].run(wildcards.run)


def priority_of_run(wildcards):
    """Runs that the paper's panels show first, one panel after the other, and of a panel the longest runs first."""
    users = (name for name, panel in PLAN.items() if wildcards.panel in (name, *panel.uses))
    later = min([*PLAN].index(name) + len(PLAN) * name.startswith("ext") for name in users)
    return seconds_of_run(wildcards.panel, run_of(wildcards)) - 1e6 * later


@cache
def sources_digest(script):
    return digest_of_files([*sources_of(f"workflow/figures/{script}.py"), PACKAGES])


def runs_shown_by(panel):
    """Their configurations and builds: inputs that an earlier, interrupted invocation remade are no trigger."""
    panels = with_used(PLAN, panel)
    return [
        *(one.hash() for one in panels),
        *sorted({BUILDS[run.program] for one in panels for run in one.runs}),
    ]
