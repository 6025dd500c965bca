"""One panel from its results."""


rule render:
    input:
        lambda wildcards: [ancient(path) for path in DATA[wildcards.panel]],
    output:
        multiext(RENDERING, *SUFFIXES),
    log:
        "build/logs/{quality}/{panel}.{identity}.log",
    priority: 10**9  # before any run
    params:
        command=lambda wildcards: rendering_command(
            PLAN[wildcards.panel], STEMS[wildcards.panel], DATA[wildcards.panel]
        ),
        stem=lambda wildcards: STEMS[wildcards.panel],
    shell:
        "{{ {params.command} && .venv/bin/python -m workflow.pipeline.publish {params.stem:q}; }} 2> {log:q}"
