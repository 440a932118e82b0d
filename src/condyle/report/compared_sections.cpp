#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/report/compared_runs_page.h"
#include "condyle/report/compared_words.h"
#include "condyle/report/html.h"
#include "condyle/report/svg_curves.h"

namespace condyle {
namespace {

/// Three digits and the sign.
std::string signed_number(double value) {
  return std::isfinite(value) ? fmt::format("{:+.3g}", value) : "-";
}

std::string name_of(const ComparedCurve& curve) {
  return curve.name.empty() ? without_units(curve.group) : curve.name;
}

/// Groups of curves that follow each other.
std::vector<std::vector<const ComparedCurve*>> groups_of(const RunComparison& comparison) {
  std::vector<std::vector<const ComparedCurve*>> groups;
  for (const ComparedCurve& curve : comparison.curves) {
    if (groups.empty() || groups.back().front()->group != curve.group) groups.emplace_back();
    groups.back().push_back(&curve);
  }
  return groups;
}

/// What is too small for any reader is none.
bool differs(const std::optional<CurveDifference>& difference) {
  constexpr double kNothing = 1e-9;
  return difference && difference->count > 0 && std::abs(difference->largest) > kNothing;
}

/// "medial by up to +12.3 N at 45°"
std::string greatest_in_words(const std::vector<const ComparedCurve*>& group,
                              std::size_t run,
                              const std::string& x_units) {
  const ComparedCurve* greatest = nullptr;
  for (const ComparedCurve* curve : group) {
    if (!differs(curve->differences[run])) continue;
    if (greatest == nullptr ||
        std::abs(curve->differences[run]->largest) > std::abs(greatest->differences[run]->largest))
      greatest = curve;
  }
  if (greatest == nullptr) return "";
  const CurveDifference& difference = *greatest->differences[run];
  const std::string units = units_of(greatest->group);
  return fmt::format("{}{}: {}{}{} at {:.6g}{}{}", without_units(greatest->group),
                     greatest->name.empty() ? "" : ", " + greatest->name,
                     signed_number(difference.largest), units == "°" ? "" : " ", units,
                     difference.at, x_units == "°" ? "" : " ", x_units);
}

std::string greatest_of_run(const RunComparison& comparison, std::size_t run) {
  std::string items;
  for (const auto& group : groups_of(comparison)) {
    const std::string words = greatest_in_words(group, run, units_of(comparison.axis));
    if (!words.empty()) items += "<li>" + escaped(words) + "</li>\n";
  }
  const std::string who =
      fmt::format("<p>{} <strong>{}</strong> minus {}: ", svg_swatch(run),
                  escaped(comparison.runs[run].name), escaped(comparison.runs.front().name));
  if (items.empty()) return who + "no difference.</p>\n";
  return who + "the greatest of each kind</p>\n<ul class=\"greatest\">\n" + items + "</ul>\n";
}

std::string difference_table(const RunComparison& comparison, std::size_t run) {
  HtmlTable table{
      fmt::format("{} minus {}", comparison.runs[run].name, comparison.runs.front().name),
      {"what", "of", "greatest difference", "at " + comparison.axis, "rms",
       "values (between poses)"},
      {},
      {0, 1}};
  for (const ComparedCurve& curve : comparison.curves) {
    if (!curve.differences[run] || curve.differences[run]->count == 0 || is_zero(curve)) continue;
    const CurveDifference& d = *curve.differences[run];
    table.rows.push_back({curve.group, curve.name, differs(d) ? signed_number(d.largest) : "0",
                          differs(d) ? fmt::format("{:.6g}", d.at) : "-",
                          differs(d) ? short_number(d.rms) : "0",
                          fmt::format("{} ({})", d.count, d.interpolated)});
  }
  return table.rows.empty() ? "" : html(table);
}

std::string range_of(const Curve& curve) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double y : curve.y) {
    if (!std::isfinite(y)) continue;
    low = std::min(low, y);
    high = std::max(high, y);
  }
  return low > high ? "-" : fmt::format("{:.3g} to {:.3g}", low, high);
}

/// What hollow circles are, where there are any.
std::string hollow_note(const RunComparison& comparison) {
  const bool any =
      std::any_of(comparison.curves.begin(), comparison.curves.end(), [](const auto& c) {
        return std::any_of(c.of.begin(), c.of.end(), [](const std::optional<Curve>& of) {
          return of && !of->hollow_x.empty();
        });
      });
  return any ? "<p class=\"note\">Hollow circles: in equilibrium, but with a contact beyond the "
               "edge of the known surface; they are no results.</p>\n"
             : "";
}

/// Least and greatest values, which need no common abscissa.
std::string range_table(const RunComparison& comparison) {
  HtmlTable table{"Least and greatest values", {"what", "of"}, {}, {0, 1}};
  for (const ComparedRun& of : comparison.runs) table.columns.push_back(of.name);
  for (const ComparedCurve& curve : comparison.curves) {
    if (is_zero(curve)) continue;
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {curve.group, curve.name};
    for (const std::optional<Curve>& of : curve.of) row.push_back(of ? range_of(*of) : "-");
  }
  return table.rows.empty() ? "" : html(table);
}

/// A figure of one quantity; nothing where none of the runs over the common abscissa has it.
std::string figure_of(const RunComparison& comparison, const ComparedCurve& curve) {
  SvgCurves curves{fmt::format("{}, {}, over {}", name_of(curve), curve.group, comparison.axis),
                   comparison.axis, curve.from_zero, curve.of};
  for (std::size_t r = 0; r < curves.of_runs.size(); ++r)
    if (!comparison.overlaid[r]) curves.of_runs[r].reset();
  const std::string drawing = svg(curves);
  if (drawing.empty()) return "";
  const std::string units = units_of(curve.group);
  return fmt::format(
      "<figure class=\"small\"><figcaption><strong>{}</strong> [{}]</figcaption>\n{}</figure>\n",
      escaped(name_of(curve)), escaped(units), drawing);
}

}  // namespace

std::string compared_differences_section(const RunComparison& comparison) {
  std::string body, tables;
  for (std::size_t r = 1; r < comparison.runs.size(); ++r) {
    if (!comparison.overlaid[r]) continue;
    body += greatest_of_run(comparison, r);
    tables += difference_table(comparison, r);
  }
  body += tables;
  const std::string ranges = range_table(comparison);
  if (tables.empty())
    body += ranges;
  else if (!ranges.empty())
    body += details("Least and greatest values", ranges);
  return section("differences", "Differences", body);
}

std::string compared_curves_section(const RunComparison& comparison) {
  std::string body, others;
  std::vector<std::string> zero;
  const auto add = [&](const std::string& head, const std::string& figures) {
    if (!figures.empty())
      body +=
          fmt::format("<h3>{}</h3>\n<div class=\"smalls\">\n{}</div>\n", escaped(head), figures);
  };
  for (const auto& group : groups_of(comparison)) {
    std::string figures;
    for (const ComparedCurve* curve : group) {
      if (is_zero(*curve))
        zero.push_back(fmt::format("{} ({})", name_of(*curve), without_units(curve->group)));
      else
        (curve->name.empty() ? others : figures) += figure_of(comparison, *curve);
    }
    add(group.front()->group, figures);
  }
  add("Of the whole knee", others);
  if (!body.empty()) body.insert(0, run_legend(comparison) + hollow_note(comparison));
  if (!zero.empty())
    body += fmt::format("<p class=\"note\">Zero in all runs: {}.</p>\n",
                        escaped(fmt::format("{}", fmt::join(zero, ", "))));
  return section("curves", "Curves", body);
}

}  // namespace condyle
