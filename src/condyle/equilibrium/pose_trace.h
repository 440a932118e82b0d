#pragma once

/// By which way a pose was found, and what each iteration left: plain data of fixed size.

#include <array>
#include <string>

namespace condyle {

/// The values are those of /sweep/route.
enum class PoseRoute {
  kNone = 0,          ///< not found, or not told
  kNewton = 1,        ///< Newton, contacts released and closed between its solutions
  kDescent = 2,       ///< the descent (descent.h), ended by Newton
  kParts = 3,         ///< the step there in parts, each by Newton
  kPartsDescents = 4  ///< in parts, some of them by the descent
};
inline constexpr int kPoseRouteCount = 5;

/// From where; the values are those of /sweep/route_from.
enum class PoseOrigin {
  kNone = 0,          ///< not found, or not told
  kStart = 1,         ///< the scene's start pose, with the contacts it estimates if any
  kPrediction = 2,    ///< the poses before it, extrapolated (predictor.h)
  kLastPose = 3,      ///< the last pose that converged
  kCarriedStart = 4,  ///< the scene's start pose carried to the values asked for (carried_pose.h)
  kCarriedLast = 5,   ///< the last pose that converged carried likewise
  kNextPose = 6,      ///< the pose after it in the sweep: from the other side of a gap
  kBeyondEdge = 7,    ///< the last equilibrium beyond the edge of a patch
  kPath = 8,          ///< the point of the path of equilibria (arc_length.h)
  kEarlierRun = 9     ///< the pose of an earlier run that does not tell its own way
};
inline constexpr int kPoseOriginCount = 10;

/// "Newton", "descent", "in parts", ...
[[nodiscard]] const char* name(PoseRoute route);
/// "the poses before it, extrapolated", ...
[[nodiscard]] const char* name(PoseOrigin origin);

/// Relative residual of each evaluation of one solve by Newton, the last one included: force and
/// moment/L by the sum of all force magnitudes or distances by L, whichever is greater (newton.h).
/// Of more than fit the last one takes the last place.
class ResidualHistory {
 public:
  static constexpr int kMost = 26;  ///< evaluations of Newton's 25 iterations

  void clear() { size_ = 0; }
  void add(double residual) {
    if (size_ == kMost) --size_;
    values_[static_cast<std::size_t>(size_++)] = residual;
  }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const double* begin() const { return values_.data(); }
  [[nodiscard]] const double* end() const { return values_.data() + size_; }
  [[nodiscard]] double operator[](int k) const { return values_[static_cast<std::size_t>(k)]; }

 private:
  std::array<double, kMost> values_{};
  int size_ = 0;
};

struct PoseTrace {
  PoseRoute route = PoseRoute::kNone;
  PoseOrigin origin = PoseOrigin::kNone;
  int parts = 0;              ///< of the step, where it was taken in parts
  ResidualHistory residuals;  ///< of the solve that found the pose; of one that was not found of
                              ///< the last try from the pose before it
  /// Over all ways that were tried:
  int searches = 0;  ///< for contacts of one pair
  int closings = 0;  ///< overlaps that became contacts between solutions of Newton
  int openings = 0;  ///< contacts released because they pulled

  [[nodiscard]] bool told() const { return route != PoseRoute::kNone || residuals.size() > 0; }
  /// What was spent on an earlier try counts too.
  void add_effort(const PoseTrace& earlier) {
    searches += earlier.searches;
    closings += earlier.closings;
    openings += earlier.openings;
  }
};

/// "Newton from the pose before it", "in 4 parts from the pose before it"; "-" where none is told.
[[nodiscard]] std::string in_words(const PoseTrace& trace);

}  // namespace condyle
