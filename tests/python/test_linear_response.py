"""The Onsager matrix and the conductivity without a particle current from currents and temperatures that are known."""

import numpy as np
import pytest

from workflow.physics.response import Response, onsager

L = np.array([[2.0e7, 2.0e5], [2.0e5, 2.2e3]])
RISE = np.array([-6e3, -40.0])  # T_N - T_1 per X_u, which is -1e4 between the baths, and per X_n
TEMPERATURE, PRESSURE = [-2e-3, 0.2], [0, 0.05]  # forces
ERRORS = np.array([1.0, 0.01, 0.05])


def response(forces: list[float], noise: np.ndarray, covariance: np.ndarray) -> Response:
    measured = np.append(L @ forces / 16, RISE @ forces) + noise
    return Response(16, np.array(forces), measured, covariance, 100, usable=True)


def rows(covariance: np.ndarray, noise: np.ndarray | None = None) -> dict[str, float]:
    given = np.zeros((2, 3)) if noise is None else noise
    return onsager(
        *(
            response(forces, one, covariance)
            for forces, one in zip((TEMPERATURE, PRESSURE), given, strict=True)
        )
    )


def test_matrix_symmetry_and_conductivity() -> None:
    """Detected mistakes: the matrix of the forces is transposed; the rise of the run at a pressure difference is ignored; the
    temperatures of the baths in place of those of the end scatterers."""
    row = rows(np.zeros((3, 3)))
    assert [row[name] for name in ("L_uu", "L_un", "L_nu", "L_nn")] == pytest.approx([2e7, 2e5, 2e5, 2.2e3])
    assert row["asymmetry"] == pytest.approx(0, abs=1e-6)
    heat = 2e7 - 2e5**2 / 2.2e3
    assert row["kappa_0_baths"] == pytest.approx(heat / 100**2)
    assert row["kappa_0"] == pytest.approx(heat / (6e3 - 40 * 2e5 / 2.2e3))


@pytest.mark.parametrize("size", [1.0, 5.0])  # of the error of the rise
def test_errors(size: float) -> None:
    """Detected mistakes: the correlation of the currents is ignored, which makes the error of kappa_0 larger; the error of the rise is."""
    errors = ERRORS * [1, 1, size]
    covariance = np.outer(errors, errors) * [[1, 0.98, 0], [0.98, 1, 0], [0, 0, 1]]
    random, exact = np.random.default_rng(1), rows(covariance)
    scores: dict[str, list[float]] = {"kappa_0": [], "kappa_0_baths": [], "L_un": [], "asymmetry": []}
    for _ in range(150):
        row = rows(covariance, random.multivariate_normal(np.zeros(3), covariance, 2))
        for name, values in scores.items():
            values.append((row[name] - exact[name]) / row[f"{name}_error"])
    for name, values in scores.items():
        assert np.std(values) == pytest.approx(1, abs=4 / np.sqrt(300) + 0.02), name
        assert abs(np.mean(values)) < 4 / np.sqrt(150), name
    plain = rows(np.diag(errors**2))
    assert plain["kappa_0_baths_error"] > 1.5 * exact["kappa_0_baths_error"]
