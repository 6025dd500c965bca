"""One run of a program: data/<quality>/<panel>/<run>.<identity>.h5.

Exit status 4: stopped before the target error; the result and the figure are marked. --resume continues from the checkpoint of an
interrupted program. The log is beside the result:
otherwise Snakemake deletes the empty folder before the checkpoint is written.
"""


def run_of(wildcards):
    return PLAN[wildcards.panel].run(wildcards.run)


rule simulate:
    output:
        RESULT,
    log:
        RESULT.removesuffix("h5") + "log",
    priority: lambda wildcards: -[*PLAN].index(wildcards.panel)  # runs of earlier panels first, so that their figures are ready first
    group:
        lambda wildcards: "short" if threads_of(run_of(wildcards)) == 1 else None  # on a cluster, several in a job
    threads: lambda wildcards: threads_of(run_of(wildcards))
    params:
        command=lambda wildcards, threads: shlex.join(command_line(run_of(wildcards), threads)),
    shell:
        "{params.command} --progress log --output {output:q} 2> {log:q} || [ $? = 4 ]"
