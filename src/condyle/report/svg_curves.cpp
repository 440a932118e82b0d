#include "condyle/report/svg_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/math/round_ticks.h"
#include "condyle/report/html.h"

namespace condyle {
namespace {

constexpr double kWidth = 340, kHeight = 210;  // of the drawing [pixel]
constexpr double kLeft = 48, kRight = 10, kTop = 8, kBottom = 40;
constexpr std::array<const char*, 6> kRunStyles = {"",        "7 3",  "2 3",
                                                   "9 3 2 3", "12 4", "5 2 1 2 1 2"};

struct Extent {
  double low = 0, high = 0;
  bool any = false;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
  /// Never of no size.
  void widen() {
    if (high - low > 1e-12 * std::max({1e-6, std::abs(low), std::abs(high)})) return;
    const double room = low == 0 ? 1 : 0.1 * std::abs(low);
    low -= room;
    high += room;
  }
};

/// Of the points that are drawn.
struct Ranges {
  Extent x, y;
};

void add_points(const std::vector<double>& x, const std::vector<double>& y, Ranges& ranges) {
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    ranges.x.add(x[i]);
    ranges.y.add(y[i]);
  }
}

Ranges ranges_of(const SvgCurves& curves) {
  Ranges ranges;
  for (const std::optional<Curve>& curve : curves.of_runs) {
    if (!curve) continue;
    add_points(curve->x, curve->y, ranges);
    add_points(curve->hollow_x, curve->hollow_y, ranges);
  }
  if (!ranges.x.any) return ranges;
  if (curves.from_zero) ranges.y.add(0);
  ranges.x.widen();
  ranges.y.widen();
  const double room = 0.04 * (ranges.y.high - ranges.y.low);
  ranges.y.high += room;
  if (!curves.from_zero) ranges.y.low -= room;
  return ranges;
}

double place_of(double value, const Extent& extent, double from, double to) {
  return from + (value - extent.low) / (extent.high - extent.low) * (to - from);
}

class Drawing {
 public:
  Drawing(const SvgCurves& curves, const Ranges& ranges) : curves_(curves), ranges_(ranges) {}

  [[nodiscard]] std::string text() const {
    std::string out =
        fmt::format("<svg class=\"curves\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
                    kWidth, kHeight, escaped(curves_.what));
    out += axes();
    for (std::size_t r = 0; r < curves_.of_runs.size(); ++r)
      if (curves_.of_runs[r]) out += line(*curves_.of_runs[r], r);
    return out + "</svg>\n";
  }

 private:
  [[nodiscard]] double x(double value) const {
    return place_of(value, ranges_.x, kLeft, kWidth - kRight);
  }
  [[nodiscard]] double y(double value) const {
    return place_of(value, ranges_.y, kHeight - kBottom, kTop);
  }

  [[nodiscard]] std::string axes() const {
    constexpr double kLow = kHeight - kBottom, kEnd = kWidth - kRight;
    std::string out;
    for (const double tick : round_ticks(ranges_.y.low, ranges_.y.high, 5))
      out += fmt::format(
          "<path class=\"grid\" d=\"M{} {:.1f}H{}\"/><text class=\"y\" x=\"{}\" "
          "y=\"{:.1f}\">{:.6g}</text>\n",
          kLeft, y(tick), kEnd, kLeft - 6, y(tick) + 4, tick);
    for (const double tick : round_ticks(ranges_.x.low, ranges_.x.high, 6))
      out += fmt::format(
          "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text class=\"x\" "
          "x=\"{0:.1f}\" y=\"{3}\">{4:.6g}</text>\n",
          x(tick), kLow, kTop, kLow + 16, tick);
    out += fmt::format("<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>\n", kLeft, kTop, kLow, kEnd);
    return out + fmt::format("<text class=\"x\" x=\"{:.1f}\" y=\"{}\">{}</text>\n",
                             0.5 * (kLeft + kEnd), kHeight - 7, escaped(curves_.x_label));
  }

  [[nodiscard]] std::string line(const Curve& curve, std::size_t run) const {
    std::string path, points;
    bool open = false, alone = false;
    double last_x = 0, last_y = 0;
    const auto close = [&] {  // a point without neighbours is no line
      if (alone) points += circle(last_x, last_y, run, "");
      open = alone = false;
    };
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
        close();
        continue;
      }
      last_x = curve.x[i];
      last_y = curve.y[i];
      path += fmt::format("{}{:.1f} {:.1f}", open ? "L" : "M", x(last_x), y(last_y));
      alone = !open;
      open = true;
    }
    close();
    for (std::size_t i = 0; i < std::min(curve.hollow_x.size(), curve.hollow_y.size()); ++i)
      if (std::isfinite(curve.hollow_y[i]))
        points += circle(curve.hollow_x[i], curve.hollow_y[i], run, " hollow");
    if (!path.empty())
      path = fmt::format("<path class=\"line run{}\" stroke-dasharray=\"{}\" d=\"{}\"/>\n", run + 1,
                         kRunStyles[run % kRunStyles.size()], path);
    return path + points;
  }

  [[nodiscard]] std::string circle(double at_x,
                                   double at_y,
                                   std::size_t run,
                                   const char* kind) const {
    return fmt::format("<circle class=\"point run{}{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>\n",
                       run + 1, kind, x(at_x), y(at_y));
  }

  const SvgCurves& curves_;
  Ranges ranges_;
};

}  // namespace

std::string svg(const SvgCurves& curves) {
  const Ranges ranges = ranges_of(curves);
  return ranges.x.any ? Drawing(curves, ranges).text() : "";
}

std::string svg_swatch(std::size_t run) {
  return fmt::format(
      "<svg class=\"swatch\" viewBox=\"0 0 44 10\" aria-hidden=\"true\"><path class=\"line run{}\" "
      "stroke-dasharray=\"{}\" d=\"M1 5H43\"/></svg>",
      run + 1, kRunStyles[run % kRunStyles.size()]);
}

}  // namespace condyle
