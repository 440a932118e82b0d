#include "condyle/pictures/pressure_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/solids.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr Rgb kOutlineColor = {22, 32, 43};

/// Where the depth changes its sign along the edges of a triangle: none or two points.
std::vector<Vector3d> crossings(const std::array<Vector3d, 3>& p,
                                const std::array<double, 3>& depth) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if ((depth[i] > 0) == (depth[j] > 0)) continue;
    points.emplace_back(p[i] + depth[i] / (depth[i] - depth[j]) * (p[j] - p[i]));
  }
  return points;
}

/// The line on a mesh along which the depth is zero; NaN where it is not known.
ShadedMesh outline(const ShadedMesh& mesh, const std::vector<double>& depth, double radius) {
  ShadedMesh lines;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vector3d, 3> p;
    std::array<double, 3> d{};
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mesh.vertices[triangle[i]].position.cast<double>();
      d[i] = depth[triangle[i]];
    }
    if (!std::isfinite(d[0] + d[1] + d[2])) continue;
    const std::vector<Vector3d> ends = crossings(p, d);
    if (ends.size() != 2 || (ends[1] - ends[0]).norm() < 1e-6) continue;
    const Paint paint = {kOutlineColor, 0.9};
    append(lines, tube({{ends[0], radius, paint}, {ends[1], radius, paint}}));
  }
  return lines;
}

}  // namespace

double greatest_pressure(const Run& run) {
  double greatest = 0;
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    for (const ContactResult& contact : pose.contacts)
      if (contact.layer) greatest = std::max(greatest, contact.layer->peak_pressure);
  }
  return greatest;
}

PressureMap::PressureMap(const Run& run) : gaps_(run) {
  const auto elastic = [&](int surface) {
    return run.scene.surfaces[static_cast<std::size_t>(surface)].elastic;
  };
  for (const ContactDescription& contact : run.scene.contacts) {
    laws_.emplace_back();
    if (contact.layer)
      laws_.back().emplace(elastic(contact.surfaces[0]), elastic(contact.surfaces[1]),
                           contact.layer->pressure);
  }
  const double greatest = greatest_pressure(run);
  if (greatest > 0) top_ = round_up_nicely(greatest);
}

std::optional<double> PressureMap::pressure(std::size_t surface,
                                            const Vector3d& p,
                                            const Vector3d& n,
                                            const std::vector<RigidTransform>& X_P) const {
  const GapMap::Gap gap = gaps_.gap(surface, p, n, X_P);
  if (gap.contact < 0 || !laws_[static_cast<std::size_t>(gap.contact)]) return std::nullopt;
  return laws_[static_cast<std::size_t>(gap.contact)]->at(-gap.width).pressure;
}

ShadedMesh PressureMap::paint(ShadedMesh& mesh,
                              std::size_t surface,
                              const std::vector<RigidTransform>& X_P,
                              const Paint& beyond,
                              double line_radius) const {
  std::vector<double> depth;
  for (ShadedVertex& vertex : mesh.vertices) {
    const Vector3d p = vertex.position.cast<double>();
    const GapMap::Gap gap = gaps_.gap(surface, p, gaps_.normal(surface, vertex), X_P);
    const bool layered =
        gap.contact >= 0 && laws_[static_cast<std::size_t>(gap.contact)].has_value();
    depth.push_back(layered ? -gap.width : NAN);
    Rgb color = beyond.color;
    if (layered && gap.width < 0)
      color =
          map_color(ColorMap::kPressure,
                    laws_[static_cast<std::size_t>(gap.contact)]->at(-gap.width).pressure / top_);
    vertex.color = bytes({color, beyond.through});
  }
  return outline(mesh, depth, line_radius);
}

}  // namespace condyle
