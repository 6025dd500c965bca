"""One run of a program: data/<quality>/<panel>/<run>.<identity>.h5.

Exit status 4: stopped before the target error; the result and the figure are marked. --resume continues from the checkpoint of an
interrupted program. A Snakemake that is terminated removes empty folders of outputs, and with them a checkpoint that is written
there later. PATH.tmp keeps the folder from being empty until the result exists.
"""


rule simulate:
    output:
        "data/{quality}/{panel}/{run}.{identity}.h5",
    log:
        "build/logs/{quality}/{panel}/{run}.{identity}.log",
    priority: priority_of_run
    params:
        command=lambda wildcards: shlex.join(command_line(run_of(wildcards), limit=limit_of_run(wildcards))),
        join=lambda wildcards, input: shlex.join(["--join", os.path.dirname(input[0])]) if input else "",
    shell:
        ": >{output:q}.tmp;"
        " {{ {params.command} {params.join} --progress log --output {output:q} 2> {log:q} || [ $? = 4 ]; }} && rm {output:q}.tmp"
