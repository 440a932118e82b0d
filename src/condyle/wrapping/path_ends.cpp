#include "condyle/wrapping/path_ends.h"

#include "condyle/wrapping/shape_geometry.h"

namespace condyle {
namespace {

double distance_from(const PathWrap& wrap, const Eigen::Vector3d& x) {
  return signed_distance(wrap.shape, wrap.placement.inverse() * x);
}

InsideEnd inside_end(const std::vector<PathWrap>& wraps, bool on_A, const Eigen::Vector3d& x) {
  InsideEnd result;
  for (std::size_t i = 0; i < wraps.size(); ++i) {
    if (wraps[i].on_moving != on_A) continue;
    const double depth = -distance_from(wraps[i], x);
    if (depth > result.depth) result = {static_cast<int>(i), depth};
  }
  return result;
}

/// The path begins on `inside.wrap`: the surfaces between it and the end, and those that the anchor lies
/// inside too, have no part in it.
void anchor(const std::vector<PathWrap>& wraps,
            int which,
            const InsideEnd& inside,
            PathEnds& ends) {
  PathEnd& end = ends.end[which];
  const PathWrap& wrap = wraps[inside.wrap];
  end.wrap = inside.wrap;
  end.anchor = closest_point(wrap.shape, wrap.placement.inverse() * end.given);
  end.at = wrap.placement * end.anchor;
  for (int i = 0; i < static_cast<int>(wraps.size()); ++i) {
    if (i == inside.wrap) continue;
    const bool nearer = which == 0 ? i < inside.wrap : i > inside.wrap;
    const bool within = wraps[i].on_moving == (which == 1) && distance_from(wraps[i], end.at) < 0;
    if (nearer || within) ends.passed_over[i] = true;
  }
}

}  // namespace

std::array<InsideEnd, 2> inside_ends(const std::vector<PathWrap>& wraps,
                                     const Eigen::Vector3d& x_C,
                                     const Eigen::Vector3d& s_D) {
  return {inside_end(wraps, false, x_C), inside_end(wraps, true, s_D)};
}

PathEnds path_ends(const std::vector<PathWrap>& wraps,
                   const Eigen::Vector3d& x_C,
                   const Eigen::Vector3d& s_D,
                   InsideRule rule) {
  PathEnds ends;
  const std::array<InsideEnd, 2> inside = inside_ends(wraps, x_C, s_D);
  for (int which = 0; which < 2; ++which) {
    PathEnd& end = ends.end[which];
    end.given = end.at = which == 0 ? x_C : s_D;
    if (inside[which].wrap < 0) continue;
    if (rule == InsideRule::kAnchor) {
      anchor(wraps, which, inside[which], ends);
      continue;
    }
    for (std::size_t i = 0; i < wraps.size(); ++i)
      if (wraps[i].on_moving == (which == 1) && distance_from(wraps[i], end.given) < 0)
        ends.passed_over[i] = true;
  }
  return ends;
}

}  // namespace condyle
