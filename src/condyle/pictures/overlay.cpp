#include "condyle/pictures/overlay.h"

#include <algorithm>

#include "condyle/input_error.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

constexpr std::size_t kMostColors = 8;  // in one panel

template <typename T, typename Same>
T* find(std::vector<T>& list, const Same& same) {
  const auto found = std::find_if(list.begin(), list.end(), same);
  return found == list.end() ? nullptr : &*found;
}

/// Adds the curves of a panel in the style of a run; a title that is known keeps its colour.
void add_panel(Chart& chart, const Panel& panel, int style) {
  Panel* whole = find(chart.panels, [&](const Panel& p) { return p.y_label == panel.y_label; });
  if (!whole) {
    chart.panels.push_back({panel.y_label, {}, panel.from_zero, panel.floor});
    whole = &chart.panels.back();
  }
  for (Curve curve : panel.curves) {
    const Curve* same =
        find(whole->curves, [&](const Curve& other) { return other.title == curve.title; });
    int colors = 0;
    for (const Curve& other : whole->curves) colors = std::max(colors, other.color + 1);
    curve.color = same ? same->color : colors;
    curve.style = style;
    whole->curves.push_back(std::move(curve));
  }
}

/// Parts with few enough colours each.
std::vector<Panel> divided(const Panel& panel) {
  std::vector<Panel> parts;
  for (Curve curve : panel.curves) {
    const auto part = static_cast<std::size_t>(curve.color) / kMostColors;
    while (parts.size() <= part) parts.push_back({panel.y_label, {}, panel.from_zero, panel.floor});
    curve.color %= static_cast<int>(kMostColors);
    parts[part].curves.push_back(std::move(curve));
  }
  return parts;
}

std::string title_of(const std::vector<NamedRun>& runs) {
  const std::string& first = runs.front().run->scene.title;
  const bool one = std::all_of(runs.begin(), runs.end(), [&](const NamedRun& named) {
    return named.run->scene.title == first;
  });
  if (one) return first;
  std::string all;
  for (const NamedRun& named : runs) all += (all.empty() ? "" : ", ") + named.name;
  return all;
}

void check(const std::vector<NamedRun>& runs) {
  for (const NamedRun& named : runs) {
    if (named.run->sweep.poses.empty())
      throw InputError(named.name +
                       ": holds no poses, expected runs with poses to draw over each "
                       "other");
    const std::string first = swept_quantity(*runs.front().run).axis,
                      other = swept_quantity(*named.run).axis;
    if (first != other)
      throw InputError(named.name + ": goes over " + other + ", but " + runs.front().name +
                       " over " + first + ": expected runs over the same quantity");
  }
}

}  // namespace

std::vector<NamedChart> overlay(const std::vector<NamedRun>& runs) {
  check(runs);
  std::vector<NamedChart> charts;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const NamedChart& named : run_charts(*runs[r].run)) {
      NamedChart* whole =
          find(charts, [&](const NamedChart& other) { return other.name == named.name; });
      if (!whole) {
        charts.push_back({named.name, {title_of(runs), named.chart.what, named.chart.x_label, {}}});
        whole = &charts.back();
      }
      for (const Panel& panel : named.chart.panels)
        add_panel(whole->chart, panel, static_cast<int>(r));
    }
  }
  for (NamedChart& named : charts) {
    std::vector<Panel> panels;
    for (const Panel& panel : named.chart.panels)
      for (Panel& part : divided(panel)) panels.push_back(std::move(part));
    named.chart.panels = std::move(panels);
    for (const NamedRun& run : runs) named.chart.runs.push_back(run.name);
  }
  return charts;
}

}  // namespace condyle
