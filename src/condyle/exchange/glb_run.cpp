#include "condyle/exchange/glb_run.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/exchange/glb_solids.h"
#include "condyle/results/contact_path.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/strain_scale.h"

namespace condyle {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kMetre = 1e-3;                         // per mm
constexpr double kContactRadius = 1.5, kDiamond = 3.2;  // [mm]
constexpr double kMoment = 1e-3;  // of a step of time, after which something is hidden

enum Material { kBone, kCartilage, kLigament, kContact, kBeyondEdge };

// Colours are linear light. Bone is translucent, so that the cartilage shows where the two meet; of
// closed bones only the outside is seen.
std::vector<GlbMaterial> materials(bool closed_bones) {
  return {{"bone", {0.79, 0.70, 0.56, 0.6}, 0.7, !closed_bones},
          {"cartilage", {0.42, 0.60, 0.78, 1}, 0.35, true},
          {"ligament", {0.80, 0.66, 0.34, 1}, 0.55, false},
          {"contact", {0.65, 0.05, 0.04, 1}, 0.4, false},
          {"beyond the edge", {0.67, 0.04, 0.007, 1}, 0.4, false}};
}

GlbMesh glb_mesh(const RunShape& shape) {
  GlbMesh mesh;
  mesh.name = shape.name;
  mesh.material = shape.bone ? kBone : kCartilage;
  for (const Vector3d& v : shape.mesh.vertices)
    mesh.positions.push_back((kMetre * v).cast<float>());
  for (const Vector3d& n : shape.normals) mesh.normals.push_back(n.cast<float>().normalized());
  for (const auto& t : shape.mesh.triangles) {
    mesh.triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                              static_cast<std::uint32_t>(t[2])});
  }
  return mesh;
}

/// A little after the first of two keyframes; none where no float, which keyframes are, lies between.
std::optional<double> moment_after(double first, double second) {
  const auto begin = static_cast<float>(first), end = static_cast<float>(second);
  const float moment =
      std::max(static_cast<float>(first + kMoment * (second - first)), std::nextafter(begin, end));
  return moment < end ? std::optional<double>(moment) : std::nullopt;
}

/// The point that lies farthest beyond the edge of what is known; null where all lie within.
const ContactPointResult* farthest_beyond(const ContactResult& contact) {
  const ContactPointResult* farthest = nullptr;
  for (const ContactPointResult& point : contact.points)
    if (beyond_edge(point) > (farthest ? beyond_edge(*farthest) : 0)) farthest = &point;
  return farthest;
}

/// The least rotation that takes the unit vector a along b.
Quaterniond shortest_turn(const Vector3d& a, const Vector3d& b) {
  constexpr double kOpposite = 1e-12;
  const Vector3d to = b.stableNormalized();
  const double real = 1 + a.dot(to);
  const Vector3d axis = real > kOpposite ? Vector3d(a.cross(to)) : a.unitOrthogonal();
  return Quaterniond(std::max(real, 0.0), axis.x(), axis.y(), axis.z()).normalized();
}

class GlbRun {
 public:
  GlbRun(const Run& run, const std::vector<ShownPose>& shown)
      : run_(run), scene_(run.scene), shown_(shown) {}

  [[nodiscard]] GlbDocument document(const ShapeOptions& options) {
    out_.title = scene_.title;
    add_times();
    GlbNode root;
    root.name = "knee";
    root.place.rotation = Quaterniond(upright(scene_));
    out_.nodes.push_back(root);
    const std::vector<RunShape> shapes = run_shapes(run_, options);
    out_.materials = materials(std::all_of(shapes.begin(), shapes.end(), [](const RunShape& shape) {
      return !shape.bone || shape.closed;
    }));
    add_bodies(shapes);
    add_ligaments();
    add_contacts();
    return std::move(out_);
  }

 private:
  [[nodiscard]] const PoseResult& pose(const ShownPose& shown) const {
    return run_.sweep.poses[shown.index];
  }

  template <typename F>
  [[nodiscard]] std::vector<double> of_poses(const F& value) const {
    std::vector<double> values;
    for (const ShownPose& shown : shown_) values.push_back(value(pose(shown)));
    return values;
  }

  int add_node(GlbNode node, int parent) {
    if (!node.track.empty()) node.place = node.track.front();
    out_.nodes.push_back(std::move(node));
    const int index = static_cast<int>(out_.nodes.size()) - 1;
    out_.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
    return index;
  }

  int add_mesh(GlbMesh mesh) {
    out_.meshes.push_back(std::move(mesh));
    return static_cast<int>(out_.meshes.size()) - 1;
  }

  void add_times() {
    out_.animation = run_.kind() == RunKind::kSimulation ? "motion" : "sweep";
    for (const ShownPose& shown : shown_) out_.times.push_back(shown.time);
    const SweptQuantity swept = swept_quantity(run_);
    out_.words = {{"title", scene_.title}, {"unit", swept.unit.name}, {"varied", swept.name}};
    out_.extras.push_back({"time_s", out_.times});
    out_.extras.push_back(
        {"value", of_poses([&](const PoseResult& p) { return swept.shown(p.value); })});
    out_.extras.push_back(
        {"status", of_poses([](const PoseResult& p) { return static_cast<double>(p.status); })});
    out_.extras.push_back({"strain_top", {strain_scale(run_).top}});
    if (!scene_.joint) return;
    out_.extras.push_back(
        {"flexion_deg", of_poses([](const PoseResult& p) { return p.joint.flexion / kDegree; })});
  }

  void add_bodies(const std::vector<RunShape>& shapes) {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      GlbNode node;
      node.name = scene_.bodies[i].name;
      if (static_cast<int>(i) == scene_.moving_body()) {
        for (const ShownPose& shown : shown_) {
          const RigidTransform& X = pose(shown).X_BA;
          node.track.push_back({kMetre * X.p, Quaterniond(X.R).normalized()});
        }
      }
      const int body = add_node(std::move(node), 0);
      for (const RunShape& shape : shapes) {
        if (shape.body != static_cast<int>(i)) continue;
        GlbNode child;
        child.name = shape.name;
        child.mesh = add_mesh(glb_mesh(shape));
        add_node(std::move(child), body);
      }
    }
  }

  /// The places at equal parts of a ligament's length, from the first end to the second [mm].
  [[nodiscard]] std::vector<Vector3d> course(const PoseResult& p,
                                             std::size_t ligament,
                                             std::size_t pieces) const {
    const LigamentDescription& described = scene_.ligaments[ligament];
    std::vector<Vector3d> line = path_corners(scene_, p, ligament);
    line.insert(line.begin(), insertion(scene_, p, described.ends[0]));
    line.push_back(insertion(scene_, p, described.ends[1]));
    double length = 0;
    for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
    std::vector<Vector3d> places = {line.front()};
    double before = 0;
    for (std::size_t k = 1; k < line.size(); ++k) {
      const double piece = (line[k] - line[k - 1]).norm();
      while (places.size() < pieces) {
        const double at = length * static_cast<double>(places.size()) / static_cast<double>(pieces);
        if (!(at <= before + piece) || piece == 0) break;
        places.push_back(line[k - 1] + (at - before) / piece * (line[k] - line[k - 1]));
      }
      before += piece;
    }
    places.resize(pieces, line.back());
    places.push_back(line.back());
    return places;
  }

  /// Cylinders of unit length along y, each stretched over one of the equal pieces of a ligament. They
  /// roll as little as can be.
  [[nodiscard]] std::vector<std::vector<GlbPlace>> ligament_tracks(std::size_t ligament,
                                                                   std::size_t pieces) const {
    std::vector<std::vector<GlbPlace>> tracks(pieces);
    std::vector<Quaterniond> turned(pieces, Quaterniond::Identity());
    for (const ShownPose& shown : shown_) {
      const std::vector<Vector3d> places = course(pose(shown), ligament, pieces);
      for (std::size_t k = 0; k < pieces; ++k) {
        const Vector3d ab = places[k + 1] - places[k];
        const Vector3d along = turned[k] * Vector3d::UnitY();
        turned[k] = (shortest_turn(along, ab) * turned[k]).normalized();
        tracks[k].push_back({kMetre * places[k], turned[k], {1, kMetre * ab.norm(), 1}});
      }
    }
    return tracks;
  }

  void add_ligaments() {
    if (scene_.ligaments.empty()) return;
    const int cylinder =
        add_mesh(unit_cylinder("ligament", kLigament, kMetre * ligament_radius(scene_)));
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i) {
      constexpr std::size_t kPieces = 16;  // of a ligament that wraps
      const std::size_t pieces = scene_.ligaments[i].path.wraps.empty() ? 1 : kPieces;
      GlbNode node;
      node.name = "ligament " + scene_.ligaments[i].name;
      node.mesh = cylinder;
      std::vector<std::vector<GlbPlace>> tracks = ligament_tracks(i, pieces);
      node.track = std::move(tracks[0]);
      node.moves_scale = true;
      const auto number = [&](double LigamentResult::*part) {
        return of_poses([&](const PoseResult& p) { return p.ligaments[i].*part; });
      };
      node.extras = {{"force_N", number(&LigamentResult::force)}};
      if (has_strain(run_.scene.ligaments[i].law))
        node.extras.insert(node.extras.begin(), {"strain", number(&LigamentResult::strain)});
      const std::string name = node.name;
      add_node(std::move(node), 0);
      for (std::size_t piece = 1; piece < pieces; ++piece) {
        GlbNode further;
        further.name = fmt::format("{}, piece {}", name, piece + 1);
        further.mesh = cylinder;
        further.track = std::move(tracks[piece]);
        further.moves_scale = true;
        add_node(std::move(further), 0);
      }
    }
  }

  using PointOf = const ContactPointResult* (*)(const ContactResult&);

  /// Where there is no point it waits where it was.
  [[nodiscard]] std::vector<GlbPlace> contact_track(std::size_t index, PointOf point_of) const {
    std::vector<GlbPlace> track;
    GlbPlace place;
    for (const ShownPose& shown : shown_) {
      const ContactPointResult* point = point_of(pose(shown).contacts[index]);
      if (point && point->point_ground.allFinite())
        place.translation = kMetre * point->point_ground;
      track.push_back(place);
    }
    return track;
  }

  /// Does the contact stay closed, with no pose missing, from one keyframe until it opens before
  /// the next?
  [[nodiscard]] bool opens_before(std::size_t next, std::size_t index) const {
    return shown_[next].index == shown_[next - 1].index + 1 &&
           !pose(shown_[next]).contacts[index].closed;
  }

  /// As small as nothing where the contact has no such point, and on the way between two places
  /// that no path joins.
  [[nodiscard]] std::vector<GlbStep> contact_steps(std::size_t index, PointOf point_of) const {
    const auto path = contact_path(run_.sweep, index);
    std::vector<GlbStep> steps;
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      const ContactResult& contact = pose(shown_[i]).contacts[index];
      const bool shown = contact.closed && point_of(contact);
      steps.push_back({shown_[i].time, shown ? 1.0 : 0.0});
      if (!shown || i + 1 == shown_.size() || opens_before(i + 1, index) ||
          joined(path, shown_[i].index, shown_[i + 1].index))
        continue;
      if (const auto moment = moment_after(shown_[i].time, shown_[i + 1].time))
        steps.push_back({*moment, 0});
    }
    return steps;
  }

  void add_contact(std::size_t index, const std::string& words, int mesh, PointOf point_of) {
    GlbNode node;
    node.name = "contact " + scene_.contacts[index].name + words;
    node.mesh = mesh;
    node.track = contact_track(index, point_of);
    node.steps = contact_steps(index, point_of);
    node.track.front().scale.setConstant(node.steps.front().scale);
    node.extras = {
        {"force_N", of_poses([&](const PoseResult& p) { return p.contacts[index].force; })}};
    add_node(std::move(node), 0);
  }

  void add_contacts() {
    if (scene_.contacts.empty()) return;
    const int sphere = add_mesh(ball("contact", kContact, kMetre * kContactRadius));
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i)
      add_contact(i, "", sphere, strongest_point);
    const bool beyond = std::any_of(shown_.begin(), shown_.end(), [&](const ShownPose& shown) {
      return beyond_edge(pose(shown)) > 0;
    });
    if (!beyond) return;
    const int sign = add_mesh(diamond("beyond the edge", kBeyondEdge, kMetre * kDiamond));
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i)
      add_contact(i, " beyond the edge", sign, farthest_beyond);
  }

  const Run& run_;
  const Scene& scene_;
  const std::vector<ShownPose>& shown_;
  GlbDocument out_;
};

}  // namespace

std::string glb_of_poses(const Run& run,
                         const std::vector<ShownPose>& shown,
                         const ShapeOptions& options) {
  ShapeOptions shapes = options;
  shapes.drop_covered = true;
  return glb_bytes(GlbRun(run, shown).document(shapes));
}

std::string glb_of_run(const Run& run, const std::string& file, const ShapeOptions& options) {
  return glb_of_poses(run, shown_poses(run, file), options);
}

}  // namespace condyle
