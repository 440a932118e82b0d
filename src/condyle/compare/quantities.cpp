#include "condyle/compare/quantities.h"

#include <cmath>

#include "condyle/elements/joint_table.h"
#include "condyle/math/degree.h"
#include "condyle/math/no_number.h"
#include "condyle/scene/ligament_bundles.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {
namespace {

void add_joint(const Scene& scene, std::vector<Quantity>& quantities) {
  const bool flexion_is_swept = quantity_of_sweep(scene).flexion;
  for (const JointCoordinate& q : kJointCoordinates) {
    if (flexion_is_swept && q.member == &JointCoordinates::flexion) continue;
    const double unit = q.angle ? kDegree : 1;
    quantities.push_back({q.words, q.angle ? "deg" : "mm",
                          [&q, unit](const PoseResult& p) { return p.joint.*q.member / unit; }});
  }
}

/// Where a contact acts, in the tibia's anatomical frame: lateral, anterior.
double place_on_tibia(const Scene& scene,
                      const PoseResult& pose,
                      std::size_t index,
                      bool anterior) {
  const ContactResult& contact = pose.contacts.at(index);
  const AnatomicalFrame& tibia = scene.joint->tibia;
  const std::optional<Eigen::Vector3d> place =
      acting_place(contact, pose.X_BA, tibia.body == scene.moving_body());
  if (!contact.closed || !place) return kNoNumber;
  return (*place - tibia.origin).dot(anterior ? tibia.anterior : tibia.lateral);
}

void add_contacts(const Scene& scene, std::vector<Quantity>& quantities) {
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const std::string& name = scene.contacts[c].name;
    quantities.push_back({name + " contact force", "N",
                          [c](const PoseResult& p) { return p.contacts.at(c).force; }});
    for (const bool anterior : {true, false}) {
      quantities.push_back({name + (anterior ? " contact, anterior" : " contact, lateral"), "mm",
                            [&scene, c, anterior](const PoseResult& p) {
                              return place_on_tibia(scene, p, c, anterior);
                            }});
    }
  }
}

void add_ligaments(const Scene& scene, std::vector<Quantity>& quantities) {
  std::vector<std::string> names;
  for (const LigamentDescription& ligament : scene.ligaments) names.push_back(ligament.name);
  for (const LigamentBundle& bundle : ligament_columns(names, 16)) {
    quantities.push_back({bundle.name + " force", "N", [bundle](const PoseResult& p) {
                            double sum = 0;
                            for (const std::size_t i : bundle.members)
                              sum += p.ligaments.at(i).force;
                            return sum;
                          }});
  }
}

}  // namespace

std::vector<Quantity> compared_quantities(const Scene& scene) {
  std::vector<Quantity> quantities;
  add_joint(scene, quantities);
  add_contacts(scene, quantities);
  add_ligaments(scene, quantities);
  quantities.push_back({"flexion moment", "N mm",
                        [](const PoseResult& p) { return p.conditions.at(0).multiplier; }});
  return quantities;
}

std::vector<double> series(const Quantity& quantity, const SweepResult& sweep) {
  std::vector<double> values;
  for (const PoseResult& pose : sweep.poses)
    values.push_back(pose.converged() ? quantity.of(pose) : kNoNumber);
  return values;
}

Difference difference(const std::vector<double>& a, const std::vector<double>& b) {
  Difference result;
  double sum = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    const double apart = std::abs(a[i] - b[i]);
    if (!std::isfinite(apart)) continue;
    sum += apart * apart;
    ++result.count;
    if (apart <= result.max && result.count > 1) continue;
    result.max = apart;
    result.at = i;
  }
  if (result.count > 0) result.rms = std::sqrt(sum / result.count);
  return result;
}

}  // namespace condyle
