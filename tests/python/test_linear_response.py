"""The Onsager matrix of ext. 11 from currents that are known, and the dynamics against its symmetry."""

import numpy as np
import pytest

from workflow.physics.response import Response, onsager

L = np.array([[2.0e7, 2.0e5], [2.0e5, 2.2e3]])


def response(forces: list[float], noise: np.ndarray, covariance: np.ndarray) -> Response:
    return Response(16, np.array(forces), L @ forces / 16 + noise, covariance, 100, usable=True)


def test_matrix_symmetry_and_conductivity() -> None:
    """Detected mistake: the matrix of the forces is transposed."""
    still = np.zeros((2, 2))
    row = onsager(response([-2e-3, 0.2], np.zeros(2), still), response([0, 0.05], np.zeros(2), still))
    assert [row[name] for name in ("L_uu", "L_un", "L_nu", "L_nn")] == pytest.approx([2e7, 2e5, 2e5, 2.2e3])
    assert row["asymmetry"] == pytest.approx(0, abs=1e-6)
    assert row["kappa_0"] == pytest.approx((2e7 - 2e5**2 / 2.2e3) / 100**2)


def test_errors() -> None:
    """Detected mistake: the correlation of the currents is ignored, which makes the error of kappa_0 larger."""
    errors = np.array([1.0, 0.01])
    covariance = np.outer(errors, errors) * [[1, 0.98], [0.98, 1]]
    random, scores = np.random.default_rng(1), {"kappa_0": [], "L_un": [], "asymmetry": []}
    exact = onsager(
        response([-2e-3, 0.2], np.zeros(2), covariance), response([0, 0.05], np.zeros(2), covariance)
    )
    for _ in range(150):
        noise = random.multivariate_normal(np.zeros(2), covariance, 2)
        runs = (response([-2e-3, 0.2], noise[0], covariance), response([0, 0.05], noise[1], covariance))
        row = onsager(*runs)
        for name, values in scores.items():
            values.append((row[name] - exact[name]) / row[f"{name}_error"])
    for name, values in scores.items():
        assert np.std(values) == pytest.approx(1, abs=4 / np.sqrt(300) + 0.02), name
        assert abs(np.mean(values)) < 4 / np.sqrt(150), name
    independent = np.diag(errors**2)
    plain = onsager(
        response([-2e-3, 0.2], np.zeros(2), independent), response([0, 0.05], np.zeros(2), independent)
    )
    assert plain["kappa_0_error"] > 1.5 * exact["kappa_0_error"]
