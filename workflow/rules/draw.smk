"""One panel from its results: figures/<quality>/<panel>.{pdf,png,svg,csv}, and then their record.

Only the record is an output, as Snakemake removes outputs before a job starts, and good pictures stay until new ones are there.
"""


rule draw:
    input:
        lambda wildcards: ancient(DATA[wildcards.panel]),
    output:
        "figures/{quality}/{panel}.{identity}.json",
    log:
        "build/logs/{quality}/{panel}.{identity}.log",
    wildcard_constraints:
        panel="(?!ext)[^/.]+",
    priority: 10**9  # before any run
    params:
        command=lambda wildcards: drawing_command(
            PLAN[wildcards.panel].script, f"figures/{QUALITY}/{wildcards.panel}", DATA[wildcards.panel]
        ),
    shell:
        "{params.command} 2> {log:q} || exit; [ -e {output:q} ] || {{"
        " echo 'no figure was written: end the script with run(draw, title); if it was edited meanwhile, run make again' >>{log:q}; exit 1; }}"


use rule draw as draw_extension with:
    wildcard_constraints:
        panel="ext[^/.]+",
