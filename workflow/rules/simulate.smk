"""One run of a program: data/<quality>/<panel>/<run>.h5.

The program's build id is the input, not the program. A program that stops before its target error exits with 4; its
result is marked and is drawn as such.
"""


rule simulate:
    input:
        build_id=ancient(build_id_of_run),
    output:
        "data/{quality}/{panel}/{run}.h5",
    log:
        "build/logs/{quality}/{panel}/{run}.log",
    benchmark:
        "build/benchmarks/{quality}/{panel}/{run}.tsv"
    priority: work_of_run
    group:
        group_of_run
    conda:
        "../environment/conda.yaml"
    threads: threads_of_run
    resources:
        runtime=minutes_of_run,
        mem_mb=memory,
        slots=1,  # of which a job on a cluster has one, so that runs that share it follow each other
    params:
        here=HERE,
        program=lambda wildcards: run_of(wildcards).program,
        options=lambda wildcards: json.dumps(run_of(wildcards).options),
        replicated=lambda wildcards: "--replicated" if run_of(wildcards).replicated else "",
    shell:
        """
        .venv/bin/python -I -S workflow/environment/launch.py workflow.provenance.execute simulate {params.here} --log {log:q} \
            --quality {wildcards.quality:q} --panel {wildcards.panel:q} --run {wildcards.run:q} \
            --program {params.program:q} --options {params.options:q} --threads {threads} {params.replicated}
        """
