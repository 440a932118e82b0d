#pragma once

/// What a wrapped path keeps, as doubles: the outcome of the last pull, and of each surface its status and
/// the geodesic on it, or, while it is off it, the normal at the side where it passes.

#include <cmath>

#include "condyle/wrapping/one_surface.h"
#include "condyle/wrapping/wrapped_path.h"

namespace condyle {

class PathState {
 public:
  static constexpr int kHead = 3, kPerWrap = 8;
  static_assert(kHead + 7 * kPerWrap <= kMostPathNumbers);
  static constexpr int numbers(std::size_t wraps) {
    return kHead + kPerWrap * static_cast<int>(wraps);
  }

  explicit PathState(double* numbers) : d_(numbers) {}

  [[nodiscard]] bool known() const { return !std::isnan(d_[0]); }
  [[nodiscard]] WrappedPath::Finding finding() const {
    return {static_cast<WrappedPath::Outcome>(static_cast<int>(d_[0])), static_cast<int>(d_[1]),
            d_[2]};
  }
  void set(WrappedPath::Outcome outcome, int wrap, double conjugate) {
    d_[0] = static_cast<double>(outcome);
    d_[1] = wrap;
    d_[2] = conjugate;
  }
  [[nodiscard]] bool touches(int wrap) const { return of(wrap)[0] == 1; }
  [[nodiscard]] ArcPlace place(int wrap) const {
    const double* w = of(wrap);
    return {{w[1], w[2], w[3]}, {w[4], w[5], w[6]}, w[7]};
  }
  void touch(int wrap, const ArcPlace& at) {
    double* w = of(wrap);
    w[0] = 1;
    for (int i = 0; i < 3; ++i) {
      w[1 + i] = at.P[i];
      w[4 + i] = at.t[i];
    }
    w[7] = at.arc;
  }
  /// Off the surface; `side`: the normal there, 0 where it is not known.
  void leave(int wrap, const Eigen::Vector3d& side) {
    touch(wrap, {side, Eigen::Vector3d::Zero(), 0});
    of(wrap)[0] = 0;
  }
  [[nodiscard]] Eigen::Vector3d side(int wrap) const { return place(wrap).P; }

 private:
  [[nodiscard]] double* of(int wrap) { return d_ + kHead + kPerWrap * wrap; }
  [[nodiscard]] const double* of(int wrap) const { return d_ + kHead + kPerWrap * wrap; }

  double* d_;
};

}  // namespace condyle
