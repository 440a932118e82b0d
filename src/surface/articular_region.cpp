#include "surface/articular_region.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "input_error.h"
#include "mesh/mesh_measures.h"
#include "mesh/orient_mesh.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void turn_components(CleanMesh& mesh, const std::vector<double>& outwardness) {
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    const int c = mesh.component[t];
    if (!mesh.closed[c] && outwardness[c] < 0)
      std::swap(mesh.mesh.triangles[t][1], mesh.mesh.triangles[t][2]);
  }
}

int count_inward(const CleanMesh& mesh, const std::vector<double>& outwardness) {
  int count = 0;
  for (std::size_t c = 0; c < outwardness.size(); ++c)
    count += !mesh.closed[c] && outwardness[c] < 0;
  return count;
}

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

/// Keeps the linked part of the largest area.
std::vector<bool> largest_part(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  const SubMesh part = sub_mesh(mesh, keep);
  const std::vector<int> component = find_components(part.mesh, TriangleLinks(part.mesh));
  std::vector<bool> result(keep.size(), false);
  for (std::size_t t = 0, k = 0; t < keep.size(); ++t)
    if (keep[t]) result[t] = component[k++] == 0;
  return result;
}

/// The largest linked part of the triangles whose three vertices all pass.
std::vector<bool> select(const TriangleMesh& mesh, const std::vector<bool>& vertex_passes) {
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    keep[t] = vertex_passes[a] && vertex_passes[b] && vertex_passes[c];
  }
  return largest_part(mesh, keep);
}

using Chart = std::function<Vector2d(const Vector3d&)>;
using ChartDirection = std::function<Vector3d(const Vector3d&)>;

ArticularRegion make_region(const TriangleMesh& mesh,
                            const std::vector<bool>& keep,
                            const Chart& chart,
                            const ChartDirection& direction) {
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  const SubMesh part = sub_mesh(mesh, keep);
  ArticularRegion region;
  region.mesh = part.mesh;
  for (std::size_t i = 0; i < part.mesh.vertices.size(); ++i) {
    const Vector3d& p = part.mesh.vertices[i];
    region.normals.push_back(normals[part.old_index[i]]);
    region.chart.push_back(chart(p));
    region.slope.push_back(region.normals.back().dot(direction(p)));
  }
  if (region.mesh.triangles.empty()) throw InputError("no articular area found");
  return region;
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
      sum += mesh.vertices[mesh.triangles[t][0]];
      ++count;
    }
  return sum / std::max(count, 1.0);
}

/// Region and chart over a plane, (0, 0) at `origin`: `forward` gives the direction of u.
ArticularRegion plane_region(const TriangleMesh& mesh,
                             const std::vector<bool>& keep,
                             const Vector3d& origin,
                             const Vector3d& height,
                             const Vector3d& forward) {
  const Vector3d u = (forward - height * height.dot(forward)).normalized(), v = height.cross(u);
  return make_region(
      mesh, keep, [=](const Vector3d& p) { return Vector2d(u.dot(p - origin), v.dot(p - origin)); },
      [=](const Vector3d&) { return height; });
}

/// Inner ends of the two plateaus, along the lateral direction [mm].
struct InnerEnds {
  double medial, lateral;
};

/// In the gap between two sheets; on a whole bone at the crests of the medial and the lateral half
/// of the eminence. A mesh that is deeper than wide is one plateau alone.
InnerEnds inner_ends(const TriangleMesh& mesh,
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
  if (box.sizes().z() < 1.1 * box.sizes().x()) return {box.max().z() + 1, box.min().z() - 1};
  const double first = box.min().z(), extent = box.sizes().z();
  if (const Gap gap = widest_gap(std::move(z)); gap.width > 0.03 * extent)
    return {gap.center, gap.center};

  constexpr int kBins = 40;
  std::vector<double> top(kBins, -1e300);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!upward[i]) continue;
    const Vector3d p = frame.components(mesh.vertices[i] - frame.origin);
    const int bin = std::clamp(static_cast<int>((p.z() - first) / extent * kBins), 0, kBins - 1);
    top[bin] = std::max(top[bin], p.y());
  }
  const auto crest = [&](int from, int to) {
    const auto highest = std::max_element(top.begin() + from, top.begin() + to);
    return first + (static_cast<double>(highest - top.begin()) + 0.5) / kBins * extent;
  };
  return {crest(kBins / 3, kBins / 2), crest(kBins / 2, kBins - kBins / 3)};
}

}  // namespace

int face_out_of_femur(CleanMesh& mesh) {
  std::vector<Eigen::AlignedBox3d> boxes(mesh.closed.size());
  for (std::size_t t = 0; t < mesh.component.size(); ++t)
    for (const int v : mesh.mesh.triangles[t])
      boxes[mesh.component[t]].extend(mesh.mesh.vertices[v]);
  const std::vector<Vector3d> areas = triangle_areas(mesh.mesh);
  std::vector<double> outwardness(mesh.closed.size(), 0.0);
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const int c = mesh.component[t];
    outwardness[c] +=
        areas[t].dot(mesh.mesh.vertices[mesh.mesh.triangles[t][0]] - boxes[c].center());
  }
  turn_components(mesh, outwardness);
  return count_inward(mesh, outwardness);
}

int face_out_of_tibia(CleanMesh& mesh, const BoneFrame& frame) {
  const std::vector<Vector3d> areas = triangle_areas(mesh.mesh);
  std::vector<double> outwardness(mesh.closed.size(), 0.0);
  for (std::size_t t = 0; t < areas.size(); ++t)
    outwardness[mesh.component[t]] += areas[t].dot(frame.proximal);
  turn_components(mesh, outwardness);
  return count_inward(mesh, outwardness);
}

ArticularRegion femoral_region(const TriangleMesh& mesh,
                               const CondylarAxis& axis,
                               Half half,
                               const RegionOptions& options) {
  const double radius = half == Half::kMedial ? axis.medial_radius : axis.lateral_radius;
  const auto radial = [&axis](const Vector3d& p) -> Vector3d {
    const Vector3d q = p - axis.point;
    return q - axis.direction * axis.direction.dot(q);
  };
  const auto angle = [&axis](const Vector3d& r) {
    return std::atan2(r.dot(axis.posterior), r.dot(axis.distal));
  };

  const std::vector<Vector3d> normals = smoothed_normals(mesh, options.normal_smoothing);
  std::vector<bool> passes(mesh.vertices.size());
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const Vector3d& p = mesh.vertices[i];
    const Vector3d q = radial(p);
    const double r = q.norm(), theta = angle(q),
                 z = axis.direction.dot(p - axis.point) - axis.split;
    passes[i] = (half == Half::kMedial) == (z < 0) && theta > options.femur_first_angle &&
                theta < options.femur_last_angle &&
                normals[i].dot(q) > options.femur_least_cosine * r && r > 0.55 * radius &&
                r < 2.2 * radius;
  }
  ArticularRegion region = make_region(
      mesh, select(mesh, passes),
      [&](const Vector3d& p) {
        return Vector2d(radius * angle(radial(p)), axis.direction.dot(p - axis.point));
      },
      [&](const Vector3d& p) -> Vector3d { return radial(p).normalized(); });
  double low = 10, high = -10;
  for (const Vector2d& uv : region.chart) {
    low = std::min(low, uv.x() / radius);
    high = std::max(high, uv.x() / radius);
  }
  region.notes.push_back(fmt::format(
      "condylar axis: radius {:.2f} mm, {:.2f} mm rms; condyle from {:.0f} to {:.0f} degrees",
      radius, axis.rms, low * 180 / M_PI, high * 180 / M_PI));
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
    upward[i] = normals[i].dot(frame.proximal) > options.tibia_least_cosine &&
                frame.proximal.dot(mesh.vertices[i] - frame.origin) > top - depth;
  const InnerEnds ends = inner_ends(mesh, frame, upward);

  Vector3d height = frame.proximal;
  std::vector<bool> keep;
  for (int round = 0; round < 3; ++round) {
    std::vector<bool> passes(mesh.vertices.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const Vector3d q = frame.components(mesh.vertices[i] - frame.origin);
      passes[i] = (half == Half::kMedial ? q.z() < ends.medial : q.z() > ends.lateral) &&
                  q.y() > top - depth && normals[i].dot(height) > options.tibia_least_cosine;
    }
    keep = select(mesh, passes);
    if (std::find(keep.begin(), keep.end(), true) == keep.end())
      throw InputError("no tibial plateau found");
    height = total_area(mesh, keep).normalized();
  }
  ArticularRegion region = plane_region(mesh, keep, frame.origin, height, frame.anterior);
  const Vector3d h = frame.components(height);
  region.notes.push_back(
      fmt::format("plateau slopes {:.1f} degrees backwards, {:.1f} towards lateral",
                  std::atan2(-h.x(), h.y()) * 180 / M_PI, std::atan2(h.z(), h.y()) * 180 / M_PI));
  return region;
}

ArticularRegion box_region(const TriangleMesh& mesh, const std::array<Vector3d, 2>& corners) {
  Eigen::AlignedBox3d box(corners[0]);
  box.extend(corners[1]);
  std::vector<bool> inside(mesh.vertices.size());
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = box.contains(mesh.vertices[i]);
  const std::vector<bool> all = select(mesh, inside);
  const Vector3d height = total_area(mesh, all).stableNormalized();
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < inside.size(); ++i)
    inside[i] = inside[i] && normals[i].dot(height) > 0.25;
  const std::vector<bool> keep = select(mesh, inside);
  if (std::find(keep.begin(), keep.end(), true) == keep.end())
    throw InputError("the region box holds no part of the mesh");

  const Vector3d center = centroid(mesh, keep);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t]) {
      const Vector3d q = mesh.vertices[mesh.triangles[t][0]] - center;
      const Vector3d flat = q - height * height.dot(q);
      spread += flat * flat.transpose();
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(spread);
  return plane_region(mesh, keep, center, height, principal.eigenvectors().col(2));
}

}  // namespace condyle
