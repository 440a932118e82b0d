#pragma once

/// Stability by trying: the moving body is pushed a little in many directions, contacts that carry
/// kept closed and conditions kept, and the energy of ligaments and loads must not fall.

#include <optional>
#include <vector>

#include "condyle/verify/gap_probe.h"
#include "condyle/verify/pose_checks.h"
#include "condyle/verify/taut_string.h"

namespace condyle::verification {

class PushCheck {
 public:
  /// `subject` must outlive it.
  explicit PushCheck(const Subject& subject);

  /// Of a pose that the file calls stable.
  void check(const PoseResult& pose, Ledger& ledger) const;

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  struct Constraint {
    double value = 0;  ///< to be brought back to zero [mm] or [rad]
    Vector6 gradient;  ///< against (da, dπ about the middle)
  };
  [[nodiscard]] std::vector<Constraint> constraints(const PoseResult& pose,
                                                    const RigidTransform& X) const;
  /// Of each ligament at the pose: its length, and how it lies where it wraps and may pull.
  struct Line {
    double length = 0;
    std::optional<TautString> string;
  };
  [[nodiscard]] std::vector<Line> lines(const PoseResult& pose) const;
  [[nodiscard]] double work(const PoseResult& pose,
                            std::vector<Line>& lines,
                            const RigidTransform& to) const;

  [[nodiscard]] RigidTransform pushed(const PoseResult& pose, Vector6 step, double& length) const;
  [[nodiscard]] double lowers(const PoseResult& pose, std::vector<Line>& lines, double size) const;

  static void not_tried(Ledger& ledger);

  const Subject& subject_;
};

}  // namespace condyle::verification
