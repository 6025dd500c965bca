#pragma once

#include <cmath>
#include <numbers>
#include <random>

namespace reference {

/// Rotates (p, P/sqrt(M), P'/sqrt(M)) about (1, sqrt(M), sqrt(M)) by an angle uniform in [0, 2 pi), by
/// Rodrigues' formula.
template <class Real>
void rotate(Real& p, Real& P, Real& neighbour, Real mass, std::mt19937_64& generator) {
  const Real root = std::sqrt(mass), length = std::sqrt(1 + 2 * mass);
  const Real n[3] = {1 / length, root / length, root / length};
  const Real v[3] = {p, P / root, neighbour / root};
  const Real angle = std::uniform_real_distribution<>(0, 2 * std::numbers::pi)(generator);
  const Real along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
  const auto rotated = [&](int i, int j, int k) {
    return v[i] * std::cos(angle) + (n[j] * v[k] - n[k] * v[j]) * std::sin(angle) +
           n[i] * along * (1 - std::cos(angle));
  };
  const Real u = rotated(0, 1, 2), one = rotated(1, 2, 0), other = rotated(2, 0, 1);
  p = u;
  P = root * one;
  neighbour = root * other;
}

}  // namespace reference
