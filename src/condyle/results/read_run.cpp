#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "condyle/results/calibration_group.h"
#include "condyle/results/comparison_groups.h"
#include "condyle/results/estimates.h"
#include "condyle/results/format_number.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/layer_group.h"
#include "condyle/results/patch_group.h"
#include "condyle/results/path_group.h"
#include "condyle/results/points_dataset.h"
#include "condyle/results/run_columns.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sensitivity_group.h"
#include "condyle/results/simulation_group.h"
#include "condyle/results/sweep_group.h"
#include "condyle/results/trace_columns.h"
#include "condyle/results/uncertainty_group.h"
#include "condyle/results/wrap_group.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

// Hands one row of numbers to each pose.
using TakeRow = std::function<void(PoseResult& pose, const double* row)>;
void take(const Hdf5Group& group,
          const char* name,
          const Shape& shape,
          Poses& poses,
          const TakeRow& take_row) {
  const std::vector<double> values = group.read(name, shape);
  const std::size_t width = values.size() / poses.size();
  for (std::size_t i = 0; i < poses.size(); ++i) take_row(poses[i], &values[i * width]);
}

void take_integers(const Hdf5Group& group,
                   const char* name,
                   Poses& poses,
                   void (*take_one)(PoseResult&, int)) {
  const std::vector<int> values = group.read_integers(name, {poses.size()});
  for (std::size_t i = 0; i < poses.size(); ++i) take_one(poses[i], values[i]);
}

Scene read_head(const Hdf5Group& root) {
  const std::string format = root.read_attribute("format");
  if (format.starts_with("condyle study"))
    root.fail("holds a study, expected a run; condyle plot and condyle report show studies");
  const std::string later = later_format(format, kRunFormat);
  if (!later.empty()) root.fail(later);
  if (format != kRunFormat)
    root.fail(fmt::format("format = \"{}\", expected \"{}\"", format, kRunFormat));
  return parse_scene(root.read_attribute("scene"), root.read_attribute("scene_file"));
}

void read_status(const Hdf5Group& sweep, const Unit& unit, Poses& poses) {
  const Shape n = {poses.size()};
  take(sweep, "value", n, poses,
       [&](PoseResult& p, const double* row) { p.value = *row * unit.factor; });
  take(sweep, "status", n, poses, [&](PoseResult& p, const double* row) {
    if (!(*row >= 0 && *row < kPoseStatusCount))
      sweep.fail(fmt::format("status = {}, which has no meaning", *row));
    p.status = static_cast<PoseStatus>(static_cast<int>(*row));
  });
  const std::vector<std::string> reasons = sweep.read_texts("reason");
  if (reasons.size() != poses.size()) sweep.fail("dataset reason has not one text for each value");
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].reason = reasons[i];
  if (!sweep.has("remark")) return;
  const std::vector<std::string> remarks = sweep.read_texts("remark");
  if (remarks.size() != poses.size()) sweep.fail("dataset remark has not one text for each value");
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].remark = remarks[i];
}

void read_pose(const Hdf5Group& sweep, const Scene& scene, Poses& poses) {
  const std::size_t n = poses.size();
  const Hdf5Group pose = sweep.open("pose");
  take(pose, "translation", {n, 3}, poses,
       [](PoseResult& p, const double* row) { std::copy_n(row, 3, p.X_BA.p.data()); });
  take(pose, "rotation", {n, 3, 3}, poses, [](PoseResult& p, const double* row) {
    for (int i = 0; i < 9; ++i) p.X_BA.R(i / 3, i % 3) = row[i];
  });
  if (!scene.joint) return;
  const Hdf5Group joint = sweep.open("joint");
  for (const auto& column : kJointColumns) {
    take(joint, column.name, {n}, poses,
         [&](PoseResult& p, const double* row) { p.joint.*column.member = *row * column.unit; });
  }
  read_joint_stiffness(joint, poses);
}

void read_contact(const Hdf5Group& group, const Scene& scene, std::size_t index, Poses& poses) {
  const std::size_t n = poses.size();
  take(group, "state", {n}, poses,
       [&](PoseResult& p, const double* row) { p.contacts[index].closed = *row == 1; });
  take(group, "force", {n}, poses,
       [&](PoseResult& p, const double* row) { p.contacts[index].force = *row; });
  const Hdf5Group points = group.open("points");
  const std::vector<int> counts = points.read_integers("count", {n});
  const Hdf5Array edges = points.read("on_edge");
  const std::size_t slots = edges.shape.size() == 2 && edges.shape[0] == n ? edges.shape[1] : 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (counts[i] < 0 || static_cast<std::size_t>(counts[i]) > slots)
      points.fail("count is not the number of points");
    std::vector<ContactPointResult>& list = poses[i].contacts[index].points;
    list.resize(static_cast<std::size_t>(counts[i]));
    for (std::size_t k = 0; k < list.size(); ++k)
      list[k].on_edge = edges.values[i * slots + k] == 1;
  }
  for (const PointColumn& column : kPointColumns) {
    if (!points.has(column.name)) continue;  // edge_distance, in files of version 0.1.0
    const Shape shape = column.width > 1 ? Shape{n, slots, column.width} : Shape{n, slots};
    take(points, column.name, shape, poses, [&](PoseResult& p, const double* row) {
      for (ContactPointResult& point : p.contacts[index].points) {
        std::copy_n(row, column.width, column.data(point));
        row += column.width;
      }
    });
  }
  read_contact_estimates(group, points, poses, index);
  read_layers(group, scene, poses, index);
}

void read_elements(const Hdf5Group& sweep, const Scene& scene, Poses& poses) {
  const Shape n = {poses.size()};
  for (PoseResult& pose : poses) {
    pose.contacts.resize(scene.contacts.size());
    pose.ligaments.resize(scene.ligaments.size());
    pose.conditions.resize(scene.conditions.size());
  }
  const Hdf5Group contacts = sweep.open("contacts"), ligaments = sweep.open("ligaments");
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    read_contact(contacts.open(scene.contacts[i].name), scene, i, poses);
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const Hdf5Group group = ligaments.open(scene.ligaments[i].name);
    for (const auto& column : kLigamentColumns) {
      take(group, column.name, n, poses,
           [&](PoseResult& p, const double* row) { p.ligaments[i].*column.member = *row; });
    }
    read_path(group, scene, poses, i);
  }
  const Hdf5Group conditions = sweep.open("conditions");
  for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
    const Hdf5Group group = conditions.open(scene.conditions[i].name);
    const double unit = is_angle(scene.conditions[i].kind) ? kDegree : 1;
    take(group, "value", n, poses,
         [&](PoseResult& p, const double* row) { p.conditions[i].value = *row * unit; });
    take(group, "multiplier", n, poses,
         [&](PoseResult& p, const double* row) { p.conditions[i].multiplier = *row; });
  }
}

void read_solver(const Hdf5Group& sweep, Poses& poses) {
  const Shape n = {poses.size()};
  const Hdf5Group stability = sweep.open("stability"), newton = sweep.open("newton");
  take_integers(stability, "stable", poses,
                [](PoseResult& p, int stable) { p.stability = stable; });
  take(stability, "lowest_stiffness", n, poses,
       [](PoseResult& p, const double* row) { p.lowest_stiffness = *row; });
  take_integers(newton, "iterations", poses,
                [](PoseResult& p, int iterations) { p.iterations = iterations; });
  take(newton, "residual", n, poses, [](PoseResult& p, const double* row) { p.residual = *row; });
  take(newton, "seconds", n, poses, [](PoseResult& p, const double* row) { p.seconds = *row; });
  if (newton.has("event_seconds"))
    take(newton, "event_seconds", n, poses,
         [](PoseResult& p, const double* row) { p.event_seconds = *row; });
  read_traces(sweep, newton, poses);
}

RunStudy read_study(const Hdf5Group& root, const Scene& scene) {
  const auto held = [](auto study) {
    return std::make_shared<const decltype(study)>(std::move(study));
  };
  if (root.has("simulate")) return held(read_simulation(root.open("simulate"), scene));
  if (root.has("reference")) return held(read_comparison(root, scene));
  if (root.has("laxity")) return held(read_laxity(root.open("laxity"), scene));
  if (root.has("calibrate")) return held(read_calibration(root, scene));
  if (root.has("sweep")) return SweepStudy{};
  return FitStudy{};
}

/// Which ligament came to lie on which surface, or left it.
void read_touch_events(const Hdf5Group& group, Run& run) {
  const Shape n = {run.sweep.events.size()};
  const std::vector<int> ligaments = group.read_integers("ligament", n),
                         wraps = group.read_integers("wrap", n);
  for (std::size_t i = 0; i < ligaments.size(); ++i) {
    if (ligaments[i] < 0) continue;
    if (ligaments[i] >= static_cast<int>(run.scene.ligaments.size()))
      group.fail("holds an event of no known ligament");
    const LigamentDescription& ligament =
        run.scene.ligaments[static_cast<std::size_t>(ligaments[i])];
    Event& event = run.sweep.events[i];
    event.ligament = ligaments[i];
    for (int k = 0; k < static_cast<int>(ligament.path.wraps.size()); ++k)
      if (wrap_on_path(run.scene, ligament, k) == wraps[i]) event.wrap = k;
    if (event.wrap < 0) group.fail("holds an event of no known wrap");
  }
}

void read_events(const Hdf5Group& group, const Unit& unit, Run& run) {
  const std::vector<double> values = group.read("value").values;
  const Shape n = {values.size()};
  const std::vector<int> kinds = group.read_integers("kind", n);
  const std::vector<int> contacts = group.read_integers("contact", n);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (kinds[i] < 0 || kinds[i] >= kEventKindCount || contacts[i] < -1 ||
        contacts[i] >= static_cast<int>(run.scene.contacts.size()))
      group.fail("holds an event of no known kind or contact");
    run.sweep.events.push_back(
        {values[i] * unit.factor, static_cast<EventKind>(kinds[i]), contacts[i]});
  }
  if (group.has("wrap")) read_touch_events(group, run);
}

std::vector<InputFile> read_inputs(const Hdf5Group& group) {
  const std::vector<std::string> files = group.read_texts("file");
  const std::vector<std::string> digests = group.read_texts("sha256");
  if (files.size() != digests.size()) group.fail("has not one checksum for each file");
  std::vector<InputFile> inputs;
  for (std::size_t i = 0; i < files.size(); ++i) inputs.push_back({files[i], digests[i]});
  return inputs;
}

BodyMesh read_body(const Hdf5Group& group, const std::string& name) {
  BodyMesh body;
  body.name = name;
  Shape shape;
  body.mesh.vertices = read_points(group, "vertices", shape);
  const Hdf5Array corners = group.read("triangles");
  const auto count = static_cast<double>(body.mesh.vertices.size());
  for (std::size_t i = 0; i + 2 < corners.values.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(corners.values[i + k] >= 0 && corners.values[i + k] < count))
        group.fail("triangles name no vertex");
    }
    body.mesh.triangles.push_back({static_cast<int>(corners.values[i]),
                                   static_cast<int>(corners.values[i + 1]),
                                   static_cast<int>(corners.values[i + 2])});
  }
  return body;
}

}  // namespace

Poses read_sweep(const Hdf5Group& sweep, const Scene& scene, const Unit& unit) {
  Poses poses(sweep.read("value").values.size());
  if (poses.empty()) sweep.fail("dataset value is empty");
  read_status(sweep, unit, poses);
  read_pose(sweep, scene, poses);
  read_elements(sweep, scene, poses);
  read_solver(sweep, poses);
  return poses;
}

namespace {

Run read_run_in(const Hdf5Group& root) {
  Run run;
  run.scene = read_head(root);
  read_fitted_wraps(root, run.scene);
  if (root.has_attribute("program")) run.program = root.read_attribute("program");
  if (root.has_attribute("created")) run.created = root.read_attribute("created");
  if (root.has("inputs")) run.inputs = read_inputs(root.open("inputs"));
  run.study = read_study(root, run.scene);
  const Unit unit = swept_quantity(run).unit;
  if (root.has("sweep")) {
    const Hdf5Group sweep = root.open("sweep");
    run.sweep.poses = read_sweep(sweep, run.scene, unit);
    if (run.scene.sweep && sweep.has("sensitivities"))
      run.sensitivities =
          read_sensitivities(sweep.open("sensitivities"), run.scene, run.sweep.poses.size());
    if (sweep.has("uncertainty"))
      run.uncertainty =
          read_uncertainty(sweep.open("uncertainty"), run.scene, run.sweep.poses.size());
  }
  if (root.has("events")) read_events(root.open("events"), unit, run);
  if (root.has("fit")) run.start = root.open("fit").read_texts("start");
  const Hdf5Group patches = root.open("patches");
  for (const std::string& name : patches.names())
    run.patches.push_back(read_patch(patches.open(name), name, run.scene));
  const Hdf5Group bodies = root.open("bodies");
  for (const std::string& name : bodies.names())
    run.bodies.push_back(read_body(bodies.open(name), name));
  return run;
}

}  // namespace

Run read_run(const std::filesystem::path& path, ReadBy by) {
  const Hdf5Reader reader(path, by);
  return read_run_in(reader.root());
}

RunWithColumns read_run_with_columns(const std::filesystem::path& path) {
  const Hdf5Reader reader(path);
  RunWithColumns found{read_run_in(reader.root()), {}};
  found.columns = read_columns(reader.root());
  return found;
}

}  // namespace condyle
