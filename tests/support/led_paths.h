#pragma once

/// Paths of a line element for tests, both led by what is fixed to the ground.

#include <cmath>

#include <Eigen/Geometry>

#include "condyle/elements/line_path.h"

namespace condyle::test {

/// Through a point P: L = |P - x_C| + |x_D - P|.
class PegPath final : public LinePath {
 public:
  explicit PegPath(const Eigen::Vector3d& peg) : peg_(peg) {}

  double pull(const LineEnds& ends, const RigidTransform&, double*, Wrench& unit) const override {
    const double l = (ends.x_D - peg_).norm();
    if (!(l > 0)) return 0;
    const Eigen::Vector3d e = (ends.x_D - peg_) / l;
    unit = pull_at_moving_end(e, (Eigen::Matrix3d::Identity() - e * e.transpose()) / l, ends.q);
    return l + (peg_ - ends.x_C).norm();
  }
  void add_points(const LineEnds&,
                  const RigidTransform&,
                  const double*,
                  const std::vector<LineTouch>&,
                  std::vector<Eigen::Vector3d>& points) const override {
    points.push_back(peg_);
  }

 private:
  Eigen::Vector3d peg_;
};

/// Over a straight edge, along which the line slides freely: with the distances r_C and r_D of its
/// ends from the edge and z = u.(x_D - x_C) along it, L² = (r_C + r_D)² + z². Where the line passes
/// the edge on the side of `outward` it is straight. Which of both is one number, held while a pose
/// is solved and kept from pose to pose: 0 straight, 1 over the edge. L is continuous with its slope.
class EdgePath final : public LinePath {
 public:
  /// `along` and `outward`: unit, at right angles.
  EdgePath(const Eigen::Vector3d& point,
           const Eigen::Vector3d& along,
           const Eigen::Vector3d& outward)
      : point_(point), u_(along), outward_(outward) {}

  [[nodiscard]] int numbers() const override { return 1; }

  double pull(const LineEnds& ends,
              const RigidTransform&,
              double* kept,
              Wrench& unit) const override {
    if (std::isnan(*kept)) *kept = clears(ends) ? 0 : 1;
    const Eigen::Vector3d d = ends.x_D - ends.x_C;
    if (*kept == 0) {
      const double l = d.norm();
      const Eigen::Vector3d e = d / l;
      unit = pull_at_moving_end(e, (Eigen::Matrix3d::Identity() - e * e.transpose()) / l, ends.q);
      return l;
    }
    const Eigen::Vector3d to_D = across(ends.x_D);
    const double r_D = to_D.norm(), r = across(ends.x_C).norm() + r_D, z = u_.dot(d);
    const double L = std::hypot(r, z);
    const Eigen::Vector3d away = to_D / r_D, round = u_.cross(away);
    const Eigen::Vector3d e = (r * away + z * u_) / L, f = (z * away - r * u_) / L;
    unit = pull_at_moving_end(
        e, f * f.transpose() / L + (r / (L * r_D)) * round * round.transpose(), ends.q);
    return L;
  }

  bool revise(const LineEnds& ends, const RigidTransform&, double* kept) const override {
    const double now = clears(ends) ? 0 : 1;
    const bool changed = *kept != now;
    *kept = now;
    return changed;
  }

  void add_points(const LineEnds& ends,
                  const RigidTransform&,
                  const double* kept,
                  const std::vector<LineTouch>&,
                  std::vector<Eigen::Vector3d>& points) const override {
    if (*kept == 0) return;
    const double r_C = across(ends.x_C).norm(), r_D = across(ends.x_D).norm();
    const double t = (u_.dot(ends.x_C - point_) * r_D + u_.dot(ends.x_D - point_) * r_C);
    points.push_back(point_ + t / (r_C + r_D) * u_);
  }

 private:
  /// From the edge to p, at right angles to it.
  [[nodiscard]] Eigen::Vector3d across(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = p - point_;
    return d - u_.dot(d) * u_;
  }
  /// Seen along the edge: does the straight line pass outside of it?
  [[nodiscard]] bool clears(const LineEnds& ends) const {
    const Eigen::Vector3d w = u_.cross(outward_);
    const double a_C = w.dot(ends.x_C - point_), a_D = w.dot(ends.x_D - point_);
    const double b_C = outward_.dot(ends.x_C - point_), b_D = outward_.dot(ends.x_D - point_);
    return (b_C * a_D - b_D * a_C) * (a_D - a_C) > 0;
  }

  Eigen::Vector3d point_, u_, outward_;
};

}  // namespace condyle::test
