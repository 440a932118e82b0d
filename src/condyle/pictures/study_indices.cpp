/// Sobol's indices as bars, the greatest first ("tornado"), and the maps of parameters by quantities.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/plot_study.h"
#include "condyle/results/study_shown.h"
#include "condyle/results/study_words.h"

namespace condyle {
namespace {

constexpr std::size_t kMostQuantities = 12, kQuantitiesOnPage = 3;
constexpr std::size_t kMostBars = 10, kMostMapRows = 40;
constexpr std::size_t kMapLigaments = 12, kBarLigaments = 6;
constexpr double kRowHeight = 25, kPanelEdge = 24, kBetween = 26;  // [pixel]
constexpr double kHead = 34, kFootOfPanel = 62;                    // of a panel [pixel]
constexpr double kThick = 0.36, kThin = 0.05, kApart = 0.2;        // of a row
constexpr double kNameSize = 10;                                   // [point]
constexpr const char *kFirstInk = "#0072B2", *kTotalInk = "#E69F00", *kIntervalInk = "#262c34";

Mark bars_of(const char* ink, double thickness) {
  return {Mark::Kind::kBars, {}, {}, {}, {}, ink, false, false, thickness};
}

/// A bar from 0 and its interval, both within 0 to 1.
void add_bar(Mark& bars, Mark& intervals, const IndexEstimate& index, double y) {
  const auto within = [](double value) { return std::clamp(value, 0.0, 1.0); };
  bars.y.push_back(y);
  bars.low.push_back(0);
  bars.high.push_back(std::isfinite(index.value) ? within(index.value) : std::nan(""));
  intervals.y.push_back(y);
  intervals.low.push_back(within(index.lower));
  intervals.high.push_back(within(index.upper));
}

/// A half or a quarter where nothing reaches further.
double index_axis(double most) { return most > 0.5 ? 1 : most > 0.25 ? 0.5 : 0.25; }

double greatest_end(const StudyEffects& effects, const std::vector<std::size_t>& rows) {
  double most = 0;
  for (const auto* indices : {&effects.first, &effects.total})
    for (const std::size_t row : rows)
      for (const IndexEstimate& index : indices->at(row))
        for (const double end : {index.value, index.upper})
          if (std::isfinite(end)) most = std::max(most, end);
  return most;
}

PagePanel index_panel(const StudyView& study,
                      const ShownOutput& output,
                      const std::vector<std::size_t>& rows,
                      std::size_t pose) {
  PagePanel panel;
  panel.title = output.name + " at " + shown_pose(study, pose);
  panel.x_label = "part of the variance [-]";
  panel.y_range = {static_cast<double>(rows.size()) - 0.5, -0.5};
  Mark first = bars_of(kFirstInk, kThick), total = bars_of(kTotalInk, kThick),
       intervals = bars_of(kIntervalInk, kThin);
  const StudyEffects& effects = study.all.effects.at(output.index);
  panel.x_range = {0, index_axis(greatest_end(effects, rows))};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double y = static_cast<double>(r);
    add_bar(first, intervals, effects.first.at(rows[r]).at(pose), y - kApart);
    add_bar(total, intervals, effects.total.at(rows[r]).at(pose), y + kApart);
  }
  panel.y_names.assign(rows.size(), "");
  panel.marks = {first, total, intervals};
  return panel;
}

std::vector<std::size_t> greatest(const std::vector<double>& by, std::size_t most) {
  std::vector<std::size_t> order = greatest_first(by);
  order.resize(std::min(order.size(), most));
  return order;
}

/// A row of panels, one for each pose, with the names of the bars before the first.
void add_quantity(ChartPage& page,
                  const StudyView& study,
                  const ShownOutput& output,
                  double names_width,
                  double& top) {
  const std::vector<std::string> names = shown_parameters(study);
  const std::vector<std::size_t> rows =
      greatest(sweep_effects(study, output.index).total, kMostBars);
  const std::vector<std::size_t> poses = shown_poses(study);
  const double left = kPanelEdge + names_width + 14,
               each = (page.width - kPanelEdge - left) / static_cast<double>(poses.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    PagePanel panel = index_panel(study, output, rows, poses[k]);
    panel.name_size = kNameSize;
    panel.left = left + each * static_cast<double>(k);
    panel.top = top + kHead;
    panel.width = each - kBetween;
    panel.height = kRowHeight * static_cast<double>(rows.size());
    for (std::size_t r = 0; k == 0 && r < rows.size(); ++r) panel.y_names[r] = names[rows[r]];
    page.panels.push_back(std::move(panel));
  }
  top += kHead + kRowHeight * static_cast<double>(rows.size()) + kFootOfPanel;
  page.height = static_cast<int>(std::ceil(top + 6));
}

double widest_name(const StudyView& study) {
  double width = 0;
  for (const std::string& name : shown_parameters(study))
    width = std::max(width, words_width(name, kNameSize));
  return width;
}

/// Of one pose by rows and columns.
template <typename At>
HeatMap::Panel map_panel(const StudyView& study,
                         const std::vector<std::size_t>& rows,
                         const std::vector<ShownOutput>& columns,
                         std::size_t pose,
                         const At& at) {
  HeatMap::Panel panel{study.swept.title + " " + shown_pose(study, pose), {}};
  for (const std::size_t row : rows)
    for (const ShownOutput& column : columns)
      panel.values.push_back(at(study.all.effects.at(column.index), row, pose));
  return panel;
}

/// Of the most that it does to any quantity.
std::vector<std::size_t> map_rows(const StudyView& study, const std::vector<ShownOutput>& columns) {
  std::vector<double> weights(study.parameters.size(), 0);
  for (const ShownOutput& column : columns) {
    const SweepEffects effects = sweep_effects(study, column.index);
    for (std::size_t j = 0; j < weights.size(); ++j)
      if (effects.total[j] > weights[j]) weights[j] = effects.total[j];
  }
  std::vector<std::size_t> rows = greatest(weights, kMostMapRows);
  std::sort(rows.begin(), rows.end());
  return rows;
}

template <typename At>
HeatMap map_of(const StudyView& study, const char* what, const At& at) {
  const std::vector<ShownOutput> columns = main_outputs(study, kMapLigaments);
  HeatMap map;
  map.title = study.title;
  map.what = what;
  if (columns.empty()) return map;
  const std::vector<std::size_t> rows = map_rows(study, columns);
  if (rows.size() < study.parameters.size())
    map.notes.push_back(fmt::format("The {} of {} numbers with the greatest effects.", rows.size(),
                                    study.parameters.size()));
  map.scales = {{what, "-", 1}};
  for (const std::size_t row : rows)
    map.rows.push_back({shown_parameters(study)[row], study.parameters[row].spread});
  for (const ShownOutput& column : columns) map.columns.push_back({column.name, 0});
  for (const std::size_t pose : shown_poses(study))
    map.panels.push_back(map_panel(study, rows, columns, pose, at));
  return map;
}

}  // namespace

std::vector<NamedPage> study_index_pages(const StudyView& study) {
  if (!has_indices(study)) return {};
  std::vector<ShownOutput> shown = main_outputs(study, kBarLigaments);
  shown.resize(std::min(shown.size(), kMostQuantities));
  const std::size_t count = (shown.size() + kQuantitiesOnPage - 1) / kQuantitiesOnPage;
  const double names = widest_name(study);
  std::vector<NamedPage> pages;
  for (std::size_t k = 0; k < count; ++k) {
    ChartPage page{study.title, "what explains the spread"};
    if (count > 1) page.what += fmt::format(" ({} of {})", k + 1, count);
    page.key = {{"first order: by itself", {bars_of(kFirstInk, kThick)}},
                {"total: with what it does together with others", {bars_of(kTotalInk, kThick)}},
                {"95 % interval", {Mark{Mark::Kind::kLine, {}, {}, {}, {}, kIntervalInk}}}};
    double top = top_of_panels(page);
    for (std::size_t i = k * kQuantitiesOnPage;
         i < std::min(shown.size(), (k + 1) * kQuantitiesOnPage); ++i)
      add_quantity(page, study, shown[i], names, top);
    pages.push_back(
        {count > 1 ? fmt::format("study_indices_{}", k + 1) : "study_indices", std::move(page)});
  }
  return pages;
}

std::vector<NamedMap> study_maps(const StudyView& study) {
  std::vector<NamedMap> maps;
  const auto keep = [&](const char* name, HeatMap map) {
    if (!map.panels.empty() && !map.rows.empty()) maps.push_back({name, std::move(map)});
  };
  HeatMap ranks =
      map_of(study, "rank correlation",
             [](const StudyEffects& effects, std::size_t row, std::size_t pose) {
               return effects.rank.empty() ? std::nan("") : effects.rank.at(row).at(pose);
             });
  const double samples = independent_samples(study);
  ranks.notes.push_back(
      fmt::format("Of {:.0f} independent samples; what is below {:.2g} may be chance.", samples,
                  std::min(1.0, chance_rank(samples))));
  keep("study_correlations", std::move(ranks));
  if (!has_indices(study)) return maps;
  HeatMap totals = map_of(
      study, "total index", [](const StudyEffects& effects, std::size_t row, std::size_t pose) {
        return effects.total.empty() ? std::nan("") : known_value(effects.total.at(row).at(pose));
      });
  totals.notes.push_back("Grey: nothing varies, or the interval of 95 % is wider than 1.");
  double most = 0;
  for (const HeatMap::Panel& panel : totals.panels)
    for (const double value : panel.values)
      if (std::isfinite(value)) most = std::max(most, value);
  for (HeatMap::Scale& scale : totals.scales) {
    scale.largest = index_axis(most);
    scale.from_zero = true;
  }
  keep("study_totals", std::move(totals));
  return maps;
}

}  // namespace condyle
