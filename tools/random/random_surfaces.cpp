#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"
#include "random/random_knee.h"
#include "support/height_patch.h"

namespace condyle::random_knees {
namespace {

using Eigen::Vector3d;

/// About the z axis, so that x stays level.
Eigen::Matrix3d about_z(double angle) { return exp_rotation({0, 0, angle}); }

/// A rounded face that points down, lowest at the origin: radii 12 to 40 mm.
SurfaceDescription convex(Draws& draws, double radius) {
  SurfaceDescription s;
  s.body = 1;
  switch (draws.below(5)) {
    case 0:
      s.kind = SurfaceKind::kSphere;
      s.radius = radius;
      s.point = {0, 0, radius};
      break;
    case 1: {
      s.kind = SurfaceKind::kEllipsoid;
      s.semi_axes = {radius * draws.between(0.6, 1.6), radius * draws.between(0.6, 1.6),
                     radius * draws.between(0.6, 1.6)};
      s.axes = about_z(draws.between(-3, 3));
      s.point = {0, 0, s.semi_axes.z()};
      break;
    }
    case 2:
      s.kind = SurfaceKind::kCylinder;
      s.radius = radius;
      s.length = draws.between(8, 30);
      s.direction = about_z(draws.between(-3, 3)).col(0);
      s.point = {0, 0, radius};
      break;
    case 3:
      s.kind = SurfaceKind::kTorus;
      s.minor_radius = draws.between(4, 12);
      s.radius = s.minor_radius + draws.between(2, 20);
      s.direction = about_z(draws.between(-3, 3)).col(0);
      s.point = {0, 0, s.radius + s.minor_radius};
      break;
    default:
      s.kind = SurfaceKind::kPolynomial;
      s.axes.col(1) = -Vector3d::UnitY();
      s.axes.col(2) = -Vector3d::UnitZ();
      s.terms = {{2, 0, -0.5 / radius}, {0, 2, -0.5 / draws.between(12, 40)}};
      if (draws.chance(0.5)) s.terms.push_back({3, 0, draws.between(-1e-4, 1e-4)});
      s.known_radius = draws.between(8, 20);
  }
  return s;
}

/// What it rests on, level at the origin: hollow, plane or rounded.
SurfaceDescription rest(Draws& draws, double hollow) {
  SurfaceDescription s;
  s.body = 0;
  switch (draws.below(8)) {
    case 0:
      s.kind = SurfaceKind::kPlane;
      s.known_radius = draws.between(8, 30);
      break;
    case 1:
    case 2:
      s.kind = SurfaceKind::kSphere;
      s.solid_inside = false;
      s.radius = hollow;
      s.point = {0, 0, hollow};
      break;
    case 3:
      s.kind = SurfaceKind::kCylinder;
      s.solid_inside = false;
      s.radius = hollow;
      s.point = {0, 0, hollow};
      s.length = draws.between(10, 40);
      s.direction = about_z(draws.between(-3, 3)).col(0);
      break;
    case 4:
      s.kind = SurfaceKind::kEllipsoid;
      s.solid_inside = false;
      s.semi_axes = {hollow * draws.between(1, 2), hollow * draws.between(1, 2), hollow};
      s.axes = about_z(draws.between(-3, 3));
      s.point = {0, 0, hollow};
      break;
    case 5:
      s.kind = SurfaceKind::kTorus;
      s.minor_radius = draws.between(5, 30);
      s.radius = s.minor_radius + draws.between(5, 40);
      s.point = {-s.radius, 0, -s.minor_radius};
      break;
    case 6:
      s.kind = SurfaceKind::kSphere;
      s.radius = draws.between(15, 60);
      s.point = {0, 0, -s.radius};
      break;
    default:
      s.kind = SurfaceKind::kPolynomial;
      s.terms = {{2, 0, draws.between(-0.01, 0.015)}, {0, 2, draws.between(-0.01, 0.015)}};
      if (draws.chance(0.5)) s.terms.push_back({1, 1, draws.between(-0.01, 0.01)});
      if (draws.chance(0.3)) s.terms.push_back({4, 0, draws.between(-1e-5, 1e-5)});
      s.known_radius = draws.between(8, 30);
  }
  return s;
}

/// A bicubic sheet over 24 x 20 mm that bends by κ1 and κ2 upwards [1/mm], with waves of 5 to 16 mm; the solid
/// lies below, or above where it faces down.
PatchData sheet(Draws& draws, double kappa1, double kappa2, bool faces_down, double size) {
  const double U = 12 * size, V = 10 * size, knot = draws.between(1.2, 2.5) * size;
  const double amplitude = draws.chance(0.3) ? 0 : draws.of_any_size(0.005, 0.3);
  std::array<Eigen::Vector4d, 6> waves;
  for (Eigen::Vector4d& w : waves) {
    const double k = 2 * M_PI / draws.between(5, 16), angle = draws.between(0, M_PI);
    w = {k * std::cos(angle), k * std::sin(angle), draws.between(0, 2 * M_PI),
         amplitude / 2.5 * draws.between(0.5, 1)};
  }
  PatchData data = height_patch(U, V, knot, [&](double u, double v) {
    double z = kappa1 * u * u / 2 + kappa2 * v * v / 2;
    for (const Eigen::Vector4d& w : waves) z += w[3] * std::sin(w[0] * u + w[1] * v + w[2]);
    return z;
  });
  data.orientation = faces_down ? -1 : 1;
  // Known is what lies 2 mm within the edge of the sheet, as fits have it.
  data.mask_nu = data.mask_nv = 8;
  const double border = 2 * size;
  for (int i = 0; i <= data.mask_nu; ++i)
    for (int j = 0; j <= data.mask_nv; ++j) {
      const double u = U * (2.0 * i / data.mask_nu - 1), v = V * (2.0 * j / data.mask_nv - 1);
      data.mask.push_back(std::min(U - std::abs(u), V - std::abs(v)) - border);
    }
  return data;
}

void place(SurfaceDescription& s, std::optional<PatchData>& patch, const RigidTransform& X) {
  s.point = X * s.point;
  s.direction = X.R * s.direction;
  s.axes = X.R * s.axes;
  if (!patch) return;
  for (Vector3d& p : patch->control_points) p = X * p;
}

ElasticSurface layer(Draws& draws) {
  return {draws.of_any_size(2, 50), draws.between(0, 0.48), draws.between(1, 4)};
}

SurfaceDescription patch_of(int body) {
  SurfaceDescription surface;
  surface.body = body;
  surface.kind = SurfaceKind::kPatch;
  return surface;
}

struct Compartment {
  bool patches, layers;
  RigidTransform upper, lower;  ///< where their faces lie
};

void add_compartment(Draws& draws, RandomKnee& knee, const Compartment& where, int number) {
  Scene& scene = knee.scene;
  const double radius = draws.between(12, 40);
  const double hollow = radius * (knee.ill == Ill::kConforming
                                      ? 1 + (draws.chance(0.2) ? 0 : draws.of_any_size(1e-7, 1e-2))
                                      : draws.between(1.2, 4));
  const double size = knee.ill == Ill::kTinyPatch ? draws.between(0.05, 0.2) : 1;
  SurfaceDescription upper = convex(draws, radius), lower = rest(draws, hollow);
  std::optional<PatchData> upper_patch, lower_patch;
  if (where.patches) {
    const int which = draws.below(3);
    if (which != 0) {
      upper = patch_of(1);
      upper_patch = sheet(draws, 1 / radius, 1 / draws.between(15, 40), true, size);
    }
    if (which != 1) {
      lower = patch_of(0);
      lower_patch = sheet(draws, draws.between(-0.015, 1 / hollow), draws.between(-0.015, 0.015),
                          false, size);
    }
  }
  for (SurfaceDescription* s : {&upper, &lower})
    if (std::isfinite(s->known_radius)) s->known_radius *= size;
  place(upper, upper_patch, where.upper);
  place(lower, lower_patch, where.lower);
  upper.name = fmt::format("condyle {}", number);
  lower.name = fmt::format("plateau {}", number);
  ContactDescription contact;
  contact.name = fmt::format("contact {}", number);
  const int first = static_cast<int>(scene.surfaces.size());
  contact.surfaces = {first, first + 1};
  if (draws.chance(0.5)) std::swap(contact.surfaces[0], contact.surfaces[1]);
  if (where.layers) {
    const int which = draws.below(4);
    if (which != 0) upper.elastic = layer(draws);
    if (which != 1) lower.elastic = layer(draws);
    contact.layer.emplace();
    if (draws.chance(0.3)) contact.layer->pressure = PressureLaw::kLogarithmic;
  } else if (draws.chance(0.03)) {
    contact.state = draws.chance(0.5) ? ContactState::kClosed : ContactState::kOpen;
  }
  for (const auto& [surface, patch] :
       {std::make_pair(&upper, &upper_patch), std::make_pair(&lower, &lower_patch)}) {
    scene.surfaces.push_back(*surface);
    knee.patches.push_back(*patch);
  }
  scene.contacts.push_back(contact);
}

}  // namespace

void add_surfaces(Draws& draws, RandomKnee& knee) {
  if (knee.family == Family::kNone) return;
  const int count = draws.chance(0.3) && knee.family != Family::kMixed ? 1 : 2;
  for (int i = 0; i < count; ++i) {
    Compartment where{};
    const double x = count == 1 ? 0 : (i == 0 ? -1 : 1) * draws.between(15, 28);
    where.lower = {exp_rotation(draws.within(0.12)), {x, draws.between(-3, 3), 0}};
    where.upper = {exp_rotation(draws.within(0.12)), where.lower.p + draws.within(2)};
    where.patches = knee.family == Family::kPatches || knee.family == Family::kLayeredPatches ||
                    (knee.family == Family::kMixed && draws.chance(0.3));
    where.layers = knee.family == Family::kLayers || knee.family == Family::kLayeredPatches ||
                   (knee.family == Family::kMixed && i == 0);
    add_compartment(draws, knee, where, i + 1);
  }
}

}  // namespace condyle::random_knees
