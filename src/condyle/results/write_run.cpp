#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <functional>
#include <limits>

#include "condyle/results/calibration_group.h"
#include "condyle/results/comparison_groups.h"
#include "condyle/results/estimates.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/layer_group.h"
#include "condyle/results/output_file.h"
#include "condyle/results/path_group.h"
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
#include "condyle/version.h"

namespace condyle {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
using Poses = std::vector<PoseResult>;

// One row of `width` numbers for each pose; one without equilibrium has NaN.
using FillRow = std::function<void(const PoseResult& pose, double* row)>;
std::vector<double> rows(const Poses& poses, std::size_t width, const FillRow& fill) {
  std::vector<double> out(poses.size() * width, kNone);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].solved()) fill(poses[i], &out[i * width]);
  }
  return out;
}

std::vector<int> integers(const Poses& poses, const std::function<int(const PoseResult&)>& of) {
  std::vector<int> out;
  for (const PoseResult& pose : poses) out.push_back(of(pose));
  return out;
}

std::vector<double> numbers(const Poses& poses,
                            const std::function<double(const PoseResult&)>& of) {
  std::vector<double> out;
  for (const PoseResult& pose : poses) out.push_back(of(pose));
  return out;
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

void write_head(const Hdf5Group& root, const Scene& scene) {
  root.write_attribute("title", scene.title);
  root.write_attribute("format", kRunFormat);
  root.write_attribute("program", "condyle " CONDYLE_VERSION);
  root.write_attribute("created", now());
  root.write_attribute("scene", scene.text);
  root.write_attribute("scene_file", scene.file.string());
}

void write_status(const Hdf5Group& sweep, const Unit& unit, const Poses& poses) {
  const std::size_t n = poses.size();
  sweep.write("value", numbers(poses, [&](const PoseResult& p) { return in_unit(p.value, unit); }),
              {n}, unit.name);
  sweep.write("status",
              integers(poses, [](const PoseResult& p) { return static_cast<int>(p.status); }), {n},
              "1");
  std::vector<std::string> meanings;
  for (int i = 0; i < kPoseStatusCount; ++i)
    meanings.emplace_back(name(static_cast<PoseStatus>(i)));
  sweep.write_attribute("status", "meaning", meanings);
  std::vector<std::string> reasons, remarks;
  for (const PoseResult& pose : poses) {
    reasons.push_back(pose.reason);
    remarks.push_back(pose.remark);
  }
  sweep.write("reason", reasons);
  sweep.write("remark", remarks);
}

void write_pose(const Hdf5Group& sweep, const Scene& scene, const Poses& poses) {
  const std::size_t n = poses.size();
  const Hdf5Group pose = sweep.create("pose");
  pose.write("translation",
             rows(poses, 3,
                  [](const PoseResult& p, double* row) { std::copy_n(p.X_BA.p.data(), 3, row); }),
             {n, 3}, "mm");
  const FillRow rotation = [](const PoseResult& p, double* row) {
    for (int i = 0; i < 9; ++i) row[i] = p.X_BA.R(i / 3, i % 3);
  };
  pose.write("rotation", rows(poses, 9, rotation), {n, 3, 3}, "1");
  if (!scene.joint) return;
  const Hdf5Group joint = sweep.create("joint");
  for (const auto& column : kJointColumns) {
    const FillRow fill = [&](const PoseResult& p, double* row) {
      *row = p.joint.*column.member / column.unit;
    };
    joint.write(column.name, rows(poses, 1, fill), {n}, column.units);
  }
  write_joint_stiffness(joint, poses);
}

ContactPointResult no_point() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  ContactPointResult point;
  point.point_ground.setConstant(kNaN);
  point.point_moving = point.normal_ground = point.point_ground;
  point.gap = std::numeric_limits<double>::infinity();
  point.relative_curvature = {kNaN, kNaN};
  return point;
}

// The point that stands for a pair of surfaces: the one with the greatest force.
// An open contact without a place near carries nothing, infinitely far away.
ContactPointResult main_point(const ContactResult& contact) {
  const ContactPointResult* strongest = strongest_point(contact);
  if (strongest == nullptr) return no_point();
  ContactPointResult point = *strongest;
  point.force = contact.force;
  return point;
}

// All the points of a pair, in slots that are NaN where a pose has fewer.
void write_points(const Hdf5Group& group, const Poses& poses, std::size_t index) {
  const std::size_t n = poses.size();
  std::size_t slots = 1;
  for (const PoseResult& pose : poses) {
    if (pose.solved()) slots = std::max(slots, pose.contacts.at(index).points.size());
  }
  const auto points_of = [&](const PoseResult& pose) -> const std::vector<ContactPointResult>& {
    return pose.contacts[index].points;
  };
  group.write("count",
              integers(poses,
                       [&](const PoseResult& p) {
                         return p.solved() ? static_cast<int>(points_of(p).size()) : 0;
                       }),
              {n}, "1");
  for (const PointColumn& column : kPointColumns) {
    const FillRow fill = [&](const PoseResult& pose, double* row) {
      for (ContactPointResult point : points_of(pose))
        row = std::copy_n(column.data(point), column.width, row);
    };
    group.write(column.name, rows(poses, slots * column.width, fill),
                with_width({n, slots}, column.width), column.units);
  }
  const FillRow edge = [&](const PoseResult& pose, double* row) {
    for (const ContactPointResult& point : points_of(pose)) *row++ = point.on_edge ? 1 : 0;
  };
  group.write("on_edge", rows(poses, slots, edge), {n, slots}, "1");
}

void write_contact(const Hdf5Group& group,
                   const Scene& scene,
                   const Poses& poses,
                   std::size_t index) {
  const std::size_t n = poses.size();
  group.write("state",
              integers(poses,
                       [&](const PoseResult& p) {
                         return p.solved() ? (p.contacts.at(index).closed ? 1 : 0) : -1;
                       }),
              {n}, "1");
  for (const PointColumn& column : kPointColumns) {
    const FillRow fill = [&](const PoseResult& pose, double* row) {
      const ContactResult& contact = pose.contacts[index];
      ContactPointResult point = main_point(contact);
      std::copy_n(column.data(point), column.width, row);
    };
    group.write(column.name, rows(poses, column.width, fill), with_width({n}, column.width),
                column.units);
  }
  const Hdf5Group points = group.create("points");
  write_points(points, poses, index);
  write_contact_estimates(group, points, scene, poses, index);
  write_layers(group, scene, poses, index);
}

/// Columns of all ligaments, filled in one walk over the poses: walks over many poses cost more than what they fetch.
using LigamentNumbers = std::array<std::vector<double>, kLigamentColumns.size()>;

std::vector<LigamentNumbers> ligament_numbers(const Poses& poses, std::size_t ligaments) {
  LigamentNumbers none;
  none.fill(std::vector<double>(poses.size(), kNone));
  std::vector<LigamentNumbers> numbers(ligaments, none);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!poses[i].solved()) continue;
    for (std::size_t k = 0; k < ligaments; ++k)
      for (std::size_t c = 0; c < kLigamentColumns.size(); ++c)
        numbers[k][c][i] = poses[i].ligaments.at(k).*kLigamentColumns[c].member;
  }
  return numbers;
}

void write_ligament(const Hdf5Group& group, const Poses& poses, const LigamentNumbers& numbers) {
  for (std::size_t c = 0; c < kLigamentColumns.size(); ++c)
    group.write(kLigamentColumns[c].name, numbers[c], {poses.size()}, kLigamentColumns[c].units);
}

void write_condition(const Hdf5Group& group, const Poses& poses, std::size_t index, bool angle) {
  const double unit = angle ? kDegree : 1;
  const FillRow value = [&](const PoseResult& p, double* row) {
    *row = p.conditions.at(index).value / unit;
  };
  const FillRow multiplier = [&](const PoseResult& p, double* row) {
    *row = p.conditions.at(index).multiplier;
  };
  group.write("value", rows(poses, 1, value), {poses.size()}, angle ? "deg" : "mm");
  group.write("multiplier", rows(poses, 1, multiplier), {poses.size()}, angle ? "N mm" : "N");
}

void write_contacts(const Hdf5Group& sweep, const Scene& scene, const Poses& poses) {
  const Hdf5Group contacts = sweep.create("contacts");
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    write_contact(contacts.create(scene.contacts[i].name), scene, poses, i);
}

void write_ligaments(const Hdf5Group& sweep, const Scene& scene, const Poses& poses) {
  const Hdf5Group ligaments = sweep.create("ligaments");
  const std::vector<LigamentNumbers> numbers = ligament_numbers(poses, scene.ligaments.size());
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const Hdf5Group ligament = ligaments.create(scene.ligaments[i].name);
    write_ligament(ligament, poses, numbers[i]);
    write_path(ligament, scene, poses, i);
  }
}

void write_conditions(const Hdf5Group& sweep, const Scene& scene, const Poses& poses) {
  const Hdf5Group conditions = sweep.create("conditions");
  for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
    write_condition(conditions.create(scene.conditions[i].name), poses, i,
                    is_angle(scene.conditions[i].kind));
  }
}

void write_solver(const Hdf5Group& sweep, const Poses& poses) {
  const Shape n = {poses.size()};
  const Hdf5Group stability = sweep.create("stability");
  stability.write(
      "stable", integers(poses, [](const PoseResult& p) { return p.solved() ? p.stability : -1; }),
      n, "1");
  stability.write(
      "lowest_stiffness",
      rows(poses, 1, [](const PoseResult& p, double* row) { *row = p.lowest_stiffness; }), n,
      "N/mm");
  const Hdf5Group newton = sweep.create("newton");
  newton.write("iterations", integers(poses, [](const PoseResult& p) { return p.iterations; }), n,
               "1");
  newton.write("residual", numbers(poses, [](const PoseResult& p) { return p.residual; }), n, "N");
  newton.write("seconds", numbers(poses, [](const PoseResult& p) { return p.seconds; }), n, "s");
  newton.write("event_seconds", numbers(poses, [](const PoseResult& p) { return p.event_seconds; }),
               n, "s");
  write_traces(sweep, newton, poses);
}

void write_events(const Hdf5Group& group, const Run& run, const Unit& unit) {
  const std::vector<Event>& events = run.sweep.events;
  std::vector<double> values;
  std::vector<int> kinds, contacts, ligaments, wraps;
  for (const Event& event : events) {
    values.push_back(event.value / unit.factor);
    kinds.push_back(static_cast<int>(event.kind));
    contacts.push_back(event.contact);
    ligaments.push_back(event.ligament);
    wraps.push_back(
        event.ligament < 0
            ? -1
            : wrap_on_path(run.scene, run.scene.ligaments[static_cast<std::size_t>(event.ligament)],
                           event.wrap));
  }
  const Shape n = {events.size()};
  group.write("value", values, n, unit.name);
  group.write("kind", kinds, n, "1");
  group.write("contact", contacts, n, "1");
  std::vector<std::string> meanings, names;
  for (int i = 0; i < kEventKindCount; ++i) meanings.emplace_back(name(static_cast<EventKind>(i)));
  for (const ContactDescription& contact : run.scene.contacts) names.push_back(contact.name);
  group.write_attribute("kind", "meaning", meanings);
  group.write_attribute("contact", "meaning", names);
  if (run.scene.wraps.empty()) return;
  group.write("ligament", ligaments, n, "1");
  group.write("wrap", wraps, n, "1");
  std::vector<std::string> ligament_names, wrap_names;
  for (const LigamentDescription& ligament : run.scene.ligaments)
    ligament_names.push_back(ligament.name);
  for (const WrapDescription& wrap : run.scene.wraps) wrap_names.push_back(wrap.name);
  group.write_attribute("ligament", "meaning", ligament_names);
  group.write_attribute("wrap", "meaning", wrap_names);
}

void write_fit(const Hdf5Group& patch, const FitReport& report) {
  patch.write("rms_mm", std::vector<double>{report.rms}, {}, "mm");
  patch.write("max_mm", std::vector<double>{report.max}, {}, "mm");
  const Hdf5Group fit = patch.create("fit");
  for (const auto& column : kFitColumns) {
    fit.write(column.name, std::vector<double>{report.*column.member / column.unit}, {},
              column.units);
  }
  fit.write("mesh_vertices", std::vector<int>{report.mesh_vertices}, {}, "1");
  fit.write("curvature_range",
            std::vector<double>(report.curvature_range.begin(), report.curvature_range.end()), {2},
            "1/mm");
  fit.write("extent", std::vector<double>(report.extent.begin(), report.extent.end()), {2}, "mm");
  fit.write("turn", std::vector<double>{report.turn[0] / kDegree, report.turn[1] / kDegree}, {2},
            "deg");
  fit.write("notes", report.notes);
}

std::vector<double> coordinates(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> out;
  out.reserve(3 * points.size());
  for (const Eigen::Vector3d& point : points) out.insert(out.end(), point.begin(), point.end());
  return out;
}

void write_patch(const Hdf5Group& group, const RunPatch& patch, const Scene& scene) {
  const PatchData& data = patch.data;
  const auto size = [](int n) { return static_cast<std::size_t>(n); };
  group.write_attribute("body", scene.bodies.at(size(patch.body)).name);
  group.write("degree", std::vector<int>(data.degree.begin(), data.degree.end()), {2}, "1");
  group.write("knots_u", data.knots_u, {data.knots_u.size()}, "mm");
  group.write("knots_v", data.knots_v, {data.knots_v.size()}, "mm");
  group.write("control_points", coordinates(data.control_points), {size(data.nu), size(data.nv), 3},
              "mm");
  group.write("orientation", std::vector<int>{data.orientation}, {}, "1");
  const Shape mask =
      data.mask.empty() ? Shape{0, 0} : Shape{size(data.mask_nu) + 1, size(data.mask_nv) + 1};
  group.write("mask", data.mask, mask, "mm");
  write_fit(group, patch.report);
}

void write_body(const Hdf5Group& group, const TriangleMesh& mesh) {
  group.write("vertices", coordinates(mesh.vertices), {mesh.vertices.size(), 3}, "mm");
  std::vector<int> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const std::array<int, 3>& triangle : mesh.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  group.write("triangles", corners, {mesh.triangles.size(), 3}, "1");
}

void write_inputs(const Hdf5Group& root, const std::vector<InputFile>& inputs) {
  if (inputs.empty()) return;
  std::vector<std::string> files, digests;
  for (const InputFile& input : inputs) {
    files.push_back(input.file);
    digests.push_back(input.sha256);
  }
  const Hdf5Group group = root.create("inputs");
  group.write("file", files);
  group.write("sha256", digests);
}

/// Of /sweep what is not of single poses.
void write_beside_poses(const Hdf5Group& sweep, const Run& run) {
  if (run.sensitivities) write_sensitivities(sweep.create("sensitivities"), *run.sensitivities);
  if (run.uncertainty) write_uncertainty(sweep.create("uncertainty"), *run.uncertainty);
}

enum class WithSweep { kNo, kYes };

void write_all(const Hdf5Group& root, const Run& run, WithSweep with_sweep) {
  write_head(root, run.scene);
  write_wraps(root, run.scene);
  if (!run.sweep.poses.empty()) {
    const Unit unit = swept_quantity(run).unit;
    if (with_sweep == WithSweep::kYes) {
      const Hdf5Group sweep = root.create("sweep");
      write_sweep(sweep, run.scene, unit, run.sweep.poses);
      write_beside_poses(sweep, run);
    }
    write_events(root.create("events"), run, unit);
  }
  const Hdf5Group patches = root.create("patches");
  for (const RunPatch& patch : run.patches)
    write_patch(patches.create(patch.surface), patch, run.scene);
  write_inputs(root, run.inputs);
  if (!run.start.empty()) root.create("fit").write("start", run.start);
  const Hdf5Group bodies = root.create("bodies");
  for (const BodyMesh& body : run.bodies) write_body(bodies.create(body.name), body.mesh);
  if (run.comparison()) write_comparison(root, run.scene, *run.comparison());
  if (run.simulation()) write_simulation(root.create("simulate"), run.scene, *run.simulation());
  if (run.laxity()) write_laxity(root.create("laxity"), run.scene, *run.laxity());
  if (run.calibration()) write_calibration(root, run.scene, *run.calibration());
}

}  // namespace

void write_sweep_part(const Hdf5Group& sweep,
                      SweepPart part,
                      const Scene& scene,
                      const Unit& unit,
                      const Poses& poses) {
  switch (part) {
    case SweepPart::kStatus:
      return write_status(sweep, unit, poses);
    case SweepPart::kPose:
      return write_pose(sweep, scene, poses);
    case SweepPart::kContacts:
      return write_contacts(sweep, scene, poses);
    case SweepPart::kLigaments:
      return write_ligaments(sweep, scene, poses);
    case SweepPart::kConditions:
      return write_conditions(sweep, scene, poses);
    case SweepPart::kSolver:
      return write_solver(sweep, poses);
  }
}

SweepPart part_with(const std::string& member) {
  if (member == "value" || member == "status" || member == "reason" || member == "remark")
    return SweepPart::kStatus;
  if (member == "pose" || member == "joint") return SweepPart::kPose;
  if (member == "contacts") return SweepPart::kContacts;
  if (member == "ligaments") return SweepPart::kLigaments;
  return member == "conditions" ? SweepPart::kConditions : SweepPart::kSolver;
}

void write_sweep(const Hdf5Group& sweep, const Scene& scene, const Unit& unit, const Poses& poses) {
  for (int part = 0; part < kSweepPartCount; ++part)
    write_sweep_part(sweep, static_cast<SweepPart>(part), scene, unit, poses);
}

ColumnTree columns_of(const Run& run) {
  ColumnTree columns;
  write_all(Hdf5Group(columns, "/"), run, WithSweep::kYes);
  return columns;
}

ColumnTree columns_beside_sweep(const Run& run) {
  ColumnTree columns;
  write_all(Hdf5Group(columns, "/"), run, WithSweep::kNo);
  return columns;
}

void add_columns(
    ColumnTree& sweep, SweepPart part, const Scene& scene, const Unit& unit, const Poses& poses) {
  write_sweep_part(Hdf5Group(sweep, "/sweep/"), part, scene, unit, poses);
}

void add_columns_beside_poses(ColumnTree& sweep, const Run& run) {
  write_beside_poses(Hdf5Group(sweep, "/sweep/"), run);
}

void write_run(const std::filesystem::path& path, const Run& run) {
  check_output_file(path);
  const Hdf5Builder builder(path.string());
  write_all(builder.root(), run, WithSweep::kYes);
  write_output_file(path, builder.bytes());
}

}  // namespace condyle
