#include "condyle/report/compared_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "condyle/input_error.h"
#include "condyle/pictures/run_charts.h"
#include "condyle/results/run_view.h"
#include "condyle/results/without_poses.h"

namespace condyle {
namespace {

void check_runs(const std::vector<ComparedRun>& runs) {
  if (runs.size() < 2 || runs.size() > kMostComparedRuns)
    throw InputError(
        fmt::format("{} runs to compare, expected 2 to {}", runs.size(), kMostComparedRuns));
  const SweptQuantity first = swept_quantity(*runs.front().run);
  for (const ComparedRun& of : runs) {
    if (of.run->sweep.poses.empty())
      throw InputError(
          fmt::format("{}: {}, expected runs with poses to compare", of.file, no_poses(*of.run)));
    const SweptQuantity swept = swept_quantity(*of.run);
    if (swept.name == first.name && swept.unit.name != first.unit.name)
      throw InputError(fmt::format("{}: sweeps {} in {}, but {} in {}: expected the same units",
                                   of.file, swept.name, swept.unit.name, runs.front().file,
                                   first.unit.name));
  }
}

bool has_values(const Curve& curve) {
  return std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); });
}

/// The sum of energies is told in a unit that suits it, another one in each run.
bool is_compared(const NamedChart& chart, const Panel& panel) {
  return chart.name != "energy" || panel.curves.size() > 1;
}

/// What the ordinate is, also apart from the title of its chart: that of places says along what alone.
std::string group_of(const NamedChart& chart, const Panel& panel) {
  if (chart.name != "contact_places") return panel.y_label;
  return "Contact on the tibia, " + with_small_letter(panel.y_label);
}

std::vector<ComparedCurve> curves_of(const std::vector<ComparedRun>& runs) {
  std::vector<ComparedCurve> all;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const NamedChart& named : run_charts(*runs[r].run)) {
      for (const Panel& panel : named.chart.panels) {
        if (!is_compared(named, panel)) continue;
        const std::string group = group_of(named, panel);
        for (const Curve& curve : panel.curves) {
          if (!has_values(curve)) continue;
          auto known = std::find_if(all.begin(), all.end(), [&](const ComparedCurve& other) {
            return other.group == group && other.name == curve.title;
          });
          if (known == all.end()) {
            all.push_back({group, curve.title, panel.from_zero, {}, {}});
            known = all.end() - 1;
            known->of.resize(runs.size());
            known->differences.resize(runs.size());
          }
          known->of[r] = curve;
        }
      }
    }
  }
  return all;
}

/// Groups stay together, in the order in which they come first.
void sort_by_group(std::vector<ComparedCurve>& curves) {
  std::map<std::string, std::size_t> order;
  for (const ComparedCurve& curve : curves) order.try_emplace(curve.group, order.size());
  std::stable_sort(curves.begin(), curves.end(), [&](const auto& a, const auto& b) {
    return order.at(a.group) < order.at(b.group);
  });
}

void add_differences(const std::vector<bool>& overlaid, ComparedCurve& curve) {
  if (!curve.of.front()) return;
  const SampledCurve first{curve.of.front()->x, curve.of.front()->y};
  for (std::size_t r = 1; r < curve.of.size(); ++r)
    if (overlaid[r] && curve.of[r])
      curve.differences[r] = difference(first, {curve.of[r]->x, curve.of[r]->y});
}

}  // namespace

std::string units_of(const std::string& label) {
  const std::size_t open = label.rfind('['), close = label.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return "";
  return label.substr(open + 1, close - open - 1);
}

std::string without_units(const std::string& label) {
  const std::size_t open = label.rfind(" [");
  return open == std::string::npos ? label : label.substr(0, open);
}

std::string with_small_letter(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

bool is_zero(const ComparedCurve& curve) {
  const auto zero = [](const std::optional<Curve>& of) {
    return !of || std::all_of(of->y.begin(), of->y.end(),
                              [](double y) { return !std::isfinite(y) || y == 0; });
  };
  return std::all_of(curve.of.begin(), curve.of.end(), zero);
}

RunComparison compare_runs(const std::vector<ComparedRun>& runs) {
  check_runs(runs);
  RunComparison comparison{runs, swept_quantity(*runs.front().run).axis, {}, {}};
  for (const ComparedRun& of : runs)
    comparison.overlaid.push_back(swept_quantity(*of.run).axis == comparison.axis);
  comparison.curves = curves_of(runs);
  sort_by_group(comparison.curves);
  for (ComparedCurve& curve : comparison.curves) add_differences(comparison.overlaid, curve);
  return comparison;
}

}  // namespace condyle
