#include "condyle/specimen/surface_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "condyle/mesh/merge_vertices.h"
#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

int cells(double length, double spacing) {
  return static_cast<int>(std::clamp(std::ceil(length / spacing), 8.0, 240.0));
}

/// Cuts a grid over a patch along the edge of what is known.
class PatchMesher {
 public:
  PatchMesher(const Patch& patch, double spacing)
      : patch_(patch),
        nu_(cells(patch.u_max() - patch.u_min(), spacing)),
        nv_(cells(patch.v_max() - patch.v_min(), spacing)) {
    for (int i = 0; i <= nu_; ++i) {
      for (int j = 0; j <= nv_; ++j)
        inside_.push_back(std::min(patch.edge_distance(place(i * (nv_ + 1) + j)), 1e3));
    }
  }

  [[nodiscard]] SurfaceMesh mesh() {
    for (int i = 0; i < nu_; ++i) {
      for (int j = 0; j < nv_; ++j) {
        const int a = i * (nv_ + 1) + j, b = a + nv_ + 1;
        add_inside({a, b, b + 1});
        add_inside({a, b + 1, a + 1});
      }
    }
    if (patch_.data().orientation < 0) {
      for (std::array<int, 3>& triangle : result_.mesh.triangles)
        std::swap(triangle[1], triangle[2]);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] Place place(int node) const {
    const int i = node / (nv_ + 1), j = node % (nv_ + 1);
    return Patch::place(patch_.u_min() + (patch_.u_max() - patch_.u_min()) * i / nu_,
                        patch_.v_min() + (patch_.v_max() - patch_.v_min()) * j / nv_);
  }

  /// The vertex at node a, or where the edge of what is known passes between a and b.
  int vertex(int a, int b) {
    const auto [found, added] =
        numbers_.try_emplace(std::minmax(a, b), static_cast<int>(result_.mesh.vertices.size()));
    if (added) {
      const double t = a == b ? 0 : inside_[a] / (inside_[a] - inside_[b]);
      const Eigen::Vector3d from = place(a).numbers, to = place(b).numbers;
      result_.places.push_back({from + t * (to - from)});
      const SurfacePoint at = patch_.evaluate_frame(result_.places.back());
      result_.mesh.vertices.push_back(at.c);
      result_.normals.push_back(at.n);
    }
    return found->second;
  }

  void add_inside(const std::array<int, 3>& corners) {
    std::vector<int> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 3];
      if (inside_[a] >= 0) polygon.push_back(vertex(a, a));
      if ((inside_[a] >= 0) != (inside_[b] >= 0)) polygon.push_back(vertex(a, b));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i)
      result_.mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }

  const Patch& patch_;
  int nu_, nv_;
  std::vector<double> inside_;                  ///< distance to the edge at each node [mm]
  std::map<std::pair<int, int>, int> numbers_;  ///< of the vertices
  SurfaceMesh result_;
};

using OnUnitSquare = std::function<Vector3d(double, double)>;

/// Triangles face along the first direction times the second.
TriangleMesh grid(int ns, int nt, const OnUnitSquare& p) {
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

constexpr double kTurn = 2 * std::numbers::pi;

/// Columns x, y, z with z along `axis`.
Eigen::Matrix3d frame_about(const Vector3d& axis) {
  Eigen::Matrix3d F;
  F.col(2) = axis.normalized();
  F.col(0) = F.col(2).unitOrthogonal();
  F.col(1) = F.col(2).cross(F.col(0));
  return F;
}

/// From the south pole up, so that triangles face outwards.
Vector3d on_unit_sphere(double s, double t) {
  const double azimuth = kTurn * s, polar = kTurn / 2 * (1 - t);
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}

TriangleMesh disc(const Vector3d& middle, const Eigen::Matrix3d& F, double radius) {
  return grid(8, 64, [&](double s, double t) -> Vector3d {
    return middle + radius * s * (std::cos(kTurn * t) * F.col(0) + std::sin(kTurn * t) * F.col(1));
  });
}

TriangleMesh tube(const Vector3d& middle, const Eigen::Matrix3d& F, double radius, double length) {
  return grid(64, 8, [&](double s, double t) -> Vector3d {
    return middle + F * Vector3d(radius * std::cos(kTurn * s), radius * std::sin(kTurn * s),
                                 length * (t - 0.5));
  });
}

TriangleMesh ring(const SurfaceDescription& d, const Eigen::Matrix3d& F) {
  return grid(96, 32, [&](double s, double t) -> Vector3d {
    const double r = d.radius + d.minor_radius * std::cos(kTurn * t);
    return d.point + F * Vector3d(r * std::cos(kTurn * s), r * std::sin(kTurn * s),
                                  d.minor_radius * std::sin(kTurn * t));
  });
}

TriangleMesh heights(const SurfaceDescription& d, double extent) {
  return grid(48, 48, [&](double s, double t) -> Vector3d {
    const double x = extent * (s - 0.5), y = extent * (t - 0.5);
    double z = 0;
    for (const PolynomialTerm& term : d.terms)
      z += term.a * std::pow(x, term.i) * std::pow(y, term.j);
    return d.point + d.axes * Vector3d(x, y, z);
  });
}

TriangleMesh triangles_of(const SurfaceDescription& d, const Vector3d& near, double extent) {
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
      return ring(d, F);
    case SurfaceKind::kCylinder:
      if (std::isfinite(d.length)) return tube(d.point, F, d.radius, d.length);
      return tube(d.point + F.col(2) * F.col(2).dot(near - d.point), F, d.radius, extent);
    case SurfaceKind::kPlane:
      if (std::isfinite(d.known_radius)) return disc(d.point, F, d.known_radius);
      return disc(near - F.col(2) * F.col(2).dot(near - d.point), F, 0.5 * extent);
    case SurfaceKind::kPolynomial:
      return heights(d, std::isfinite(d.known_radius) ? 2 * d.known_radius : extent);
    case SurfaceKind::kPatch:
      break;
  }
  return {};
}

void drop_without_area(TriangleMesh& mesh) {
  std::erase_if(mesh.triangles, [](const std::array<int, 3>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

}  // namespace

SurfaceMesh patch_mesh(const Patch& patch, double spacing) {
  return PatchMesher(patch, spacing).mesh();
}

SurfaceMesh exact_mesh(const SurfaceDescription& surface, const Vector3d& near, double extent) {
  SurfaceMesh result;
  result.mesh = triangles_of(surface, near, extent);
  merge_vertices(result.mesh, 1e-9 * extent);
  drop_without_area(result.mesh);
  drop_unreferenced_vertices(result.mesh);
  if (!surface.solid_inside && surface.kind != SurfaceKind::kPlane) {
    for (std::array<int, 3>& triangle : result.mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  result.normals = vertex_normals(result.mesh);
  return result;
}

}  // namespace condyle
