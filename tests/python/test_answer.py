"""The answers of the report: every verdict has a sentence, which contains the numbers of the results."""

import re
import string
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from tests.python.claim_truths_closed import drop_per_cell, linear_response
from tests.python.conftest import ROOT
from tests.python.known_results import QUANTITIES, Known, truth, uneven
from workflow.claims.growth import saturation
from workflow.claims.judge import Judgement, judge_all, read_claims
from workflow.claims.verdict import Band, Number, Outcome, Reading
from workflow.configuration import ConfigurationError
from workflow.lib.load import Quantity
from workflow.plan import Run, load_plan
from workflow.report import numbers
from workflow.report.questions import FILE, VERDICTS, answers, read_questions

FOLDER = ROOT / "workflow/report"
CLAIMS = [claim["id"] for claim in read_claims(ROOT)]
NUMBER = Number("found", 0.5, 0.001)
BANDS = {"reproduced": Band(0, 1), "contradicted": Band(1, 2), "undecided at this precision": Band(0.5, 1)}


def judgements(verdict: str) -> Sequence[Judgement]:
    reading = Reading(BANDS[verdict], (NUMBER,), 0.05) if verdict in BANDS else None
    return [Judgement({"id": claim}, Outcome(verdict), reading, reading, reading) for claim in CLAIMS]


def test_questions_name_claims_panels_and_numbers() -> None:
    questions, panels = read_questions(), load_plan("standard")
    assert sum("summary" in question for question in questions) == 3
    for question in questions:
        assert question["claim"] in CLAIMS
        assert {*question["panels"]} <= panels.keys()
        assert question.get("summary", {}).keys() <= {*VERDICTS}
        for verdict in VERDICTS:
            sentences = question[verdict] + question.get("summary", {}).get(verdict, "")
            names = {name for _, name, _, _ in string.Formatter().parse(sentences) if name}
            if verdict == "not testable":
                assert names <= {"quality"}
            assert all(callable(getattr(numbers, name)) for name in names - {"number", "label", "quality"})


def test_a_missing_sentence_is_an_error(tmp_path: Path) -> None:
    text = (FOLDER / FILE).read_text()
    (tmp_path / FILE).write_text(text.replace("  reproduced:", "  unused:", 1))
    with pytest.raises(ConfigurationError, match="no sentence for reproduced"):
        read_questions(tmp_path)


@pytest.mark.parametrize("verdict", VERDICTS)
def test_the_verdict_selects_the_sentence_and_the_number_is_that_of_the_reading(verdict: str) -> None:
    """A number without results has the reason instead."""
    rows = answers(judgements(verdict), Known({}))
    for row in rows:
        assert row["outcome"] == (verdict if "number" not in row else "not testable")
        assert ("0.5000(10)" in row["answer"]) == ("{number}" in row[row["outcome"]])
    if verdict == "contradicted":
        assert any("not measured (data/paper/fig08/" in row["answer"] for row in rows)


def heat(exponent: float, error: float, monkeypatch: pytest.MonkeyPatch) -> tuple[str, str]:
    """Verdict and answer on heat transport if the longest ring has this exponent in its last octave and 0.01 more before. Others have another one."""
    monkeypatch.setitem(
        QUANTITIES, "heat_current", {"heat_variance": ("time",), "local_exponent": ("middle",)}
    )
    rings = [run.options for run in load_plan("paper")["ext13"].runs if "rule" not in run.options]
    longest = max(float(options["times"].split(",")[-1]) for options in rings)

    def local_exponent(run: Run, middle: np.ndarray) -> np.ndarray:
        random = run.options["rule"] == "random-direction"
        decisive = 1.0 if random else exponent
        if not random and 2 * middle[-1] / 1.5 != longest:
            return np.full(middle.shape, 0.7)
        return np.select([middle == middle[-1], middle == middle[-2]], [decisive, decisive + 0.01], 0.7)

    world = {"ext13": truth({"heat_variance": 1, "local_exponent": local_exponent}, error)}
    row = answers(judgements("reproduced"), Known(world))[0]
    return row["outcome"], row["answer"]


def test_heat_transport_is_superdiffusive_if_the_longest_times_show_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    outcome, answer = heat(4 / 3, 0.01, monkeypatch)
    assert outcome == "reproduced"
    assert re.findall(r"\d\.\d+\(\d+\)", answer) == ["1.333(13)", "0.7000(70)", "1.000(10)"]
    assert heat(0.9, 0.01, monkeypatch)[0] == "contradicted"
    assert heat(4 / 3, 0.1, monkeypatch)[0] == "undecided at this precision"


# The results are arbitrary, some conductivities negative.
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("quality", ["smoke", "deep"])
def test_every_quality_has_answers(quality: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The report can be written if a quality omits series. Detected mistake: a number requires the dilute chains of ext09."""

    def fill(run: Run) -> dict[str, Quantity]:
        return uneven(run) | truth({"stationary": 1, "current_correlation": 0.5}, 1e-9)(run)

    monkeypatch.setitem(QUANTITIES["heat_current"], "heat_variance", ("time",))
    data = Known(dict.fromkeys(load_plan(quality), fill), quality)
    assert all(one["answer"] for one in answers(judge_all(data), data))


def test_numbers_are_those_of_the_right_runs() -> None:
    """Detected mistakes: a number is taken from another chain, relaxation time or half of the sizes; the change of momentum is the
    smallest."""
    fills = {
        "fig07": truth({"alpha": 1.85}, 0.001),
        "ext01": truth(
            {"alpha": lambda run: run.options["zero-total-momentum"] * run.options["relaxation-time"]}, 0.001
        ),
        "fig07_inset": truth({"momentum_drift": lambda run: run.options["sigma"] ** 2 * 1e-15}, 0.001),
        "fig08": truth({"kappa": lambda run: min(run.options["cells"], 256) ** 0.5, "stationary": 1}, 0.001),
    }
    data = Known(fills)
    assert numbers.alpha(data).value == 1.85
    assert numbers.alpha_without_drift(data).value == max(
        run.options["relaxation-time"] for run in data.plan["ext01"].runs
    )
    assert numbers.momentum_change(data).value == pytest.approx(0.81e-15, rel=1e-9, abs=0)
    assert numbers.kappa_of_small_chains(data).value == pytest.approx(0.5)
    assert numbers.kappa_of_large_chains(data).value == pytest.approx(0)
    assert numbers.middle_size(data) == "N = 256"


def test_exponents_of_the_last_octave_are_those_of_the_longest_chains() -> None:
    """In these results κ_0 ∼ √N up to 128 cells and N^0.2 beyond, κ ∼ N^0.1 with random directions, and κ ∼ N^0.3 at γ = N."""

    def kappa(run: Run) -> float:
        cells = run.options["cells"]
        return float(cells ** (0.1 if run.options["rule"] == "random-direction" else 0.3))

    kappas = {
        "kappa": kappa,
        "kappa_particle": kappa,
        "energy_current": lambda run: kappa(run) * drop_per_cell(run),
        "stationary": 1,
    }
    response = linear_response(lambda cells: 128**0.5 * (cells / 128) ** (0.5 if cells < 128 else 0.2))
    data = Known(
        {
            "fig08": truth(kappas, 1e-4),
            "ext09": truth(kappas, 1e-4),
            "ext11": truth({**response, "stationary": 1}, 1e-6),
        }
    )
    assert numbers.kappa_of_longest_chains(data).value == pytest.approx(0.3)
    assert numbers.sizes_of_longest_chains(data) == "N = 1024 to 2048"
    assert numbers.kappa_0_in_the_last_octave(data).value == pytest.approx(0.2, abs=1e-3)
    assert numbers.sizes_of_kappa_0(data) == "N = 16 to 256"
    assert "(λ = 1/N, an exponent of 0.1000" in saturation(data)
    assert "(λ = 0.1, an exponent of 0.1000" in saturation(data)


def test_the_heat_in_a_ring_predicts_the_conductivity_of_chains(monkeypatch: pytest.MonkeyPatch) -> None:
    """⟨Q²⟩/N = t^1.3; in chains sound ends its growth at the time 0.3 N/c with c = 0.887."""
    monkeypatch.setitem(QUANTITIES["heat_current"], "heat_variance", ("time",))
    rings = {"heat_variance": lambda _, t: t**1.3, "local_exponent": 1.3}
    response = {**linear_response(lambda cells: 65 * (0.3 * cells / 0.887) ** 0.3), "stationary": 1}
    data = Known({"ext11": truth(response, 1e-6), "ext13": truth(rings, 1e-6)})
    assert numbers.kappa_0_expected(data).startswith("0.3000")


def test_the_kinetic_limit_without_the_smallest_chain() -> None:
    """In these results the deviation falls as 1/N^2 from 2 to 4 cells and as 1/N beyond."""
    factor = {2: 2.0, "continuum": 0.0}

    def flux(run: Run, _place: np.ndarray, p: np.ndarray) -> np.ndarray:
        cells = run.options["cells"]
        size = factor.get(cells, 1.0) / (cells if isinstance(cells, int) else 1)
        return np.asarray(10 + size * np.exp(-(p**2) / 200))

    data = Known({"fig03_inset": truth({"flux": flux}, 1e-5)})
    assert numbers.kinetic_exponent_of_longer_chains(data).value == pytest.approx(-1, abs=1e-3)
    assert numbers.sizes_of_longer_chains(data) == "N = 4 to 16"
