#include "condyle/report/curve_difference.h"

#include <algorithm>
#include <cmath>

#include "condyle/math/no_number.h"

namespace condyle {
namespace {

bool same_place(double a, double b) {
  constexpr double kRounding = 1e-9;
  return std::abs(a - b) <= kRounding * std::max({1.0, std::abs(a), std::abs(b)});
}

struct Knot {
  double x = 0, y = 0;
  bool joined = false;  ///< to the next
};

/// By growing x; nothing where the curve turns back.
std::optional<std::vector<Knot>> knots_of(const SampledCurve& curve) {
  std::vector<Knot> knots;
  bool joined = false;
  double last = kNoNumber;
  int direction = 0;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    const bool placed = std::isfinite(curve.x[i]);
    if (placed && std::isfinite(last)) {
      const int now = curve.x[i] > last ? 1 : curve.x[i] < last ? -1 : 0;
      if (now == 0 || now * direction < 0) return std::nullopt;
      direction = now;
    }
    if (placed) last = curve.x[i];
    const bool known = placed && std::isfinite(curve.y[i]);
    if (known) {
      if (!knots.empty()) knots.back().joined = joined;
      knots.push_back({curve.x[i], curve.y[i]});
    }
    joined = known;
  }
  if (direction >= 0) return knots;
  std::vector<Knot> turned(knots.rbegin(), knots.rend());
  for (std::size_t i = 0; i < turned.size(); ++i)
    turned[i].joined = i + 1 < turned.size() && knots[turned.size() - 2 - i].joined;
  return turned;
}

struct Reading {
  double y = kNoNumber;
  bool between = false;  ///< two points
};

Reading read(const std::vector<Knot>& knots, double x) {
  const auto after = std::lower_bound(knots.begin(), knots.end(), x,
                                      [](const Knot& k, double v) { return k.x < v; });
  if (after != knots.end() && same_place(after->x, x)) return {after->y, false};
  if (after == knots.begin()) return {};
  const Knot& before = *(after - 1);
  if (same_place(before.x, x)) return {before.y, false};
  if (after == knots.end() || !before.joined) return {};
  return {before.y + (x - before.x) / (after->x - before.x) * (after->y - before.y), true};
}

std::vector<double> places_of(const std::vector<Knot>& a, const std::vector<Knot>& b) {
  std::vector<double> all;
  for (const std::vector<Knot>* knots : {&a, &b})
    for (const Knot& knot : *knots) all.push_back(knot.x);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), same_place), all.end());
  return all;
}

}  // namespace

std::optional<CurveDifference> difference(const SampledCurve& a, const SampledCurve& b) {
  const auto first = knots_of(a), second = knots_of(b);
  if (!first || !second) return std::nullopt;
  CurveDifference found;
  double squares = 0;
  for (const double x : places_of(*first, *second)) {
    const Reading of_a = read(*first, x), of_b = read(*second, x);
    const double d = of_b.y - of_a.y;
    if (!std::isfinite(d)) continue;
    squares += d * d;
    found.interpolated += of_a.between || of_b.between ? 1 : 0;
    if (found.count++ == 0 || std::abs(d) > std::abs(found.largest)) {
      found.largest = d;
      found.at = x;
    }
  }
  if (found.count > 0) found.rms = std::sqrt(squares / found.count);
  return found;
}

bool same_places(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_place);
}

}  // namespace condyle
