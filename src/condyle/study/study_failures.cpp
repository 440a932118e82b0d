#include <algorithm>
#include <array>

#include "condyle/contact/pose_status.h"
#include "condyle/math/no_number.h"
#include "condyle/study/quantiles.h"
#include "condyle/study/summarise.h"

namespace condyle {

namespace {

constexpr auto kSolved = static_cast<std::uint8_t>(PoseStatus::kConverged);

/// Share of failed poses in the quarters of a parameter's samples that `own` lists; equal values are in the same
/// quarter, and a quarter that has none is NaN.
std::array<double, 4> failed_by_quarter(const std::vector<double>& theta,
                                        const std::vector<std::uint32_t>& own,
                                        const std::vector<std::uint32_t>& failed,
                                        std::size_t poses) {
  std::vector<double> sorted;
  for (const std::uint32_t k : own) sorted.push_back(theta[k]);
  const std::array<double, 3> levels = {0.25, 0.5, 0.75};
  const std::vector<double> edges = take_quantiles(sorted, levels);
  std::array<double, 4> all{}, bad{}, share{};
  for (const std::uint32_t k : own) {
    const auto quarter = static_cast<std::size_t>((theta[k] > edges[0]) + (theta[k] > edges[1]) +
                                                  (theta[k] > edges[2]));
    all[quarter] += static_cast<double>(poses);
    bad[quarter] += failed[k];
  }
  for (std::size_t q = 0; q < 4; ++q) share[q] = all[q] > 0 ? bad[q] / all[q] : kNoNumber;
  return share;
}

}  // namespace

StudyFailures study_failures(const std::vector<std::uint8_t>& status,
                             std::size_t poses,
                             const std::vector<std::vector<double>>& theta,
                             bool saltelli) {
  StudyFailures failures;
  failures.by_pose.resize(poses);
  failures.by_status.resize(poses);
  failures.poses = static_cast<long>(status.size());
  std::vector<std::uint32_t> failed(poses == 0 ? 0 : status.size() / poses);  // by samples
  for (std::size_t i = 0; i < status.size(); ++i) {
    const std::size_t pose = i % poses;
    ++failures.by_status[pose][std::min<std::size_t>(status[i], 15)];
    if (status[i] == kSolved) continue;
    ++failures.by_pose[pose];
    ++failures.failed;
    ++failed[i / poses];
  }
  failures.incomplete = std::count_if(failed.begin(), failed.end(), [](auto n) { return n > 0; });
  const std::vector<std::uint32_t> own = own_samples(failed.size(), theta.size(), saltelli);
  for (const std::vector<double>& parameter : theta)
    failures.by_quartile.push_back(failed_by_quarter(parameter, own, failed, poses));
  return failures;
}

}  // namespace condyle
