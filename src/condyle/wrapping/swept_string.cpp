#include "condyle/wrapping/swept_string.h"

#include <algorithm>
#include <cmath>

#include "condyle/wrapping/path_pose.h"
#include "condyle/wrapping/path_start.h"
#include "condyle/wrapping/solve_chain.h"
#include "condyle/wrapping/touching_line.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

double longest_way(const StraightPiece& from, const StraightPiece& to) {
  return std::max((to.U - from.U).norm(), (to.V - from.V).norm());
}

/// One step: what is touched is followed, left or come to. False where the string is lost.
bool follow(PathChain& chain, const ChainLink& link, Vector3d& side, double& height) {
  if (chain.n == 0) {
    if (ends_inside(*link.shape, {chain.X, chain.Y, true, true})) return false;
    double part = 0;
    height = clearance(*link.shape, chain.X, chain.Y, &part);
    if (height >= -kTouch) {
      side = normal_at(*link.shape, chain.X + part * (chain.Y - chain.X));
      return true;
    }
    return insert_link(chain, link, &side);
  }
  height = 0;
  if (!solve(chain)) return false;
  if (chain.links[0].arc >= -kTouch) return conjugate(chain) > 0;
  side = normal_at(*link.shape, chain.links[0].P);
  chain.n = 0;
  return true;
}

}  // namespace

bool comes_clear(const StraightPiece& from, const StraightPiece& to, double clearance) {
  constexpr double kSure = 0.5;  // the clearance of an ellipsoid is a distance to first order alone
  return longest_way(from, to) <= kSure * clearance;
}

std::optional<ArcPlace> swept_onto(const WrapShape& shape,
                                   const StraightPiece& from,
                                   const StraightPiece& to) {
  constexpr double kStep = 0.25, kClear = 0.5;
  constexpr int kMost = 64;
  const double way = longest_way(from, to), least = kStep * least_radius(shape);
  if (!(way > 0)) return std::nullopt;
  PathChain chain;
  ChainLink link;
  link.shape = &shape;
  Vector3d side = Vector3d::Zero();
  double gone = 0;
  for (int k = 0; k < kMost; ++k) {
    const double part = gone / way;
    chain.X = from.U + part * (to.U - from.U);
    chain.Y = from.V + part * (to.V - from.V);
    double height = 0;
    if (!follow(chain, link, side, height)) return std::nullopt;
    if (gone == way) {
      if (chain.n == 0 || !(chain.links[0].arc > kTouch)) return std::nullopt;
      return ArcPlace{chain.links[0].P, chain.links[0].t, chain.links[0].arc};
    }
    gone = std::min(way, gone + std::max(least, kClear * height));
  }
  return std::nullopt;
}

}  // namespace condyle
