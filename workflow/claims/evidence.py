"""What a claim's function returns: its numbers, by reading."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from workflow.claims.data import Data
from workflow.claims.verdict import Number


@dataclass(frozen=True)
class Evidence:
    """Numbers by reading, each with its acceptance band in data/claims.csv. The alternative reading is reported and does not
    count."""

    literal: Sequence[Number]
    intended: Sequence[Number] = ()
    alternative: Sequence[Number] = ()
    caveat: str = ""


Claim = Callable[[Data], Evidence]
