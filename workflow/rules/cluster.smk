"""A run that would take a job of a cluster too long: its replicas in parts, measured apart and joined here.

Parts lie under a name that changes with build and options, as checkpoints do, so that a run with others starts anew.
"""

# Runs of a group that have nothing to do with each other are put into one job by `group-components: [batch=…]`.
workflow.parent_groupids.update({name: "batch" for name in BATCHES.groups.values()})
NONE = "(?!)"  # matches no name
SPLIT = "|".join(sorted({re.escape(job.partition("/")[2]) for job in BATCHES.parts})) or NONE


localrules:
    join,
    draw,


ruleorder: join > simulate


def parts_of_run(wildcards):
    """At least one, as a run that is not split may have the name of one that is."""
    job = f"{wildcards.panel}/{wildcards.run}"
    force_if_stale(job)
    run = run_of(wildcards)
    parts = BATCHES.parts.get(job) or (f"0-{run.options['replicas'] - 1}",)
    folder = f"build/parts/{QUALITY}/{job}-{identity_of(run.program, run.options)}"
    paths = [f"{folder}/{part}.part" for part in parts]
    if REQUEST.fresh and workflow.is_main_process:
        workflow.dag.forcefiles.update(paths)
    return paths


rule part:
    input:
        build_id=ancient(build_id_of_run),
    output:
        part=temp("build/parts/{quality}/{panel}/{run}-{identity}/{part}.part"),
        cost=temp("build/parts/{quality}/{panel}/{run}-{identity}/{part}.part.cost.json"),
    log:
        "build/logs/{quality}/{panel}/{run}-{identity}/{part}.log",
    wildcard_constraints:
        run=SPLIT,
        identity="[0-9a-f]{16}",
        part="[0-9]+-[0-9]+",
    priority: work_of_run
    conda:
        "../environment/conda.yaml"
    resources:
        runtime=minutes_of_run,
        mem_mb=memory,
        slots=1,
    params:
        program=lambda wildcards: run_of(wildcards).program,
        options=lambda wildcards: json.dumps(run_of(wildcards).options),
    shell:
        """
        .venv/bin/python -I -S workflow/environment/launch.py workflow.provenance.execute part --log {log:q} \
            --program {params.program:q} --options {params.options:q} --part {wildcards.part:q} --output {output.part:q}
        """


rule join:
    input:
        build_id=ancient(build_id_of_run),
        parts=parts_of_run,
        costs=lambda wildcards: [f"{part}.cost.json" for part in parts_of_run(wildcards)],
    output:
        "data/{quality}/{panel}/{run}.h5",
    log:
        "build/logs/{quality}/{panel}/{run}.log",
    wildcard_constraints:
        run=SPLIT,
    priority: BEFORE_ANY_RUN
    conda:
        "../environment/conda.yaml"
    params:
        program=lambda wildcards: run_of(wildcards).program,
        options=lambda wildcards: json.dumps(run_of(wildcards).options),
        folder=lambda wildcards, input: str(Path(input.parts[0]).parent),
    shell:
        """
        .venv/bin/python -I -S workflow/environment/launch.py workflow.provenance.execute simulate --log {log:q} \
            --quality {wildcards.quality:q} --panel {wildcards.panel:q} --run {wildcards.run:q} \
            --program {params.program:q} --options {params.options:q} --threads 1 --replicated --parts {params.folder:q}
        """
