"""What a claim's function returns: its numbers, by reading."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from workflow.claims.data import Data
from workflow.claims.verdict import Number


@dataclass(frozen=True)
class Evidence:
    """literal: numbers for the words as they stand. substance: for what they mean. other: for another reading, which is told
    and does not count. Each has its band in data/claims.csv. remark: what the answer tells beside the verdict, in a clause."""

    literal: Sequence[Number]
    substance: Sequence[Number] = ()
    other: Sequence[Number] = ()
    caveat: str = ""
    remark: str = ""


Claim = Callable[[Data], Evidence]
