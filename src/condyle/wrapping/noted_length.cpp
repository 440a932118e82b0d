#include "condyle/wrapping/noted_length.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// The end that what leads the path sees moving.
Vector3d moving_end(const PathLead& lead, const LineEnds& ends, const RigidTransform& X_BA) {
  return lead.all_on_A ? Vector3d(X_BA.R.transpose() * (ends.x_C - X_BA.p)) : ends.x_D;
}

bool has_turn(const PathLead& lead) { return !lead.all_on_A && !lead.all_on_B; }

double over_last_corner(const Vector3d& x, const double* noted) {
  const Vector3d begin(noted[4], noted[5], noted[6]), normal(noted[7], noted[8], noted[9]);
  if (!(noted[10] >= 0)) return std::numeric_limits<double>::infinity();
  const Vector3d d = x - begin;
  const double depth = std::max(0.0, -normal.dot(d));
  return noted[10] + (d + depth * normal).norm() + depth;
}

}  // namespace

bool is_noted(const double* noted) { return noted != nullptr && noted[0] > 0; }

PathLead lead_of(const std::vector<PathSurface>& surfaces, const PathEnds& ends) {
  PathLead lead{true, true, 0};
  bool on_A = false;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (ends.passed_over[i]) continue;
    (surfaces[i].on_A ? lead.all_on_B : lead.all_on_A) = false;
    lead.crossings += surfaces[i].on_A != on_A ? 1 : 0;
    on_A = surfaces[i].on_A;
  }
  lead.crossings += on_A ? 0 : 1;
  if (lead.all_on_B) lead.all_on_A = false;
  return lead;
}

void note_length(const PathLead& lead,
                 const LineEnds& ends,
                 const RigidTransform& X_BA,
                 double length,
                 const LastPiece& last,
                 double* noted) {
  if (noted == nullptr) return;
  const Vector3d x = moving_end(lead, ends, X_BA);
  noted[0] = length;
  for (int i = 0; i < 3; ++i) {
    noted[1 + i] = x[i];
    noted[4 + i] = last.begin[i];
    noted[7 + i] = last.normal[i];
  }
  noted[10] = last.rest;
  if (!has_turn(lead)) return;
  const Eigen::Quaterniond turn(X_BA.R);
  for (int i = 0; i < 4; ++i) noted[4 + i] = turn.coeffs()[i];
}

bool noted_at(const PathLead& lead,
              const LineEnds& ends,
              const RigidTransform& X_BA,
              const double* noted) {
  if (!is_noted(noted)) return false;
  if (moving_end(lead, ends, X_BA) != Vector3d(noted[1], noted[2], noted[3])) return false;
  return !has_turn(lead) || Eigen::Quaterniond(X_BA.R).coeffs() ==
                                Eigen::Vector4d(noted[4], noted[5], noted[6], noted[7]);
}

double length_at_most(const PathLead& lead,
                      const LineEnds& ends,
                      const RigidTransform& X_BA,
                      const double* noted) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (!is_noted(noted)) return kUnknown;
  const Vector3d x = moving_end(lead, ends, X_BA);
  const double moved = (x - Vector3d(noted[1], noted[2], noted[3])).norm();
  if (!has_turn(lead)) return std::min(noted[0] + moved, over_last_corner(x, noted));
  const Eigen::Quaterniond before(noted[7], noted[4], noted[5], noted[6]);
  const Eigen::Quaterniond turn = before.conjugate() * Eigen::Quaterniond(X_BA.R);
  const double angle = 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
  const double left = 1 - lead.crossings * angle;
  return left > 0 ? (noted[0] + lead.crossings * moved) / left : kUnknown;
}

}  // namespace condyle
