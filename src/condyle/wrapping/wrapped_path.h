#pragma once

/// The shortest path of a line element over a sequence of smooth surfaces fixed to either body:
/// straight pieces, and on each surface that it touches a geodesic, without friction. Length, its
/// exact gradient and Hessian, the wrench and its blocks: natural geodesic variations
/// [Scholz 2015], one explicit Newton step where one surface is touched.
///
/// Whether a surface is touched is held while a pose is solved and revised at a pose that has been
/// solved, as with contacts: a path that is off a surface comes to lie on it where the straight line
/// runs through it, one on it leaves where its arc would be negative. L, its gradient and hence the
/// force are continuous there, its Hessian jumps.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/elements/line_path.h"
#include "condyle/wrapping/shape_geometry.h"

namespace condyle {

/// A surface that a path may touch.
struct PathWrap {
  std::string name;
  WrapShape shape;
  RigidTransform placement;  ///< from the surface's frame to that of its body [mm]
  bool on_moving = false;    ///< fixed to A, else to B
  /// A point on the side of the surface that the path passes, frame of its body [mm]. Absent: the
  /// side on which a straight line is nearest to leaving, at the first pose.
  std::optional<Eigen::Vector3d> side;
};

/// What becomes of a path one of whose ends lies inside a surface on that end's own body.
enum class InsideRule {
  kAnchor,   ///< the end is moved to the closest point of the surface and the path begins there
  kStraight  ///< the surface is passed over, as OpenSim does
};

/// Most surfaces of one path.
inline constexpr int kMostWraps = 7;

/// Constant and shared by threads.
class WrappedPath : public LinePath {
 public:
  enum class Outcome {
    kFound,
    kNotShortest,  ///< stationary, and at or past a conjugate point (B <= 0)
    kEndInside,    ///< an end lies inside a surface of the other body
    kNotFound      ///< Newton did not arrive
  };

  [[nodiscard]] virtual const std::vector<PathWrap>& wraps() const = 0;
  /// One for each of wraps(), in order; of a path that kept `kept` at this pose. Allocates for the
  /// caller.
  [[nodiscard]] std::vector<LineTouch> touches(const LineEnds& ends,
                                               const RigidTransform& X_BA,
                                               const double* kept) const {
    std::vector<LineTouch> result;
    add_touches(ends, X_BA, kept, result);
    return result;
  }
  struct Finding {
    Outcome outcome = Outcome::kFound;
    int wrap = -1;  ///< the surface that is to blame
    double conjugate =
        0;  ///< least B/L over the touched surfaces: 1 straight, 0 at a conjugate point
  };
  /// What came of the last pull at `kept`.
  [[nodiscard]] virtual Finding finding(const LineEnds& ends,
                                        const RigidTransform& X_BA,
                                        const double* kept) const = 0;
};

/// How far the end of a line lies inside the surfaces of its own body, the deepest [mm]; 0 outside.
struct InsideEnd {
  int wrap = -1;
  double depth = 0;
};

/// `wraps` in order from C (on B) to D (on A), at most kMostWraps; ends C in the ground frame, D in A's frame:
/// what is anchored there need not be found at each pose. A pull at other ends finds it anew. Throws
/// std::invalid_argument where a radius is not positive, the tube of a torus closes its hole, or there are
/// too many.
[[nodiscard]] std::shared_ptr<const WrappedPath> make_wrapped_path(
    std::vector<PathWrap> wraps,
    const Eigen::Vector3d& x_C,
    const Eigen::Vector3d& s_D,
    InsideRule inside = InsideRule::kAnchor);

/// Of the ends C and D: {C, D}.
[[nodiscard]] std::array<InsideEnd, 2> inside_ends(const std::vector<PathWrap>& wraps,
                                                   const Eigen::Vector3d& x_C,
                                                   const Eigen::Vector3d& s_D);

}  // namespace condyle
