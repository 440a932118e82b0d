#include "condyle/pictures/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "condyle/math/round_ticks.h"

namespace condyle {
namespace {

using Eigen::Vector2d;

constexpr double kTriangle = 15;  // high, in units of the page

/// Two lines that end above `at`; where what the bar shows and its unit are too long for one line,
/// the unit has one of its own, and what is still too long is set smaller or, where letters would be
/// too small, further to the left.
void draw_heading(const Pen& pen, const ColorBar& bar, const Vector2d& at) {
  const double right = pen.canvas.width() - 3 * pen.s, room = right - at.x(), line = 19 * pen.s;
  const TextStyle quiet = pen.style(14, kQuiet);
  const auto write = [&](const std::string& text, TextStyle style, double y) {
    while (style.size > 7 && pen.canvas.text_width(text, style) > room) --style.size;
    const double left = std::min(at.x(), right - pen.canvas.text_width(text, style));
    pen.canvas.text({left, y}, text, style);
  };
  std::vector<std::string> below = {bar.unit};
  const std::size_t bracket = bar.unit.rfind(" [");
  if (bracket != std::string::npos && pen.canvas.text_width(bar.unit, quiet) > room)
    below = {bar.unit.substr(0, bracket), bar.unit.substr(bracket + 1)};
  double y = at.y();
  for (std::size_t i = below.size(); i-- > 0; y -= line) write(below[i], quiet, y);
  write(bar.title, pen.style(14), y);
}

/// Above the bar, as wide as it.
void draw_triangle(const Pen& pen, const Frame& place, Rgb color, const std::string& words) {
  const double middle = 0.5 * (place.left + place.right), half = 0.5 * (place.right - place.left);
  const int rows = static_cast<int>(std::lround(kTriangle * pen.s));
  for (int i = 0; i < rows; ++i) {
    const double reach = half * (rows - i - 0.5) / rows, y = place.top - 2 * pen.s - i;
    pen.canvas.rectangle({middle - reach, y - 1, middle + reach, y}, color);
  }
  pen.canvas.text({place.right + 9 * pen.s, place.top - 11 * pen.s}, words, pen.style(14));
}

}  // namespace

void draw_color_bar(const Pen& pen, const ColorBar& bar, const Frame& wanted) {
  // On whole pixels: two halves of a pixel laid over each other would let the paper through.
  const Frame place{std::round(wanted.left), std::round(wanted.top), std::round(wanted.right),
                    std::round(wanted.bottom)};
  const double height = place.bottom - place.top;
  const int rows = static_cast<int>(std::lround(height));
  for (int i = 0; i < rows; ++i) {
    pen.canvas.rectangle({place.left, place.top + i, place.right, place.top + i + 1.0},
                         map_color(bar.map, 1 - (i + 0.5) / rows));
  }
  const double lift = bar.above.empty() ? 0 : (kTriangle + 2) * pen.s;
  if (lift > 0) draw_triangle(pen, place, map_color(bar.map, 1), bar.above);
  const double words = place.top - lift;
  draw_heading(pen, bar, {place.left - 2 * pen.s, words - 15 * pen.s});
  const double range = bar.high - bar.low;
  std::vector<double> ticks = round_ticks(bar.low, bar.high, 6);
  if (ticks.empty()) ticks = {bar.low};  // of no size
  for (const double value : ticks) {
    const double y = place.bottom - (range > 0 ? height * (value - bar.low) / range : 0);
    pen.canvas.line({place.right, y}, {place.right + 5 * pen.s, y}, pen.s, kInk);
    pen.canvas.text({place.right + 9 * pen.s, y + 5 * pen.s}, fmt::format("{:.6g}", value),
                    pen.style(14));
  }
}

}  // namespace condyle
