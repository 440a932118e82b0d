#include "condyle/pictures/label_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace condyle {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool segments_cross(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const bool apart_ab = cross(b - a, c - a) * cross(b - a, d - a) < 0;
  return apart_ab && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

/// Heights near the wanted ones (ascending), at least `spacing` apart, pushed into [low, high].
std::vector<double> spread(const std::vector<double>& wanted,
                           double spacing,
                           double low,
                           double high) {
  std::vector<double> y = wanted;
  const double room = spacing * static_cast<double>(y.empty() ? 0 : y.size() - 1);
  const double bottom = std::max(high, low + room);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = std::max(y[i], i == 0 ? low : y[i - 1] + spacing);
  for (std::size_t i = y.size(); i-- > 0;)
    y[i] = std::min(y[i], i + 1 == y.size() ? bottom : y[i + 1] - spacing);
  return y;
}

/// Swaps labels whose lines cross; each swap shortens the lines, so this ends.
void uncross(std::vector<std::size_t>& order,
             const std::vector<Vector2d>& slots,
             const std::vector<Vector2d>& anchors) {
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        if (!segments_cross(slots[i], anchors[order[i]], slots[j], anchors[order[j]])) continue;
        std::swap(order[i], order[j]);
        again = true;
      }
    }
  }
}

void place_column(std::vector<std::size_t> order,
                  bool left,
                  const std::vector<Vector2d>& anchors,
                  const Frame& frame,
                  double spacing,
                  std::vector<PlacedLabel>& placed) {
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return anchors[a].y() < anchors[b].y(); });
  std::vector<double> wanted;
  for (const std::size_t i : order) wanted.push_back(anchors[i].y());
  std::vector<Vector2d> slots;
  for (const double y : spread(wanted, spacing, frame.top, frame.bottom))
    slots.push_back({left ? frame.left : frame.right, y});
  uncross(order, slots, anchors);
  for (std::size_t i = 0; i < order.size(); ++i) placed.push_back({order[i], left, slots[i]});
}

}  // namespace

std::vector<PlacedLabel> place_labels(const std::vector<Vector2d>& anchors,
                                      const Frame& frame,
                                      double spacing) {
  std::vector<std::size_t> order(anchors.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return anchors[a].x() < anchors[b].x(); });
  // Each goes to the nearer side, as long as neither column gets more than three fifths.
  const double middle = 0.5 * (frame.left + frame.right);
  const auto n = static_cast<std::ptrdiff_t>(order.size());
  auto cut = std::partition_point(order.begin(), order.end(),
                                  [&](auto i) { return anchors[i].x() < middle; }) -
             order.begin();
  cut = std::clamp(cut, 2 * n / 5, n - 2 * n / 5);
  std::vector<PlacedLabel> placed;
  place_column({order.begin(), order.begin() + cut}, true, anchors, frame, spacing, placed);
  place_column({order.begin() + cut, order.end()}, false, anchors, frame, spacing, placed);
  return placed;
}

}  // namespace condyle
