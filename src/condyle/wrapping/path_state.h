#pragma once

/// What a wrapped path keeps, as doubles: the outcome of the last pull, its length with the pose
/// (noted_length.h), and of each surface its status and the geodesic on it, or, while it is off it, the
/// normal at the side where it passes and the straight piece that did so when the statuses were last revised.

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/wrapping/one_surface.h"
#include "condyle/wrapping/straight_piece.h"
#include "condyle/wrapping/wrapped_path.h"

namespace condyle {

/// The numbers of a path, read.
class PathNumbers {
 public:
  static constexpr int numbers(std::size_t wraps) {
    const int n = static_cast<int>(wraps);
    return kHead + kPerWrap * n + (n <= kMostNoted ? kNoted : 0) + (n <= kMostWithEnd ? kEnd : 0);
  }

  PathNumbers(const double* numbers, std::size_t wraps)
      : r_(numbers), end_at_(wraps <= kMostWithEnd ? kHead + kPerWrap * wraps + kNoted : 0) {}

  [[nodiscard]] bool known() const { return !std::isnan(r_[0]); }
  [[nodiscard]] WrappedPath::Finding finding() const {
    return {static_cast<WrappedPath::Outcome>(static_cast<int>(r_[0])), static_cast<int>(r_[1]),
            r_[2]};
  }
  /// The length where the path was last followed, kNoted numbers; the first is 0 where it may have
  /// changed since. Null where there is no room for them.
  static constexpr int kNoted = 11;
  template <class Number>
  [[nodiscard]] static Number* noted(Number* numbers, std::size_t wraps) {
    return wraps <= kMostNoted ? numbers + kHead + kPerWrap * wraps : nullptr;
  }

  [[nodiscard]] bool touches(int wrap) const { return of(wrap)[0] == 1; }
  [[nodiscard]] ArcPlace place(int wrap) const {
    const double* w = of(wrap);
    return {{w[1], w[2], w[3]}, {w[4], w[5], w[6]}, w[7]};
  }
  /// Where the geodesic on the surface ends, if that is kept: of one surface, that was touched alone.
  [[nodiscard]] std::optional<ArcEnd> end(int wrap) const {
    if (end_at_ == 0 || r_[end_at_] != wrap) return std::nullopt;
    const double* e = r_ + end_at_ + 1;
    return ArcEnd{{e[0], e[1], e[2]}, {e[3], e[4], e[5]}, e[6], e[7], e[8], e[9], e[10]};
  }
  /// Of a surface that it is off: the normal where it passes; 0 where that is not known.
  [[nodiscard]] Eigen::Vector3d side(int wrap) const { return place(wrap).P; }
  /// And the piece that passed it when the statuses were last revised, if that is known.
  [[nodiscard]] std::optional<StraightPiece> line(int wrap) const {
    const double* w = of(wrap);
    if (touches(wrap) || std::isnan(w[4])) return std::nullopt;
    return StraightPiece{{w[4], w[5], w[6]}, {w[7], w[8], w[9]}};
  }

 protected:
  static constexpr int kHead = 3, kPerWrap = 10, kEnd = 12;
  static constexpr int kMostNoted = 6, kMostWithEnd = 4;
  static_assert(kHead + kMostWraps * kPerWrap <= kMostPathNumbers);
  static_assert(kHead + kMostNoted * kPerWrap + kNoted <= kMostPathNumbers);
  static_assert(kHead + kMostWithEnd * kPerWrap + kNoted + kEnd <= kMostPathNumbers);

  const double* r_;
  std::size_t end_at_;  ///< where the end of a geodesic is kept; 0 where it is not

 private:
  [[nodiscard]] const double* of(int wrap) const { return r_ + kHead + kPerWrap * wrap; }
};

/// The same, written.
class PathState : public PathNumbers {
 public:
  PathState(double* numbers, std::size_t wraps)
      : PathNumbers(numbers, wraps),
        d_(numbers),
        noted_(PathNumbers::noted(numbers, wraps)),
        end_(end_at_ > 0 ? numbers + end_at_ : nullptr) {}

  void set(WrappedPath::Outcome outcome, int wrap, double conjugate) {
    d_[0] = static_cast<double>(outcome);
    d_[1] = wrap;
    d_[2] = conjugate;
  }
  [[nodiscard]] double* noted() { return noted_; }
  void forget_length() {
    if (noted_ != nullptr) std::fill_n(noted_, kNoted, 0.0);
  }

  void touch(int wrap, const ArcPlace& at) {
    double* w = of(wrap);
    std::fill_n(w, kPerWrap, 0.0);
    w[0] = 1;
    for (int i = 0; i < 3; ++i) {
      w[1 + i] = at.P[i];
      w[4 + i] = at.t[i];
    }
    w[7] = at.arc;
    forget_length();
    if (end_ == nullptr) return;
    if (std::isnan(end_[0])) std::fill(end_, end_ + kEnd, -1.0);
    end_[0] = -1;
  }
  /// To be told after the place.
  void set_end(int wrap, const ArcEnd& end) {
    if (end_ == nullptr) return;
    end_[0] = wrap;
    for (int i = 0; i < 3; ++i) {
      end_[1 + i] = end.Q[i];
      end_[4 + i] = end.t[i];
    }
    end_[7] = end.a;
    end_[8] = end.da;
    end_[9] = end.r;
    end_[10] = end.dr;
    end_[11] = end.size;
  }
  /// Off the surface; `side`: the normal there, 0 where it is not known; `line`: the piece that passes it.
  void leave(int wrap, const Eigen::Vector3d& side, const std::optional<StraightPiece>& line = {}) {
    touch(wrap, {side, Eigen::Vector3d::Zero(), 0});
    double* w = of(wrap);
    w[0] = 0;
    for (int i = 0; i < 3; ++i) {
      w[4 + i] = line ? line->U[i] : NAN;
      w[7 + i] = line ? line->V[i] : NAN;
    }
  }

 private:
  [[nodiscard]] double* of(int wrap) { return d_ + kHead + kPerWrap * wrap; }

  double* d_;
  double* noted_;
  double* end_;
};

}  // namespace condyle
