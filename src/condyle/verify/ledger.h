#pragma once

/// Keeps what the checks find: the worst of each kind over the run, and what is wrong at a pose.

#include <array>
#include <compare>
#include <map>
#include <optional>
#include <string>

#include "condyle/scene/swept_quantity.h"
#include "condyle/verify/verification.h"

namespace condyle::verification {

class Ledger {
 public:
  explicit Ledger(const SweptQuantity& swept);

  /// The checks that follow are of this pose.
  void at_pose(std::size_t index, double value);

  /// The checks that follow are of no single pose.
  void beside_poses();

  /// `figure` in the units of the check, allowed up to `allowed` (of the check itself where 0);
  /// NaN is wrong. `element` names what was checked, `words` say what is wrong with it: "" for the
  /// usual sentence.
  void note(Check check,
            double figure,
            const std::string& element,
            const std::string& words = "",
            double allowed = 0);

  [[nodiscard]] double allowed(Check check) const {
    return checks_[static_cast<std::size_t>(check)].allowed;
  }

  /// A warning; of many with the same key only the one with the greatest weight stays.
  void warn(const std::string& key, double weight, const std::string& text);

  /// What could not be looked at; of many poses with the same words one is named, with their count.
  void leave_out(const std::string& words);

  /// "flexion = 45 deg"
  [[nodiscard]] const std::string& pose_name() const { return pose_name_; }

  /// Into the result: summaries, faults, warnings.
  void close(Verification& result) const;

 private:
  struct Warning {
    double weight = 0;
    std::string text;
    int count = 0;
  };
  SweptQuantity swept_;
  /// Of a pose the worst fault of each check is told; beside poses, that of each element too.
  struct FaultKey {
    std::optional<std::size_t> pose;
    Check check;
    std::string element;
    // NOLINTNEXTLINE(modernize-use-nullptr): the zero of a comparison is no pointer.
    auto operator<=>(const FaultKey&) const = default;
  };
  std::optional<std::size_t> pose_;
  std::string pose_name_;
  std::array<CheckSummary, kCheckCount> checks_;
  std::map<FaultKey, Fault> faults_;
  std::map<std::string, Warning> warnings_, left_out_;
};

}  // namespace condyle::verification
