#include "condyle/equilibrium/edge_in_words.h"

#include <Eigen/Geometry>

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "condyle/equilibrium/motion_name.h"
#include "condyle/surface/affordable_samples.h"

namespace condyle {
namespace {

/// One of the two surfaces of a pair in the anatomical frame of its body: lateral, anterior,
/// proximal.
struct Seen {
  const Surface& surface;
  const std::string& name;
  std::optional<RigidTransform> X;  ///< of the anatomical frame in the body's; absent: no joint
  double side = 1;                  ///< -1: the first axis points medially
  double up = 1;                    ///< -1: the surface faces downwards, as a femur's does
  Eigen::Vector3d origin;           ///< of the model's frame of the body, in the file's [mm]

  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector3d& v) const {
    Eigen::Vector3d d = X->R.transpose() * v;
    d.x() *= side;
    return d;
  }
  [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector3d& p) const {
    return direction(p - X->p);
  }
};

Seen see(const Model& model, const ContactPair& pair, bool on_A) {
  Seen seen{
      on_A ? *pair.on_A : *pair.on_B,          on_A ? pair.surface_A : pair.surface_B, {}, 1, 1,
      on_A ? model.origins.A : model.origins.B};
  if (!model.joint) return seen;
  const bool tibia = model.joint->tibia_moves == on_A;
  seen.X = tibia ? model.joint->X_T : model.joint->X_F;
  seen.side = model.joint->side;
  seen.up = tibia ? 1 : -1;
  return seen;
}

/// The tangent direction in which the known part ends soonest; zero where none is told.
Eigen::Vector3d outward(const Surface& surface, const Place& place, double step) {
  const SurfacePoint at = surface.evaluate(place);
  const Eigen::Vector3d t = at.n.unitOrthogonal(), b = at.n.cross(t);
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& e : {t, b}) {
    const double ahead = surface.edge_distance(surface.moved(place, at, step * e));
    const double behind = surface.edge_distance(surface.moved(place, at, -step * e));
    rate -= (ahead - behind) * e;
  }
  return rate.allFinite() && rate.norm() > 0 ? Eigen::Vector3d(rate.normalized())
                                             : Eigen::Vector3d::Zero();
}

/// Mean of a surface's samples in its anatomical frame.
Eigen::Vector3d middle(const Seen& seen, double L) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::vector<Place> places = affordable_samples(seen.surface, 0.2 * L);
  for (const Place& place : places) sum += seen.point(seen.surface.evaluate_frame(place).c);
  return places.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(places.size()));
}

/// How far a tangent leads forwards along the surface. Where a condyle has turned up behind, forwards
/// is downwards.
double forwards(const Seen& seen, const Eigen::Vector3d& normal, const Eigen::Vector3d& way) {
  return seen.up * way.dot(normal.cross(Eigen::Vector3d::UnitX()));
}

/// "notch side", "rim side" where there are two compartments, else "medial side", "lateral side";
/// "anterior end", "posterior end"; "edge" where no direction can be told.
std::string side_in_words(const Model& model, const Seen& seen, bool on_A, const Place& place) {
  const Eigen::Vector3d way =
      seen.X ? seen.direction(outward(seen.surface, place, 0.02 * model.length))
             : Eigen::Vector3d::Zero();
  if (way.isZero()) return "edge";
  constexpr double kOblique = 0.5;
  const SurfacePoint at = seen.surface.evaluate_frame(place);
  const Eigen::Vector3d center = middle(seen, model.length);
  const bool ahead = forwards(seen, seen.direction(at.n), way) > 0;
  // A side that bends backwards in front of the middle, as that of the notch does, is no end.
  if (std::abs(way.x()) < kOblique * way.norm() && ahead == (seen.point(at.c).y() > center.y()))
    return ahead ? "anterior end" : "posterior end";
  if (model.pairs.size() < 2) return way.x() > 0 ? "lateral side" : "medial side";
  double midline = 0;
  for (const ContactPair& pair : model.pairs)
    midline +=
        middle(see(model, pair, on_A), model.length).x() / static_cast<double>(model.pairs.size());
  return way.x() * (center.x() - midline) > 0 ? "rim side" : "notch side";
}

std::string place_in_words(const Seen& seen, const Place& place) {
  const Eigen::Vector3d c = seen.surface.evaluate_frame(place).c;
  if (!seen.X) {
    const Eigen::Vector3d p = c + seen.origin;
    return fmt::format("at ({:.1f}, {:.1f}, {:.1f}) mm of its body", p.x(), p.y(), p.z());
  }
  const Eigen::Vector3d p = seen.point(c);
  return fmt::format("{:.1f} mm {}, {:.1f} mm {} and {:.1f} mm {} of the joint's origin",
                     std::abs(p.x()), p.x() < 0 ? "medial" : "lateral", std::abs(p.y()),
                     p.y() < 0 ? "posterior" : "anterior", std::abs(p.z()),
                     p.z() < 0 ? "distal" : "proximal");
}

/// The surface of a contact whose edge is nearer, and the place on it.
struct At {
  bool on_A;
  Seen seen;
  Place place;
  std::string contact, surface;  ///< in words
};
At nearer_edge(const Model& model, const ClosedContact& contact) {
  const ContactPair& pair = model.pairs[static_cast<std::size_t>(contact.pair)];
  const bool on_A =
      pair.on_A->edge_distance(contact.places.on_A) < pair.on_B->edge_distance(contact.places.on_B);
  const Seen seen = see(model, pair, on_A);
  return {on_A, seen, on_A ? contact.places.on_A : contact.places.on_B, quoted(pair.name),
          seen.name.empty() ? "its surface" : quoted(seen.name)};
}

}  // namespace

std::string edge_in_words(const Model& model, const ClosedContact& contact) {
  constexpr double kAt = 0.05;  // nearer than this to an edge [mm] is at it
  const At at = nearer_edge(model, contact);
  const double beyond = -at.seen.surface.edge_distance(at.place);
  const std::string how = beyond > kAt ? fmt::format("{:.2f} mm beyond", beyond) : "at the edge of";
  return fmt::format("contact {} lies {} the known part of {} at its {}, {}", at.contact, how,
                     at.surface, side_in_words(model, at.seen, at.on_A, at.place),
                     place_in_words(at.seen, at.place));
}

std::string rim_in_words(const Model& model, const ClosedContact& rim, double depth) {
  const At at = nearer_edge(model, rim);
  return fmt::format(
      "contact {} runs over an edge: {} ends {:.2g} mm deep in the other surface at its {}, {}",
      at.contact, at.surface, depth, side_in_words(model, at.seen, at.on_A, at.place),
      place_in_words(at.seen, at.place));
}

}  // namespace condyle
