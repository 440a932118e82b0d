#include "condyle/exchange/opensim_run.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/math/no_number.h"
#include "condyle/results/run_layout.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kMetre = 1e-3;  // per mm

struct StorageColumn {
  std::string label;
  std::vector<double> values;
};

/// Labels must not hold blanks: they are what separates columns.
std::string without_blanks(std::string label) {
  for (char& c : label)
    if (c == ' ' || c == '\t') c = '_';
  return label;
}

/// Columns are found by their labels.
void expect_distinct(const std::vector<StorageColumn>& columns) {
  std::set<std::string> taken;
  for (const StorageColumn& column : columns)
    if (const std::string label = without_blanks(column.label); !taken.insert(label).second)
      throw InputError(fmt::format(
          "two columns would have the label \"{}\", expected names that are not the same "
          "with \"_\" in place of blanks",
          label));
}

std::string storage(const std::string& name,
                    bool degrees,
                    const std::vector<ShownPose>& shown,
                    const std::vector<StorageColumn>& columns) {
  expect_distinct(columns);
  std::string text =
      fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\nendheader\ntime", name,
                  shown.size(), columns.size() + 1, degrees ? "yes" : "no");
  for (const StorageColumn& column : columns)
    fmt::format_to(std::back_inserter(text), "\t{}", without_blanks(column.label));
  text += '\n';
  for (std::size_t i = 0; i < shown.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{}", shown[i].time);
    for (const StorageColumn& column : columns)
      fmt::format_to(std::back_inserter(text), "\t{}", column.values[i]);
    text += '\n';
  }
  return text;
}

/// The anatomical frame in the ground frame, with the axes that OpenSim uses.
RigidTransform opensim_frame(const Scene& scene,
                             const PoseResult& pose,
                             const AnatomicalFrame& frame) {
  RigidTransform X;
  X.R.col(0) = frame.anterior;
  X.R.col(1) = frame.proximal;
  X.R.col(2) = scene.joint->side == Side::kRight ? frame.lateral : Vector3d(-frame.lateral);
  X.p = frame.origin;
  return body_pose(scene, pose.X_BA, frame.body) * X;
}

class StorageColumns {
 public:
  StorageColumns(const Run& run, const std::vector<ShownPose>& shown) : run_(run), shown_(shown) {}

  template <typename F>
  void add(const std::string& label, const F& value) {
    StorageColumn column{label, {}};
    for (const ShownPose& shown : shown_)
      column.values.push_back(value(run_.sweep.poses[shown.index]));
    columns_.push_back(std::move(column));
  }

  template <typename F>
  void add_vector(const std::string& label, const F& value) {
    for (int k = 0; k < 3; ++k)
      add(label + "xyz"[k], [&](const PoseResult& pose) { return value(pose)[k]; });
  }

  [[nodiscard]] const std::vector<StorageColumn>& columns() const { return columns_; }

 private:
  const Run& run_;
  const std::vector<ShownPose>& shown_;
  std::vector<StorageColumn> columns_;
};

}  // namespace

JamCoordinates jam_coordinates(const Scene& scene, const PoseResult& pose) {
  const RigidTransform X_FT = opensim_frame(scene, pose, scene.joint->femur).inverse() *
                              opensim_frame(scene, pose, scene.joint->tibia);
  const Eigen::Matrix3d& R = X_FT.R;
  JamCoordinates q;
  q.flex = std::atan2(R(0, 1), R(1, 1));
  q.add = std::atan2(R(2, 1), std::hypot(R(0, 1), R(1, 1)));
  q.rot = std::atan2(-R(2, 0), R(2, 2));
  q.translation = X_FT.p;
  if (scene.joint->side == Side::kLeft) {
    q.add = -q.add;
    q.rot = -q.rot;
    q.translation.z() = -q.translation.z();
  }
  return q;
}

std::string mot_of_poses(const Run& run,
                         const std::vector<ShownPose>& shown,
                         const std::string& file) {
  if (!run.scene.joint)
    throw InputError(file + ": its scene has no [joint], which a motion file (.mot) needs");
  const std::string side = run.scene.joint->side == Side::kRight ? "_r" : "_l";
  const auto jam = [&](const PoseResult& pose) { return jam_coordinates(run.scene, pose); };
  StorageColumns columns(run, shown);
  columns.add("knee_flex" + side, [&](const PoseResult& p) { return jam(p).flex / kDegree; });
  columns.add("knee_add" + side, [&](const PoseResult& p) { return jam(p).add / kDegree; });
  columns.add("knee_rot" + side, [&](const PoseResult& p) { return jam(p).rot / kDegree; });
  for (int k = 0; k < 3; ++k) {
    columns.add(fmt::format("knee_t{}{}", "xyz"[k], side),
                [&](const PoseResult& p) { return kMetre * jam(p).translation[k]; });
  }
  return storage("Coordinates", true, shown, columns.columns());
}

std::string sto_of_poses(const Run& run, const std::vector<ShownPose>& shown) {
  const Scene& scene = run.scene;
  StorageColumns columns(run, shown);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const std::string& name = scene.contacts[i].name;
    columns.add_vector(name + ".force_v",
                       [&](const PoseResult& p) { return force_on_moving_body(p.contacts[i]); });
    columns.add_vector(name + ".force_p", [&](const PoseResult& p) -> Vector3d {
      return kMetre * force_place(p.contacts[i]);
    });
  }
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const std::string& name = scene.ligaments[i].name;
    columns.add(name + ".force", [&](const PoseResult& p) { return p.ligaments[i].force; });
    columns.add(name + ".strain", [&](const PoseResult& p) {
      return has_strain(scene.ligaments[i].law) ? p.ligaments[i].strain : kNoNumber;
    });
    columns.add(name + ".length",
                [&](const PoseResult& p) { return kMetre * p.ligaments[i].length; });
  }
  return storage("ForcesOfTheKnee", false, shown, columns.columns());
}

}  // namespace condyle
