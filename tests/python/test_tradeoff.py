"""Trade-off: laws and comparisons on known samples, each measurement in short, and the results with and without a method."""

import io
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from workflow.lib.described import with_option
from workflow.tradeoff import accuracy, bias, efficiency, measure, rounding, tradeoff
from workflow.tradeoff.efficiency import Estimate

REPLICAS = np.array([10, 100, 1000])
SIGMAS = 4  # combined standard errors that two estimates of one quantity may differ by


def test_amplitude_of_the_law_and_of_noisy_errors() -> None:
    seconds = np.array([0.1, 1, 10])
    assert accuracy.amplitude(seconds, 3 / np.sqrt(seconds), REPLICAS) == pytest.approx(3)
    # The least precise point has a negligible weight.
    noisy = 3 / np.sqrt(seconds) * [2, 1, 1]
    assert accuracy.amplitude(seconds, noisy, REPLICAS) == pytest.approx(3, rel=0.01)


def test_uncertainty_over_samples() -> None:
    samples = np.random.default_rng(1).normal(size=(4000, 10))
    errors = samples.std(axis=1, ddof=1) / np.sqrt(10)
    ratio = np.var(errors) / np.mean(accuracy.uncertainty(errors, 10) ** 2)
    assert 0.9 < ratio < 1.1
    assert not 0.9 < 2 * ratio < 1.1  # detected mistake: the factor 2 is missing


def test_compared() -> None:
    plain = Estimate(np.array([1.0, 1.0]), np.array([0.3, 0.0]), 101, 2)
    better = Estimate(np.array([1.5, 9.0]), np.array([0.4, 0.1]), 51, 0.5)
    row = efficiency.compared("method", "quantity", plain, better)
    assert row["factor"] == pytest.approx(0.09 * 2 / (0.16 * 0.5))
    assert row["factor_error"] == pytest.approx(row["factor"] * np.sqrt(0.02 + 0.04))
    assert row["z"] == pytest.approx(1)  # a value without an error is not compared
    assert row["values"] == 1


def test_average_over_samples() -> None:
    samples = np.random.default_rng(1).normal(size=(20, 4000))
    estimate = efficiency.averaged(samples, 1)
    pulls = estimate.value / estimate.error
    assert np.var(pulls) == pytest.approx(19 / 17, rel=0.1)  # for Student's t with 19 degrees of freedom


def test_bias_is_relative_to_the_last_value_of_a_setting() -> None:
    rows = {"panel": "p", "start": "", "quantity": "q", "setting": ["a", "a", "b"]}
    table = bias.with_bias(pd.DataFrame(rows | {"result": [3.0, 2.0, 7.0], "result_error": [0.3, 0.4, 0.7]}))
    assert list(table.bias) == pytest.approx([0.5, 0, 0])
    assert list(table.bias_error) == pytest.approx([0.25, 0.2, 0.1])


def test_every_row_of_the_bias_has_the_setting_that_it_states(monkeypatch: pytest.MonkeyPatch) -> None:
    """Programs are replaced: the result is the logarithm of the option that is varied."""

    def execute(_run: object, **changes: object) -> SimpleNamespace:
        (value,) = (float(changes[name]) for name in changes if "-" in name)
        found = SimpleNamespace(mean=np.log(value), error=0.1, units="1")
        return SimpleNamespace(result=dict.fromkeys(("mu", "temperature_first", "jump", "alpha"), found))

    monkeypatch.setattr(bias, "execute", execute)
    table = bias.measure()
    assert table.result.to_numpy() == pytest.approx(np.log(table.value.to_numpy(dtype=float)))
    assert set(table.setting) == {"relaxation-time", "momentum-bins", "fit-decades"}
    assert set(table.start) == {"", "warm", "empty"}


def test_error_falls_with_replicas(monkeypatch: pytest.MonkeyPatch) -> None:
    """The law is 1/sqrt(replicas), in a program at its setting; every program has a panel in the figure."""
    monkeypatch.setattr(accuracy, "REPLICAS", (30, 480))
    monkeypatch.setattr(accuracy, "TARGETS", (1e-2, 1e-4))
    table = accuracy.errors("persistence")
    few, many = table.itertuples()
    ratio, error = np.log(few.error / many.error), np.sqrt(1 / (2 * 29) + 1 / (2 * 479))
    assert abs(ratio - np.log(4)) < SIGMAS * error
    assert abs(ratio - np.log(16)) > SIGMAS * error  # detected mistake: an error that falls as 1/replicas
    assert many.cpu_seconds > few.cpu_seconds > 0
    assert (accuracy.errors("boltzmann").error.to_numpy() <= accuracy.TARGETS).all()
    monkeypatch.setattr(accuracy, "errors", lambda program: table.assign(program=program))
    assert len(accuracy.draw(accuracy.measure().query("program != 'boltzmann'")).axes) == 12


@pytest.mark.parametrize("program", with_option("target-error"))
def test_every_program_with_an_error_is_in_the_table_of_accuracy(program: str) -> None:
    panel, name, _ = accuracy.SETTINGS[program]
    assert measure.planned(panel, name).program == program


def test_results_with_and_without_a_method() -> None:
    """Engine against the reference simulator, control variates against the plain means, all particles against one."""
    rows = [
        *efficiency.conductivity(measure.planned("fig08", "deterministic_cells=4"), 8, (0.4, 25), (40, 40))
    ]
    assert [row["method"] for row in rows] == ["engine", "control variates", "both", "control variates"]
    one, known = efficiency.spreading("ext07", "spreading_relaxation-time=1", "label")
    assert all(row["z"] < SIGMAS for row in [*rows, one, known])
    assert one["factor"] > 10  # the chain has some hundred particles


def test_products(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """A table with units, also printed, and its figure; the drift grows less than with one-sided rounding."""
    monkeypatch.setattr(rounding, "LONGEST", 5.5)
    files = {path.name: content for path, content in tradeoff.make("ext08").items()}
    lines = files["ext08.csv"].decode().splitlines()
    assert lines[0].startswith("# units: ")
    assert len(lines) == 2 + 2 * 2 * len(rounding.SIGMAS)
    assert "energy_drift" in capsys.readouterr().out
    assert all(len(files[f"ext08.{kind}"]) > 1000 for kind in ("pdf", "png"))
    drift = pd.read_csv(io.BytesIO(files["ext08.csv"]), comment="#")
    assert (drift.drift < 2.0**-53 * np.sqrt(drift.events)).all()


def test_floating_point_types() -> None:
    table = rounding.measure_types().set_index("type")
    limits = {"float": 1e-2, "double": 1e-11, "long_double": 1e-16}
    assert all(0 < table.relative_change[name] < limit for name, limit in limits.items())
