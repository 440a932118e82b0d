#include "condyle/python/run_data.h"

#include <algorithm>
#include <utility>

#include "condyle/results/run_view.h"

namespace condyle::python {
namespace {

/// The first two names of "sweep/ligaments/aACL"; empty ones where there are fewer.
std::vector<std::string> first_names(const std::string& place) {
  const std::size_t slash = std::min(place.find('/'), place.size());
  const std::size_t next = std::min(place.find('/', slash + 1), place.size());
  return {place.substr(0, slash),
          slash < place.size() ? place.substr(slash + 1, next - slash - 1) : ""};
}

/// The part that has the member, or all for the whole, each once.
template <typename Make>
void make_parts(const std::string& member,
                std::array<bool, kSweepPartCount>& made,
                const Make& make) {
  for (int i = 0; i < kSweepPartCount; ++i) {
    const auto part = static_cast<SweepPart>(i);
    bool& done = made[static_cast<std::size_t>(i)];
    if (done || (!member.empty() && part_with(member) != part)) continue;
    make(part);
    done = true;
  }
}

}  // namespace

RunData::RunData(std::shared_ptr<const KneeModel> model, Run computed)
    : model_(std::move(model)), run_(std::move(computed)) {}

RunData::RunData(Run complete, ColumnTree columns, std::string file)
    : run_(std::move(complete)),
      file_(std::move(file)),
      columns_(std::make_unique<ColumnTree>(std::move(columns))) {}

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

bool RunData::is_of_model(const std::string& place) {
  const std::string group = first_names(place)[0];
  return group == "patches" || group == "bodies" || group == "inputs" || group == "fit";
}

const ColumnTree* RunData::tree_at(const std::string& place) const {
  const std::vector<std::string> names = first_names(place);
  const std::string& group = names[0];
  const auto holding = [&](const ColumnTree& tree) {
    return tree.group(group) != nullptr || tree.column(group) != nullptr ? &tree : nullptr;
  };
  if (!model_) return holding(*columns_);
  if (is_of_model(place)) {
    if (!rest_) rest_ = std::make_unique<const ColumnTree>(columns_of(model_->empty_run()));
    return holding(*rest_);
  }
  if (!columns_) columns_ = std::make_unique<ColumnTree>(columns_beside_sweep(run_));
  if (group == "sweep" && !run_.sweep.poses.empty()) make_sweep(names[1]);
  return holding(*columns_);
}

void RunData::make_sweep(const std::string& member) const {
  ColumnTree& sweep = columns_->make_group("sweep");
  if (sweep.names.empty()) add_columns_beside_poses(sweep, run_);
  make_parts(member, made_, [&](SweepPart part) {
    add_columns(sweep, part, run_.scene, swept_quantity(run_).unit, run_.sweep.poses);
  });
}

const ColumnTree& PoseData::tree_at(const std::string& place) const {
  make_parts(first_names(place)[0], made_, [&](SweepPart part) {
    add_columns(columns_, part, model_->scene(), Unit{"1", 1}, poses_);
  });
  return columns_;
}

}  // namespace condyle::python
