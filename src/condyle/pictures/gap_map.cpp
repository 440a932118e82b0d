#include "condyle/pictures/gap_map.h"

#include <algorithm>
#include <cmath>

#include "condyle/pictures/color_map.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/patch.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kFade = 1;      // [mm]
constexpr double kAside = 0.05;  // [mm] of a nearest point beside the normal: the search stopped

/// From p to a surface in its own frame, along its normal.
GapMap::Gap distance_to(const Surface& surface, const Vector3d& p, const Vector3d& n) {
  const Place place = surface.closest(p, surface.seed(p));
  const SurfacePoint at = surface.evaluate_frame(place);
  if (at.n.dot(n) > 0) return {};  // it looks away: another side of the bone
  const double along = at.n.dot(p - at.c);
  const double aside = (p - at.c - along * at.n).norm();
  if (aside > kAside + 0.02 * std::abs(along)) return {};
  return {along, surface.edge_distance(place)};
}

Rgb mixed(Rgb a, Rgb b, double share) {
  for (std::size_t i = 0; i < 3; ++i)
    a[i] = static_cast<std::uint8_t>(std::lround(a[i] + share * (b[i] - a[i])));
  return a;
}

Rgb gap_color(double width) {
  return width < -kLeastOverlap ? kAlarmColor : map_color(ColorMap::kGap, width / kGapLimit);
}

}  // namespace

GapMap::GapMap(const Run& run) : run_(run), surfaces_(run.scene.surfaces.size()) {
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const SurfaceDescription& surface = run.scene.surfaces[i];
    if (surface.kind != SurfaceKind::kPatch) {
      surfaces_[i] = make_exact_surface(surface);
      continue;
    }
    for (const RunPatch& patch : run.patches)
      if (patch.surface == surface.name) surfaces_[i] = std::make_shared<Patch>(patch.data);
  }
}

GapMap::Gap GapMap::gap(std::size_t surface,
                        const Vector3d& p,
                        const Vector3d& n,
                        const std::vector<RigidTransform>& X_P) const {
  const auto pose_of = [&](std::size_t s) {
    return X_P[static_cast<std::size_t>(run_.scene.surfaces[s].body)];
  };
  Gap least;
  for (std::size_t c = 0; c < run_.scene.contacts.size(); ++c) {
    const ContactDescription& contact = run_.scene.contacts[c];
    const auto a = static_cast<std::size_t>(contact.surfaces[0]),
               b = static_cast<std::size_t>(contact.surfaces[1]);
    if (surface != a && surface != b) continue;
    const std::size_t other = surface == a ? b : a;
    if (other >= surfaces_.size() || !surfaces_[other]) continue;
    const RigidTransform X = pose_of(other).inverse() * pose_of(surface);
    Gap here = distance_to(*surfaces_[other], X * p, X.R * n);
    here.contact = here.inside >= 0 ? static_cast<int>(c) : -1;
    if (here.inside >= 0 && (least.inside < 0 || here.width < least.width)) least = here;
  }
  return least;
}

Vector3d GapMap::normal(std::size_t surface, const ShadedVertex& vertex) const {
  if (run_.scene.surfaces[surface].kind == SurfaceKind::kPatch) return vertex.normal.cast<double>();
  const Surface& exact = *surfaces_[surface];
  return exact.evaluate_frame(exact.place_of(vertex.position.cast<double>())).n;
}

double GapMap::paint(ShadedMesh& mesh,
                     std::size_t surface,
                     const std::vector<RigidTransform>& X_P,
                     const Paint& beyond) const {
  double deepest = 0;
  for (ShadedVertex& vertex : mesh.vertices) {
    const Vector3d p = vertex.position.cast<double>();
    const Gap here = gap(surface, p, normal(surface, vertex), X_P);
    const double share = std::clamp(here.inside / kFade, 0.0, 1.0);
    vertex.color = bytes({mixed(beyond.color, gap_color(here.width), share), beyond.through});
    if (share > 0 && here.width < -kLeastOverlap) deepest = std::max(deepest, -here.width);
  }
  return deepest;
}

}  // namespace condyle
