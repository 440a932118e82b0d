#pragma once

/// The strains that have colours of their own, for all who colour ligaments.

#include "condyle/results/run_file.h"

namespace condyle {

/// Ligaments fail at some 10 to 15 %: colours end here, whatever a strand of a model does [-].
inline constexpr double kPhysiologicalStrain = 0.10;

struct StrainScale {
  double top = 0.01;       ///< at the upper end of the colours [-]
  double greatest = 0.01;  ///< of all strands over the poses that have a place [-]
  [[nodiscard]] bool exceeded() const { return greatest > top; }
};
/// Ends at a round number where all strains lie below the physiological end, else there.
[[nodiscard]] StrainScale strain_scale(const Run& run);

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below x (> 0):
/// round ends for scales.
[[nodiscard]] double round_up_nicely(double x);

}  // namespace condyle
