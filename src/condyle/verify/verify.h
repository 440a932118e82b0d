#pragma once

/// Is what a run calls converged right? Every converged pose is checked against the scene, the
/// patches and the meshes in the file by code that shares nothing with the solver (docs/verify.md):
/// laws, conditions, joint coordinates, balance, contact points, gaps over all of both surfaces,
/// meshes inside each other.

#include <string>
#include <vector>

#include "condyle/on_progress.h"
#include "condyle/results/column_tree.h"
#include "condyle/results/run_file.h"
#include "condyle/verify/verification.h"

namespace condyle {

struct VerifyOptions {
  bool pushes = false;  ///< stability too
  bool meshes = true;   ///< meshes inside each other
  OnProgress on_pose = {};
  const ColumnTree* columns = nullptr;  ///< all that the run's file holds; null: not looked at
};

/// Throws InputError for a run without poses, or with a patch that cannot be evaluated.
[[nodiscard]] Verification verify_run(const Run& run, const VerifyOptions& options = {});

/// "25 of 25 poses converged; none is false" and the like.
[[nodiscard]] std::string verdict(const Verification& verification);

/// A line for each kind of check, its worst figure beside what is allowed.
[[nodiscard]] std::vector<std::string> check_lines(const Verification& verification);

}  // namespace condyle
