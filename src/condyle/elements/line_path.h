#pragma once

/// The way that a line element takes between its ends where it is not straight: over a surface,
/// through a pulley. A path is a length L of the pose; all that mechanics asks of it is L and the
/// wrench of a unit tension on A, -∂L/∂(a, π), with the exact derivatives of that wrench. From them
/// follow force, moment and blocks for every law f(L) (line_element.h).

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "condyle/elements/wrench.h"
#include "condyle/math/no_number.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

/// The ends of a line element at a pose, ground frame [mm]: x_C on B, x_D on A at the arm q from
/// O_A.
struct LineEnds {
  Eigen::Vector3d x_C, x_D, q;
};

/// How a path lies at a pose on one of the surfaces that it may touch, frame of that surface's body.
struct LineTouch {
  bool touching = false;
  bool on_moving = false;  ///< the surface is fixed to A, else to B
  Eigen::Vector3d P = Eigen::Vector3d::Zero(),
                  Q = Eigen::Vector3d::Zero();  ///< comes to it, from C, and leaves it [mm]
  Eigen::Vector3d t_P = Eigen::Vector3d::Zero(),
                  t_Q = Eigen::Vector3d::Zero();  ///< unit tangents there, from C to D
  /// Of a path that is off the surface: the normal at the place that it passes, unit; 0 where that is
  /// not known.
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  double arc = 0;   ///< length on the surface [mm]
  double turn = 0;  ///< angle between t_P and t_Q [rad]
};

struct LineRates;

/// Constant, and shared by threads. What a path keeps from pose to pose (places, tangents, arcs,
/// which surfaces it touches) are `numbers()` doubles of the state (EquilibriumState::paths): NaN
/// where nothing is known yet, those of the pose asked for afterwards.
class LinePath {
 public:
  virtual ~LinePath() = default;

  [[nodiscard]] virtual int numbers() const { return 0; }

  /// L [mm]; writes into `unit` the wrench of a tension of 1 N and its derivatives. Allocates
  /// nothing. A path without length or that cannot be found has the length 0.
  virtual double pull(const LineEnds& ends,
                      const RigidTransform& X_BA,
                      double* kept,
                      Wrench& unit) const = 0;

  /// The same while a pose is far from solved: where that costs less, of a path that is off by about 1e-8
  /// of its size. length() at that very pose is then the same.
  virtual double pull_roughly(const LineEnds& ends,
                              const RigidTransform& X_BA,
                              double* kept,
                              Wrench& unit) const {
    return pull(ends, X_BA, kept, unit);
  }

  /// L [mm] alone.
  [[nodiscard]] virtual double length(const LineEnds& ends,
                                      const RigidTransform& X_BA,
                                      double* kept) const {
    Wrench unit;
    return pull(ends, X_BA, kept, unit);
  }

  /// No less than L here, told by `kept`, in which the path was followed elsewhere [mm]; infinite
  /// where that is not known. Of what the path holds while a pose is solved: a strand that is known to
  /// be slack is passed over (surely_slack.h).
  [[nodiscard]] virtual double at_most(const LineEnds&,
                                       const RigidTransform&,
                                       const double*) const {
    return std::numeric_limits<double>::infinity();
  }

  /// L where `kept` was last followed, at this pose or another [mm]; infinite where that is not known.
  [[nodiscard]] virtual double last_length(const double*) const {
    return std::numeric_limits<double>::infinity();
  }

  /// How length and pull follow the ends on their own bodies (end_rates.h), for sensitivities by
  /// insertions. `kept`: the numbers of the path at this pose. False where it does not know: a path
  /// that was not found. Allocates nothing.
  virtual bool end_rates(const LineEnds&, const RigidTransform&, const double*, LineRates&) const {
    return false;
  }

  /// At a pose that has been solved: changes in `kept` what is held while one is solved (a surface
  /// that it has come to or left), and says whether it did: then the pose is solved on.
  virtual bool revise(const LineEnds&, const RigidTransform&, double*) const { return false; }

  /// One for each surface that the path may touch, in order from C to D.
  virtual void add_touches(const LineEnds&,
                           const RigidTransform&,
                           const double*,
                           std::vector<LineTouch>&) const {}
  /// The numbers of a path that was told by add_touches at this pose.
  virtual void keep(const std::vector<LineTouch>&,
                    const LineEnds&,
                    const RigidTransform&,
                    double*) const {}

  /// Corners of the path between the ends, from C to D, ground frame [mm]: for those who draw it.
  /// `touches`: what add_touches told of it.
  virtual void add_points(const LineEnds&,
                          const RigidTransform&,
                          const double*,
                          const std::vector<LineTouch>&,
                          std::vector<Eigen::Vector3d>&) const {}

  /// What speaks against calling a pose converged whose path this is, or says why the path could not
  /// be found: half a sentence; empty where nothing does.
  [[nodiscard]] virtual std::string objection(const LineEnds&,
                                              const RigidTransform&,
                                              const double*) const {
    return {};
  }

  /// What is worth knowing of a path against which nothing speaks: half a sentence; empty where nothing is.
  [[nodiscard]] virtual std::string remark(const LineEnds&,
                                           const RigidTransform&,
                                           const double*) const {
    return {};
  }
};

/// Most numbers that one path keeps.
inline constexpr int kMostPathNumbers = 80;

/// Numbers of a path of which nothing is known.
[[nodiscard]] inline std::array<double, kMostPathNumbers> unknown_path() {
  std::array<double, kMostPathNumbers> kept;
  kept.fill(kNoNumber);
  return kept;
}

/// Of a path that all that leads it is fixed to B: e = ∂L/∂x_D the unit tangent at D, away from the
/// path, H = ∂²L/∂x_D² [1/mm], both in the ground frame.
[[nodiscard]] Wrench pull_at_moving_end(const Eigen::Vector3d& e,
                                        const Eigen::Matrix3d& H,
                                        const Eigen::Vector3d& q);

/// Of a path that all that leads it is fixed to A: e = -∂L/∂x_C the unit tangent at C, towards the
/// path, H = ∂²L/∂x_C² [1/mm], c = x_C - a the arm of C from O_A [mm], all in the ground frame.
[[nodiscard]] Wrench pull_at_fixed_end(const Eigen::Vector3d& e,
                                       const Eigen::Matrix3d& H,
                                       const Eigen::Vector3d& c);

}  // namespace condyle
