#include "condyle/verify/ledger.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <set>

namespace condyle::verification {
namespace {

struct Kind {
  const char* name;
  const char* units;
  double allowed;
};

/// As enum Check; docs/verify.md says why so much is allowed.
constexpr std::array<Kind, kCheckCount> kKinds = {{
    {"rotation is orthonormal", "1", 1e-12},
    {"joint coordinates", "deg, mm", 1e-8},
    {"slack lengths", "mm", 1e-8},
    {"ligament lengths", "mm", 1e-9},
    {"ligament strains", "1", 1e-10},
    {"ligament forces", "relative", 1e-9},
    {"conditions", "deg, mm", 1e-8},
    {"contact points on both surfaces", "mm", 1e-8},
    {"contact points meet", "mm", 1e-8},
    {"normals opposite", "rad", 1e-7},
    {"contacts push", "relative", 1e-8},
    {"contacts on the known part", "mm", 1e-6},
    {"sum of forces", "relative", 2e-9},
    {"sum of moments", "relative", 2e-9},
    {"overlap of the surfaces", "mm", 1e-6},
    {"meshes inside each other", "mm", 10},
    {"energy under small pushes", "N/mm", 1e-3},
    {"depths of layers", "mm", 1e-7},
    {"pressures of layers", "relative", 1e-8},
    {"sums of pressures", "relative", 1e-8},
    {"force of layers on another grid", "relative", 0.013},
    {"depth that layers bear", "mm", 3},
    {"wrapped paths", "mm", 1e-6},
    {"numbers that stand twice", "relative", 1e-12},
}};

}  // namespace

Ledger::Ledger(const SweptQuantity& swept) : swept_(swept) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    checks_[i].name = kKinds[i].name;
    checks_[i].units = kKinds[i].units;
    checks_[i].allowed = kKinds[i].allowed;
  }
}

void Ledger::beside_poses() {
  pose_.reset();
  pose_name_.clear();
}

void Ledger::at_pose(std::size_t index, double value) {
  pose_ = index;
  const double shown = swept_.shown(value);
  pose_name_ = fmt::format("{} = {:.10g}{}", swept_.name, std::abs(shown) < 1e-12 ? 0.0 : shown,
                           swept_.unit_after_number());
}

void Ledger::note(Check check,
                  double figure,
                  const std::string& element,
                  const std::string& words,
                  double allowed) {
  CheckSummary& summary = checks_[static_cast<std::size_t>(check)];
  if (allowed == 0) allowed = summary.allowed;
  const double share =
      std::isnan(figure) ? std::numeric_limits<double>::infinity() : figure / allowed;
  if (summary.count++ == 0 || share > summary.worst) {
    summary.worst = share;
    summary.figure = figure;
    summary.where =
        pose_name_.empty() ? element : pose_name_ + (element.empty() ? "" : ", " + element);
  }
  if (share <= 1) return;
  ++summary.failed;
  Fault& fault = faults_[{pose_, check, pose_ ? "" : element}];
  if (share <= fault.excess) return;
  const std::string what = !words.empty()
                               ? words
                               : fmt::format("{}: off by {:.3g} {}, expected at most {:.1g}",
                                             summary.name, figure, summary.units, allowed);
  fault = {pose_.value_or(0), check, share,
           fmt::format("{}{}{}", pose_name_.empty() ? "" : pose_name_ + ": ",
                       element.empty() ? "" : element + ": ", what)};
}

void Ledger::warn(const std::string& key, double weight, const std::string& text) {
  Warning& warning = warnings_[key];
  ++warning.count;
  if (warning.count > 1 && weight <= warning.weight) return;
  warning.weight = weight;
  warning.text = pose_name_.empty() ? text : pose_name_ + ": " + text;
}

void Ledger::leave_out(const std::string& words) {
  Warning& left_out = left_out_[words];
  if (left_out.count++ == 0) left_out.text = words + " (" + pose_name_;
}

void Ledger::close(Verification& result) const {
  result.checks.assign(checks_.begin(), checks_.end());
  std::set<std::size_t> poses;
  for (const auto& [key, fault] : faults_) {
    poses.insert(fault.pose);
    result.faults.push_back(fault);
  }
  result.false_poses = poses.size();
  for (const auto& [key, warning] : warnings_)
    result.warnings.push_back(
        warning.count == 1 ? warning.text
                           : fmt::format("{} (the greatest of {})", warning.text, warning.count));
  for (const auto& [words, left_out] : left_out_)
    result.not_checked.push_back(
        left_out.count == 1
            ? left_out.text + ")"
            : fmt::format("{}, and {} more poses)", left_out.text, left_out.count - 1));
}

}  // namespace condyle::verification
