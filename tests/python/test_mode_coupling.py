"""Mode coupling: the Euler currents by computer algebra, f_KPZ by Fredholm determinants, limits of everything else."""

from dataclasses import replace
from functools import cache
from math import gamma, pi, sin, sqrt

import numpy as np
import pytest
import sympy
from scipy.integrate import quad
from scipy.special import airy
from sympy import Expr, Matrix, Symbol, exp, integrate, oo, simplify

from workflow.physics import mode_coupling
from workflow.physics.mode_coupling import Chain, f_kpz, levy, logarithm_at, slow_logarithm

SQUARE_INTEGRAL = 0.389813  # of f_KPZ (Prähofer and Spohn, J. Stat. Phys. 115, 255, 2004)

CHAINS = [Chain(1.6, 3), Chain(0.8, 1 / 3), Chain(3, 3, 2.5, 0.4), Chain(0.07, 10, 0.3, 2.0)]

z, T, M, length, flux = (Symbol(name, positive=True) for name in ("z", "T", "M", "lambda", "F0"))
w, p, slow = Symbol("w", real=True), Symbol("p", positive=True), Symbol("Lambda", positive=True)


def second_order(expression: Expr) -> Expr:
    return sympy.series(expression, w, 0, 3).removeO()


def moment(power: int, sign: int) -> Expr:
    """Integral of |p|^power over both halves of the flux exp(-(p-w)²/2T), the left half times `sign`, to second order in w."""
    expanded = second_order(exp((2 * p * w - w**2) / (2 * T)))
    both = expanded + sign * expanded.subs(w, -w)
    return sympy.expand(integrate(sympy.expand(both * p**power * exp(-(p**2) / (2 * T))), (p, 0, oo)))


@cache
def fields_and_currents() -> tuple[Matrix, Matrix]:
    """n, g, e per length and their currents [eqs. M2 to M8], in z, T and w."""
    # The only divergent term of n is that of 1/|p|; its finite rest is moment(1).
    rest = integrate(p * exp(-(p**2) / (2 * T)), (p, 0, oo)) * w**2 / T**2
    number = z * (2 * slow * (1 - w**2 / (2 * T)) + rest)
    momentum = z * moment(0, -1) + M * w / length
    energy = z * moment(1, 1) / 2 + (T + M * w**2) / (2 * length)
    return Matrix([number, momentum, energy]), z * Matrix([moment(0, -1), moment(1, 1), moment(2, -1) / 2])


def pinned() -> tuple[Matrix, Matrix]:
    """g, e and their currents at fixed flux F(0) of slow particles, in T and w: the limit of infinite Λ."""
    fields, currents = fields_and_currents()
    at_fixed_flux = {z: flux * second_order(exp(w**2 / (2 * T)))}
    fields, currents = (x[1:, :].subs(at_fixed_flux).applyfunc(second_order) for x in (fields, currents))
    return fields, currents


def values(chain: Chain) -> dict[Expr, float]:
    return {
        z: chain.fugacity,
        flux: chain.fugacity,
        T: chain.temperature,
        M: chain.mass,
        length: chain.cell_length,
        slow: chain.slow_logarithm,
    }


@cache
def normal_modes() -> tuple[Matrix, Matrix, Matrix]:
    """Fields, their linear combinations of unit variance that move to the right and to the left, and second-order currents."""
    fields, currents = pinned()
    at_rest = {w: 0}
    static = Matrix([fields[0].diff(w), fields[1].diff(T)]).subs(at_rest)  # dg/dw = ρ, de/dT = a
    inertia, capacity = static
    right, left = sympy.symbols("right left")
    drift = sympy.sqrt(T / (2 * inertia)) * (right + left)
    # Second-order T from e = a T + ρ w²/2, which fixes e to first order in the modes.
    heating = T * (right - left) / sympy.sqrt(2 * capacity)
    hot = T + heating - inertia * drift**2 / (2 * capacity)
    epsilon = Symbol("epsilon")
    scaled = {right: epsilon * right, left: epsilon * left}

    def order(expression: Expr, power: int) -> Expr:
        inserted = expression.subs({T: hot, w: drift}, simultaneous=True).subs(scaled, simultaneous=True)
        return sympy.expand(sympy.series(inserted, epsilon, 0, 3).removeO()).coeff(epsilon, power)

    combine = Matrix(
        [
            [1 / sympy.sqrt(inertia * T), 1 / (T * sympy.sqrt(capacity))],
            [1 / sympy.sqrt(inertia * T), -1 / (T * sympy.sqrt(capacity))],
        ]
    ) / sympy.sqrt(2)
    linear = combine * currents.applyfunc(lambda x: order(x, 1))
    quadratic = combine * currents.applyfunc(lambda x: order(x, 2))
    modes = combine * fields.applyfunc(lambda x: order(x, 1))
    assert simplify(modes - Matrix([right, left])) == Matrix([0, 0])
    return Matrix([right, left]), linear, quadratic


@pytest.mark.parametrize("chain", CHAINS)
def test_speed_and_couplings(chain: Chain) -> None:
    modes, linear, quadratic = normal_modes()
    numbers = values(chain)
    speeds = linear.jacobian(modes).subs(numbers).evalf()
    assert np.allclose(np.array(speeds, dtype=float), np.diag([chain.sound_speed, -chain.sound_speed]))
    current = sympy.Poly(quadratic[0].subs(numbers).evalf(), *modes)
    coefficients = [
        float(current.coeff_monomial(x)) for x in (modes[0] ** 2, modes[1] ** 2, modes[0] * modes[1])
    ]
    # Eq. M16.
    unit = sqrt(chain.temperature / (2 * chain.inertia))
    own, heat = chain.fugacity / chain.inertia, chain.fugacity / (2 * chain.heat_capacity)
    expected = [own + heat, own - 3 * heat, 2 * (own - heat)]
    assert coefficients == pytest.approx([unit * coupling for coupling in expected])
    assert chain.self_coupling == pytest.approx(2 * sqrt(2) * coefficients[0])


@cache
def derivatives() -> list[list[Matrix]]:
    """For the fields and the currents the first derivatives by z, T and w at rest, and the derivatives of these by each of them."""
    start, state = Symbol("T0", positive=True), (z, T, w)
    logarithm = slow + sympy.log(T / start) / 2  # the cut is a momentum
    first = [vector.subs(slow, logarithm).jacobian(state) for vector in fields_and_currents()]
    return [[x.subs({start: T, w: 0}) for x in (each, *map(each.diff, state))] for each in first]


@pytest.mark.parametrize("chain", CHAINS)
def test_three_fields_with_many_slow_particles(chain: Chain) -> None:
    """Speed at a finite Λ, and K = dc/dw along the wave for large Λ: what the slow particles pin is F(0), not z."""

    def found(number: float) -> tuple[float, float, float]:
        numbers = {**values(chain), slow: number}
        (a, *da), (b, *db) = (
            [np.array(x.subs(numbers).evalf(), dtype=float) for x in each] for each in derivatives()
        )
        speeds, right = np.linalg.eig(np.linalg.solve(a, b))
        fastest = int(np.argmax(speeds.real))
        speed, wave = float(speeds[fastest].real), right[:, fastest].real
        wave = wave / wave[2]
        left_speeds, left = np.linalg.eig(np.linalg.solve(a.T, b.T))
        mirror = left[:, int(np.argmax(left_speeds.real))].real
        mirror = np.linalg.solve(a.T, a.T @ mirror)
        change = np.tensordot(wave, np.array(db) - speed * np.array(da), axes=1)
        return speed, float(mirror @ change @ wave / (mirror @ a @ wave)), float(wave[1])

    for number in (4.0, 9.0):
        speed, _, heating = found(number)
        finite = replace(chain, slow_logarithm=number)
        assert speed == pytest.approx(finite.sound_speed)
        # J_q = 2 z δT w, with w² = (T/2ρ) φ+² in a wave to the right.
        current = 2 * chain.fugacity * heating * chain.temperature / (2 * chain.inertia)
        amplitude = (2 * current / chain.temperature) ** 2 * finite.self_coupling ** (-2 / 3)
        assert finite.heat_amplitude == pytest.approx(8 / 9 * 0.510523 * amplitude)
    _, steepening, _ = found(300.0)
    to_first_order = replace(chain, slow_logarithm=300.0).steepening
    assert steepening / chain.steepening - 1 == pytest.approx(to_first_order / chain.steepening - 1, rel=0.1)
    speed, steepening, _ = found(1e7)
    assert speed == pytest.approx(chain.sound_speed, rel=1e-5)
    assert steepening == pytest.approx(chain.steepening, rel=1e-5)


def test_slow_logarithm() -> None:
    expected, _ = quad(lambda q: np.exp(-(q**2) / 5) / q, 0.01, 30, limit=200)
    assert slow_logarithm(0.01, 2.5) == pytest.approx(expected)
    # Slower ones count by the part of a cell that they cross.
    expected, _ = quad(lambda q: np.exp(-(q**2) / 5) * min(300.0, 1 / q), 0, 30, points=[1 / 300], limit=200)
    assert logarithm_at(120, 2.5, 0.4) == pytest.approx(expected)


def test_moments_of_f_kpz() -> None:
    y = np.linspace(-4, 4, 8001)
    f, step = f_kpz(y), y[1] - y[0]
    assert np.all(f[1:-1] > 0)
    assert f.sum() * step == pytest.approx(1, abs=1e-7)
    assert (y**2 * f).sum() * step == pytest.approx(mode_coupling.SECOND_MOMENT, abs=1e-6)
    assert (f**2).sum() * step == pytest.approx(SQUARE_INTEGRAL, abs=1e-6)


def baik_rains(s: float, position: float) -> float:
    """Integral up to s of the distribution of the height at a position w > 0, by the Fredholm determinant of Baik, Ferrari and
    Péché (Commun. Pure Appl. Math. 63, 1017, 2010, theorem 1.2) with Gauss's rule (Bornemann, Math. Comp. 79, 871, 2010)."""

    def interval(start: float, end: float) -> tuple[np.ndarray, np.ndarray]:
        x, weight = np.polynomial.legendre.leggauss(40)
        return start + (end - start) * (x + 1) / 2, (end - start) / 2 * weight

    square = position**2
    y, of_y = interval(s, max(14 - square, s + 6))
    x, of_x = interval(0, max(16 - s - square, 6))
    kernel = airy(y[:, None] + x + square)[0]
    weighted = kernel * of_x
    root = np.sqrt(of_y)
    operator = np.eye(len(y)) - root[:, None] * (weighted @ kernel.T) * root
    gauge = np.exp(-2 * position**3 / 3)
    first = gauge * (kernel.T @ (of_y * np.exp(-position * y)))
    phi = weighted @ first - kernel @ (of_x * np.exp(position * x))
    psi = np.exp(position * y) / gauge - weighted @ np.exp(-position * x)
    mean = s + first @ (of_x * np.exp(-position * x)) - (root * psi) @ np.linalg.solve(operator, root * phi)
    return float(np.linalg.det(operator) * mean)


def height_variance(position: float) -> float:
    nodes, weights = np.polynomial.legendre.leggauss(60)
    reach = 10 + 3 * position
    return float(
        sum(
            reach * weight * (baik_rains(s, position) - max(s, 0))
            for side in (-1, 1)
            for s, weight in zip(reach * (side + nodes) / 2, weights, strict=True)
        )
    )


def test_f_kpz_against_fredholm_determinants() -> None:
    """f_KPZ is a quarter of the second derivative of the variance, which at 0 is that of Baik and Rains."""
    variance = height_variance(0)
    assert variance == pytest.approx(1.1503944782, abs=1e-8)
    for position in (0.5, 1.0, 1.5):
        integral, _ = quad(lambda y, end=position: (end - y) * float(f_kpz(y)), 0, position, epsabs=1e-11)
        assert height_variance(position) == pytest.approx(variance + 4 * integral, abs=2e-7)


def test_levy() -> None:
    assert levy(0) == pytest.approx(gamma(1 + 3 / 5) / pi)
    far = 200.0
    tail = gamma(1 + 5 / 3) * sin(5 * pi / 6) / pi * far ** (-8 / 3)
    assert levy(far) == pytest.approx(tail, rel=0.01)
    x = np.linspace(-3, 3, 7)
    assert levy(x, 2) == pytest.approx(np.exp(-(x**2) / 4) / (2 * sqrt(pi)))


@pytest.mark.parametrize("chain", CHAINS)
def test_amplitude_from_the_width_of_the_sound_peak(chain: Chain) -> None:
    """G++² times the covariance of φ+² is half the second derivative of the peak's squared width; J_q = Tc/2 (φ+² - φ-²)."""
    time = 30.0 * chain.cell_length / sqrt(chain.temperature)
    x = chain.sound_speed * time + 6 * (chain.self_coupling * time) ** (2 / 3) * np.linspace(-1, 1, 8001)
    step = 0.02 * time

    def squared_width(at: float) -> float:
        peak = chain.sound_peak(x, at)
        return float(peak @ (x - chain.sound_speed * at) ** 2 / peak.sum())

    curvature = squared_width(time + step) - 2 * squared_width(time) + squared_width(time - step)
    squares = curvature / step**2 * 4 / chain.self_coupling**2  # G++ = λ_s/√8
    heat = (chain.temperature * chain.sound_speed / 2) ** 2 * 2 * squares
    expected = chain.temperature**2 * chain.heat_amplitude * time ** (-2 / 3)
    assert heat == pytest.approx(expected, rel=1e-3)


def test_heat_peak_from_the_heat_current() -> None:
    """The decay rate of a Fourier mode is k² times the integral of the current's correlation, which moves with ±c."""
    chain, k = Chain(1.6, 3, slow_logarithm=6.0), 0.1
    # s = r^3 removes the singularity; a factor exp(-0.001 s) makes the integral converge.
    decays, _ = quad(
        lambda r: 3 * np.cos(chain.sound_speed * k * r**3) * np.exp(-1e-3 * r**3), 0, 20, limit=2000
    )
    rate = k**2 * chain.temperature**2 * chain.heat_amplitude / chain.heat_susceptibility * decays
    assert chain.heat_spreading * k ** (5 / 3) == pytest.approx(rate, rel=0.02)


@pytest.mark.parametrize("number", [3.0, 8.0])
def test_heat_susceptibility(number: float) -> None:
    """Variance of e - Tn per length: particles are a Poisson process of density F/|p|, scatterers have one degree of freedom."""
    chain = Chain(1.2, 3, 1.7, 0.5, number)
    rest, _ = quad(
        lambda q: (
            ((q**2 / 2 - chain.temperature) ** 2 - chain.temperature**2)
            / q
            * np.exp(-(q**2) / (2 * chain.temperature))
        ),
        0,
        20,
    )
    particles = 2 * chain.fugacity * (chain.temperature**2 * number + rest)
    scatterers = chain.temperature**2 / (2 * chain.cell_length)
    assert chain.heat_susceptibility == pytest.approx(particles + scatterers)
