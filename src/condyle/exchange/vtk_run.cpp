#include "condyle/exchange/vtk_run.h"

#include <fmt/format.h>

#include <utility>

#include "condyle/exchange/pressure_export.h"
#include "condyle/exchange/stl_run.h"
#include "condyle/exchange/vtk_file.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

std::string shape_vtp(const RunShape& shape, const RigidTransform& X) {
  VtkPolyData data;
  data.triangles = shape.mesh.triangles;
  for (const Vector3d& v : shape.mesh.vertices) data.points.push_back(X * v);
  VtkArray normals{"Normals", 3, {}};
  for (const Vector3d& n : shape.normals) {
    const Vector3d turned = X.R * n;
    normals.values.insert(normals.values.end(), turned.data(), turned.data() + 3);
  }
  data.point_data.push_back(std::move(normals));
  return vtp_bytes(data);
}

/// The swept value at each step where it grows, as ParaView wants of time.
std::vector<double> step_times(const Run& run, const std::vector<ShownPose>& shown) {
  const SweptQuantity quantity = swept_quantity(run);
  std::vector<double> swept, times;
  bool grows = true;
  for (const ShownPose& pose : shown) {
    swept.push_back(quantity.shown(run.sweep.poses[pose.index].value));
    times.push_back(pose.time);
    grows = grows && (swept.size() < 2 || swept.back() > swept[swept.size() - 2]);
  }
  return grows ? swept : times;
}

class VtkRun {
 public:
  VtkRun(const Run& run, const std::vector<ShownPose>& shown, std::string stem)
      : run_(run), shown_(shown), stem_(std::move(stem)), times_(step_times(run, shown)) {}

  [[nodiscard]] std::vector<ExportFile> files(const std::vector<RunShape>& shapes) {
    add_shapes(shapes, true, "bones");
    add_shapes(shapes, false, "surfaces");
    if (!run_.scene.ligaments.empty()) add_each("ligaments", ligaments_vtp);
    if (!run_.scene.contacts.empty()) add_each("contacts", contacts_vtp);
    if (has_layers(run_)) add_each("pressures", pressures_vtp);
    return std::move(files_);
  }

 private:
  [[nodiscard]] const PoseResult& pose(std::size_t step) const {
    return run_.sweep.poses[shown_[step].index];
  }
  [[nodiscard]] std::string numbered(const std::string& word, std::size_t step) const {
    return fmt::format("{}_vtk/{}_{:04d}.vtp", stem_, word, shown_[step].index);
  }

  /// What does not move is written once and named at every step.
  void add_shapes(const std::vector<RunShape>& shapes, bool bones, const std::string& kind) {
    std::vector<VtkStep> series;
    int part = 0;
    for (const RunShape& shape : shapes) {
      if (shape.bone != bones) continue;
      const bool moves = shape.body == run_.scene.moving_body();
      const std::string word = file_word(shape.name), still = stem_ + "_vtk/" + word + ".vtp";
      if (!moves) files_.push_back({still, shape_vtp(shape, RigidTransform())});
      for (std::size_t i = 0; i < shown_.size(); ++i) {
        if (moves) files_.push_back({numbered(word, i), shape_vtp(shape, pose(i).X_BA)});
        series.push_back({times_[i], part, moves ? numbered(word, i) : still});
      }
      ++part;
    }
    if (!series.empty()) files_.push_back({stem_ + "_" + kind + ".pvd", pvd_bytes(series)});
  }

  void add_each(const std::string& kind, std::string (*bytes)(const Run&, const PoseResult&)) {
    std::vector<VtkStep> series;
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      files_.push_back({numbered(kind, i), bytes(run_, pose(i))});
      series.push_back({times_[i], 0, numbered(kind, i)});
    }
    files_.push_back({stem_ + "_" + kind + ".pvd", pvd_bytes(series)});
  }

  const Run& run_;
  const std::vector<ShownPose>& shown_;
  std::string stem_;
  std::vector<double> times_;
  std::vector<ExportFile> files_;
};

}  // namespace

std::vector<ExportFile> vtk_of_poses(const Run& run,
                                     const std::vector<ShownPose>& shown,
                                     const std::vector<RunShape>& shapes,
                                     const std::string& stem) {
  return VtkRun(run, shown, stem).files(shapes);
}

std::string ligaments_vtp(const Run& run, const PoseResult& pose) {
  VtkPolyData data;
  VtkArray strain{"strain", 1, {}}, force{"force_N", 1, {}}, length{"length_mm", 1, {}};
  for (std::size_t i = 0; i < run.scene.ligaments.size(); ++i) {
    const LigamentDescription& ligament = run.scene.ligaments[i];
    const int first = static_cast<int>(data.points.size());
    data.points.push_back(insertion(run.scene, pose, ligament.ends[0]));
    for (const Eigen::Vector3d& corner : path_corners(run.scene, pose, i))
      data.points.push_back(corner);
    data.points.push_back(insertion(run.scene, pose, ligament.ends[1]));
    for (int k = first; k + 1 < static_cast<int>(data.points.size()); ++k) {
      data.lines.push_back({k, k + 1});
      data.cell_names.push_back(ligament.name);
      strain.values.push_back(has_strain(ligament.law) ? pose.ligaments[i].strain : kNoNumber);
      force.values.push_back(pose.ligaments[i].force);
      length.values.push_back(pose.ligaments[i].length);
    }
  }
  data.cell_data = {strain, force, length};
  return vtp_bytes(data);
}

namespace {

/// Where a contact's forces act: its points, or the centre of pressure of a layer.
std::vector<ContactPointResult> acting_points(const ContactResult& contact) {
  if (!contact.layer || contact.points.empty()) return contact.points;
  ContactPointResult at = contact.points.front();
  at.point_ground = contact.resultant_ground;
  at.normal_ground = contact.layer->force.normalized();
  return {at};
}

}  // namespace

std::string contacts_vtp(const Run& run, const PoseResult& pose) {
  VtkPolyData data;
  VtkArray force{"force_N", 3, {}}, size{"force_size_N", 1, {}}, normal{"normal", 3, {}},
      beyond{"beyond_edge_mm", 1, {}};
  for (std::size_t i = 0; i < run.scene.contacts.size(); ++i) {
    if (!pose.contacts[i].closed) continue;
    for (const ContactPointResult& point : acting_points(pose.contacts[i])) {
      data.points.push_back(point.point_ground);
      data.cell_names.push_back(run.scene.contacts[i].name);
      for (int k = 0; k < 3; ++k) {
        force.values.push_back(point.force * point.normal_ground[k]);
        normal.values.push_back(point.normal_ground[k]);
      }
      size.values.push_back(point.force);
      beyond.values.push_back(beyond_edge(point));
    }
  }
  data.point_data = {force, size, normal, beyond};
  return vtp_bytes(data);
}

}  // namespace condyle
