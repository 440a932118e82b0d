#pragma once

/// A string over surfaces for tests: both ends are told in the ground frame, body A standing at the
/// identity, and what it keeps goes from call to call.

#include <optional>
#include <vector>

#include "condyle/elements/line_element.h"
#include "condyle/wrapping/wrapped_path.h"

namespace condyle::test {

struct StringEnds {
  double length;
  Eigen::Vector3d e_X, e_Y;    ///< unit tangents from X to Y
  Eigen::Matrix3d H_XX, H_YY;  ///< second derivatives of the length
};

/// Surfaces are on B unless `on_A` says otherwise; placements are the identity unless given.
class StringOver {
 public:
  explicit StringOver(const std::vector<WrapShape>& shapes,
                      const std::vector<std::optional<Eigen::Vector3d>>& sides = {},
                      const std::vector<RigidTransform>& placements = {},
                      const std::vector<bool>& on_A = {},
                      InsideRule inside = InsideRule::kAnchor) {
    std::vector<PathWrap> wraps, other;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      PathWrap wrap{"surface", shapes[i], {}, false, {}};
      if (i < sides.size()) wrap.side = sides[i];
      if (i < placements.size()) wrap.placement = placements[i];
      if (i < on_A.size()) wrap.on_moving = on_A[i];
      wraps.push_back(wrap);
      wrap.on_moving = true;
      other.push_back(wrap);
    }
    const Eigen::Vector3d none = Eigen::Vector3d::Constant(1e6);
    path_ = make_wrapped_path(wraps, none, none, inside);
    all_on_A_ = make_wrapped_path(other, none, none, inside);
  }

  [[nodiscard]] std::shared_ptr<const WrappedPath> path() const { return path_; }
  [[nodiscard]] double* kept() { return kept_.data(); }
  void forget() { kept_ = unknown_path(); }

  double length(const Eigen::Vector3d& X, const Eigen::Vector3d& Y) {
    return path_->length({X, Y, Y}, {}, kept_.data());
  }
  /// Statuses held.
  StringEnds ends(const Eigen::Vector3d& X, const Eigen::Vector3d& Y) {
    StringEnds result;
    Wrench on_B, on_A;
    result.length = path_->pull({X, Y, Y}, {}, kept_.data(), on_B);
    std::array<double, kMostPathNumbers> same = kept_;
    all_on_A_->pull({X, Y, Y}, {}, same.data(), on_A);
    // F = -e on A; with the surfaces on A, O_A and A's frame carry them while X stays.
    result.e_Y = -on_B.f;
    result.H_YY = -on_B.F1;
    result.e_X = -on_A.f;
    result.H_XX = -on_A.F1;
    return result;
  }
  [[nodiscard]] std::vector<LineTouch> touches(const Eigen::Vector3d& X,
                                               const Eigen::Vector3d& Y) const {
    return path_->touches({X, Y, Y}, {}, kept_.data());
  }
  [[nodiscard]] WrappedPath::Finding finding(const Eigen::Vector3d& X,
                                             const Eigen::Vector3d& Y) const {
    return path_->finding({X, Y, Y}, {}, kept_.data());
  }
  bool revise(const Eigen::Vector3d& X, const Eigen::Vector3d& Y) {
    return path_->revise({X, Y, Y}, {}, kept_.data());
  }

 private:
  std::shared_ptr<const WrappedPath> path_, all_on_A_;
  std::array<double, kMostPathNumbers> kept_ = unknown_path();
};

}  // namespace condyle::test
