"""The measurements of speed against accuracy, shortly: what varies is what the table says, and what is compared agrees."""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import ROOT
from workflow.lib.load import Quantity, Result
from workflow.lib.plan import Run
from workflow.tradeoff import accuracy, bias, efficiency, frame, prediction
from workflow.tradeoff.measure import planned

PROGRAMS = ROOT / "build/bin"
OPTION = {
    "bins": "momentum_bins",
    "decades": "fit_decades",
    "relaxation": "relaxation_time",
}  # by knob of bias
SIGMAS = 4  # standard errors that separate what should agree


def told(changes: dict[str, Any], settings: np.ndarray) -> Result:
    """A result whose every quantity is the logarithm of what the program was told, or where it stores all settings, of them."""
    given = next((changes[name] for name in OPTION.values() if name in changes), 1)
    value = np.array(np.log(float(str(given).removesuffix("N"))))
    stored = {name: np.log(settings) for name in ("damping_exponent_from", "exponent_by_cut")}
    stored["jump"] = value[np.newaxis]

    class Everything(dict):
        def __missing__(self, name: str) -> Quantity:
            mean = stored.get(name, value)
            axes = {"from": settings, "cut": settings}
            return Quantity(mean, 0.1 + 0 * mean, None, 8 + 0 * mean, axes, "1", {}, {}, None)

    return Result(Path(), {}, {}, Everything())


def test_bias_varies_what_it_says(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where ln(setting) is what comes out, it is that of the row; the last row of a knob is the careful one. Of a share of the
    panel's relaxation the logarithm is another, by that of the panel's time."""
    settings = np.arange(1.0, 61)
    monkeypatch.setattr(bias, "execute", lambda _programs, _run, **changes: (told(changes, settings), 1.0))
    table = bias.measure(PROGRAMS)
    assert set(table.knob) == set(bias.KNOBS)
    plain = table[~table.knob.str.contains(",")]
    assert plain.value.to_numpy() == pytest.approx(np.log(plain.setting.to_numpy()))
    for _, part in table.groupby(["knob", "quantity"]):
        assert np.ptp(part.value - np.log(part.setting)) == pytest.approx(0, abs=1e-6)
        assert part.careful.tolist() == [False] * (len(part) - 1) + [True]
        assert len(part) > 2
    titles = [axes.get_title() for axes in bias.draw(table).axes]
    assert sorted(titles) == sorted({title for title, _ in bias.KNOBS.values()})


def test_error_falls_with_replicas(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the law 1/sqrt(replicas), for one of the programs with its real settings; all programs have a panel in the figure."""
    monkeypatch.setattr(accuracy, "REPLICAS", (30, 480))
    monkeypatch.setattr(accuracy, "TARGETS", (1e-2, 1e-4))
    table = accuracy.sample(PROGRAMS, "persistence")
    few, many = table.itertuples()
    ratio = np.log(few.error / many.error)
    error = np.hypot(few.uncertainty / few.error, many.uncertainty / many.error)
    assert abs(ratio - np.log(4)) < SIGMAS * error
    assert abs(ratio - np.log(16)) > SIGMAS * error
    assert many.cpu_seconds > few.cpu_seconds > 0
    solved = accuracy.solve(PROGRAMS)
    assert (solved.error.to_numpy() <= accuracy.TARGETS).all()
    sampled = [table.assign(program=name) for name in accuracy.SETTINGS if name != "boltzmann"]
    assert len(accuracy.draw(pd.concat([*sampled, solved])).axes) == len(accuracy.SETTINGS)


@pytest.mark.parametrize("program", sorted(accuracy.SETTINGS))
def test_a_shortened_run_has_its_program(program: str) -> None:
    panel, name, share = accuracy.SETTINGS[program]
    run = planned(panel, name)
    assert run.program == program
    assert share == 1 or any(key in accuracy.window(run, share) for key in ("observation-time", "times"))


def test_devices_find_what_is_found_without_them() -> None:
    """Engine against the reference simulator, controls against the plain means, all particles against one."""
    run = planned("fig08", "deterministic_cells=4")
    rows = [*efficiency.conductivity(PROGRAMS, run, 8, (40, 40))]
    assert [row["device"] for row in rows] == ["engine", "control variates", "both"] * 2
    assert all(row["z"] < SIGMAS for row in rows)
    spread = [*efficiency.spreading(PROGRAMS, "ext07", "spreading_relaxation-time=1", "label")]
    assert all(row["z"] < SIGMAS for row in spread)
    one, _ = spread
    assert one["factor"] > 10  # of some hundred particles


def test_pulse_with_and_without_devices(monkeypatch: pytest.MonkeyPatch) -> None:
    short = {"cells": 21, "particles-per-cell": 5, "pairs-per-replica": 4, "times": "0.016,0.05"}
    run = Run("gaussian", "energy_pulse", planned("fig09a", "gaussian").options | short)
    monkeypatch.setattr(efficiency, "planned", lambda *_: run)
    rows = [*efficiency.pulse(PROGRAMS)]
    assert len(rows) == 10
    assert all(row["z"] < SIGMAS + np.log(row["values"]) for row in rows)  # the largest of so many
    gains = [row["factor"] for row in rows if row["device"] == "one start for both"]
    assert min(gains) > 1


def test_what_a_program_foretells(monkeypatch: pytest.MonkeyPatch) -> None:
    row = prediction.compare(PROGRAMS, "persistence", 2)
    assert row["replicas_least"] <= row["replicas_most"]
    assert row["as_foretold"] == (row["replicas_least"] <= row["replicas"] <= row["replicas_most"])
    assert row["seconds_least"] / row["replicas_least"] == pytest.approx(
        row["seconds_most"] / row["replicas_most"]
    )
    monkeypatch.setattr(prediction, "EXCESSES", {})
    assert prediction.measure(PROGRAMS).empty


def test_frame_writes_the_table_and_the_figure(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "new folder/table"
    monkeypatch.setattr(sys, "argv", ["x", "--programs", "bin", "--times", "3", "--output", str(output)])

    def measure(programs: Path, times: int) -> pd.DataFrame:
        return pd.DataFrame({"folder": [str(programs)], "value": [2.0 * times]})

    def draw(table: pd.DataFrame) -> Any:
        return table.plot().figure

    frame.run(measure, "Twice.", {"value": "1"}, draw, times={"type": int})
    assert "6.0" in capsys.readouterr().out
    lines = output.with_suffix(".csv").read_text().splitlines()
    assert lines[-1].split(",") == ["bin", "6"]
    assert all(output.with_suffix(kind).stat().st_size > 1000 for kind in (".pdf", ".png"))
