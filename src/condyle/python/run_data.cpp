#include "condyle/python/run_data.h"

#include <utility>

namespace condyle::python {

RunData::RunData(std::shared_ptr<const KneeModel> model, Run computed)
    : model_(std::move(model)), run_(std::move(computed)) {}

RunData::RunData(Run complete, ColumnTree columns, std::string file)
    : run_(std::move(complete)),
      file_(std::move(file)),
      columns_(std::make_unique<const ColumnTree>(std::move(columns))) {}

Run RunData::complete() const {
  Run run = run_;
  if (!model_) return run;
  const Run& empty = model_->empty_run();
  run.patches = empty.patches;
  run.bodies = empty.bodies;
  run.start = empty.start;
  run.inputs = empty.inputs;
  return run;
}

const ColumnTree& RunData::columns() const {
  if (!columns_) columns_ = std::make_unique<const ColumnTree>(columns_of(run_));
  return *columns_;
}

const ColumnTree& RunData::rest() const {
  if (!model_) return columns();
  if (!rest_) rest_ = std::make_unique<const ColumnTree>(columns_of(model_->empty_run()));
  return *rest_;
}

const ColumnTree* RunData::tree_with(const std::string& name) const {
  const auto holds = [&](const ColumnTree& tree) {
    return tree.group(name) != nullptr || tree.column(name) != nullptr;
  };
  const bool of_the_model =
      name == "patches" || name == "bodies" || name == "inputs" || name == "fit";
  const ColumnTree& tree = of_the_model ? rest() : columns();
  return holds(tree) ? &tree : nullptr;
}

const ColumnTree& PoseData::tree() const {
  if (!columns)
    columns = std::make_unique<const ColumnTree>(columns_of(model->scene(), Unit{"1", 1}, pose));
  return *columns;
}

}  // namespace condyle::python
