/// Sobol's indices of a knee beside what its exact derivatives say: two ways that share no line.

#include "study/linear_knee.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace condyle::study {
namespace {

TEST(LinearKnee, IndicesOfSmallChangesAreTheSquaresOfTheDerivatives) {
  const LinearKnee knee =
      linear_knee(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml", 256);
  const StudyEffects effects = effects_of(knee);
  int held = 0, all = 0;
  for (std::size_t p = 0; p < knee.plan.values.size(); ++p)
    for (std::size_t j = 0; j < knee.closed.size(); ++j)
      for (const IndexEstimate& e : {effects.first[j][p], effects.total[j][p]}) {
        EXPECT_NEAR(e.value, knee.closed[j][p], 0.15);
        held += holds(e, knee.closed[j][p]);
        ++all;
      }
  EXPECT_EQ(all, 2 * 12 * 19);
  EXPECT_GT(held, 0.9 * all);
}

}  // namespace
}  // namespace condyle::study
