#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/calibration/calibration.h"
#include "condyle/calibration/calibration_words.h"
#include "condyle/calibration/shown_numbers.h"
#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/plot_calibration.h"

namespace condyle {
namespace {

constexpr std::size_t kMostDirections = 4, kMostShares = 7;
constexpr double kLeastShare = 0.1;
constexpr double kShown = 1e-3;  // of the largest singular value: less is drawn there
constexpr double kSpectrumWidth = 380, kShareWidth = 200, kRow = 22;  // [pixel]

PagePanel spectrum_panel(const CalibrationResult& result) {
  const Eigen::VectorXd s = result.known.singular_values.head(free_directions(result));
  PagePanel panel;
  panel.title = "Singular values";
  panel.x_label = "Direction";
  panel.y_label = "Prior sd over that of the data [-]";
  panel.log_y = true;
  Mark above{Mark::Kind::kDots, {}, {}, {}, {}, kAfterInk, false, false, 1.0};
  Mark below{Mark::Kind::kDots, {}, {}, {}, {}, kUnseenInk, false, true, 1.0};
  const double floor = kShown * std::max(1.0, s.maxCoeff());
  double least = 1, greatest = 1;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    Mark& mark = s[i] > 1 ? above : below;
    mark.x.push_back(static_cast<double>(i) + 1);
    mark.y.push_back(std::max(s[i], floor));
    least = std::min(least, mark.y.back());
    greatest = std::max(greatest, mark.y.back());
  }
  const double end = static_cast<double>(s.size()) + 1;
  panel.x_range = {0, end};
  panel.y_range = {std::pow(10, std::floor(std::log10(least) - 0.05)),
                   std::pow(10, std::ceil(std::log10(greatest) + 0.05))};
  const Mark one{Mark::Kind::kLine, {0, end}, {1, 1}, {}, {}, kBeforeInk, true, false, 1.6};
  panel.marks = {one, above, below};
  return panel;
}

/// Of a direction the parameters with the largest shares, largest first.
std::vector<Eigen::Index> largest_shares(const Eigen::VectorXd& direction) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(direction.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(direction[a]) > std::abs(direction[b]);
  });
  while (order.size() > 1 &&
         (order.size() > kMostShares || std::abs(direction[order.back()]) < kLeastShare))
    order.pop_back();
  return order;
}

PagePanel share_panel(const CalibrationResult& result, Eigen::Index which) {
  const Eigen::VectorXd direction = result.known.directions.col(which);
  PagePanel panel;
  panel.title = fmt::format("Direction {}: {:.2g}", which + 1, result.known.singular_values[which]);
  panel.x_label = "Share [prior deviations]";
  panel.x_range = {-1, 1};
  const std::vector<Eigen::Index> shares = largest_shares(direction);
  Mark bars{Mark::Kind::kBars, {}, {}, {}, {}, kUnseenInk, false, false, 0.6};
  const double sign = direction[shares.front()] < 0 ? -1 : 1;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double share = sign * direction[shares[k]];
    bars.y.push_back(static_cast<double>(k));
    bars.low.push_back(std::min(0.0, share));
    bars.high.push_back(std::max(0.0, share));
    panel.y_names.push_back(shown_name(result.parameters[static_cast<std::size_t>(shares[k])]));
  }
  const double rows = static_cast<double>(kMostShares);
  panel.y_range = {rows - 0.5, -0.5};
  panel.marks = {
      bars,
      Mark{Mark::Kind::kLine, {0, 0}, {-0.5, rows - 0.5}, {}, {}, kBeforeInk, false, false, 1}};
  return panel;
}

/// The spectrum left, directions in rows of two beside it.
void lay_out_spectrum(ChartPage& page) {
  const double top = top_of_panels(page) + 34;
  const double height = kRow * kMostShares;
  PagePanel& spectrum = page.panels[0];
  spectrum.left = 96;
  spectrum.top = top;
  double names = 0;
  for (const PagePanel& panel : page.panels)
    for (const std::string& name : panel.y_names)
      names = std::max(names, words_width(name, panel.name_size));
  const double cell = names + kShareWidth + 44;
  const std::size_t rows = page.panels.size() > 2 ? 2 : 1;
  for (std::size_t k = 1; k < page.panels.size(); ++k) {
    PagePanel& panel = page.panels[k];
    panel.left = 96 + kSpectrumWidth + 50 + cell * static_cast<double>((k - 1) / 2) + names;
    panel.top = top + static_cast<double>((k - 1) % 2) * (height + 96);
    panel.width = kShareWidth;
    panel.height = height;
  }
  spectrum.width = kSpectrumWidth;
  spectrum.height = static_cast<double>(rows) * height + (rows > 1 ? 96 : 0);
  const double right = page.panels.back().left + kShareWidth + 30;
  page.width = std::max(page.width, static_cast<int>(std::ceil(right)));
  page.height = static_cast<int>(std::ceil(top + spectrum.height + 70));
}

}  // namespace

std::vector<NamedPage> spectrum_pages(const Scene& scene, const CalibrationResult& result) {
  const Identifiability& known = result.known;
  const Eigen::Index n = free_directions(result);
  if (n == 0 || known.directions.cols() != known.singular_values.size() ||
      known.directions.rows() != static_cast<Eigen::Index>(result.parameters.size()) ||
      !known.singular_values.allFinite() || !known.directions.allFinite())
    return {};
  ChartPage page{scene.title, "what the measurements determine"};
  page.notes = {
      fmt::format("{} of {} directions have a singular value above 1: of these the data "
                  "say more than the prior; effective number {:.1f}",
                  known.determined, n, known.effective)};
  page.panels.push_back(spectrum_panel(result));
  const auto count = std::min<Eigen::Index>(n, kMostDirections);
  for (Eigen::Index k = 0; k < count; ++k) page.panels.push_back(share_panel(result, n - 1 - k));
  page.notes.push_back(
      "Right: the weakest directions with their singular values, and the parameters that they "
      "consist of");
  lay_out_spectrum(page);
  return {{"calibration_spectrum", std::move(page)}};
}

}  // namespace condyle
