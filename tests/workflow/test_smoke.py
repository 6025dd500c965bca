"""All figures at smoke quality, from which other tests take tables and captions."""

import subprocess


def test_all_figures_are_made(made_at_smoke: subprocess.CompletedProcess[str]) -> None:
    assert made_at_smoke.returncode == 0, made_at_smoke.stdout + made_at_smoke.stderr
