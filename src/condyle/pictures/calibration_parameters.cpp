#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/calibration/calibration.h"
#include "condyle/calibration/shown_numbers.h"
#include "condyle/calibration/told_parameter.h"
#include "condyle/pictures/color_map.h"
#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/plot_calibration.h"

namespace condyle {
namespace {

constexpr double kSpread = 560, kTallestRow = 40, kLeastRow = 12;  // of the matrix [pixel]
constexpr double kNamesEnd = 24, kGap = 64, kBarsWidth = 260;      // [pixel]
constexpr Eigen::Index kMostNumbers = 13;  // of a row whose cells have their number in them
constexpr double kTitlePoints = 12.5;      // as wide as the bold title of a panel
constexpr int kScaleSteps = 10;
constexpr double kNothing = 0.02;  // a correlation that is left white

double correlation(const CalibrationResult& result, Eigen::Index i, Eigen::Index j) {
  const Eigen::MatrixXd& C = result.known.covariance;
  const double scale = std::sqrt(C(i, i) * C(j, j));
  return scale > 0 ? std::clamp(C(i, j) / scale, -1.0, 1.0) : 0;
}

/// Its lower triangle: row and column i are parameter i, downward and to the right.
void add_cells(PagePanel& panel, const CalibrationResult& result, Eigen::Index n) {
  Mark cells{Mark::Kind::kCells, {}, {}};
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double r = i == j ? 0 : correlation(result, i, j);
      if (!(std::abs(r) >= kNothing)) continue;
      const double x = static_cast<double>(j), y = static_cast<double>(i);
      cells.x.push_back(x);
      cells.y.push_back(y);
      cells.colors.push_back(map_color(ColorMap::kDiverging, 0.5 + 0.5 * r));
      if (n <= kMostNumbers)
        panel.words.push_back({x, y, with_minus(fmt::format("{:.2f}", r)), std::abs(r) > 0.6});
    }
  panel.marks.push_back(std::move(cells));
}

/// What no correlation stands out from, and the diagonal.
void add_ground(PagePanel& panel, Eigen::Index n) {
  Mark ground{Mark::Kind::kBars, {}, {}, {}, {}, "#f3f4f5", false, false, 1};
  Mark diagonal{Mark::Kind::kBars, {}, {}, {}, {}, "#c3c8cd", false, false, 1};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double y = static_cast<double>(i);
    for (Mark* mark : {&ground, &diagonal}) {
      mark->y.push_back(y);
      mark->high.push_back(y + 0.5);
    }
    ground.low.push_back(-0.5);
    diagonal.low.push_back(y - 0.5);
  }
  panel.marks = {ground, diagonal};
}

PagePanel matrix_panel(const CalibrationResult& result) {
  const auto n = static_cast<Eigen::Index>(result.parameters.size());
  const double last = static_cast<double>(n) - 0.5;
  PagePanel panel;
  panel.title = "Correlation of the posterior";
  panel.x_range = {-0.5, last};
  panel.y_range = {last, -0.5};
  panel.frame = false;
  add_ground(panel, n);
  add_cells(panel, result, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::string name = shown_name(result.parameters[static_cast<std::size_t>(i)]);
    panel.y_names.push_back(fmt::format("{}  {}", name, i + 1));
    panel.x_names.push_back(fmt::format("{}", i + 1));
  }
  return panel;
}

PagePanel shrinkage_panel(const CalibrationResult& result) {
  PagePanel panel;
  panel.title = "Deviation of the posterior";
  panel.x_label = "of that of the prior [-]";
  panel.x_range = {0, 1};
  const double last = static_cast<double>(result.parameters.size()) - 0.5;
  panel.y_range = {last, -0.5};
  Mark prior{Mark::Kind::kBars, {}, {}, {}, {}, "#dfe2e5", false, false, 0.66};
  Mark posterior{Mark::Kind::kBars, {}, {}, {}, {}, kAfterInk, false, false, 0.66};
  Mark samples{Mark::Kind::kDots, {}, {}, {}, {}, kUnseenInk, false, true, 0.9};
  const std::vector<ToldParameter> told = told_parameters(result);
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double y = static_cast<double>(j), before = result.prior_sd[at];
    const bool held = std::isfinite(before) && before > 0;
    for (Mark* mark : {&prior, &posterior, &samples}) mark->y.push_back(y);
    prior.low.push_back(0);
    prior.high.push_back(1);
    posterior.low.push_back(0);
    posterior.high.push_back(held ? result.known.sd[at] / before : std::nan(""));
    samples.x.push_back(held && told[j].parts ? result.sample_sd[at] / before : std::nan(""));
    if (std::isfinite(samples.x.back()) && samples.x.back() > panel.x_range[1])
      panel.x_range[1] = samples.x.back() * 1.05;
    const bool bound = j < result.at_bound.size() && result.at_bound[j];
    panel.right_names.push_back(
        bound ? "at its bound"
              : shown_deviation(result.parameters[j], before) + " → " +
                    shown_deviation(result.parameters[j], result.known.sd[at]));
  }
  panel.y_names.assign(result.parameters.size(), "");
  panel.marks = {prior, posterior, samples};
  return panel;
}

double widest(const std::vector<std::string>& names, double size) {
  double width = 0;
  for (const std::string& name : names) width = std::max(width, words_width(name, size));
  return width;
}

/// Both panels side by side with common rows; the page is as large as they need.
void lay_out_parameters(ChartPage& page, std::size_t count) {
  const double n = static_cast<double>(count),
               row = std::clamp(kSpread / n, kLeastRow, kTallestRow);
  PagePanel &matrix = page.panels[0], &bars = page.panels[1];
  const double size = std::clamp(0.55 * row, 6.5, 10.0);
  const double top = top_of_panels(page) + 40;
  for (PagePanel* panel : {&matrix, &bars}) {
    panel->top = top;
    panel->height = n * row;
    panel->name_size = size;
  }
  matrix.left = kNamesEnd + widest(matrix.y_names, size) + 14;
  matrix.width = n * row;
  const double title = words_width(matrix.title, kTitlePoints);
  bars.left = matrix.left + std::max(matrix.width, title) + kGap;
  bars.width = kBarsWidth;
  const double right = bars.left + bars.width + widest(bars.right_names, size) + 40;
  page.width = std::max(page.width, static_cast<int>(std::ceil(right)));
  page.height = static_cast<int>(std::ceil(top + n * row + 84));
}

std::vector<KeyEntry> parameter_key(const PagePanel& bars) {
  std::vector<KeyEntry> key;
  Mark scale{Mark::Kind::kCells, {}, {}};
  for (int k = 0; k <= kScaleSteps; ++k)
    scale.colors.push_back(map_color(ColorMap::kDiverging, static_cast<double>(k) / kScaleSteps));
  key.push_back({"correlation −1 to 1", {scale}});
  key.push_back({"prior", {Mark{Mark::Kind::kBars, {}, {}, {}, {}, "#dfe2e5"}}});
  key.push_back({"posterior", {Mark{Mark::Kind::kBars, {}, {}, {}, {}, kAfterInk}}});
  const std::vector<double>& parted = bars.marks.back().x;
  if (std::any_of(parted.begin(), parted.end(), [](double x) { return std::isfinite(x); }))
    key.push_back({"by samples, where 10 % off",
                   {Mark{Mark::Kind::kDots, {}, {}, {}, {}, kUnseenInk, false, true, 0.9}}});
  return key;
}

}  // namespace

std::vector<NamedPage> parameter_pages(const Scene& scene, const CalibrationResult& result) {
  const auto n = static_cast<Eigen::Index>(result.parameters.size());
  if (n == 0 || result.known.covariance.rows() != n || result.known.sd.size() != n ||
      result.prior_sd.size() != n)
    return {};
  ChartPage page{scene.title, "what is known of the parameters"};
  page.panels = {matrix_panel(result), shrinkage_panel(result)};
  page.key = parameter_key(page.panels[1]);
  lay_out_parameters(page, result.parameters.size());
  return {{"calibration_parameters", std::move(page)}};
}

}  // namespace condyle
