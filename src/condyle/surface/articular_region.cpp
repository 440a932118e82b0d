#include "condyle/surface/articular_region.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/math/decompositions.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/condyle_chart.h"
#include "condyle/surface/grow_region.h"
#include "condyle/surface/outermost_part.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCrestCosine = 0.55;   // of normal and radial direction: what the chart follows
constexpr double kPlateauCosine = 0.5;  // of normal and plateau direction: what gives its slope
constexpr double kChartCosine = 0.5;    // of normal and chart direction: beyond it the chart folds
constexpr double kGrownCosine = 0.3;    // the same of what goes on beyond the limits
constexpr double kBeyondCrest = 3;      // that a plateau may reach over its crest [mm]
constexpr double kBeyondDivide = 8;     // that a condyle may reach over the dividing plane [mm]

/// Normals averaged over a few rings, about as far as `distance`; a staircase of voxels has no say
/// in them.
std::vector<Vector3d> smoothed_normals(const TriangleMesh& mesh, double distance) {
  std::vector<Vector3d> normals = vertex_normals(mesh);
  const double edge = mean_edge_length(mesh);
  const int rounds =
      edge > 0
          ? std::clamp(static_cast<int>(std::lround(distance * distance / (edge * edge))), 0, 12)
          : 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vector3d> next(normals.size(), Vector3d::Zero());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3d sum = normals[a] + normals[b] + normals[c];
      next[a] += sum, next[b] += sum, next[c] += sum;
    }
    for (Vector3d& n : next) n = n.stableNormalized();
    normals = std::move(next);
  }
  return normals;
}

/// The largest linked part of the triangles whose three vertices all pass, of those that lie outermost.
OutermostPart select(const TriangleMesh& mesh, const std::vector<bool>& vertex_passes) {
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    keep[t] = vertex_passes[a] && vertex_passes[b] && vertex_passes[c];
  }
  return outermost_part(mesh, keep);
}

using Chart = std::function<Vector2d(const Vector3d&)>;
using ChartDirection = std::function<Vector3d(const Vector3d&)>;

/// Vertices of the triangles that are kept.
std::vector<bool> vertices_of(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  std::vector<bool> used(mesh.vertices.size());
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t])
      for (const int v : mesh.triangles[t]) used[v] = true;
  return used;
}

/// The triangles that are kept, with those of `face` as the articular face proper.
ArticularRegion make_region(const TriangleMesh& mesh,
                            const std::vector<bool>& keep,
                            const std::vector<bool>& face,
                            const Chart& chart,
                            const ChartDirection& direction) {
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  const std::vector<bool> on_face = vertices_of(mesh, face);
  const SubMesh part = sub_mesh(mesh, keep);
  ArticularRegion region;
  region.mesh = part.mesh;
  for (std::size_t i = 0; i < part.mesh.vertices.size(); ++i) {
    const Vector3d& p = part.mesh.vertices[i];
    region.normals.push_back(normals[part.old_index[i]]);
    region.face.push_back(on_face[part.old_index[i]]);
    region.chart.push_back(chart(p));
    region.slope.push_back(region.normals.back().dot(direction(p)));
  }
  if (region.mesh.triangles.empty()) throw InputError("no articular area found");
  return region;
}

/// Is a vertex within the box of the options?
bool in_box(const RegionOptions& options, const Vector3d& p) {
  if (!options.box) return true;
  Eigen::AlignedBox3d box((*options.box)[0]);
  box.extend((*options.box)[1]);
  return box.contains(p);
}

/// Area vector of the triangles that are kept [mm²].
Vector3d total_area(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  const std::vector<Vector3d> areas = triangle_areas(mesh);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t]) sum += areas[t];
  return sum;
}

Vector3d centroid(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t]) {
      sum += triangle_middle(mesh, mesh.triangles[t]);
      ++count;
    }
  return sum / std::max(count, 1.0);
}

/// Region and chart over a plane, (0, 0) at `origin`: `forward` gives the direction of u.
ArticularRegion plane_region(const TriangleMesh& mesh,
                             const std::vector<bool>& keep,
                             const std::vector<bool>& face,
                             const Vector3d& origin,
                             const Vector3d& height,
                             const Vector3d& forward) {
  const Vector3d u = (forward - height * height.dot(forward)).normalized(), v = height.cross(u);
  return make_region(
      mesh, keep, face,
      [=](const Vector3d& p) { return Vector2d(u.dot(p - origin), v.dot(p - origin)); },
      [=](const Vector3d&) { return height; });
}

/// Inner ends of the two plateaus, along the lateral direction [mm].
struct InnerEnds {
  double medial, lateral;
};

/// Of their articular faces, and of all that belongs to either.
struct PlateauEnds {
  InnerEnds face, all;
};

/// In the gap between two sheets. On a whole bone the faces end at the crests of the medial and the
/// lateral half of the eminence, and what belongs to them 3 mm beyond, or at the saddle between. A
/// mesh that is deeper than wide is one plateau alone.
PlateauEnds inner_ends(const TriangleMesh& mesh,
                       const BoneFrame& frame,
                       const std::vector<bool>& upward) {
  std::vector<double> z;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!upward[i]) continue;
    const Vector3d p = frame.components(mesh.vertices[i] - frame.origin);
    box.extend(p);
    z.push_back(p.z());
  }
  if (z.size() < 20)
    throw InputError(
        "no tibial plateau found: expected faces towards the proximal direction of [joint]");
  if (box.sizes().z() < 1.1 * box.sizes().x()) {
    const InnerEnds none{box.max().z() + 1, box.min().z() - 1};
    return {none, none};
  }
  const double first = box.min().z(), extent = box.sizes().z();
  if (const Gap gap = widest_gap(std::move(z)); gap.width > 0.03 * extent)
    return {{gap.center, gap.center}, {gap.center, gap.center}};

  constexpr int kBins = 40;
  std::vector<double> top(kBins, -1e300);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!upward[i]) continue;
    const Vector3d p = frame.components(mesh.vertices[i] - frame.origin);
    const int bin = std::clamp(static_cast<int>((p.z() - first) / extent * kBins), 0, kBins - 1);
    top[bin] = std::max(top[bin], p.y());
  }
  const auto highest = [&](int from, int to) {
    return std::max_element(top.begin() + from, top.begin() + to) - top.begin();
  };
  const auto medial = highest(kBins / 3, kBins / 2),
             lateral = highest(kBins / 2, kBins - kBins / 3);
  const auto lowest = std::min_element(top.begin() + medial, top.begin() + lateral) - top.begin();
  const auto place = [&](std::ptrdiff_t bin) {
    return first + (static_cast<double>(bin) + 0.5) / kBins * extent;
  };
  return {{place(medial), place(lateral)},
          {std::min(place(lowest), place(medial) + kBeyondCrest),
           std::max(place(lowest), place(lateral) - kBeyondCrest)}};
}

}  // namespace

ArticularRegion femoral_region(const TriangleMesh& mesh,
                               const CondylarAxis& axis,
                               Half half,
                               const RegionOptions& options) {
  const double radius = half == Half::kMedial ? axis.medial_radius : axis.lateral_radius;
  const std::vector<Vector3d> normals = smoothed_normals(mesh, options.normal_smoothing);
  const auto may = [&](std::size_t i, const AboutAxis& q) {
    return q.radius > 0.55 * radius && q.radius < 2.2 * radius && in_box(options, mesh.vertices[i]);
  };
  const auto passing = [&](const auto& test) {
    std::vector<bool> passes(mesh.vertices.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const AboutAxis q = about_axis(axis, mesh.vertices[i]);
      passes[i] = q.angle > options.femur_first_angle && q.angle < options.femur_last_angle &&
                  may(i, q) && test(i, q);
    }
    return select(mesh, passes);
  };
  // Beyond the dividing plane, positive towards the other condyle.
  const auto beyond = [half](const AboutAxis& q) {
    return half == Half::kMedial ? q.along : -q.along;
  };
  const auto [crest, crest_below] = passing([&](std::size_t i, const AboutAxis& q) {
    return beyond(q) < 0 && normals[i].dot(q.radial) > kCrestCosine;
  });
  const CondyleChart chart(mesh, crest, axis, radius);
  const auto [keep, below] = passing([&](std::size_t i, const AboutAxis& q) {
    return beyond(q) < kBeyondDivide && normals[i].dot(q.radial) > options.femur_least_cosine &&
           normals[i].dot(chart.direction(mesh.vertices[i])) > kChartCosine;
  });
  std::vector<bool> grows(mesh.vertices.size());
  for (std::size_t i = 0; i < grows.size(); ++i)
    grows[i] = may(i, about_axis(axis, mesh.vertices[i])) &&
               normals[i].dot(chart.direction(mesh.vertices[i])) > kGrownCosine;
  ArticularRegion region = make_region(
      mesh, grow_region(mesh, keep, grows, options.beyond), crest,
      [&](const Vector3d& p) { return chart.at(p); },
      [&](const Vector3d& p) { return chart.direction(p); });
  double low = 10, high = -10;
  for (const Vector2d& uv : region.chart) {
    low = std::min(low, uv.x() / radius);
    high = std::max(high, uv.x() / radius);
  }
  region.notes.push_back(fmt::format(
      "condylar axis: radius {:.2f} mm, {:.2f} mm rms; condyle from {:.0f} to {:.0f} degrees",
      radius, axis.rms, low * 180 / M_PI, high * 180 / M_PI));
  region.sheet_below = std::max(below, crest_below);
  return region;
}

ArticularRegion tibial_region(const TriangleMesh& mesh,
                              const BoneFrame& frame,
                              Half half,
                              const RegionOptions& options) {
  const std::vector<Vector3d> normals = smoothed_normals(mesh, options.normal_smoothing);
  double top = -1e300, low = 1e300, high = -1e300;
  for (const Vector3d& p : mesh.vertices) {
    const Vector3d q = frame.components(p - frame.origin);
    top = std::max(top, q.y());
    low = std::min(low, q.z());
    high = std::max(high, q.z());
  }
  const double depth = 0.4 * (high - low);  // of the head below the eminence
  std::vector<bool> upward(mesh.vertices.size());
  for (std::size_t i = 0; i < upward.size(); ++i)
    upward[i] = normals[i].dot(frame.proximal) > kPlateauCosine &&
                frame.proximal.dot(mesh.vertices[i] - frame.origin) > top - depth;
  const PlateauEnds ends = inner_ends(mesh, frame, upward);

  Vector3d height = frame.proximal;
  const auto is_on_side = [&](const InnerEnds& inner, std::size_t i) {
    const Vector3d q = frame.components(mesh.vertices[i] - frame.origin);
    return (half == Half::kMedial ? q.z() < inner.medial : q.z() > inner.lateral) &&
           q.y() > top - depth && in_box(options, mesh.vertices[i]);
  };
  // Vertices whose normal is steeper than that of a plateau pass only on the inner side of
  // `middle`.
  const auto passing = [&](const InnerEnds& inner, double middle, double least_cosine) {
    std::vector<bool> passes(mesh.vertices.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const double z = frame.lateral.dot(mesh.vertices[i] - frame.origin);
      const double least = (z > middle) == (half == Half::kMedial) ? least_cosine : kPlateauCosine;
      passes[i] = is_on_side(inner, i) && normals[i].dot(height) > least;
    }
    return select(mesh, passes);
  };
  OutermostPart outermost;
  const std::vector<bool>& face = outermost.keep;
  for (int round = 0; round < 3; ++round) {
    outermost = passing(ends.face, 0, kPlateauCosine);
    if (std::find(face.begin(), face.end(), true) == face.end())
      throw InputError("no tibial plateau found");
    height = total_area(mesh, face).normalized();
  }
  const double middle = frame.lateral.dot(centroid(mesh, face) - frame.origin);
  const auto [keep, below] = passing(ends.all, middle, options.tibia_least_cosine);
  std::vector<bool> grows(mesh.vertices.size());
  for (std::size_t i = 0; i < grows.size(); ++i)
    grows[i] = is_on_side(ends.all, i) && normals[i].dot(height) > kGrownCosine;
  ArticularRegion region = plane_region(mesh, grow_region(mesh, keep, grows, options.beyond), face,
                                        frame.origin, height, frame.anterior);
  const Vector3d h = frame.components(height);
  region.notes.push_back(
      fmt::format("plateau slopes {:.1f} degrees backwards, {:.1f} towards lateral",
                  std::atan2(-h.x(), h.y()) * 180 / M_PI, std::atan2(h.z(), h.y()) * 180 / M_PI));
  region.sheet_below = std::max(below, outermost.below);
  return region;
}

ArticularRegion box_region(const TriangleMesh& mesh, const std::array<Vector3d, 2>& corners) {
  Eigen::AlignedBox3d box(corners[0]);
  box.extend(corners[1]);
  const Vector3d round_off = Vector3d::Constant(1e-9 * box.diagonal().norm());
  box = {box.min() - round_off, box.max() + round_off};
  std::vector<bool> inside(mesh.vertices.size());
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = box.contains(mesh.vertices[i]);
  const std::vector<bool> all = select(mesh, inside).keep;
  const Vector3d height = total_area(mesh, all).stableNormalized();
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < inside.size(); ++i)
    inside[i] = inside[i] && normals[i].dot(height) > 0.25;
  const auto [keep, below] = select(mesh, inside);
  if (std::find(keep.begin(), keep.end(), true) == keep.end())
    throw InputError("the region box holds no part of the mesh");

  const Vector3d center = centroid(mesh, keep);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t]) {
      const Vector3d q = triangle_middle(mesh, mesh.triangles[t]) - center;
      const Vector3d flat = q - height * height.dot(q);
      spread += flat * flat.transpose();
    }
  Vector3d forward = symmetric_eigenvalues(spread).vectors.col(2);
  double third = 0;  // moment: an axis has no sense of its own
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t])
      third += std::pow(forward.dot(triangle_middle(mesh, mesh.triangles[t]) - center), 3);
  if (third < 0) forward = -forward;
  ArticularRegion region = plane_region(mesh, keep, keep, center, height, forward);
  region.sheet_below = below;
  return region;
}

}  // namespace condyle
