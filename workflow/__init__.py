"""The workflow of the project. Results in Python: workflow.pipeline.load_panel, workflow.lib.load."""
