/// Sobol's indices whose closed values are known, with their intervals of 95 %: Ishigami's function, and
/// a knee whose numbers vary by so little that it is linear in them (docs/study.md).
///
///     condyle_known_indices DATA [POINTS]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>

#include "condyle/study/sobol_indices.h"
#include "study/linear_knee.h"

namespace condyle::study {
namespace {

/// Of all that were printed: how many intervals hold the closed value.
struct Tally {
  int held = 0, all = 0;
};

std::string told(const IndexEstimate& e) {
  return fmt::format("{:.3f} ({:.3f} to {:.3f})", e.value, e.lower, e.upper);
}

void count(const IndexEstimate& e, double closed, Tally& tally) {
  ++tally.all;
  tally.held += holds(e, closed);
}

double ishigami(const std::vector<double>& u) {
  const auto x = [&](std::size_t j) { return std::numbers::pi * (2 * u[j] - 1); };
  const double s1 = std::sin(x(0)), s2 = std::sin(x(1));
  return s1 + 7 * s2 * s2 + 0.1 * std::pow(x(2), 4) * s1;
}

void print_ishigami(std::uint64_t points, Tally& tally) {
  const SampleDesign design(
      {.kind = DesignKind::kSaltelli, .dimensions = 3, .points = points, .seed = 1});
  std::vector<double> u, y;
  for (std::uint64_t k = 0; k < design.size(); ++k) {
    design.point(k, u);
    y.push_back(ishigami(u));
  }
  const SobolIndices indices = sobol_indices(y.data(), points, 3, 1);
  // [Saltelli 2010], a = 7, b = 0.1.
  constexpr double kFirst[] = {0.3139, 0.4424, 0}, kTotal[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t j = 0; j < 3; ++j) {
    fmt::print("| Ishigami, number {} | {} | {:.3f} | {} | {:.3f} |\n", j + 1,
               told(indices.first[j]), kFirst[j], told(indices.total[j]), kTotal[j]);
    count(indices.first[j], kFirst[j], tally);
    count(indices.total[j], kTotal[j], tally);
  }
}

void print_knee(const std::filesystem::path& data, std::uint64_t points, Tally& tally) {
  const LinearKnee knee = linear_knee(data / "wismans-type/knee.toml", static_cast<long>(points));
  const StudyEffects effects = effects_of(knee);
  constexpr double kFlexion = 30 * std::numbers::pi / 180, kShown = 0.05;
  for (std::size_t p = 0; p < knee.plan.values.size(); ++p)
    for (std::size_t j = 0; j < knee.closed.size(); ++j) {
      const IndexEstimate &first = effects.first[j][p], &total = effects.total[j][p];
      const double closed = knee.closed[j][p];
      count(first, closed, tally);
      count(total, closed, tally);
      if (closed < kShown || std::abs(knee.plan.values[p] - kFlexion) > 1e-9) continue;
      fmt::print("| drawer at 30 degrees, {} | {} | {:.3f} | {} | {:.3f} |\n",
                 knee.plan.parameters[j].name, told(first), closed, told(total), closed);
    }
}

}  // namespace
}  // namespace condyle::study

int main(int count, char** words) {
  try {
    const std::filesystem::path data = count > 1 ? words[1] : "data";
    const std::uint64_t points = count > 2 ? std::strtoull(words[2], nullptr, 10) : 2048;
    condyle::study::Tally tally;
    fmt::print(
        "| | first order (95 %) | closed | total (95 %) | closed |\n|---|---|---|---|---|\n");
    condyle::study::print_ishigami(points, tally);
    condyle::study::print_knee(data, points, tally);
    fmt::print(
        "\nOf all {} intervals, those of every strain and pose included, {} hold the closed "
        "value.\n",
        tally.all, tally.held);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
