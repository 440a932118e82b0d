#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/calibration/calibration.h"
#include "condyle/calibration/shown_numbers.h"
#include "condyle/calibration/told_units.h"
#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/plot_calibration.h"

namespace condyle {
namespace {

constexpr double kLimit = 3.84;  // χ² of one degree of freedom, 95 %
constexpr double kHighest = 12;  // of χ² that is shown
constexpr int kParabola = 61;    // points
constexpr std::size_t kMostProfiles = 16, kMostSuggested = 15;
constexpr double kProfileHeight = 150, kResidualHeight = 240, kSuggestionRow = 26;  // [pixel]
constexpr double kLeastResidual = 3;  // that the axis reaches to
constexpr double kLeastTest = 14;     // width of a test whose name is written [pixel]

PagePanel profile_panel(const CalibrationResult& result, const Profile& profile) {
  const FreeParameter& parameter = result.parameters[profile.parameter];
  const auto at = static_cast<Eigen::Index>(profile.parameter);
  PagePanel panel;
  panel.title = shown_name(parameter);
  panel.x_label = shown_axis(parameter);
  panel.y_label = "χ² above the least";
  panel.y_range = {0, kHighest};
  Mark curve{Mark::Kind::kLine, {}, profile.chi_square, {}, {}, kAfterInk, false, false, 2.2};
  Mark parabola{Mark::Kind::kLine, {}, {}, {}, {}, kBeforeInk, true, false, 1.8};
  for (const double theta : profile.theta) curve.x.push_back(shown_value(parameter, theta));
  const auto [low, high] = std::minmax_element(profile.theta.begin(), profile.theta.end());
  const double best = result.fit.theta[at], sd = result.known.sd[at];
  for (int k = 0; k < kParabola && sd > 0; ++k) {
    const double theta = *low + (*high - *low) * k / (kParabola - 1);
    parabola.x.push_back(shown_value(parameter, theta));
    parabola.y.push_back(std::pow((theta - best) / sd, 2));
  }
  panel.x_range = {shown_value(parameter, *low), shown_value(parameter, *high)};
  const Mark limit{Mark::Kind::kLine,
                   {panel.x_range[0], panel.x_range[1]},
                   {kLimit, kLimit},
                   {},
                   {},
                   kUnseenInk,
                   false,
                   false,
                   1.4};
  panel.marks = {limit, parabola, curve};
  return panel;
}

bool drawable(const CalibrationResult& result, const Profile& profile) {
  const auto at = static_cast<Eigen::Index>(profile.parameter);
  return profile.parameter < result.parameters.size() && at < result.fit.theta.size() &&
         at < result.known.sd.size() && profile.theta.size() > 1 &&
         profile.theta.size() == profile.chi_square.size() &&
         std::all_of(profile.theta.begin(), profile.theta.end(),
                     [](double theta) { return std::isfinite(theta); });
}

/// Tests by name and flexion, in the order of the table.
std::vector<std::string> test_names(const MeasurementTable& table, std::vector<std::size_t>& of) {
  std::vector<std::string> names;
  for (const Measurement& row : table.rows) {
    const std::string name = row.test + " " + shown_degrees(row.flexion);
    const auto found = std::find(names.begin(), names.end(), name);
    of.push_back(static_cast<std::size_t>(found - names.begin()));
    if (found == names.end()) names.push_back(name);
  }
  return names;
}

/// Residuals side by side within their test.
PagePanel residual_panel(const CalibrationResult& result,
                         const std::vector<std::size_t>& of,
                         std::size_t tests,
                         double CalibratedRow::*prediction) {
  const Measurement* rows = result.table.rows.data();
  std::vector<double> count(tests, 0), done(tests, 0);
  for (const std::size_t test : of) ++count[test];
  Mark fitted{Mark::Kind::kDots, {}, {}, {}, {}, kAfterInk, false, false, 0.7};
  Mark unseen{Mark::Kind::kDots, {}, {}, {}, {}, kUnseenInk, false, true, 0.8};
  for (std::size_t i = 0; i < of.size(); ++i) {
    Mark& mark = rows[i].use == MeasuredUse::kTest ? unseen : fitted;
    const double at = (done[of[i]]++ + 0.5) / count[of[i]] - 0.5;
    mark.x.push_back(static_cast<double>(of[i]) + 0.8 * at);
    mark.y.push_back((result.rows[i].*prediction - rows[i].value) / result.rows[i].sd);
  }
  const double first = -0.5, last = static_cast<double>(tests) - 0.5;
  PagePanel panel;
  panel.y_label = "Residual [deviations]";
  panel.x_range = {first, last};
  double most = kLeastResidual;
  for (const Mark* mark : {&fitted, &unseen})
    for (const double y : mark->y)
      if (std::isfinite(y)) most = std::max(most, 1.08 * std::abs(y));
  panel.y_range = {-most, most};
  panel.marks = {
      Mark{Mark::Kind::kBand, {first, last}, {}, {-2, -2}, {2, 2}, kBeforeInk},
      Mark{Mark::Kind::kLine, {first, last}, {0, 0}, {}, {}, kBeforeInk, false, false, 1.2}, fitted,
      unseen};
  return panel;
}

void lay_out_residuals(ChartPage& page, const std::vector<std::string>& names) {
  double room = 0;
  for (const std::string& name : names) room = std::max(room, words_width(name, 9));
  double top = top_of_panels(page) + 34;
  for (PagePanel& panel : page.panels) {
    panel.left = 90;
    panel.width = page.width - 90 - 30;
    panel.top = top;
    panel.height = kResidualHeight;
    top += kResidualHeight + 56;
  }
  page.height = static_cast<int>(std::ceil(top - 56 + room + 30));
}

/// Every k-th of them, so that each that is left has room.
std::vector<std::string> thinned(std::vector<std::string> names, double width) {
  const double each = width / static_cast<double>(names.size());
  const auto step = static_cast<std::size_t>(std::max(1.0, std::ceil(kLeastTest / each)));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (i % step != 0) names[i].clear();
  return names;
}

std::string suggestion_name(const Scene& scene, const SuggestedTest& test) {
  const Unit unit = unit_of_level(scene, test.load);
  const std::string level =
      test.load < 0 ? ""
                    : fmt::format(", {:g} {}", test.level / unit.factor, shown_unit(unit.name));
  return with_minus(
      fmt::format("{}, {}{}", shown_degrees(test.flexion), load_name(scene, test.load), level));
}

}  // namespace

std::vector<NamedPage> profile_pages(const Scene& scene, const CalibrationResult& result) {
  ChartPage page{scene.title, "profiles: one parameter held, all others fitted anew"};
  page.key = {
      {"profile", {Mark{Mark::Kind::kLine, {}, {}, {}, {}, kAfterInk, false, false, 2.2}}},
      {"delta method", {Mark{Mark::Kind::kLine, {}, {}, {}, {}, kBeforeInk, true, false, 1.8}}},
      {"95 %", {Mark{Mark::Kind::kLine, {}, {}, {}, {}, kUnseenInk, false, false, 1.4}}}};
  for (const Profile& profile : result.profiles)
    if (drawable(result, profile)) page.panels.push_back(profile_panel(result, profile));
  return divided({{"calibration_profiles", page}}, kMostProfiles, 4, kProfileHeight);
}

std::vector<NamedPage> residual_pages(const Scene& scene, const CalibrationResult& result) {
  if (result.rows.empty() || result.rows.size() != result.table.rows.size()) return {};
  ChartPage page{scene.title, "residuals by test"};
  page.key = {
      {"fitted", {Mark{Mark::Kind::kDots, {}, {}, {}, {}, kAfterInk, false, false, 0.9}}},
      {"unseen", {Mark{Mark::Kind::kDots, {}, {}, {}, {}, kUnseenInk, false, true, 0.9}}},
      {"± 2 deviations of the measurement", {Mark{Mark::Kind::kBand, {}, {}, {}, {}, kBeforeInk}}}};
  std::vector<std::size_t> of;
  const std::vector<std::string> names = test_names(result.table, of);
  page.panels = {residual_panel(result, of, names.size(), &CalibratedRow::after),
                 residual_panel(result, of, names.size(), &CalibratedRow::before)};
  page.panels[0].title = "Fitted knee";
  page.panels[1].title = "Scene's own numbers";
  lay_out_residuals(page, names);
  page.panels[0].x_names.assign(names.size(), "");
  page.panels[1].x_names = thinned(names, page.panels[1].width);
  return {{"calibration_residuals", std::move(page)}};
}

std::vector<NamedPage> suggestion_pages(const Scene& scene, const CalibrationResult& result) {
  PagePanel information, shrinkage;
  Mark bits{Mark::Kind::kBars, {}, {}, {}, {}, kAfterInk, false, false, 0.66}, sd = bits;
  sd.ink = "#009E73";
  for (const SuggestedTest& test : result.suggested) {
    if (!test.reason.empty() || !std::isfinite(test.information)) continue;
    if (information.y_names.size() == kMostSuggested) break;
    for (Mark* mark : {&bits, &sd}) {
      mark->y.push_back(static_cast<double>(information.y_names.size()));
      mark->low.push_back(0);
    }
    bits.high.push_back(test.information);
    sd.high.push_back(100 * (1 - test.shrinkage));
    information.y_names.push_back(suggestion_name(scene, test));
  }
  if (information.y_names.empty()) return {};
  ChartPage page{scene.title, "which test next"};
  information.title = "Information that it would add";
  information.x_label = "½ ln det of the posterior's precision [-]";
  shrinkage.title = "Mean deviation of the knee's parameters";
  shrinkage.x_label = "less by [%]";
  shrinkage.y_names.assign(information.y_names.size(), "");
  information.marks = {bits};
  shrinkage.marks = {sd};
  const double rows = static_cast<double>(information.y_names.size());
  double names = 0;
  for (const std::string& name : information.y_names)
    names = std::max(names, words_width(name, information.name_size));
  double left = 40 + names;
  for (PagePanel* panel : {&information, &shrinkage}) {
    panel->x_range[0] = 0;
    panel->y_range = {rows - 0.5, -0.5};
    panel->left = left;
    panel->top = top_of_panels(page) + 34;
    panel->width = 400;
    panel->height = kSuggestionRow * std::max(rows, 3.0);
    left += 440;
    page.panels.push_back(*panel);
  }
  page.height = static_cast<int>(std::ceil(page.panels[0].top + page.panels[0].height + 74));
  page.width = std::max(page.width, static_cast<int>(std::ceil(left)));
  return {{"calibration_suggestions", std::move(page)}};
}

}  // namespace condyle
