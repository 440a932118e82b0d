#pragma once

/// All poses of a table from the scene's start pose: the knee is flexed without the loads of the tests
/// in steps of 5 degrees, and loaded from there in steps of a tenth of the greatest level.

#include <optional>
#include <string>
#include <vector>

#include "condyle/calibration/test_bench.h"

namespace condyle {

struct ReachedPose {
  std::optional<EquilibriumSolver::Standing> standing;
  std::string reason;  ///< why there is none
};

/// By poses, at the θ that was set. A pose that is not found so is tried from the same load and level at
/// the next flexion.
[[nodiscard]] std::vector<ReachedPose> walk_to_tests(const Scene& scene,
                                                     const MeasuredModels& models,
                                                     const TestPoses& tests,
                                                     TestBench& bench);

}  // namespace condyle
