#include "condyle/contact/contact_result.h"

#include <algorithm>

#include "condyle/contact/contact.h"
#include "condyle/math/no_number.h"

namespace condyle {

ContactPointResult describe_point(const ContactLinearization& at, double force, double edge) {
  ContactPointResult point;
  point.force = force;
  point.point_ground = at.B.c;
  point.point_moving = at.A.c;
  point.normal_ground = at.B.n;
  point.gap = at.gap();
  point.relative_curvature = at.relative_curvature;
  point.edge_distance = edge;
  return point;
}

void set_resultant(ContactResult& contact) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  contact.force = 0;
  for (const ContactPointResult& point : contact.points) {
    contact.force += point.force;
    moment += point.force * point.point_ground;
  }
  contact.resultant_ground =
      contact.force != 0 ? Eigen::Vector3d(moment / contact.force) : contact.points[0].point_ground;
}

const ContactPointResult* strongest_point(const ContactResult& contact) {
  const auto strongest = std::max_element(
      contact.points.begin(), contact.points.end(),
      [](const ContactPointResult& a, const ContactPointResult& b) { return a.force < b.force; });
  return strongest == contact.points.end() ? nullptr : &*strongest;
}

std::optional<Eigen::Vector3d> acting_place(const ContactResult& contact,
                                            const RigidTransform& X_BA,
                                            bool on_moving) {
  const ContactPointResult* point = strongest_point(contact);
  if (point == nullptr) return std::nullopt;
  if (!contact.layer) return on_moving ? point->point_moving : point->point_ground;
  return on_moving ? Eigen::Vector3d(X_BA.inverse() * contact.resultant_ground)
                   : contact.resultant_ground;
}

void clear(ContactResult& contact) {
  contact.points.clear();
  contact.closed = false;
  contact.shape = ContactShape::kPoint;
  contact.force = 0;
  contact.layer.reset();
  contact.pressures.clear();
  contact.resultant_ground.setConstant(kNoNumber);
}

}  // namespace condyle
