"""The table of f_KPZ, the scaling function of sound peaks, recomputed from scratch.

After Prähofer and Spohn (J. Stat. Phys. 115, 255, 2004). u is the Hastings-McLeod solution of Painlevé II,
u'' = 2u^3 + su with u ~ -Ai(s) for s -> infinity, F(s) the Tracy-Widom distribution of GUE, and a, b solve

    da/dw = u^2 a - (u' + wu) b,  db/dw = (u' - wu) a + (w^2 - s - u^2) b,  a(s, 0) = -b(s, 0) = exp(int_s^inf u).

The height of a stationary KPZ surface at position w has the distribution d/ds [F(s + w^2) g(s + w^2, w)], with
g(s, w) = int_{-inf}^s a(x, w) a(x, -w) dx. Its mean is 0. Twice integrated by parts, its variance is

    V(w) = 2 int a(x, w) a(x, -w) H(x) dx - (X - w^2)^2,  H(x) = int_x^X F,  X beyond the distribution,

and f_KPZ = V''/4. The Hastings-McLeod solution is unstable, and a and b are power series in w with large terms of both
signs: the numbers have 80 digits.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pytest
from mpmath import airyai, exp, mp, mpf, polyval, quad, workdps
from mpmath.calculus.quadrature import GaussLegendre

from tests.python.conftest import ROOT

DIGITS = 80
FIRST, LAST = -11, 40  # range of x; the contributions from outside are below 1e-40 for w <= END
ORDER = 70  # order of the Taylor series in x, which are used over steps of 1
DEGREE = 3  # mpmath's degree of the Gauss-Legendre rule in a step, which has 12 nodes
END = 4  # largest w of the table
NEGLIGIBLE = mpf(10) ** -40

Series = list[mpf]


class Node(NamedTuple):
    """Node of the quadrature over x in V(w), with the functions in the integrand at x."""

    x: mpf
    weight: mpf
    u: mpf
    slope: mpf  # du/dx
    tail: mpf  # int_x^inf u
    h: mpf  # H(x)


def product(a: Series, b: Series) -> Series:
    """Product of two power series, to the lower order of both."""
    return [sum((a[j] * b[n - j] for j in range(n + 1)), mpf(0)) for n in range(min(len(a), len(b)))]


def integral(a: Series, value: mpf) -> Series:
    """Integral of a power series, with this value at 0."""
    return [value] + [term / (n + 1) for n, term in enumerate(a)]


def at(series: Series, x: mpf) -> mpf:
    """Value of a power series."""
    return polyval(series[::-1], x)


def painleve(s: mpf, u: mpf, derivative: mpf) -> Series:
    """Taylor series about s of the solution of u'' = 2u^3 + su."""
    series, squares = [u, derivative], []
    for n in range(ORDER):
        squares.append(sum(series[j] * series[n - j] for j in range(n + 1)))
        cube = sum(squares[j] * series[n - j] for j in range(n + 1))
        total = 2 * cube + s * series[n] + (series[n - 1] if n else 0)
        series.append(total / ((n + 1) * (n + 2)))
    return series


def nodes() -> Iterator[Node]:
    """Nodes from x = LAST down to FIRST: Taylor series of all functions are continued from step to step."""
    rule = GaussLegendre(mp).calc_nodes(DEGREE, mp.prec)
    s = mpf(LAST)
    u, derivative = -airyai(s), -airyai(s, derivative=1)
    tail, log_f, h = -quad(airyai, [s, s + 4, s + 12]), mpf(0), mpf(0)
    while s > FIRST:
        of_u = painleve(s, u, derivative)
        of_derivative = [(n + 1) * term for n, term in enumerate(of_u[1:])]
        square = product(of_u, of_u)
        fourth, kinetic = product(square, square), product(of_derivative, of_derivative)
        # (ln F)' = u'^2 - s u^2 - u^4; F' = (ln F)' F
        slope = [
            kinetic[n] - fourth[n] - s * square[n] - (square[n - 1] if n else 0) for n in range(len(kinetic))
        ]
        of_f = [exp(log_f)]
        for n in range(ORDER):
            of_f.append(sum(slope[j] * of_f[n - j] for j in range(n + 1)) / (n + 1))
        of_tail = [-term for term in integral(of_u, -tail)]
        of_log, of_h = integral(slope, log_f), [-term for term in integral(of_f, -h)]
        for abscissa, weight in rule:
            d = -(1 + abscissa) / 2
            local = (at(series, d) for series in (of_u, of_derivative, of_tail, of_h))
            yield Node(s + d, weight / 2, *local)
        tail, log_f, h = (at(series, mpf(-1)) for series in (of_tail, of_log, of_h))
        s, u, derivative = s - 1, at(of_u, mpf(-1)), at(of_derivative, mpf(-1))


def in_powers_of_w(node: Node) -> tuple[Series, Series]:
    """Coefficients of the power series of a(x, w) and b(x, w) in w."""
    x, u, slope = node.x, node.u, node.slope
    a, b = [exp(node.tail)], [-exp(node.tail)]
    n = 0
    while n < 40 or max(abs(a[n]), abs(b[n]), abs(a[n - 1]), abs(b[n - 1])) * mpf(END) ** n > NEGLIGIBLE:
        last_a, last_b = (a[n - 1], b[n - 1]) if n else (0, 0)
        last_but_one = b[n - 2] if n > 1 else 0
        a.append((u * u * a[n] - slope * b[n] - u * last_b) / (n + 1))
        b.append((slope * a[n] - u * last_a - (x + u * u) * b[n] + last_but_one) / (n + 1))
        n += 1
    return a, b


def with_derivatives(a: mpf, b: mpf, w: mpf, node: Node) -> tuple[mpf, mpf, mpf]:
    """a and its first two derivatives in w."""
    x, u, slope = node.x, node.u, node.slope
    da = u * u * a - (slope + w * u) * b
    db = (slope - w * u) * a + (w * w - x - u * u) * b
    return a, da, u * u * da - u * b - (slope + w * u) * db


def f_kpz(positions: np.ndarray) -> np.ndarray:
    """f_KPZ at positions w that are multiples of 1/20."""
    exact = [mpf(round(20 * w)) / 20 for w in positions]  # the steps of the table are 1/20
    sums = [mpf(0)] * len(exact)
    for node in nodes():
        of_a, of_b = in_powers_of_w(node)
        for k, w in enumerate(exact):
            (a, da, d2a), (c, dc, d2c) = (
                with_derivatives(at(of_a, v), at(of_b, v), v, node) for v in (w, -w)
            )
            sums[k] += node.weight * node.h * (d2a * c - 2 * da * dc + a * d2c)
    return np.array(
        [float((2 * total + 4 * LAST - 12 * w * w) / 4) for total, w in zip(sums, exact, strict=True)]
    )


def test_every_thirtieth_number_of_the_table() -> None:
    y, f = np.loadtxt(ROOT / "workflow/lib/f_kpz.csv", delimiter=",", skiprows=3)[::30].T
    with workdps(DIGITS):
        assert f_kpz(y) == pytest.approx(f, rel=1e-12)
