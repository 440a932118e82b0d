#include "condyle/results/estimates.h"

#include <algorithm>
#include <array>

#include "condyle/math/no_number.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

/// Numbers of an estimate that lie side by side.
struct HertzColumn {
  const char* name;
  const char* units;
  std::size_t width;
  double* (*data)(HertzEstimate& hertz);
};

constexpr std::array<HertzColumn, 4> kHertzColumns = {{
    {"semi_axes", "mm", 2, [](HertzEstimate& hertz) { return hertz.semi_axes.data(); }},
    {"major_axis", "1", 3, [](HertzEstimate& hertz) { return hertz.major_axis.data(); }},
    {"peak_pressure", "N/mm^2", 1, [](HertzEstimate& hertz) { return &hertz.peak_pressure; }},
    {"approach", "mm", 1, [](HertzEstimate& hertz) { return &hertz.approach; }},
}};

constexpr const char* kStiffnessUnits = "N, mm, rad: N mm/rad among the three angles, N/rad, N/mm";
constexpr const char* kComplianceUnits =
    "N, mm, rad: rad/(N mm) among the three angles, rad/N, mm/N";

/// Of rigid points: a layer knows its pressures itself.
bool is_elastic(const Scene& scene, std::size_t contact) {
  if (scene.contacts.at(contact).layer) return false;
  const auto& surfaces = scene.contacts.at(contact).surfaces;
  return std::any_of(surfaces.begin(), surfaces.end(), [&](int s) {
    return scene.surfaces.at(static_cast<std::size_t>(s)).elastic.has_value();
  });
}

/// One row of `slots` estimates a pose; `of` tells which points they belong to.
template <class PointsOf>
void write_hertz(const Hdf5Group& group, const Poses& poses, Shape shape, const PointsOf& of) {
  const std::size_t slots = shape.size() > 1 ? shape[1] : 1;
  for (const HertzColumn& column : kHertzColumns) {
    std::vector<double> values(poses.size() * slots * column.width, kNoNumber);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!poses[i].solved()) continue;
      std::size_t k = i * slots;
      for (const ContactPointResult& point : of(poses[i])) {
        if (point.hertz) {
          HertzEstimate hertz = *point.hertz;
          std::copy_n(column.data(hertz), column.width, &values[k * column.width]);
        }
        ++k;
      }
    }
    group.write(column.name, values, with_width(shape, column.width), column.units);
  }
}

std::vector<ContactPointResult> main_point(const ContactResult& contact) {
  const ContactPointResult* point = strongest_point(contact);
  if (point == nullptr) return {};
  return {*point};
}

using Matrix = JointStiffness::Matrix6 JointStiffness::*;

void write_matrix(const Hdf5Group& joint,
                  const char* name,
                  const char* units,
                  const Poses& poses,
                  Matrix matrix) {
  std::vector<double> values(36 * poses.size(), kNoNumber);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!poses[i].solved() || !poses[i].joint_stiffness) continue;
    for (std::size_t k = 0; k < 36; ++k)
      values[36 * i + k] = ((*poses[i].joint_stiffness).*matrix)(static_cast<Eigen::Index>(k / 6),
                                                                 static_cast<Eigen::Index>(k % 6));
  }
  joint.write(name, values, {poses.size(), 6, 6}, units);
}

void read_matrix(const Hdf5Group& joint, const char* name, Poses& poses, Matrix matrix) {
  const std::vector<double> values = joint.read(name, {poses.size(), 6, 6});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (values[36 * i] != values[36 * i]) continue;
    if (!poses[i].joint_stiffness) poses[i].joint_stiffness.emplace();
    for (std::size_t k = 0; k < 36; ++k)
      ((*poses[i].joint_stiffness).*matrix)(static_cast<Eigen::Index>(k / 6),
                                            static_cast<Eigen::Index>(k % 6)) = values[36 * i + k];
  }
}

void read_hertz(const Hdf5Group& group, std::size_t slots, Poses& poses, std::size_t index) {
  for (const HertzColumn& column : kHertzColumns) {
    const std::vector<double> values =
        group.read(column.name, with_width({poses.size(), slots}, column.width));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      std::size_t k = i * slots;
      for (ContactPointResult& point : poses[i].contacts[index].points) {
        const double* row = &values[k++ * column.width];
        if (row[0] != row[0]) continue;
        if (!point.hertz) point.hertz.emplace();
        std::copy_n(row, column.width, column.data(*point.hertz));
      }
    }
  }
}

}  // namespace

void write_contact_estimates(const Hdf5Group& contact,
                             const Hdf5Group& points,
                             const Scene& scene,
                             const Poses& poses,
                             std::size_t index) {
  const std::size_t n = poses.size();
  std::vector<int> shapes;
  std::vector<double> resultants(3 * n, kNoNumber);
  std::size_t slots = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const bool known = poses[i].solved();
    shapes.push_back(known ? static_cast<int>(poses[i].contacts.at(index).shape) : -1);
    if (!known) continue;
    const ContactResult& result = poses[i].contacts[index];
    std::copy_n(result.resultant_ground.data(), 3, &resultants[3 * i]);
    slots = std::max(slots, result.points.size());
  }
  contact.write("shape", shapes, {n}, "1");
  contact.write_attribute("shape", "meaning", {"point", "line", "conforming"});
  contact.write("resultant_ground", resultants, {n, 3}, "mm");
  if (!is_elastic(scene, index)) return;
  write_hertz(contact.create("hertz"), poses, {n},
              [&](const PoseResult& pose) { return main_point(pose.contacts[index]); });
  write_hertz(points.create("hertz"), poses, {n, slots},
              [&](const PoseResult& pose) -> const std::vector<ContactPointResult>& {
                return pose.contacts[index].points;
              });
}

void read_contact_estimates(const Hdf5Group& contact,
                            const Hdf5Group& points,
                            Poses& poses,
                            std::size_t index) {
  if (!contact.has("shape")) return;
  const std::size_t n = poses.size();
  const std::vector<int> shapes = contact.read_integers("shape", {n});
  const std::vector<double> resultants = contact.read("resultant_ground", {n, 3});
  for (std::size_t i = 0; i < n; ++i) {
    ContactResult& result = poses[i].contacts[index];
    if (shapes[i] > 2) contact.fail("shape has no meaning");
    if (shapes[i] >= 0) result.shape = static_cast<ContactShape>(shapes[i]);
    std::copy_n(&resultants[3 * i], 3, result.resultant_ground.data());
  }
  if (!points.has("hertz")) return;
  const Hdf5Group hertz = points.open("hertz");
  const Shape shape = hertz.read("approach").shape;
  if (shape.size() != 2) hertz.fail("dataset approach has not one row for each pose");
  read_hertz(hertz, shape[1], poses, index);
}

void write_joint_stiffness(const Hdf5Group& joint, const Poses& poses) {
  const bool any = std::any_of(poses.begin(), poses.end(), [](const PoseResult& pose) {
    return pose.joint_stiffness.has_value();
  });
  if (!any) return;
  write_matrix(joint, "stiffness", kStiffnessUnits, poses, &JointStiffness::stiffness);
  write_matrix(joint, "compliance", kComplianceUnits, poses, &JointStiffness::compliance);
}

void read_joint_stiffness(const Hdf5Group& joint, Poses& poses) {
  if (!joint.has("stiffness")) return;
  read_matrix(joint, "stiffness", poses, &JointStiffness::stiffness);
  read_matrix(joint, "compliance", poses, &JointStiffness::compliance);
}

}  // namespace condyle
