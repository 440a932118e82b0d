#include "condyle/wrapping/solve_chain.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "condyle/wrapping/chain_system.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

SurfaceFrame turned(const RigidTransform& X, const SurfaceFrame& f) {
  SurfaceFrame result = f;
  result.x = X * f.x;
  result.t = X.R * f.t;
  result.n = X.R * f.n;
  result.b = X.R * f.b;
  return result;
}

/// The largest of the steps, in rad and in radii of curvature.
double size_of(const PathChain& chain, const ChainVector& step) {
  double size = 0;
  for (int i = 0; i < chain.n; ++i) {
    const Geodesic& g = chain.links[i].g;
    const double k = largest_curvature(g.from), k_Q = largest_curvature(g.to);
    const double s = std::max(std::abs(step[4 * i + 1]), std::abs(step[4 * i + 2]));
    size = std::max({size, std::abs(step[4 * i]), k * s, k_Q * std::abs(step[4 * i + 3])});
  }
  return size;
}

void take(PathChain& chain, const ChainVector& step) {
  for (int i = 0; i < chain.n; ++i) {
    ChainLink& link = chain.links[i];
    const Eigen::Matrix3d R_SG = link.X_GS.R.transpose();
    const Vector3d t = R_SG * link.g.from.t, b = R_SG * link.g.from.b;
    if (!link.starts_here)
      link.P = onto_surface(*link.shape, link.P + step[4 * i + 2] * t + step[4 * i + 1] * b);
    link.t = std::cos(step[4 * i]) * t + std::sin(step[4 * i]) * b;
    link.arc += step[4 * i + 3];
  }
}

/// No piece runs backwards.
bool runs_ahead(const PathChain& chain) {
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    if (!link.starts_here && !((link.g.from.x - before(chain, i)).dot(link.g.from.t) > 0))
      return false;
    if (!link.ends_here && !((after(chain, i) - link.g.to.x).dot(link.g.to.t) > 0)) return false;
  }
  return true;
}

}  // namespace

bool shoot_links(PathChain& chain) {
  for (int i = 0; i < chain.n; ++i) {
    ChainLink& link = chain.links[i];
    if (!link.P.allFinite() || !link.t.allFinite() || !std::isfinite(link.arc)) return false;
    link.g = shoot(*link.shape, frame_at(*link.shape, link.P, link.t), link.arc);
    if (!link.g.found) return false;
    link.g.from = turned(link.X_GS, link.g.from);
    link.g.to = turned(link.X_GS, link.g.to);
  }
  return true;
}

bool solve(PathChain& chain, int most) {
  constexpr double kLongest = 0.3, kSmall = 1e-8;
  for (int iteration = 0; iteration < most; ++iteration) {
    if (!shoot_links(chain)) return false;
    const Eigen::PartialPivLU<ChainMatrix> lu(path_error_rates(chain));
    ChainVector step = -path_errors(chain);
    step = lu.solve(step).eval();
    const double size = size_of(chain, step);
    if (!std::isfinite(size)) return false;
    if (size > kLongest) step *= kLongest / size;
    take(chain, step);
    if (size < kSmall) return shoot_links(chain) && runs_ahead(chain);
  }
  return false;
}

double length(const PathChain& chain) {
  double L = 0;
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    L += link.arc;
    if (!link.starts_here) L += (link.g.from.x - before(chain, i)).norm();
    if (!link.ends_here && i + 1 == chain.n) L += (chain.Y - link.g.to.x).norm();
  }
  return L;
}

/// Shifts y of the points P and Q along their b: of a piece from u to v the energy is |Δw|²/(2 l), w = y b,
/// of an arc (a y_P² - 2 y_P y_Q + r' y_Q²)/(2 r). The pivots of this form, times all l and r, are B;
/// of an arc without length the two y are one.
double conjugate(const PathChain& chain) {
  const double L = length(chain);
  double pivot = 0, product = 1 / L;
  bool least = true;
  const auto eliminate = [&](double diagonal, double coupling) {
    pivot = diagonal - (coupling != 0 ? coupling * coupling / pivot : 0);
    product *= pivot;
    least = least && pivot > 0;
  };
  double coupling = 0;  // of the next y with the last one eliminated
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    const Geodesic& g = link.g;
    const double l1 = link.starts_here ? 0 : (g.from.x - before(chain, i)).norm();
    const double l2 = link.ends_here ? 0 : (after(chain, i) - g.to.x).norm();
    least = least && g.presses && (link.arc <= 0 || g.first_of_kind);
    const double short_arc = 1e-7 * L;
    const bool has_P = !link.starts_here, has_Q = !link.ends_here;
    if (has_P) product *= l1;
    if (has_Q && i + 1 == chain.n) product *= l2;
    if (link.arc < short_arc) {
      if (has_P && has_Q) eliminate(1 / l1 + 1 / l2, coupling);
    } else {
      product *= g.r;
      least = least && g.r > 0;
      if (has_P) eliminate(1 / l1 + g.a / g.r, coupling);
      if (has_Q) eliminate(1 / l2 + g.dr / g.r, has_P ? -1 / g.r : 0);
    }
    const bool moves = has_Q && (has_P || link.arc >= short_arc);
    coupling = moves && i + 1 < chain.n ? -g.to.b.dot(chain.links[i + 1].g.from.b) / l2 : 0;
  }
  return least ? product : -std::abs(product);
}

}  // namespace condyle
