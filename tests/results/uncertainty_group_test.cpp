#include "condyle/results/uncertainty_group.h"

#include <gtest/gtest.h>

namespace condyle {
namespace {

MeshUncertainty made_up() {
  MeshUncertainty all;
  all.sweeps = 20;
  all.failed_fits = 1;
  all.surfaces = {{"medial condyle", {0.2, 1.5, 0.19}}};
  all.outputs = {{"joint/anterior_drawer", {"mm", 1}, {OutputKind::kJointCoordinate, 4}},
                 {"contacts/medial/force", {"N", 1}, {OutputKind::kContactForce, 0}}};
  all.sd = {{0.1, 0.3}, {4, 2}};
  all.shift = {{0, 0}, {0, 0}};
  all.converged = {19, 18};
  return all;
}

TEST(UncertaintyGroup, TellsTheGreatestSpreadInWords) {
  EXPECT_EQ(uncertainty_words(made_up()),
            "mesh noise of 0.20 mm rms: in 20 sweeps a standard deviation of up to - deg, 0.3 mm, "
            "contact forces 4 N, ligament forces - N; 37 of 40 poses solved, fits that failed: 1");
}

TEST(UncertaintyGroup, SaysWhereTheShapeOfTheBoneIsInTheNoise) {
  MeshUncertainty all = made_up();
  all.surfaces.push_back({"lateral plateau", {0.3, 4.92, 0.06}});
  EXPECT_TRUE(uncertainty_words(all).ends_with(
      "; at most so much: what is left beside \"lateral plateau\" is as broad as the smoothing, so "
      "that the bone's own shape is in it"))
      << uncertainty_words(all);
}

TEST(UncertaintyGroup, FindsAnOutputByItsPlace) {
  const MeshUncertainty all = made_up();
  ASSERT_NE(inside_sd(all, "contacts/medial/force"), nullptr);
  EXPECT_EQ(*inside_sd(all, "contacts/medial/force"), (std::vector<double>{4, 2}));
  EXPECT_EQ(inside_sd(all, "contacts/lateral/force"), nullptr);
}

/// Tables of Student's distribution, 97.5 %.
TEST(UncertaintyGroup, IntervalsOfFewSweepsAreWider) {
  for (const auto& [sweeps, student] :
       {std::pair{20, 2.093}, {10, 2.262}, {5, 2.776}, {4, 3.182}, {2, 12.706}, {200, 1.972}})
    EXPECT_NEAR(interval_of(sweeps), student, 0.05) << sweeps;
}

}  // namespace
}  // namespace condyle
