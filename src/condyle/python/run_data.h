#pragma once

/// A run as Python holds it: what was computed, and its columns as a file would have them, made when first asked for.
/// The interpreter's lock is held by whoever asks.

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "condyle/python/knee.h"
#include "condyle/results/run_columns.h"

namespace condyle::python {

class RunData {
 public:
  /// Of a run made here: patches, meshes and warnings are those of the model.
  RunData(std::shared_ptr<const KneeModel> model, Run computed);
  /// Of one that is complete: read from a file, or made by a study.
  RunData(Run complete, ColumnTree columns, std::string file);

  [[nodiscard]] const Run& computed() const { return run_; }
  /// Null for one that was read.
  [[nodiscard]] const std::shared_ptr<const KneeModel>& model() const { return model_; }
  /// Where it was read; empty for one that was made here.
  [[nodiscard]] const std::string& file() const { return file_; }
  /// With all that a file holds.
  [[nodiscard]] Run complete() const;
  /// Does a place begin with what a model knows without poses: its patches, meshes, warnings?
  [[nodiscard]] static bool is_of_model(const std::string& place);
  /// The tree where "sweep/ligaments/aACL" stands, with that part of it made; null where it has no such beginning.
  [[nodiscard]] const ColumnTree* tree_at(const std::string& place) const;

 private:
  void make_sweep(const std::string& member) const;

  std::shared_ptr<const KneeModel> model_;
  Run run_;
  std::string file_;
  mutable std::unique_ptr<ColumnTree> columns_;     ///< of the run
  mutable std::unique_ptr<const ColumnTree> rest_;  ///< patches, meshes, warnings: of the model
  mutable std::array<bool, kSweepPartCount> made_{};
};

/// A solved pose, likewise: a sweep of one.
class PoseData {
 public:
  PoseData(std::shared_ptr<const KneeModel> model, const PoseResult& pose)
      : model_(std::move(model)), poses_{pose} {}

  [[nodiscard]] const PoseResult& pose() const { return poses_[0]; }
  [[nodiscard]] const Scene& scene() const { return model_->scene(); }
  /// The columns of /sweep, with those made that have the member that a place begins with.
  [[nodiscard]] const ColumnTree& tree_at(const std::string& place) const;

 private:
  std::shared_ptr<const KneeModel> model_;
  std::vector<PoseResult> poses_;
  mutable ColumnTree columns_;
  mutable std::array<bool, kSweepPartCount> made_{};
};

}  // namespace condyle::python
