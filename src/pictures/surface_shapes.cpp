#include "pictures/surface_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A vertex of the patch grid with its distance to the edge of the data, positive inside, and its
/// place in the mesh once it has one.
struct Sample {
  ShadedVertex vertex;
  double inside;
  std::uint32_t index = kNotYet;
  static constexpr std::uint32_t kNotYet = 0xffffffff;
};

ShadedVertex between(const ShadedVertex& a, const ShadedVertex& b, float t) {
  return {a.position + t * (b.position - a.position),
          (a.normal + t * (b.normal - a.normal)).normalized(), a.color};
}

std::uint32_t add_vertex(ShadedMesh& mesh, const ShadedVertex& vertex) {
  mesh.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Adds the part of a triangle that lies inside: the edge of a patch is a smooth line, not a
/// staircase.
void add_inside(ShadedMesh& mesh, const std::array<Sample*, 3>& corners) {
  std::array<std::uint32_t, 4> polygon{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    Sample &a = *corners[i], &b = *corners[(i + 1) % 3];
    if (a.inside >= 0) {
      if (a.index == Sample::kNotYet) a.index = add_vertex(mesh, a.vertex);
      polygon[size++] = a.index;
    }
    if ((a.inside >= 0) != (b.inside >= 0)) {
      const auto t = static_cast<float>(a.inside / (a.inside - b.inside));
      polygon[size++] = add_vertex(mesh, between(a.vertex, b.vertex, t));
    }
  }
  for (std::size_t i = 2; i < size; ++i)
    mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
}

int cells(double length, double spacing) {
  return std::clamp(static_cast<int>(std::ceil(length / spacing)), 8, 240);
}

/// A grid over the unit square of positions p(s, t); normals follow from the triangles.
TriangleMesh grid(int ns, int nt, const std::function<Vector3d(double, double)>& p) {
  TriangleMesh mesh;
  for (int i = 0; i <= ns; ++i) {
    for (int j = 0; j <= nt; ++j)
      mesh.vertices.push_back(p(static_cast<double>(i) / ns, static_cast<double>(j) / nt));
  }
  for (int i = 0; i < ns; ++i) {
    for (int j = 0; j < nt; ++j) {
      const int a = i * (nt + 1) + j, b = a + nt + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

/// Columns x, y, z with z along `axis`.
Eigen::Matrix3d frame_about(const Vector3d& axis) {
  Eigen::Matrix3d F;
  F.col(2) = axis.normalized();
  F.col(0) = F.col(2).unitOrthogonal();
  F.col(1) = F.col(2).cross(F.col(0));
  return F;
}

Vector3d on_unit_sphere(double s, double t) {
  const double azimuth = 2 * std::numbers::pi * s, polar = std::numbers::pi * t;
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}

double polynomial_height(const SurfaceDescription& surface, double x, double y) {
  double z = 0;
  for (const PolynomialTerm& term : surface.terms)
    z += term.a * std::pow(x, term.i) * std::pow(y, term.j);
  return z;
}

TriangleMesh triangles_of(const SurfaceDescription& d, const Vector3d& near, double extent) {
  const double tau = 2 * std::numbers::pi;
  const Eigen::Matrix3d F = frame_about(d.direction);
  switch (d.kind) {
    case SurfaceKind::kSphere:
      return grid(64, 32, [&](double s, double t) -> Vector3d {
        return d.point + d.radius * on_unit_sphere(s, t);
      });
    case SurfaceKind::kEllipsoid:
      return grid(64, 32, [&](double s, double t) -> Vector3d {
        return d.point + d.axes * d.semi_axes.cwiseProduct(on_unit_sphere(s, t));
      });
    case SurfaceKind::kTorus:
      return grid(96, 32, [&](double s, double t) -> Vector3d {
        const double r = d.radius + d.minor_radius * std::cos(tau * t);
        return d.point + F * Vector3d(r * std::cos(tau * s), r * std::sin(tau * s),
                                      d.minor_radius * std::sin(tau * t));
      });
    case SurfaceKind::kCylinder: {
      const Vector3d middle = d.point + F.col(2) * F.col(2).dot(near - d.point);
      return grid(64, 8, [&](double s, double t) -> Vector3d {
        return middle + F * Vector3d(d.radius * std::cos(tau * s), d.radius * std::sin(tau * s),
                                     extent * (t - 0.5));
      });
    }
    case SurfaceKind::kPlane: {
      const bool bounded = std::isfinite(d.known_radius);
      const Vector3d middle =
          bounded ? d.point : Vector3d(near - F.col(2) * F.col(2).dot(near - d.point));
      const double radius = bounded ? d.known_radius : 0.5 * extent;
      return grid(8, 64, [&](double s, double t) -> Vector3d {
        return middle + radius * s * (std::cos(tau * t) * F.col(0) + std::sin(tau * t) * F.col(1));
      });
    }
    case SurfaceKind::kPolynomial:
      return grid(48, 48, [&](double s, double t) -> Vector3d {
        const double x = extent * (s - 0.5), y = extent * (t - 0.5);
        return d.point + d.axes * Vector3d(x, y, polynomial_height(d, x, y));
      });
    case SurfaceKind::kPatch:
      break;
  }
  return {};
}

}  // namespace

ShadedMesh patch_shape(const Patch& patch, const Paint& paint, double spacing) {
  return painted_patch(
      patch, [&](const SurfacePoint&) { return paint; }, spacing);
}

ShadedMesh painted_patch(const Patch& patch,
                         const std::function<Paint(const SurfacePoint&)>& paint,
                         double spacing) {
  const int nu = cells(patch.u_max() - patch.u_min(), spacing),
            nv = cells(patch.v_max() - patch.v_min(), spacing);
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>((nu + 1) * (nv + 1)));
  for (int i = 0; i <= nu; ++i) {
    for (int j = 0; j <= nv; ++j) {
      const Place place(patch.u_min() + (patch.u_max() - patch.u_min()) * i / nu,
                        patch.v_min() + (patch.v_max() - patch.v_min()) * j / nv, 0);
      const SurfacePoint at = patch.evaluate(place);
      samples.push_back({{at.c.cast<float>(), at.n.cast<float>(), bytes(paint(at))},
                         std::min(patch.edge_distance(place), 1e3)});
    }
  }
  ShadedMesh mesh;
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      Sample* a = &samples[static_cast<std::size_t>(i * (nv + 1) + j)];
      Sample* b = a + nv + 1;
      if (patch.data().orientation > 0) {
        add_inside(mesh, {a, b, b + 1});
        add_inside(mesh, {a, b + 1, a + 1});
      } else {
        add_inside(mesh, {a, b + 1, b});
        add_inside(mesh, {a, a + 1, b + 1});
      }
    }
  }
  return mesh;
}

ShadedMesh exact_shape(const SurfaceDescription& surface,
                       const Paint& paint,
                       const Vector3d& near,
                       double extent) {
  return shade(triangles_of(surface, near, extent), paint, 0);
}

}  // namespace condyle
