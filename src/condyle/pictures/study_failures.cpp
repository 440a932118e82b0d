/// Poses of a study that have no result: where in the sweep, and whether they keep to some part of the
/// samples.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/plot_study.h"
#include "condyle/results/study_shown.h"
#include "condyle/results/study_words.h"

namespace condyle {
namespace {

constexpr std::size_t kMostParameters = 16;
constexpr double kLineHeight = 24, kFailureTop = 36, kFailureFoot = 64, kLeast = 240;  // [pixel]
constexpr double kAxesLeft = 98, kOverSweep = 400, kMiddle = 40, kRightEdge = 30;      // [pixel]
constexpr double kLetters = 10;                                                        // [point]
/// Of the quarters, from the lowest values of a parameter to the highest.
constexpr std::array<const char*, 4> kQuarterInks = {"#56B4E9", "#8a9199", "#E69F00", "#D55E00"};
constexpr std::array<const char*, 4> kQuarters = {"lowest quarter of its values", "second", "third",
                                                  "highest"};

double percent(long part, long whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

PagePanel over_sweep(const StudyView& study) {
  PagePanel panel;
  panel.title = "Poses without a result";
  panel.x_label = study.swept.axis;
  panel.y_label = "of the samples [%]";
  panel.y_range[0] = 0;
  Mark line{Mark::Kind::kLine, shown_values(study), {}, {}, {}, kUnseenInk};
  for (const long failed : study.all.failures.by_pose)
    line.y.push_back(percent(failed, study.samples));
  Mark dots = line;
  dots.kind = Mark::Kind::kDots;
  dots.size = 0.7;
  panel.marks = {line, dots};
  return panel;
}

/// Parameters by how much their quarters differ.
std::vector<std::size_t> most_uneven(const StudyFailures& failures) {
  std::vector<double> differences;
  for (const std::array<double, 4>& shares : failures.by_quartile) {
    const auto [low, high] = range_of_quarters(shares);
    differences.push_back(high - low);
  }
  std::vector<std::size_t> order = greatest_first(differences);
  order.resize(std::min(order.size(), kMostParameters));
  return order;
}

PagePanel by_quarter(const StudyView& study) {
  const StudyFailures& failures = study.all.failures;
  const std::vector<std::size_t> rows = most_uneven(failures);
  const std::vector<std::string> names = shown_parameters(study);
  PagePanel panel;
  panel.title = "By quarters of each number's samples";
  panel.x_label = "poses without a result [%]";
  panel.x_range[0] = 0;
  panel.y_range = {static_cast<double>(rows.size()) - 0.5, -0.5};
  Mark spans{Mark::Kind::kBars, {}, {}, {}, {}, "#c3c8cd", false, false, 0.08};
  double most = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::array<double, 4>& shares = failures.by_quartile.at(rows[r]);
    const auto [low, high] = range_of_quarters(shares);
    spans.y.push_back(static_cast<double>(r));
    spans.low.push_back(100 * low);
    spans.high.push_back(100 * high);
    most = std::max(most, 100 * high);
    panel.y_names.push_back(names.at(rows[r]));
  }
  panel.marks.push_back(spans);
  for (std::size_t q = 0; q < kQuarterInks.size(); ++q) {
    Mark dots{Mark::Kind::kDots, {}, {}, {}, {}, kQuarterInks[q], false, false, 1.2};
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double share = failures.by_quartile[rows[r]][q];
      if (std::isnan(share)) continue;
      dots.x.push_back(100 * share);
      dots.y.push_back(static_cast<double>(r));
    }
    panel.marks.push_back(dots);
  }
  panel.x_range[1] = most > 0 ? 1.08 * most : 1;
  return panel;
}

std::vector<KeyEntry> key_of_quarters() {
  std::vector<KeyEntry> key;
  for (std::size_t q = 0; q < kQuarters.size(); ++q)
    key.push_back({kQuarters[q],
                   {Mark{Mark::Kind::kDots, {}, {}, {}, {}, kQuarterInks[q], false, false, 1.2}}});
  return key;
}

/// The curve on the left, the quarters on the right with their names before them.
void lay_out_failures(ChartPage& page) {
  const double top = top_of_panels(page) + kFailureTop;
  PagePanel& curve = page.panels[0];
  curve.left = kAxesLeft;
  curve.top = top;
  curve.width = kOverSweep;
  curve.height = kLeast;
  double height = kLeast;
  if (page.panels.size() > 1) {
    PagePanel& quarters = page.panels[1];
    double names = 0;
    for (const std::string& name : quarters.y_names)
      names = std::max(names, words_width(name, kLetters));
    quarters.left = kAxesLeft + kOverSweep + kMiddle + names + 14;
    quarters.top = top;
    quarters.width = std::max(260.0, page.width - kRightEdge - quarters.left);
    quarters.height = kLineHeight * static_cast<double>(quarters.y_names.size());
    quarters.name_size = kLetters;
    page.width = std::max(page.width,
                          static_cast<int>(std::ceil(quarters.left + quarters.width + kRightEdge)));
    height = std::max(height, quarters.height);
  }
  page.height = static_cast<int>(std::ceil(top + height + kFailureFoot));
}

}  // namespace

std::vector<NamedPage> study_failure_pages(const StudyView& study) {
  const StudyFailures& failures = study.all.failures;
  if (failures.failed == 0) return {};
  ChartPage page{study.title, "poses without a result"};
  page.notes = {
      fmt::format("{} of {} poses, in {} of {} samples. Where quarters differ the bands "
                  "leave out more of one side than of the other.",
                  failures.failed, failures.poses, failures.incomplete, study.samples)};
  page.panels = {over_sweep(study)};
  if (!failures.by_quartile.empty()) {
    page.panels.push_back(by_quarter(study));
    page.key = key_of_quarters();
  }
  lay_out_failures(page);
  return {{"study_failures", std::move(page)}};
}

}  // namespace condyle
