"""One run of a program: data/<quality>/<panel>/<run>.h5.

Exit status 4: stopped before the target error; the result and the figure are marked. --resume continues from the checkpoint of an
interrupted program.
"""


rule simulate:
    output:
        "data/{quality}/{panel}/{run}.h5",
    log:
        "build/logs/{quality}/{panel}/{run}.log",
    priority: priority_of_run
    params:
        program=lambda wildcards: run_of(wildcards).program,
        options=lambda wildcards: shlex.join(arguments(run_of(wildcards).options)),
        build=lambda wildcards: BUILDS[run_of(wildcards).program],
        resume=lambda wildcards: "--threads 1 --resume" if run_of(wildcards).replicated else "",
        # No trigger of a rerun, as it depends on the input.
        join=lambda wildcards, input: shlex.join(["--join", os.path.dirname(input[0])]) if input else "",
    shell:
        "build/bin/{params.program} {params.options} {params.resume} {params.join} --progress log --output {output:q}"
        " 2> {log:q} || [ $? = 4 ]"
