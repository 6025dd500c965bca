#include "boltzmann/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "boltzmann/moments.hpp"

namespace lorentz {
namespace {

constexpr int finest_level = 3;

double difference(const KineticProblem& problem, const KineticSolution& coarse, const KineticSolution& fine) {
  const auto currents = [](const KineticSolution& solution) {
    const Flux flux = solution.flux(Eigen::VectorXd::Zero(1));
    return Currents(HalfMoments(solution.momenta(), flux)).values(0);
  };
  const auto a = currents(coarse), b = currents(fine), scale = injected(problem.left, problem.right);
  double largest = 0;
  for (std::size_t i = 0; i < scale.size(); ++i)
    largest =
        std::max(largest, std::abs(a[i] - b[i]) / std::max(std::abs(b[i]), scale[i] / (1 + problem.gamma)));
  return largest;
}

}  // namespace

RefinedSolution refine(const KineticProblem& problem, double target, int coarsening) {
  const auto solve = [&](int level, const KineticSolution* guess) {
    return std::make_unique<KineticSolution>(problem, Resolution::level(level, problem.gamma), guess);
  };
  RefinedSolution result{nullptr, solve(-coarsening, nullptr), std::numeric_limits<double>::infinity(), 0};
  result.evaluations = result.fine->evaluations();
  for (int level = 1 - coarsening; level <= finest_level; ++level) {
    result.coarse = std::move(result.fine);
    result.fine = solve(level, result.coarse.get());
    result.evaluations += result.fine->evaluations();
    const double before = std::exchange(result.error, difference(problem, *result.coarse, *result.fine));
    if (result.error <= target || result.error > before) break;
  }
  return result;
}

}  // namespace lorentz
