#include "condyle/design/sample_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "condyle/design/permutation.h"
#include "condyle/design/sobol_points.h"
#include "condyle/design/uniform_draws.h"
#include "condyle/input_error.h"

namespace condyle {

namespace {

constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 53;
constexpr double kBelowOne = 1 - 0x1p-53;

void draw(const DesignOptions& options, UniformFor what, std::uint64_t k, std::vector<double>& u) {
  uniform_draws(options.seed, static_cast<std::uint64_t>(what), k, u);
}

/// a * b, checked.
std::uint64_t points_times(std::uint64_t a, std::uint64_t b) {
  if (b != 0 && a > kMostPoints / b) throw InputError("the design has more than 2^53 points");
  return a * b;
}

std::uint64_t design_size(const DesignOptions& options) {
  if (options.kind == DesignKind::kSaltelli)
    return points_times(options.points, options.dimensions + 2);
  if (options.kind != DesignKind::kGrid) return points_times(options.points, 1);
  if (options.levels < 1)
    throw InputError(fmt::format("a grid has {} levels, expected at least 1", options.levels));
  std::uint64_t size = 1;
  for (std::size_t j = 0; j < options.dimensions && options.levels > 1; ++j)
    size = points_times(size, static_cast<std::uint64_t>(options.levels));
  return size;
}

/// How many coordinates of Sobol's sequence a design takes.
std::size_t sobol_dimensions(const DesignOptions& options) {
  if (options.kind == DesignKind::kSobol) return options.dimensions;
  return options.kind == DesignKind::kSaltelli ? 2 * options.dimensions : 0;
}

void expect_possible(const DesignOptions& options) {
  if (options.kind == DesignKind::kTable) throw InputError("a table is no computed design");
  if (options.dimensions == 0) throw InputError("the design has no dimension: nothing varies");
  if (options.points == 0 && options.kind != DesignKind::kGrid)
    throw InputError("the design has no points");
  if (sobol_dimensions(options) > SobolPoints::kMostDimensions)
    throw InputError(
        fmt::format("{} numbers vary, of which Sobol's sequence takes {} dimensions; it has {}",
                    options.dimensions, sobol_dimensions(options), SobolPoints::kMostDimensions));
}

}  // namespace

struct SampleDesign::Parts {
  DesignOptions options;
  std::uint64_t size = 0;
  std::optional<SobolPoints> sobol;
  std::vector<Permutation> permutations;  ///< kLatinHypercube: by dimensions

  void latin_point(std::uint64_t k, std::vector<double>& u) const {
    draw(options, UniformFor::kWithinStratum, k, u);
    for (std::size_t j = 0; j < u.size(); ++j) {
      const auto stratum = static_cast<double>(permutations[j](k));
      u[j] = std::min((stratum + u[j]) / static_cast<double>(size), kBelowOne);
    }
  }

  void saltelli_point(std::uint64_t k, std::vector<double>& u) const {
    const std::size_t d = u.size();
    const std::uint64_t row = k / (d + 2), block = k % (d + 2);  // A, B, AB_0 ... AB_d-1
    for (std::size_t j = 0; j < d; ++j) {
      const bool from_b = block == 1 || block == j + 2;
      u[j] = sobol->coordinate(row, from_b ? d + j : j);
    }
  }

  void grid_point(std::uint64_t k, std::vector<double>& u) const {
    const auto levels = static_cast<std::uint64_t>(options.levels);
    for (std::size_t j = u.size(); j-- > 0; k /= levels)
      u[j] = (static_cast<double>(k % levels) + 0.5) / static_cast<double>(levels);
  }
};

SampleDesign::SampleDesign(const DesignOptions& options) {
  expect_possible(options);
  auto parts = std::make_unique<Parts>();
  parts->options = options;
  parts->size = design_size(options);
  if (sobol_dimensions(options) > 0) parts->sobol.emplace(sobol_dimensions(options), options.seed);
  if (options.kind == DesignKind::kLatinHypercube)
    for (std::size_t j = 0; j < options.dimensions; ++j)
      parts->permutations.emplace_back(parts->size, options.seed, j);
  parts_ = std::move(parts);
}

SampleDesign::~SampleDesign() = default;
SampleDesign::SampleDesign(SampleDesign&&) noexcept = default;

std::uint64_t SampleDesign::size() const { return parts_->size; }

void SampleDesign::point(std::uint64_t k, std::vector<double>& u) const {
  u.resize(parts_->options.dimensions);
  switch (parts_->options.kind) {
    case DesignKind::kMonteCarlo:
      return draw(parts_->options, UniformFor::kPoint, k, u);
    case DesignKind::kLatinHypercube:
      return parts_->latin_point(k, u);
    case DesignKind::kSobol:
      for (std::size_t j = 0; j < u.size(); ++j) u[j] = parts_->sobol->coordinate(k, j);
      return;
    case DesignKind::kSaltelli:
      return parts_->saltelli_point(k, u);
    case DesignKind::kGrid:
      return parts_->grid_point(k, u);
    case DesignKind::kTable:
      break;
  }
}

}  // namespace condyle
