#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "condyle/math/no_number.h"
#include "condyle/results/estimates.h"
#include "condyle/results/layer_group.h"
#include "condyle/results/path_group.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/sweep_group.h"
#include "condyle/results/trace_columns.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

// One row of `width` numbers for each pose; one without equilibrium has NaN.
using FillRow = std::function<void(const PoseResult& pose, double* row)>;
std::vector<double> rows(const Poses& poses, std::size_t width, const FillRow& fill) {
  std::vector<double> out(poses.size() * width, kNoNumber);
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
  ContactPointResult point;
  point.point_ground.setConstant(kNoNumber);
  point.point_moving = point.normal_ground = point.point_ground;
  point.gap = std::numeric_limits<double>::infinity();
  point.relative_curvature = {kNoNumber, kNoNumber};
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
  none.fill(std::vector<double>(poses.size(), kNoNumber));
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

}  // namespace condyle
