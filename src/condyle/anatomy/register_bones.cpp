#include "condyle/anatomy/register_bones.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/point_tree.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kCoarse = 3, kFine = 1.5;  // spacing of samples [mm]

/// Extent along the shaft [mm].
struct Range {
  double low = 0, high = 0;
};

Range proximal_range(const std::vector<Vector3d>& points, double margin) {
  Range range;  // holds the origin, which is at the joint
  for (const Vector3d& p : points) {
    range.low = std::min(range.low, p.y());
    range.high = std::max(range.high, p.y());
  }
  return {range.low - margin, range.high + margin};
}

/// What is bone: within the range, and not the cut across a shaft, whose normal is along it at the
/// end that is farther from the joint.
std::vector<bool> looked_at(const TriangleMesh& mesh, const Range& range) {
  constexpr double kCut = 10, kCosine = 0.7;  // depth of an oblique cut [mm], of its normal
  constexpr double kShaft = 40;               // nearer to the joint is no shaft [mm]
  const Range whole = proximal_range(mesh.vertices, 0);
  const double end = whole.high > -whole.low ? whole.high : whole.low;
  std::vector<bool> keep;
  for (const auto& t : mesh.triangles) {
    const double at = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]).y() / 3;
    const Vector3d normal = triangle_area(mesh, t).normalized();
    const bool cut = std::abs(end) > kShaft && std::abs(at - end) < kCut &&
                     normal.y() * (end > 0 ? 1 : -1) > kCosine;
    keep.push_back(at >= range.low && at <= range.high && !cut);
  }
  return keep;
}

/// Parts of `samples` that face against what of `from` is next to them are turned.
void turn_parts(SurfaceSamples& samples, const SurfaceSamples& from) {
  const PointCloud cloud{from.points};
  const PointTree tree(3, cloud);
  std::map<int, std::array<double, 2>> votes;  // area against and in all
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const std::size_t nearest = nearest_point(tree, samples.points[i]).index;
    auto& vote = votes[samples.parts[i]];
    vote[0] += samples.areas[i] * samples.normals[i].dot(from.normals[nearest]);
    vote[1] += samples.areas[i];
  }
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    if (votes[samples.parts[i]][0] < -0.2 * votes[samples.parts[i]][1]) samples.normals[i] *= -1;
}

MovedSurface moved_by(const SurfaceSamples& aligned, const LatticeField& field) {
  MovedSurface out{aligned, {}, {}};
  for (std::size_t i = 0; i < aligned.points.size(); ++i) {
    const Vector3d& p = aligned.points[i];
    const Matrix3d F = Matrix3d::Identity() + field.gradient(p);
    out.points.push_back(p + field.at(p));
    // Area vectors go with the cofactors of F.
    Matrix3d cofactors;
    cofactors << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
    out.normals.push_back((cofactors * aligned.normals[i]).normalized());
  }
  return out;
}

struct Stage {
  double spacing, bending, reach;  ///< of the lattice [mm], [mm⁴], of pairs [mm]
  int times;
};
constexpr Stage kStages[] = {{32, 1e5, 12, 3}, {24, 3e4, 10, 3}, {18, 1e4, 8, 2}};

}  // namespace

BoneRegistration register_bones(const TriangleMesh& from,
                                const TriangleMesh& to,
                                const std::vector<Vector3d>& points) {
  constexpr double kMargin = 30, kMore = 15;  // around the points, and around that [mm]
  const Range range = proximal_range(points, kMargin);
  const std::vector<bool> keep = looked_at(from, range),
                          keep_to = looked_at(to, {range.low - kMore, range.high + kMore});
  const SurfaceSamples coarse = sample_surface(from, keep, kCoarse),
                       fine = sample_surface(from, keep, kFine);
  SurfaceSamples to_coarse = sample_surface(to, keep_to, kCoarse),
                 to_fine = sample_surface(to, keep_to, kFine);
  const auto need = [](bool met) {
    if (!met)
      throw InputError(
          "the bones do not lie over each other near the joint: are frames and units right?");
  };
  need(!coarse.points.empty() && !to_coarse.points.empty());
  turn_parts(to_coarse, fine);
  turn_parts(to_fine, fine);
  SampledSurface other(std::move(to_fine));

  const Alignment alignment = align_surfaces(coarse, fine, to_coarse, other);
  const SurfaceSamples aligned = moved(coarse, alignment), aligned_fine = moved(fine, alignment);
  Vector3d low = aligned.points.front(), high = low;
  for (const Vector3d& p : aligned.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  for (const Vector3d& p : points) {
    low = low.cwiseMin(alignment.at(p));
    high = high.cwiseMax(alignment.at(p));
  }
  // A few hundred nodes are solved for at most, however far from the joint a point may be.
  constexpr double kMostCells = 200;
  const double least = std::cbrt((high - low).prod() / kMostCells);
  LatticeField field(low, high, std::max(least, kStages[0].spacing));
  for (const Stage& stage : kStages) {
    LatticeField finer(low, high, std::max(least, stage.spacing));
    for (int i = 0; i < stage.times; ++i) {
      const LatticeField& now = i == 0 ? field : finer;
      const SurfacePairs found = pair_surfaces(moved_by(aligned, now), moved_by(aligned_fine, now),
                                               to_coarse, other, stage.reach);
      finer.fit(found.pairs, {stage.bending});
    }
    field = finer;
  }
  MovedSurface surface = moved_by(aligned, field);
  SurfacePairs found = pair_surfaces(surface, moved_by(aligned_fine, field), to_coarse, other,
                                     kStages[std::size(kStages) - 1].reach);
  need(std::any_of(found.trust.begin(), found.trust.end(), [](double t) { return t > 0; }));
  return {alignment, std::move(field), std::move(other), std::move(surface), std::move(found)};
}

}  // namespace condyle
