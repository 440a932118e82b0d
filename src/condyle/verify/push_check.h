#pragma once

/// Stability by trying: the moving body is pushed a little in many directions, contacts that carry
/// kept closed and conditions kept, and the energy of ligaments and loads must not fall.

#include <vector>

#include "condyle/verify/gap_probe.h"
#include "condyle/verify/pose_checks.h"

namespace condyle::verification {

class PushCheck {
 public:
  /// `subject` must outlive it.
  explicit PushCheck(const Subject& subject);

  /// Of a pose that the file calls stable.
  void check(const PoseResult& pose, Ledger& ledger) const;

 private:
  struct Constraint {
    double value = 0;                      ///< to be brought back to zero [mm] or [rad]
    Eigen::Matrix<double, 6, 1> gradient;  ///< against (da, dπ about the middle)
  };
  [[nodiscard]] std::vector<Constraint> constraints(const PoseResult& pose,
                                                    const RigidTransform& X) const;
  [[nodiscard]] double work(const PoseResult& pose,
                            const RigidTransform& from,
                            const RigidTransform& to) const;

  const Subject& subject_;
};

}  // namespace condyle::verification
