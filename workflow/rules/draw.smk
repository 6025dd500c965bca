"""One panel from its runs: figures/<quality>/<panel>.{pdf,png,svg,csv}."""


rule draw:
    input:
        data=data_of_panel,
        sources=ancient(lambda wildcards: CHAIN.sources(wildcards.panel)),
        lock=ancient("requirements.lock"),
    output:
        pdf="figures/{quality}/{panel}.pdf",
        png=report(
            "figures/{quality}/{panel}.png",
            caption="../report/caption.rst",
            category="{quality}",
            labels={"panel": "{panel}"},
        ),
        svg="figures/{quality}/{panel}.svg",
        csv="figures/{quality}/{panel}.csv",
    log:
        "build/logs/{quality}/{panel}.log",
    benchmark:
        "build/benchmarks/{quality}/{panel}.tsv"
    priority: BEFORE_ANY_RUN
    conda:
        "../environment/conda.yaml"
    params:
        here=HERE,
        configuration=lambda wildcards: PANELS[wildcards.panel].hash(),
        # For the report. What depends on an output is not among the parameters whose change Snakemake looks for.
        caption=lambda wildcards, output: caption_of(Path(output.csv)),
    shell:
        """
        .venv/bin/python -I -S workflow/environment/launch.py workflow.provenance.execute draw {params.here} --log {log:q} \
            --quality {wildcards.quality:q} --panel {wildcards.panel:q} \
            --configuration {params.configuration:q} --sources {input.sources:q} --data {input.data:q}
        """
