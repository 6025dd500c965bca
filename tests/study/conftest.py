"""The small project of tests/workflow."""

from tests.workflow.conftest import made, project

__all__ = ["made", "project"]
