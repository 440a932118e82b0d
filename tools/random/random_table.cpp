#include "random/random_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace condyle::random_knees {
namespace {

constexpr double kLongest = 0.05;  ///< that a pose may take [s]

constexpr PoseStatus kStatuses[] = {PoseStatus::kConverged,     PoseStatus::kLeftPatch,
                                    PoseStatus::kNoEquilibrium, PoseStatus::kOverlap,
                                    PoseStatus::kSingular,      PoseStatus::kZeroLength,
                                    PoseStatus::kNoPath,        PoseStatus::kIterationLimit,
                                    PoseStatus::kDiverged,      PoseStatus::kNotComputed};

/// [ms]
double quantile(std::vector<float> seconds, double q) {
  if (seconds.empty()) return 0;
  std::sort(seconds.begin(), seconds.end());
  const double last = static_cast<double>(seconds.size() - 1);
  return 1e3 * static_cast<double>(seconds[static_cast<std::size_t>(q * last)]);
}

}  // namespace

void RandomTable::add(std::uint64_t k, const SweepOutcome& outcome) {
  Row& row = rows_[outcome.kind];
  for (Row* r : {&row, &all_}) {
    ++r->sweeps;
    if (!outcome.refused.empty()) ++r->refused;
    for (const PoseOutcome& pose : outcome.poses) {
      ++r->statuses[pose.status];
      r->false_poses += pose.is_false ? 1 : 0;
      r->looked_again += pose.looked_again ? 1 : 0;
      r->found += pose.found ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < outcome.poses.size(); ++i) {
    const PoseOutcome& pose = outcome.poses[i];
    seconds_.push_back(static_cast<float>(pose.seconds));
    false_poses_ += pose.is_false ? 1 : 0;
    if (pose.seconds > kLongest) {
      ++slow_;
      wrongs_.push_back(fmt::format("{} slow: pose {} ({}): {:.1f} ms", k, i, name(pose.status),
                                    1e3 * pose.seconds));
    }
    if (pose.seconds > slowest_) {
      slowest_ = pose.seconds;
      slowest_knee_ = k;
      slowest_words_ = fmt::format("{}, {}", outcome.kind, name(pose.status));
    }
  }
  if (outcome.seconds > 0) set_up_.push_back(static_cast<float>(outcome.set_up_seconds));
  sweeping_ += outcome.seconds;
  checked_ += outcome.checked_seconds;
  for (const std::string& fault : outcome.faults) wrongs_.push_back(fmt::format("{} {}", k, fault));
  if (outcome.exception.empty()) return;
  ++exceptions_;
  wrongs_.push_back(fmt::format("{} exception: {}", k, outcome.exception));
}

std::string RandomTable::text() const {
  std::string text = "| knees | sweeps | refused |";
  std::string rule = "|---|---|---|";
  for (const PoseStatus status : kStatuses) {
    if (all_.statuses.count(status) == 0) continue;
    text += fmt::format(" {} |", name(status));
    rule += "---|";
  }
  text += " false | looked at again | found then |\n" + rule + "---|---|---|\n";
  const auto add_row = [&](const std::string& kind, const Row& row) {
    text += fmt::format("| {} | {} | {} |", kind, row.sweeps, row.refused);
    for (const PoseStatus status : kStatuses) {
      if (all_.statuses.count(status) == 0) continue;
      const auto found = row.statuses.find(status);
      text += fmt::format(" {} |", found == row.statuses.end() ? 0 : found->second);
    }
    text += fmt::format(" {} | {} | {} |\n", row.false_poses, row.looked_again, row.found);
  };
  for (const auto& [kind, row] : rows_) add_row(kind, row);
  add_row("all", all_);
  text += fmt::format(
      "\nA pose takes {:.2f} ms (median), 99 % less than {:.1f} ms, 99.9 % less than {:.1f} ms; "
      "{} of {} poses more than 50 ms; the\nslowest {:.1f} ms (knee {}: {}). Model and samples of "
      "a sweep take "
      "{:.1f} ms (median), 99 % less than {:.1f} ms. Sweeps took {:.0f} s "
      "of processor time, with their checks {:.0f} s. Exceptions: {}.\n",
      quantile(seconds_, 0.5), quantile(seconds_, 0.99), quantile(seconds_, 0.999), slow_,
      seconds_.size(), 1e3 * slowest_, slowest_knee_, slowest_words_, quantile(set_up_, 0.5),
      quantile(set_up_, 0.99), sweeping_, checked_, exceptions_);
  return text;
}

}  // namespace condyle::random_knees
