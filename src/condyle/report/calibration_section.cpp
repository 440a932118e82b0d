#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/calibration/calibration.h"
#include "condyle/calibration/calibration_words.h"
#include "condyle/calibration/shown_numbers.h"
#include "condyle/calibration/told_parameter.h"
#include "condyle/calibration/told_units.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"

namespace condyle {
namespace {

constexpr std::size_t kMostResiduals = 15;
constexpr double kAngle = 180 / M_PI;

/// "6.1 → 0.97"
std::string from_to(double before, double after) {
  if (!std::isfinite(before) && !std::isfinite(after)) return "-";
  return short_number(before) + " → " + short_number(after);
}

/// A list; lines that begin with blanks are a list within the line before them.
std::string told(const std::vector<std::string>& lines) {
  std::string text;
  bool within = false;
  for (const std::string& line : lines) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    const bool belongs = begin > 0 && !text.empty();
    if (belongs && !within) text += "\n<ul>\n<li>";
    if (belongs && within) text += "</li>\n<li>";
    if (!belongs && within) text += "</li>\n</ul>\n";
    if (!belongs) text += text.empty() ? "<li>" : "</li>\n<li>";
    within = belongs;
    text += escaped(line.substr(begin));
  }
  if (within) text += "</li>\n</ul>\n";
  return text.empty() ? "" : "<ul class=\"words\">\n" + text + "</li>\n</ul>\n";
}

std::vector<std::string> agreement_row(const Agreement& agreement) {
  return {agreement.name,
          fmt::format("{}", agreement.rows),
          fmt::format("{}", agreement.lost),
          from_to(agreement.before, agreement.after),
          number(100 * agreement.covered, 0),
          from_to(agreement.length_before, agreement.length_after),
          from_to(agreement.angle_before * kAngle, agreement.angle_after * kAngle)};
}

std::string agreement_table(const CalibrationResult& result) {
  HtmlTable table{
      "Differences of prediction and measurement before and after the fit, rms; covered: within "
      "the 95 % interval",
      {"rows", "number", "without pose", "in deviations", "covered [%]", "displacements [mm]",
       "angles [°]"},
      {}};
  for (const Agreement* all : {&result.fitted, &result.unseen})
    if (all->rows > 0) table.rows.push_back(agreement_row(*all));
  HtmlTable tests = table;
  tests.caption = "By test";
  tests.rows.clear();
  for (const Agreement& test : result.tests) tests.rows.push_back(agreement_row(test));
  return html(table) + (tests.rows.empty() ? "" : details("By test", html(tests)));
}

std::string parameter_table(const CalibrationResult& result) {
  HtmlTable table{
      "Parameters: of a factor the deviations are those of its logarithm; insertions are moves",
      {"parameter", "unit", "scene", "fitted", "prior sd", "posterior sd", "sd of samples",
       "posterior/prior"},
      {},
      {0, 1}};
  for (const ToldParameter& of : told_parameters(result)) {
    const auto sd = [&](double value, bool taken) {
      if (of.at_bound) return std::string("at its bound");
      return short_number(value) + (of.parts && taken ? " (the one to take)" : "");
    };
    table.rows.push_back({of.name, of.unit, short_number(of.scene), short_number(of.mean),
                          short_number(of.prior_sd), sd(of.sd, false), sd(of.sample_sd, true),
                          of.at_bound ? "-" : number(of.shrinkage, 2)});
  }
  return table.rows.empty() ? "" : html(table);
}

double residual(const CalibrationResult& result, std::size_t i) {
  return (result.rows[i].after - result.table.rows[i].value) / result.rows[i].sd;
}

/// Largest first; rows without a pose after all others.
std::vector<std::size_t> worst_rows(const CalibrationResult& result) {
  std::vector<std::size_t> order(std::min(result.rows.size(), result.table.rows.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto size = [&](std::size_t i) {
    const double r = residual(result, i);
    return std::isfinite(r) ? std::abs(r) : -1;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  order.resize(std::min(order.size(), kMostResiduals));
  return order;
}

std::string residual_table(const Scene& scene, const CalibrationResult& result) {
  HtmlTable table{"Rows that the fitted knee meets worst",
                  {"row", "quantity", "use", "measured", "scene", "fitted", "sd", "residual [sd]"},
                  {},
                  {0, 1, 2}};
  for (const std::size_t i : worst_rows(result)) {
    const Measurement& row = result.table.rows[i];
    const CalibratedRow& answer = result.rows[i];
    const Unit unit = unit_of(row, scene);
    const double r = residual(result, i);
    table.rows.push_back(
        {name_of(row, result.table, scene),
         fmt::format("{} [{}]", quantity_of(row, scene), shown_unit(unit.name)),
         row.use == MeasuredUse::kTest ? "unseen" : "fitted", short_number(row.value / unit.factor),
         short_number(answer.before / unit.factor), short_number(answer.after / unit.factor),
         short_number(answer.sd / unit.factor), std::isfinite(r) ? number(r, 2) : "no pose"});
  }
  return table.rows.empty() ? "" : html(table);
}

std::vector<std::string> suggestion_row(const Scene& scene, const SuggestedTest& test) {
  const Unit unit = unit_of_level(scene, test.load);
  return {shown_degrees(test.flexion),
          load_name(scene, test.load),
          fmt::format("{:g} {}", test.level / unit.factor, shown_unit(unit.name)),
          short_number(test.information),
          number(100 * test.shrinkage, 0),
          test.reason};
}

/// The first of them; the others folded away.
std::string suggestion_table(const Scene& scene, const CalibrationResult& result) {
  constexpr std::size_t kMostSuggestions = 10;
  HtmlTable table{"Tests that were not made, by what they would tell",
                  {"flexion", "load", "level", "information", "posterior sd [%]", "remark"},
                  {},
                  {1, 5}};
  HtmlTable others = table;
  others.caption.clear();
  for (const SuggestedTest& test : result.suggested)
    (table.rows.size() < kMostSuggestions ? table : others)
        .rows.push_back(suggestion_row(scene, test));
  if (table.rows.empty()) return "";
  return html(table) + (others.rows.empty() ? "" : details("Those that tell less", html(others)));
}

}  // namespace

std::string calibration_section(const Run& run) {
  if (run.calibration() == nullptr) return "";
  const Scene& scene = run.scene;
  const CalibrationResult& result = *run.calibration();
  return section("calibration", "Calibration",
                 told(calibration_remarks(scene, result)) + agreement_table(result) +
                     parameter_table(result) + residual_table(scene, result) +
                     suggestion_table(scene, result));
}

}  // namespace condyle
