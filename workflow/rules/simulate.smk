"""One run of a program: data/<quality>/<panel>/<run>.h5.

The program's build id is the input, not the program. What has to run again is decided by content before
Snakemake starts (workflow/provenance/stale.py), so all inputs are `ancient`: their times do not count. Partial results and checkpoints lie in build/partial, under a name that changes with build
and options, so that an interrupted run goes on and one with other parameters starts anew. A program
that stops before its target error exits with 4; its result is marked and is drawn as such.
"""


rule simulate:
    input:
        build_id=ancient(
            lambda wildcards: f"build/id/{PANELS[wildcards.panel].run(wildcards.run).program}.json"
        ),
    output:
        "data/{quality}/{panel}/{run}.h5",
    log:
        "build/logs/{quality}/{panel}/{run}.log",
    benchmark:
        "build/benchmarks/{quality}/{panel}/{run}.tsv"
    conda:
        "../environment/conda.yaml"
    threads: lambda wildcards: max(1, workflow.cores // len(PANELS[wildcards.panel].runs))
    params:
        program=lambda wildcards: PANELS[wildcards.panel].run(wildcards.run).program,
        arguments=lambda wildcards: PANELS[wildcards.panel].run(wildcards.run).arguments(),
        conduct=lambda wildcards, threads: (
            f"--threads {threads} --resume" if PANELS[wildcards.panel].run(wildcards.run).replicated else ""
        ),
        work="build/partial/{quality}/{panel}/{run}",
        cost="build/costs/{quality}/{panel}/{run}.json",
    shell:
        """
        exec 2> {log}
        identity=$(echo '{params.arguments}' | cat - {input.build_id} | sha256sum | cut -c 1-16)
        partial={params.work}-$identity
        mkdir -p "$(dirname $partial)" "$(dirname {params.cost})"
        build/bin/{params.program} {params.arguments} {params.conduct} --progress log \
            --output $partial.h5 || [ $? -eq 4 ]
        mv $partial.cost.json {params.cost}
        mv $partial.h5 {output}
        .venv/bin/python -S -m workflow.provenance.lock --quality {wildcards.quality} \
            --job {wildcards.panel}/{wildcards.run} --outputs {output} \
            --build {input.build_id} --arguments='{params.arguments}'
        """
