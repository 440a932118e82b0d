#include "condyle/calibration/words_of_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/calibration/told_units.h"
#include "condyle/math/degree.h"

namespace condyle {
namespace {

std::string decimals(double value, int digits = 2) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits);
}

std::string change(double before, double after) {
  return std::isnan(before) && std::isnan(after)
             ? "-"
             : fmt::format("{} -> {}", decimals(before), decimals(after));
}

/// Width of the names of tests; longer ones are cut.
int name_width(const CalibrationResult& result) {
  constexpr std::size_t kLeast = 24, kMost = 60;
  std::size_t width = kLeast;
  for (const Agreement& test : result.tests) width = std::max(width, test.name.size());
  return static_cast<int>(std::min(width, kMost));
}

/// `indent` of the name within its column.
std::string agreement_line(const Agreement& a, int width, const char* indent = "") {
  return fmt::format(
      "{:<{}.{}}{:>6}{:>18}{:>18}{:>18}{:>11}", indent + a.name, width + 2, width + 2, a.rows,
      change(a.before, a.after), change(a.length_before, a.length_after),
      change(a.angle_before / kDegree, a.angle_after / kDegree),
      std::isnan(a.covered) || a.rows == a.lost ? "-" : fmt::format("{:.1f} %", 100 * a.covered));
}

/// Whether fewer lie within their 95 % intervals than chance leaves out (two binomial deviations).
bool too_few_covered(const Agreement& a) {
  constexpr double kShare = 0.95;
  const double n = a.rows - a.lost;
  return n > 0 && a.covered * n < kShare * n - 2 * std::sqrt(kShare * (1 - kShare) * n);
}

/// The best start's own least, but for what the search leaves open.
bool same_least(const CalibrationStart& start, double best) {
  constexpr double kCost = 1e-6, kDistance = 0.01;  // relative; [prior sd]
  return start.converged && start.cost - best <= kCost * (1 + best) && start.distance <= kDistance;
}

std::string load_words(const Scene& scene, const SuggestedTest& test) {
  const CalibrationLoad* load = find_load(scene, test.load);
  if (load == nullptr) return "unloaded";
  const Unit unit = unit_of_level(scene, test.load);
  return fmt::format("{} {:.4g} {}", load->name, test.level / unit.factor, unit.name);
}

}  // namespace

Lines agreement_lines(const CalibrationResult& result) {
  const int width = name_width(result);
  Lines lines = {fmt::format("{:<{}}{:>6}{:>18}{:>18}{:>18}{:>11}", "rms error before -> after",
                             width + 2, "rows", "deviations", "mm", "deg", "in 95 %"),
                 agreement_line(result.fitted, width)};
  if (result.unseen.rows > 0) lines.push_back(agreement_line(result.unseen, width));
  for (const Agreement& test : result.tests) lines.push_back(agreement_line(test, width, "  "));
  if (result.unseen.rows == 0)
    lines.emplace_back(
        "No row is unseen (use = test): nothing says how well other tests are predicted");
  for (const Agreement* a : {&result.fitted, &result.unseen})
    if (a->lost > 0)
      lines.push_back(fmt::format("{}: {} of {} rows have no pose", a->name, a->lost, a->rows));
  if (result.unseen.rows > 0 && too_few_covered(result.unseen))
    lines.push_back(fmt::format(
        "Of unseen rows {:.1f} % lie within their 95 % intervals, fewer than chance leaves: the "
        "intervals are too narrow",
        100 * result.unseen.covered));
  return lines;
}

Lines chi_square_lines(const CalibrationResult& result) {
  const double reduced = result.reduced_chi_square, limit = result.reduced_chi_square_limit;
  const std::string chi_square =
      fmt::format("chi square {:.4g} of {} rows with {:.1f} numbers determined",
                  result.fit.chi_square, result.fitted.rows, result.known.effective);
  if (std::isnan(limit))
    return {chi_square, "No degree of freedom is left: chi square says nothing of the model"};
  Lines lines = {
      fmt::format("{}: {:.3g} per degree of freedom, below {:.3g} where the model is right",
                  chi_square, reduced, limit)};
  if (reduced > limit) {
    lines.emplace_back(
        "The model does not explain the data within their deviations: it lacks something that the "
        "knee has, or the deviations are too small");
    lines.push_back(fmt::format(
        "Standard deviations here are those of the table; with deviations that fit they would be "
        "{:.2g} times as large",
        std::sqrt(reduced)));
  } else {
    lines.emplace_back("The model explains the data within their deviations");
  }
  return lines;
}

Lines start_lines(const CalibrationResult& result) {
  const double best = result.fit.cost;
  const auto reached =
      std::count_if(result.starts.begin(), result.starts.end(),
                    [&](const CalibrationStart& start) { return same_least(start, best); });
  Lines lines = {
      fmt::format("{} of {} starts reached the same least", reached, result.starts.size())};
  for (std::size_t i = 0; i < result.starts.size(); ++i) {
    const CalibrationStart& start = result.starts[i];
    if (same_least(start, best)) continue;
    lines.push_back(
        start.converged
            ? fmt::format("  start {}: cost {:.4g} in place of {:.4g}, {:.2g} prior sd away", i + 1,
                          start.cost, best, start.distance)
            : fmt::format("  start {}: did not converge, cost {:.4g}: {}", i + 1, start.cost,
                          start.message));
  }
  return lines;
}

Lines fit_lines(const CalibrationResult& result) {
  Lines lines;
  if (result.stopped)
    lines.emplace_back("Stopped before it was done: the best so far, without samples");
  else if (!result.fit.converged)
    lines.push_back("The fit did not converge: " + result.fit.message);
  lines.push_back(
      fmt::format("{} iterations, {} trials refused; fit {:.3g} s, all starts and samples {:.3g} "
                  "s; {} poses, {} "
                  "of them failed",
                  result.fit.iterations, result.fit.refused, result.fit_seconds, result.seconds,
                  result.poses, result.failed_poses));
  return lines;
}

Lines caution_lines(const CalibrationResult& result) {
  constexpr double kOtherBranch = 1e-3;  // deviations
  Lines lines;
  if (std::isnan(result.cold_difference))
    lines.emplace_back(
        "From the start pose anew some pose of the fit is not found: it may be one of several");
  else if (result.cold_difference > kOtherBranch)
    lines.push_back(fmt::format(
        "From the start pose anew predictions differ by up to {:.2g} deviations: there is another "
        "equilibrium",
        result.cold_difference));
  if (result.lost_samples > 0)
    lines.push_back(fmt::format("{} of {} samples were lost, their poses fail", result.lost_samples,
                                result.lost_samples + result.samples.rows()));
  return lines;
}

Lines suggestion_lines(const Scene& scene, const CalibrationResult& result) {
  constexpr std::size_t kMost = 10;
  if (result.suggested.empty()) return {};
  Lines lines = {fmt::format("{:<10}{:<26}{:>13}{:>18}", "flexion", "next test", "information",
                             "sd after/before")};
  for (std::size_t i = 0; i < std::min(kMost, result.suggested.size()); ++i) {
    const SuggestedTest& test = result.suggested[i];
    const std::string line = fmt::format(
        "{:<10}{:<26}", fmt::format("{:.4g} deg", test.flexion / kDegree), load_words(scene, test));
    lines.push_back(test.reason.empty()
                        ? line + fmt::format("{:>13.3f}{:>18.3f}", test.information, test.shrinkage)
                        : line + "  " + test.reason);
  }
  return lines;
}

}  // namespace condyle
