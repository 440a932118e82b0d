#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "condyle/calibration/calibration.h"
#include "condyle/calibration/shown_numbers.h"
#include "condyle/calibration/told_units.h"
#include "condyle/pictures/plot_calibration.h"

namespace condyle {
namespace {

constexpr double kCurveInterval = 1.96;  // 95 % of a normal distribution, in standard deviations
constexpr double kAngle = 180 / std::numbers::pi;
constexpr double kCurveHeight = 210;  // [pixel]

/// Rows of one quantity over level or, where each flexion has but one level, over flexion.
struct RowCurve {
  std::string title, x_label;
  std::vector<std::pair<double, std::size_t>> points;  // x, row
};

/// What belongs to one panel: flexion is that of all rows, or none.
struct Group {
  std::string test;
  double flexion;  // NaN: over flexion
  int load;
  MeasuredKind kind;
  bool laxity;
  std::size_t index;

  bool operator==(const Group& other) const {
    return test == other.test && load == other.load && kind == other.kind &&
           laxity == other.laxity && index == other.index &&
           (flexion == other.flexion || (std::isnan(flexion) && std::isnan(other.flexion)));
  }
};

/// How the rows of a table are drawn, found in one pass over them.
class RowLayout {
 public:
  explicit RowLayout(const MeasurementTable& table) {
    std::map<std::pair<std::string, int>, std::map<double, std::set<double>>> levels;
    for (const Measurement& row : table.rows)
      levels[{row.test, row.load}][row.flexion].insert(row.level);
    for (const auto& [curve, at_flexion] : levels)
      if (at_flexion.size() > 1 &&
          std::all_of(at_flexion.begin(), at_flexion.end(),
                      [](const auto& at) { return at.second.size() == 1; }))
        over_flexion_.insert(curve);
    for (const Measurement& row : table.rows)
      if (row.load >= 0 && !over_flexion(row.test, row.load))
        loads_[{row.test, row.flexion}].insert(row.load);
  }

  [[nodiscard]] bool over_flexion(const std::string& test, int load) const {
    return load < 0 || over_flexion_.contains({test, load});
  }

  /// Loads under which an unloaded row stands as level 0: those of its test at its flexion.
  [[nodiscard]] std::vector<int> loads_of(const Measurement& row) const {
    if (row.load >= 0) return {row.load};
    const auto loads = loads_.find({row.test, row.flexion});
    if (loads == loads_.end()) return {-1};
    return {loads->second.begin(), loads->second.end()};
  }

 private:
  std::set<std::pair<std::string, int>> over_flexion_;
  std::map<std::pair<std::string, double>, std::set<int>> loads_;  // over levels, by flexion
};

RowCurve named_curve(const Scene& scene, const RowLayout& layout, const Group& group) {
  const auto& [test, flexion, load, kind, laxity, index] = group;
  RowCurve curve;
  if (layout.over_flexion(test, load)) {
    curve.title = load < 0 ? test : test + ", " + load_name(scene, load);
    curve.x_label = "Flexion [°]";
  } else {
    curve.title = test + " at " + shown_degrees(flexion);
    curve.x_label =
        fmt::format("{} [{}]", load_name(scene, load), shown_unit(unit_of_level(scene, load).name));
  }
  return curve;
}

/// In the order of the table.
std::vector<std::pair<Group, RowCurve>> row_curves(const Scene& scene,
                                                   const CalibrationResult& result) {
  const MeasurementTable& table = result.table;
  const RowLayout layout(table);
  std::vector<std::pair<Group, RowCurve>> curves;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Measurement& row = table.rows[i];
    for (const int load : layout.loads_of(row)) {
      const bool flexed = layout.over_flexion(row.test, load);
      const Group group{row.test, flexed ? std::nan("") : row.flexion, load, row.kind, row.laxity,
                        row.index};
      auto found = std::find_if(curves.begin(), curves.end(),
                                [&](const auto& known) { return known.first == group; });
      if (found == curves.end())
        found = curves.insert(curves.end(), {group, named_curve(scene, layout, group)});
      const double x =
          flexed ? row.flexion * kAngle : row.level / unit_of_level(scene, load).factor;
      found->second.points.emplace_back(x, i);
    }
  }
  for (auto& [group, curve] : curves) std::stable_sort(curve.points.begin(), curve.points.end());
  return curves;
}

/// By how many of its deviations the quantity changes along the curve.
double signal(const CalibrationResult& result, const RowCurve& curve) {
  double low = std::numeric_limits<double>::infinity(), high = -low, sd = 0;
  for (const auto& [x, i] : curve.points) {
    low = std::min(low, result.table.rows[i].value);
    high = std::max(high, result.table.rows[i].value);
    sd += result.table.rows[i].sd / static_cast<double>(curve.points.size());
  }
  return sd > 0 ? (high - low) / sd : 0;
}

/// Of the curves of the same poses that which moves most.
std::vector<bool> main_curves(const CalibrationResult& result,
                              const std::vector<std::pair<Group, RowCurve>>& curves) {
  std::map<std::tuple<std::string, std::string, int>, std::size_t> best;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const auto key = std::tuple{curves[k].second.title, curves[k].first.test, curves[k].first.load};
    const auto at = best.try_emplace(key, k).first;
    if (signal(result, curves[k].second) > signal(result, curves[at->second].second))
      at->second = k;
  }
  std::vector<bool> is_main(curves.size(), false);
  for (const auto& [key, k] : best) is_main[k] = true;
  return is_main;
}

/// Half of what a curve of one point is drawn wide.
double half_width(const RowCurve& curve) {
  return curve.points.front().first == curve.points.back().first
             ? std::max(1.0, 0.1 * std::abs(curve.points.front().first))
             : 0;
}

struct Predicted {
  Mark before, after, band;
};

Predicted predictions(const CalibrationResult& result, const RowCurve& curve, double unit) {
  Predicted made;
  made.before = {Mark::Kind::kLine, {}, {}, {}, {}, kBeforeInk, true, false, 1.8};
  made.after = {Mark::Kind::kLine, {}, {}, {}, {}, kAfterInk, false, false, 2.2};
  made.band = {Mark::Kind::kBand, {}, {}, {}, {}, kAfterInk};
  const auto add = [&](double x, const CalibratedRow& row) {
    for (Mark* mark : {&made.before, &made.after, &made.band}) mark->x.push_back(x);
    made.before.y.push_back(row.before / unit);
    made.after.y.push_back(row.after / unit);
    made.band.low.push_back((row.after - kCurveInterval * row.after_sd) / unit);
    made.band.high.push_back((row.after + kCurveInterval * row.after_sd) / unit);
  };
  const double wide = half_width(curve);
  for (const auto& [x, i] : curve.points) {
    if (wide > 0) add(x - wide, result.rows[i]);
    add(x + wide, result.rows[i]);
  }
  return made;
}

Mark measured(const CalibrationResult& result, const RowCurve& curve, double unit, bool unseen) {
  Mark mark{
      Mark::Kind::kDots, {}, {}, {}, {}, unseen ? kUnseenInk : kMeasuredInk, false, unseen, 0.9};
  for (const auto& [x, i] : curve.points) {
    const Measurement& row = result.table.rows[i];
    if ((row.use == MeasuredUse::kTest) != unseen) continue;
    mark.x.push_back(x);
    mark.y.push_back(row.value / unit);
    mark.high.push_back(kCurveInterval * result.rows[i].sd / unit);
  }
  return mark;
}

PagePanel curve_panel(const Scene& scene, const CalibrationResult& result, const RowCurve& curve) {
  const Measurement& row = result.table.rows[curve.points.front().second];
  const Unit unit = unit_of(row, scene);
  const std::vector<std::string>& relative = scene.calibration->relative;
  const bool change = row.kind == MeasuredKind::kJointCoordinate && !row.laxity &&
                      std::find(relative.begin(), relative.end(), row.test) != relative.end();
  PagePanel panel;
  panel.title = curve.title;
  panel.x_label = curve.x_label;
  panel.y_label =
      fmt::format("{}{} [{}]", change ? "Δ " : "", quantity_of(row, scene), shown_unit(unit.name));
  Predicted made = predictions(result, curve, unit.factor);
  panel.marks = {made.band, made.before, made.after, measured(result, curve, unit.factor, false),
                 measured(result, curve, unit.factor, true)};
  const double low = curve.points.front().first, high = curve.points.back().first;
  const double room = std::max(0.06 * (high - low), 2 * half_width(curve));
  panel.x_range = {low - room, high + room};
  return panel;
}

std::vector<KeyEntry> curve_key() {
  const Mark band{Mark::Kind::kBand, {}, {}};
  const Mark after{Mark::Kind::kLine, {}, {}, {}, {}, kAfterInk, false, false, 2.2};
  const Mark before{Mark::Kind::kLine, {}, {}, {}, {}, kBeforeInk, true, false, 1.8};
  const Mark fitted{Mark::Kind::kDots, {}, {}, {}, {0}, kMeasuredInk, false, false, 0.9};
  const Mark unseen{Mark::Kind::kDots, {}, {}, {}, {0}, kUnseenInk, false, true, 0.9};
  return {{"fitted knee, 95 %", {band, after}},
          {"scene's own numbers", {before}},
          {"measured and fitted, 95 %", {fitted}},
          {"measured, not fitted", {unseen}}};
}

}  // namespace

std::vector<NamedPage> measured_pages(const Scene& scene, const CalibrationResult& result) {
  if (!scene.calibration || result.rows.size() != result.table.rows.size()) return {};
  ChartPage first{scene.title, "measured and fitted"},
      others{scene.title, "measured and fitted, the other coordinates"};
  first.key = others.key = curve_key();
  const auto curves = row_curves(scene, result);
  const std::vector<bool> is_main = main_curves(result, curves);
  for (std::size_t k = 0; k < curves.size(); ++k)
    (is_main[k] ? first : others).panels.push_back(curve_panel(scene, result, curves[k].second));
  return divided({{"calibration_curves", first}, {"calibration_other_curves", others}}, kMostPanels,
                 kPanelColumns, kCurveHeight);
}

}  // namespace condyle
