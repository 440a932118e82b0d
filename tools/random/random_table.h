#pragma once

/// What many random sweeps came to: a table of statuses, and what is wrong.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "random/sweep_outcome.h"

namespace condyle::random_knees {

class RandomTable {
 public:
  /// In the order of k.
  void add(std::uint64_t k, const SweepOutcome& outcome);

  /// Markdown: kinds of knees and statuses; then single figures.
  [[nodiscard]] std::string text() const;
  /// A line for each thing that is wrong, with the number of its knee.
  [[nodiscard]] const std::vector<std::string>& wrongs() const { return wrongs_; }
  /// Nothing is wrong that may never be.
  [[nodiscard]] bool good() const { return false_poses_ == 0 && exceptions_ == 0; }

 private:
  struct Row {
    long sweeps = 0, refused = 0, false_poses = 0, looked_again = 0, found = 0;
    std::map<PoseStatus, long> statuses;
  };
  std::map<std::string, Row> rows_;
  Row all_;
  std::vector<std::string> wrongs_;
  std::vector<float> seconds_, set_up_;  ///< of each pose; of each sweep
  long false_poses_ = 0, exceptions_ = 0, slow_ = 0;
  double slowest_ = 0, sweeping_ = 0, checked_ = 0;
  std::uint64_t slowest_knee_ = 0;
  std::string slowest_words_;
};

}  // namespace condyle::random_knees
