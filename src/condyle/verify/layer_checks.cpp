#include "condyle/verify/layer_checks.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace condyle::verification {
namespace {

constexpr double kFade = 1;        ///< border over which pressure fades at an edge [mm]
constexpr double kOpposed = -0.3;  ///< cosine between normals that face each other, at most

const SurfaceDescription& surface_of(const Scene& scene, int index) {
  return scene.surfaces[static_cast<std::size_t>(index)];
}

/// A layer's thickness over its confined modulus [mm³/N], and its thickness.
struct Spring {
  double h = 0, K = 1;
};

/// Two layers in series.
class Law {
 public:
  Law(const Scene& scene, const PairOfSides& pair, PressureLaw pressure) : pressure_(pressure) {
    int side = 0;
    for (const int surface : {pair.fixed_surface, pair.moving_surface}) {
      Spring& spring = springs_[side++];
      const std::optional<ElasticSurface>& elastic = surface_of(scene, surface).elastic;
      if (!elastic) continue;
      const double nu = elastic->poisson;
      spring = {elastic->layer, elastic->modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))};
    }
  }
  [[nodiscard]] double thickness() const { return springs_[0].h + springs_[1].h; }
  [[nodiscard]] double deepest() const {
    return (pressure_ == PressureLaw::kLinear ? 0.5 : 0.9) * thickness();
  }
  /// Of both layers under a pressure [mm].
  [[nodiscard]] double depth(double p) const {
    double d = 0;
    for (const Spring& s : springs_)
      d += pressure_ == PressureLaw::kLinear ? p * s.h / s.K : s.h * (1 - std::exp(-p / s.K));
    return d;
  }
  /// By bisection [N/mm²].
  [[nodiscard]] double pressure(double d) const {
    if (!(d > 0)) return 0;
    double low = 0, high = 1e-3;
    while (depth(high) < d && high < 1e9) high *= 2;
    for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
      const double middle = 0.5 * (low + high);
      (depth(middle) < d ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  /// ∫ p dd by Simpson's rule [N/mm].
  [[nodiscard]] double energy(double d) const {
    if (!(d > 0)) return 0;
    if (pressure_ == PressureLaw::kLinear) return 0.5 * d * pressure(d);
    constexpr int kParts = 16;
    double sum = pressure(d);
    for (int i = 1; i < kParts; ++i) sum += (i % 2 == 1 ? 4 : 2) * pressure(d * i / kParts);
    return sum * d / (3 * kParts);
  }

 private:
  std::array<Spring, 2> springs_;
  PressureLaw pressure_;
};

/// One surface of a contact with the points of it, pressed into the other.
struct Side {
  const SurfaceSide &own, &other;
  bool on_A;
  RigidTransform to_other;  ///< from the frame of the body that carries the points
  int surface;
};

std::array<Side, 2> sides_of(const PairOfSides& pair, const RigidTransform& X) {
  return {Side{*pair.fixed, *pair.moving, false, X.inverse(), pair.fixed_surface},
          Side{*pair.moving, *pair.fixed, true, X, pair.moving_surface}};
}

/// Has the one side points: has it bounds, and is it not too large for a fine grid beside one that is not (docs/results.md)?
bool has_points(const SurfaceSide& own, const SurfaceSide& other) {
  constexpr double kLong = 256;  // [mm]
  const bool is_long = own.longest_way() > kLong, other_is_long = other.longest_way() > kLong;
  return std::isfinite(own.longest_way()) && (!is_long || other_is_long);
}

double count_sides(const PairOfSides& pair) {
  return (has_points(*pair.fixed, *pair.moving) ? 1 : 0) +
         (has_points(*pair.moving, *pair.fixed) ? 1 : 0);
}

struct Resultant {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();  ///< on A, about O_A, ground frame
  double sum = 0, deepest = 0;
  void press(const Side& side,
             const RigidTransform& X,
             const Vector3d& point,
             const ClosestPoint& closest,
             double force_here) {
    const Vector3d at = side.on_A ? X * point : point;
    const Vector3d n = side.on_A ? closest.n : Vector3d(-(X.R * closest.n));
    force += force_here * n;
    moment += force_here * (at - X.p).cross(n);
    sum += force_here;
    deepest = std::max(deepest, -closest.distance);
  }
};

/// 0 at the edge, 1 from kFade inside it.
double share_at(double edge) {
  const double x = std::clamp(edge / kFade, 0.0, 1.0);
  return x * x * x * (10 - 15 * x + 6 * x * x);
}

/// The law on cells of a grid, divided where they are near the other surface.
class Grid {
 public:
  Grid(const Side& side, const RigidTransform& X, const Law& law, double weight, Resultant& all)
      : side_(side), X_(X), law_(law), weight_(weight), all_(all) {}

  void look(const Cell& cell, double size) {
    const double u = 0.5 * (cell.u0 + cell.u1), v = 0.5 * (cell.v0 + cell.v1);
    const ChartPoint at = side_.own.at(cell.chart, u, v);
    const double width = (cell.u1 - cell.u0) * at.p_u.norm(),
                 height = (cell.v1 - cell.v0) * at.p_v.norm(), radius = std::hypot(width, height);
    const Vector3d there = side_.to_other * at.p;
    if (side_.other.is_clear(there, radius)) return;
    if (std::max(width, height) > size) return divide(cell, width > height, size);
    const double share = share_at(side_.own.edge(cell.chart, u, v));
    if (!(share > 0)) return;
    const ClosestPoint closest = side_.other.closest(there);
    const Vector3d n = side_.to_other.R * side_.own.closest(at.p).n;
    if (!(closest.distance < 0) || n.dot(closest.n) > kOpposed) return;
    const double area = at.p_u.cross(at.p_v).norm() * (cell.u1 - cell.u0) * (cell.v1 - cell.v0);
    all_.press(side_, X_, at.p, closest, weight_ * share * area * law_.pressure(-closest.distance));
  }

 private:
  void divide(Cell cell, bool along_u, double size) {
    Cell second = cell;
    if (along_u)
      cell.u1 = second.u0 = 0.5 * (cell.u0 + cell.u1);
    else
      cell.v1 = second.v0 = 0.5 * (cell.v0 + cell.v1);
    look(cell, size);
    look(second, size);
  }

  const Side& side_;
  const RigidTransform& X_;
  const Law& law_;
  double weight_;
  Resultant& all_;
};

/// The force on a grid of one's own.
Resultant on_grid(const PairOfSides& pair, const RigidTransform& X, const Law& law) {
  constexpr double kCell = 0.5;  // [mm]
  Resultant all;
  const double weight = 1 / std::max(1.0, count_sides(pair));
  for (const Side& side : sides_of(pair, X)) {
    if (!has_points(side.own, side.other)) continue;
    Grid grid(side, X, law, weight, all);
    for (const Cell& cell : side.own.cells(4)) grid.look(cell, kCell);
  }
  return all;
}

/// The stored points, each by its own place and the point closest to it.
Resultant check_field(const ContactResult& contact,
                      const PairOfSides& pair,
                      const RigidTransform& X,
                      const Law& law,
                      const std::string& element,
                      Ledger& ledger) {
  const double weight = 1 / std::max(1.0, count_sides(pair));
  const std::array<Side, 2> sides = sides_of(pair, X);
  Resultant all;
  for (const PressurePoint& point : contact.pressures) {
    const Side& side = sides[point.on_A ? 1 : 0];
    const ClosestPoint own = side.own.closest(point.point),
                       closest = side.other.closest(side.to_other * point.point);
    const double far = 1e-14 * (point.point.norm() + X.p.norm());
    ledger.note(Check::kOnSurface, (own.point - point.point).norm(), element, "", 1e-8 + 100 * far);
    ledger.note(Check::kDepth, std::abs(point.depth + closest.distance), element,
                fmt::format("is stored {:.9g} mm deep at [{:.3f}, {:.3f}, {:.3f}] mm, but lies "
                            "{:.9g} mm within the other surface",
                            point.depth, point.point.x(), point.point.y(), point.point.z(),
                            -closest.distance),
                1e-7 + 100 * far);
    const double p = law.pressure(point.depth);
    ledger.note(Check::kPressure, std::abs(point.pressure - p) / std::max(p, 1e-6), element);
    all.press(side, X, point.point, closest, weight * point.area * point.pressure);
  }
  return all;
}

void check_sums(const Resultant& field,
                const ContactResult& contact,
                const std::string& element,
                Ledger& ledger) {
  const LayerResult& layer = *contact.layer;
  const double scale = std::max(field.sum, 1e-9);
  ledger.note(Check::kLayerSums, (field.force - layer.force).norm() / scale, element,
              fmt::format("its pressures add up to {:.10g} N, the file says {:.10g} N",
                          field.force.norm(), layer.force.norm()));
  ledger.note(Check::kLayerSums, std::abs(contact.force - layer.force.norm()) / scale, element);
  ledger.note(Check::kLayerSums, std::abs(layer.area * layer.mean_pressure - field.sum) / scale,
              element);
  const double arm = std::max(1.0, field.moment.norm() / scale);
  ledger.note(
      Check::kLayerSums, (field.moment - layer.moment).norm() / (scale * arm), element,
      "its pressures have another moment about the moving body's origin than the file says");
}

}  // namespace

void check_layers(const Subject& subject, const PoseResult& pose, Ledger& ledger) {
  const Scene& scene = subject.run.scene;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (!scene.contacts[i].layer) continue;
    const std::string element = fmt::format("contact \"{}\"", scene.contacts[i].name);
    const PairOfSides pair = pair_of(subject, i);
    const Law law(scene, pair, scene.contacts[i].layer->pressure);
    const ContactResult& contact = pose.contacts[i];
    const Resultant anew = on_grid(pair, pose.X_BA, law);
    const double stored = contact.layer ? contact.layer->force.norm() : 0;
    // Cells of half a millimetre see an area of 2 mm² with a per cent of error.
    const double scale = std::max(stored, anew.sum) + 5;
    ledger.note(Check::kLayerForce, std::abs(anew.force.norm() - stored) / scale, element,
                fmt::format("carries {:.6g} N, its law on a grid of its own {:.6g} N", stored,
                            anew.force.norm()),
                0.01 + 3 * scene.contacts[i].layer->tolerance);
    ledger.note(Check::kLayerDepth, anew.deepest, element,
                fmt::format("is pressed {:.4g} mm deep, its layers bear {:.4g} mm", anew.deepest,
                            law.deepest()),
                1.01 * law.deepest());
    if (!contact.layer) continue;
    check_sums(check_field(contact, pair, pose.X_BA, law, element, ledger), contact, element,
               ledger);
  }
}

double layer_energy(const Subject& subject, const PoseResult& pose, const RigidTransform& X) {
  const Scene& scene = subject.run.scene;
  double energy = 0;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (!scene.contacts[i].layer || !pose.contacts[i].layer) continue;
    const PairOfSides pair = pair_of(subject, i);
    const Law law(scene, pair, scene.contacts[i].layer->pressure);
    const double weight = 1 / std::max(1.0, count_sides(pair));
    const std::array<Side, 2> sides = sides_of(pair, X);
    for (const PressurePoint& point : pose.contacts[i].pressures) {
      const Side& side = sides[point.on_A ? 1 : 0];
      const double depth = -side.other.closest(side.to_other * point.point).distance;
      energy += weight * point.area * law.energy(depth);
    }
  }
  return energy;
}

}  // namespace condyle::verification
