#include "condyle/results/study_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/contact/pose_status.h"
#include "condyle/study/summarise.h"

namespace condyle {
namespace {

std::string counted(long count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string line_of_size(const StudyView& view) {
  std::string line = fmt::format(
      "{}, {} of {} ({}, seed {})", counted(static_cast<long>(view.knees.size()), "knee"),
      counted(view.samples, "sample"), counted(static_cast<long>(view.parameters.size()), "number"),
      view.design, view.seed);
  return line += fmt::format(", {} each", counted(static_cast<long>(view.values.size()), "pose"));
}

std::string line_of_failures(const StudyFailures& failures) {
  if (failures.failed == 0) return fmt::format("{} poses, none failed", failures.poses);
  std::array<long, 16> total{};
  for (const std::array<long, 16>& counts : failures.by_status)
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += counts[i];
  std::string line = fmt::format(
      "{} poses, {} failed ({:.3g} %) in {}", failures.poses, failures.failed,
      100.0 * static_cast<double>(failures.failed) / static_cast<double>(failures.poses),
      counted(failures.incomplete, "sample"));
  const char* mark = ": ";
  for (std::size_t i = 1; i < total.size() && i < std::size_t{kPoseStatusCount}; ++i) {
    if (total[i] == 0) continue;
    line += fmt::format("{}{} {}", mark, total[i], name(static_cast<PoseStatus>(i)));
    mark = ", ";
  }
  return line;
}

std::string line_of_quartiles(const StudyView& view, std::size_t parameter) {
  std::string rates;
  for (const double rate : view.all.failures.by_quartile[parameter])
    rates += (rates.empty() ? "" : ", ") +
             (std::isnan(rate) ? std::string("-") : fmt::format("{:.3g}", 100 * rate));
  return fmt::format("failed poses by quarters of {}: {} %: bands lean to where poses are found",
                     view.parameters[parameter].name, rates);
}

constexpr double kSmall = 0.05;  // not named

bool is_unknown(const IndexEstimate& index) {
  return std::isfinite(index.value) && std::isnan(known_value(index));
}

std::string effects_in_words(const StudyView& view, std::size_t output, std::size_t pose) {
  constexpr std::size_t kMost = 3;
  std::string words;
  std::size_t count = 0;
  for (const EffectSize& effect : largest_effects(view, output, pose)) {
    if (std::abs(effect.value) < kSmall || count++ == kMost) break;
    words += fmt::format("{} {:.2f}, ", view.parameters[effect.parameter].name, effect.value);
  }
  return words.empty() ? words : words.substr(0, words.size() - 2);
}

}  // namespace

std::optional<std::size_t> widest_pose(const StudyBand& band) {
  std::optional<std::size_t> widest;
  double width = -1;
  for (std::size_t p = 0; p < band.mean.size(); ++p) {
    const double here = band.quantiles.back()[p] - band.quantiles.front()[p];
    if (!(here > width)) continue;
    width = here;
    widest = p;
  }
  return widest;
}

QuarterRange range_of_quarters(const std::array<double, 4>& shares) {
  QuarterRange range{1, 0};
  for (const double share : shares) {
    if (std::isnan(share)) continue;
    range.low = std::min(range.low, share);
    range.high = std::max(range.high, share);
  }
  return range;
}

bool failures_depend_on(const StudyView& view, std::size_t parameter) {
  constexpr double kDeviations = 4;  // of the farthest two of four quarters, for each parameter
  const StudyFailures& failures = view.all.failures;
  if (failures.failed == 0 || failures.incomplete == 0) return false;
  const auto samples = static_cast<double>(view.samples);
  const auto failed = static_cast<double>(failures.failed);
  const double poses = static_cast<double>(failures.poses) / samples;
  const double share = failed / static_cast<double>(failures.poses);
  // Poses of a sample fail together: a sample with any has so large a share of them.
  const double together = failed / static_cast<double>(failures.incomplete) / poses;
  const double variance = share * std::max(together - share, (1 - share) / poses);
  const auto [low, high] = range_of_quarters(failures.by_quartile.at(parameter));
  return high - low >
         kDeviations * std::sqrt(2 * variance / std::max(1.0, independent_samples(view) / 4));
}

double independent_samples(const StudyView& view) {
  const auto numbers = static_cast<double>(view.parameters.size());
  const double own = view.design == "saltelli" ? 2 / (2 + numbers) : 1;
  return std::min(own * static_cast<double>(view.points), static_cast<double>(kMostRanked));
}

double independent_samples(const StudyView& view, const StudyBand& band, std::size_t pose) {
  const double solved =
      static_cast<double>(band.samples.at(pose)) / static_cast<double>(std::max(view.samples, 1L));
  return solved * independent_samples(view);
}

std::vector<EffectSize> largest_effects(const StudyView& view,
                                        std::size_t output,
                                        std::size_t pose) {
  const StudyEffects& effects = view.all.effects[output];
  const double samples = independent_samples(view, view.all.bands[output], pose);
  std::vector<EffectSize> sizes;
  const std::size_t d = effects.total.empty() ? effects.rank.size() : effects.total.size();
  for (std::size_t i = 0; i < d; ++i) {
    const double value = effects.total.empty() ? known_rank(effects.rank[i][pose], samples)
                                               : known_value(effects.total[i][pose]);
    if (!std::isnan(value)) sizes.push_back({i, value});
  }
  std::stable_sort(sizes.begin(), sizes.end(), [](const EffectSize& a, const EffectSize& b) {
    return std::abs(a.value) > std::abs(b.value);
  });
  return sizes;
}

bool has_chance_ranks(const StudyView& view) {
  const auto is_chance = [](double rank, double samples) {
    return std::abs(rank) >= kSmall && std::isnan(known_rank(rank, samples));
  };
  for (std::size_t o = 0; o < view.all.effects.size(); ++o) {
    const StudyEffects& effects = view.all.effects[o];
    const std::optional<std::size_t> pose = widest_pose(view.all.bands[o]);
    if (!pose || !effects.total.empty()) continue;
    const double samples = independent_samples(view, view.all.bands[o], *pose);
    for (const std::vector<double>& by_pose : effects.rank)
      if (is_chance(by_pose[*pose], samples)) return true;
  }
  return false;
}

bool has_unknown_indices(const StudyView& view) {
  const auto any = [](const std::vector<std::vector<IndexEstimate>>& indices) {
    for (const std::vector<IndexEstimate>& by_pose : indices)
      if (std::any_of(by_pose.begin(), by_pose.end(), is_unknown)) return true;
    return false;
  };
  return std::any_of(
      view.all.effects.begin(), view.all.effects.end(),
      [&](const StudyEffects& effects) { return any(effects.first) || any(effects.total); });
}

std::vector<std::string> study_lines(const StudyView& view) {
  std::vector<std::string> lines = {line_of_size(view), line_of_failures(view.all.failures)};
  for (std::size_t i = 0; i < view.parameters.size(); ++i)
    if (failures_depend_on(view, i)) lines.push_back(line_of_quartiles(view, i));
  if (view.outputs.empty() || view.all.failures.failed == view.all.failures.poses) return lines;
  const bool indices = !view.all.effects.empty() && !view.all.effects.front().total.empty();
  lines.emplace_back();
  lines.push_back(fmt::format("where each band is widest: 5, 50 and 95 %, and the largest {}",
                              indices ? "total indices" : "rank correlations"));
  bool unknown = false;
  for (std::size_t o = 0; o < view.outputs.size(); ++o) {
    const StudyBand& band = view.all.bands[o];
    const std::optional<std::size_t> pose = widest_pose(band);
    if (!pose) continue;
    for (const std::vector<IndexEstimate>& by_pose : view.all.effects[o].total)
      unknown = unknown || is_unknown(by_pose[*pose]);
    lines.push_back(fmt::format("  {:<24} at {:>6.4g}{}: {:>9.4g} {:>9.4g} {:>9.4g} {:<4}  {}",
                                view.outputs[o].name, view.values[*pose],
                                view.swept.unit_after_number(), band.quantiles[0][*pose],
                                band.quantiles[2][*pose], band.quantiles[4][*pose],
                                view.outputs[o].units, effects_in_words(view, o, *pose)));
  }
  if (unknown) lines.push_back(std::string("  ") + kTooFewSamples);
  if (has_chance_ranks(view)) lines.push_back(std::string("  ") + kChanceRanks);
  return lines;
}

}  // namespace condyle
