#include "condyle/study/patch_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/math/no_number.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/point_tree.h"
#include "condyle/surface/fit_patch.h"

namespace condyle {
namespace {

/// Covariances of heights: at lag 0, then of pairs around each multiple of the step.
constexpr int kLags = 11;
constexpr double kLagStep = 0.5;  // [mm]
using Covariance = std::array<double, kLags>;

struct MeasuredCovariance {
  Covariance value{};
  Covariance weight{};  ///< pairs for each vertex, 1 at most: lags shorter than edges have few
};

constexpr double kLongestTexture = 5, kTextureRatio = 1.06;  // [mm]

/// Those in the middle: more than 4 mm from the edge, or half as far as any where the patch is narrow.
std::vector<const VertexOverPatch*> core_of(const std::vector<VertexOverPatch>& vertices) {
  constexpr double kCore = 4;  // [mm]
  double farthest = 0;
  for (const VertexOverPatch& v : vertices) farthest = std::max(farthest, v.edge_distance);
  const double least = std::min(kCore, farthest / 2);
  std::vector<const VertexOverPatch*> core;
  for (const VertexOverPatch& v : vertices)
    if (v.edge_distance > least) core.push_back(&v);
  return core;
}

MeasuredCovariance covariance_of(const std::vector<const VertexOverPatch*>& core) {
  Covariance sum{}, count{};
  constexpr double kFarthest = (kLags - 0.5) * kLagStep;
  std::vector<Eigen::Vector3d> places;
  for (const VertexOverPatch* v : core) places.push_back(v->closest);
  const PointCloud cloud{places};
  const PointTree tree(3, cloud);
  std::vector<std::pair<std::size_t, double>> near;
  for (std::size_t i = 0; i < core.size(); ++i) {
    sum[0] += core[i]->height * core[i]->height;
    count[0] += 1;
    points_within(tree, places[i], kFarthest, near);
    for (const auto& [j, d2] : near) {
      if (j <= i) continue;
      // NOLINTNEXTLINE(bugprone-incorrect-roundings): it is never negative, and lround is slow.
      const auto lag = static_cast<std::size_t>(std::sqrt(d2) / kLagStep + 0.5);
      if (lag == 0) continue;
      sum[lag] += core[i]->height * core[j]->height;
      count[lag] += 1;
    }
  }
  MeasuredCovariance measured;
  for (std::size_t k = 0; k < kLags; ++k) {
    if (count[k] > 0) measured.value[k] = sum[k] / count[k];
    measured.weight[k] = std::min(1., count[k] / static_cast<double>(core.size()));
  }
  return measured;
}

/// The smoothing length where the heights are: shorter near the edge.
double mean_smoothing(const std::vector<const VertexOverPatch*>& core,
                      const PatchDescription& surface,
                      double length) {
  const bool plain = surface.smoothing || surface.smooth_for_position;
  const EdgeSmoothing& edge = plain ? kPlainEdge : kNormalsEdge;
  double sum = 0;
  for (const VertexOverPatch* v : core)
    sum += edge.edge + (1 - edge.edge) * std::clamp(v->edge_distance / edge.band, 0., 1.);
  return length * sum / static_cast<double>(core.size());
}

/// Of heights left beside a fit by a texture of 1 mm rms.
Covariance left_of_texture(double correlation, double smoothing) {
  constexpr int kSteps = 160;
  const double greatest = 6 / correlation, dk = greatest / kSteps;
  Covariance left{};
  for (int i = 0; i < kSteps; ++i) {
    const double k = (i + 0.5) * dk, q = std::pow(smoothing * k, 6), cut = q / (1 + q);
    const double weight = correlation * correlation *
                          std::exp(-k * k * correlation * correlation / 2) * cut * cut * k * dk;
    for (int lag = 0; lag < kLags; ++lag)
      left[static_cast<std::size_t>(lag)] += weight * std::cyl_bessel_j(0, k * lag * kLagStep);
  }
  return left;
}

}  // namespace

std::vector<VertexOverPatch> vertices_over_patch(const TriangleMesh& mesh,
                                                 const std::vector<int>& candidates,
                                                 const Surface& patch,
                                                 double offset) {
  constexpr double kBeyondKnown = 2, kFarthest = 2, kLeastCosine = 0.5;
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  std::vector<VertexOverPatch> over;
  for (const int i : candidates) {
    const Eigen::Vector3d& p = mesh.vertices[i];
    const Place place = patch.closest(p, patch.seed(p));
    const SurfacePoint at = patch.evaluate_frame(place);
    const Eigen::Vector3d closest = at.c - offset * at.n;
    const double edge = patch.edge_distance(place);
    if (edge < -kBeyondKnown || (p - closest).norm() > kFarthest ||
        std::abs(at.n.dot(normals[i])) < kLeastCosine)
      continue;
    over.push_back({i, closest, at.n, at.n.dot(p - closest), edge});
  }
  return over;
}

std::size_t vertices_that_tell(const std::vector<VertexOverPatch>& vertices) {
  return core_of(vertices).size();
}

bool is_broad(const PatchTexture& texture) {
  return texture.correlation * kTextureRatio >= kLongestTexture;
}

PatchTexture texture_beside(const std::vector<VertexOverPatch>& vertices,
                            const PatchDescription& surface,
                            const FitReport& report) {
  const std::vector<const VertexOverPatch*> core = core_of(vertices);
  PatchTexture texture;
  if (core.size() < kFewestOfTexture) return {kNoNumber, kNoNumber, kNoNumber};
  const MeasuredCovariance measured = covariance_of(core);
  texture.left = std::sqrt(measured.value[0]);
  const double smoothing = mean_smoothing(core, surface, report.smoothing_length);
  constexpr double kShortest = 0.3;
  double least = std::numeric_limits<double>::infinity();
  for (double l = kShortest; l < kLongestTexture; l *= kTextureRatio) {
    const Covariance expected = left_of_texture(l, smoothing);
    double both = 0, square = 0, misfit = 0;
    for (std::size_t k = 0; k < kLags; ++k) {
      both += measured.weight[k] * measured.value[k] * expected[k];
      square += measured.weight[k] * expected[k] * expected[k];
    }
    const double variance = std::max(0., both / square);
    for (std::size_t k = 0; k < kLags; ++k)
      misfit += measured.weight[k] * std::pow(measured.value[k] - variance * expected[k], 2);
    if (misfit >= least) continue;
    least = misfit;
    texture.rms = std::sqrt(variance);
    texture.correlation = l;
  }
  return texture;
}

}  // namespace condyle
