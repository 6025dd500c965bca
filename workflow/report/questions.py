"""The answer: questions, each answered by the sentence of questions.yaml that belongs to the verdict."""

import string
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from workflow.claims.data import Data, MissingError
from workflow.claims.judge import Judgement
from workflow.claims.verdict import Band, Outcome, Reading, level_of_each
from workflow.configuration import ConfigurationError, read
from workflow.report import numbers, words

FILE = "questions.yaml"
VERDICTS = [
    outcome.value for outcome in Outcome if outcome is not Outcome.IN_MEANING
]  # possible verdicts on one reading


def read_questions(folder: Path = Path(__file__).parent) -> list[dict[str, Any]]:
    """Questions, each with a sentence for every verdict. Raises ConfigurationError."""
    content = read(folder, FILE).content
    questions = [content["otherwise"] | question for question in content["questions"]]
    for question in questions:
        if missing := [verdict for verdict in VERDICTS if verdict not in question]:
            raise ConfigurationError(
                f"{FILE}: '{question['question']}' has no sentence for {', '.join(missing)}: add it"
            )
    return questions


def answers(judgements: Sequence[Judgement], data: Data) -> list[dict[str, Any]]:
    """question, answer, outcome, claim, panels and summary of each; the summary is empty where the question has none."""
    by_id = {judgement.claim["id"]: judgement for judgement in judgements}
    level = level_of_each(len(judgements) + 1)
    rows = []
    for question in read_questions():
        reading = (
            _measured(question, data, level)
            if "number" in question
            else getattr(by_id[question["claim"]], question["reading"])
        )
        outcome = reading.outcome if reading else Outcome.NOT_TESTABLE
        answer = _filled(question[outcome.value], reading, data)
        sentence = question.get("summary", {outcome.value: ""}).get(outcome.value)
        summary = f"{question['question']} {answer}" if sentence is None else _filled(sentence, reading, data)
        rows.append({**question, "outcome": outcome.value, "answer": answer, "summary": summary})
    return rows


def _measured(question: Mapping[str, Any], data: Data, level: float) -> Reading | None:
    try:
        return Reading(Band.of(question["band"]), (getattr(numbers, question["number"])(data),), level)
    except MissingError:
        return None


def _filled(sentence: str, reading: Reading | None, data: Data) -> str:
    values = {"quality": data.quality}
    if reading:
        values |= {"number": words.value(reading.worst), "label": reading.worst.label}
    for _, name, _, _ in string.Formatter().parse(sentence):
        if name and name not in values:
            values[name] = words.or_reason(words.value_or_text, getattr(numbers, name), data)
    return sentence.format_map(values)
