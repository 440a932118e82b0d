#include "condyle/anatomy/surface_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/mesh/point_tree.h"

namespace condyle {

using Eigen::Vector3d;

struct SampledSurface::Index {
  SurfaceSamples samples;
  PointCloud cloud;
  PointTree tree;
  explicit Index(SurfaceSamples s) : samples(std::move(s)), cloud{samples.points}, tree(3, cloud) {}
};

SampledSurface::SampledSurface(SurfaceSamples samples)
    : index_(std::make_unique<Index>(std::move(samples))) {}
SampledSurface::~SampledSurface() = default;
SampledSurface::SampledSurface(SampledSurface&&) noexcept = default;

const SurfaceSamples& SampledSurface::samples() const { return index_->samples; }

std::optional<Opposite> SampledSurface::under(const Vector3d& p,
                                              const Vector3d& normal,
                                              double reach) const {
  constexpr double kLeastCosine = 0.5;
  constexpr std::size_t kNearest = 8;
  std::array<std::size_t, kNearest> near{};
  std::array<double, kNearest> square{};
  const SurfaceSamples& samples = index_->samples;
  // The nearest sample faces the same way nearly always: it is looked for alone, at a third of the cost of eight.
  for (const std::size_t count : {std::size_t{1}, kNearest}) {
    nanoflann::KNNResultSet<double> result(count);
    result.init(near.data(), square.data());
    index_->tree.findNeighbors(result, p.data(), nanoflann::SearchParams());
    for (std::size_t k = 0; k < result.size() && square[k] <= reach * reach; ++k) {
      const Vector3d& n = samples.normals[near[k]];
      if (n.dot(normal) < kLeastCosine) continue;
      const Vector3d d = p - samples.points[near[k]];
      const double height = n.dot(d), beside = (d - height * n).norm();
      if (beside > std::max(1.5 * samples.spacing, 0.7 * std::abs(height))) return std::nullopt;
      return Opposite{near[k], height};
    }
    if (result.size() == 0 || square[0] > reach * reach) return std::nullopt;
  }
  return std::nullopt;
}

namespace {

double robust_deviation(const std::vector<PointPair>& pairs) {
  std::vector<double> sizes;
  for (const PointPair& pair : pairs) sizes.push_back(std::abs(pair.gap));
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

}  // namespace

SurfacePairs pair_surfaces(const MovedSurface& coarse,
                           const MovedSurface& fine,
                           const SurfaceSamples& other_coarse,
                           const SampledSurface& other,
                           double reach) {
  SurfacePairs out;
  const std::size_t n = coarse.points.size();
  std::vector<int> pair_of(n, -1);
  for (std::size_t i = 0; i < n; ++i)
    if (const auto opposite = other.under(coarse.points[i], coarse.normals[i], reach)) {
      pair_of[i] = static_cast<int>(out.pairs.size());
      out.pairs.push_back({coarse.before.points[i], other.samples().points[opposite->sample],
                           other.samples().normals[opposite->sample], opposite->height,
                           coarse.before.areas[i]});
    }
  SurfaceSamples now = fine.before;
  now.points = fine.points;
  now.normals = fine.normals;
  const SampledSurface from_other(std::move(now));
  for (std::size_t j = 0; j < other_coarse.points.size(); ++j) {
    const Vector3d &y = other_coarse.points[j], &normal = other_coarse.normals[j];
    if (const auto opposite = from_other.under(y, normal, reach))
      out.pairs.push_back({fine.before.points[opposite->sample], y, normal,
                           normal.dot(fine.points[opposite->sample] - y), other_coarse.areas[j]});
  }
  constexpr double kDeviations = 4, kLeast = 1;  // [-], [mm]
  const double limit = std::max(kDeviations * robust_deviation(out.pairs), kLeast);
  double sum = 0, squares = 0;
  for (PointPair& pair : out.pairs) {
    const double share = std::max(0.0, 1 - pair.gap * pair.gap / (limit * limit));
    pair.weight *= share * share;
    sum += pair.weight;
    squares += pair.weight * pair.gap * pair.gap;
  }
  out.rms = sum > 0 ? std::sqrt(squares / sum) : 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PointPair* pair = pair_of[i] < 0 ? nullptr : &out.pairs[pair_of[i]];
    out.trust.push_back(pair ? pair->weight / coarse.before.areas[i] : 0);
    out.gaps.push_back(pair ? pair->gap : 0);
  }
  return out;
}

}  // namespace condyle
