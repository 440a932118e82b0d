#pragma once

/// The points of a study: point k is a function of the seed and of k and of nothing else, so that
/// anyone can compute it at any time; nothing is stored or sent.
///
/// kMonteCarlo: independent (uniform_draws.h). kLatinHypercube [McKay 1979]: coordinate j of point k is
/// (π_j(k) + u)/n with a permutation π_j of its own (permutation.h). kSobol: sobol_points.h. kSaltelli
/// [Saltelli 2010]: a Sobol point of 2d coordinates is a row of A and one of B; AB_j is A's row with
/// coordinate j of B's. kGrid: midpoints (l + 1/2)/levels in all combinations, the last coordinate the
/// fastest.

#include <cstdint>
#include <memory>
#include <vector>

#include "condyle/scene/study_description.h"

namespace condyle {

struct DesignOptions {
  DesignKind kind = DesignKind::kMonteCarlo;  ///< any but kTable
  std::size_t dimensions = 1;
  std::uint64_t points = 0;  ///< of kSaltelli of each block; of kGrid not used
  int levels = 3;            ///< kGrid
  std::uint64_t seed = 1;
};

class SampleDesign {
 public:
  /// Throws InputError with one sentence for a design that cannot be: no dimension, no point, too many
  /// dimensions for Sobol's sequence, more than 2^53 points.
  explicit SampleDesign(const DesignOptions& options);
  ~SampleDesign();
  SampleDesign(SampleDesign&&) noexcept;

  /// How many points there are; kSaltelli: points * (dimensions + 2), in the order A_0 B_0 AB_0,1 ...
  /// AB_0,d A_1 ...: what belongs together is computed together.
  [[nodiscard]] std::uint64_t size() const;
  /// Point k < size(), 0 < u < 1 each. Threads may ask at the same time.
  void point(std::uint64_t k, std::vector<double>& u) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace condyle
