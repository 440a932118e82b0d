#include "pictures/color_bar.h"

#include <fmt/format.h>

#include <cmath>

namespace condyle {
namespace {

/// A step of 1, 2 or 5 times a power of ten that gives at most six ticks.
double tick_step(double range) {
  double step = std::pow(10.0, std::floor(std::log10(range / 5)));
  for (const double factor : {2.0, 2.5, 2.0}) {
    if (range / step <= 6) break;
    step *= factor;
  }
  return step;
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
  pen.canvas.text({place.left - 2 * pen.s, place.top - 34 * pen.s}, bar.title, pen.style(14));
  pen.canvas.text({place.left - 2 * pen.s, place.top - 15 * pen.s}, bar.unit,
                  pen.style(14, kQuiet));
  const double range = std::max(1e-9, bar.high - bar.low), step = tick_step(range);
  for (double value = std::ceil(bar.low / step - 1e-6) * step; value <= bar.high + 1e-6 * range;
       value += step) {
    const double y = place.bottom - height * (value - bar.low) / range;
    pen.canvas.line({place.right, y}, {place.right + 5 * pen.s, y}, pen.s, kInk);
    pen.canvas.text({place.right + 9 * pen.s, y + 5 * pen.s},
                    fmt::format("{:g}", std::round(value / step) * step + 0.0), pen.style(14));
  }
}

}  // namespace condyle
