#pragma once

/// A run as Python holds it: what was computed, and its columns as a file would have them, made when first asked for.
/// The interpreter's lock is held by whoever asks.

#include <filesystem>
#include <memory>

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
  /// Of the poses and what goes with them; `rest`: patches, bodies, inputs.
  [[nodiscard]] const ColumnTree& columns() const;
  [[nodiscard]] const ColumnTree& rest() const;
  /// A group or a column at the top of the tree, wherever it is kept; null where there is none.
  [[nodiscard]] const ColumnTree* tree_with(const std::string& name) const;

 private:
  std::shared_ptr<const KneeModel> model_;
  Run run_;
  std::string file_;
  mutable std::unique_ptr<const ColumnTree> columns_, rest_;
};

/// A solved pose, likewise.
struct PoseData {
  std::shared_ptr<const KneeModel> model;
  PoseResult pose;
  mutable std::unique_ptr<const ColumnTree> columns = {};

  [[nodiscard]] const ColumnTree& tree() const;
};

}  // namespace condyle::python
