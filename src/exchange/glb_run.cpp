#include "exchange/glb_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exchange/glb_file.h"
#include "results/run_layout.h"

namespace condyle {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kMetre = 1e-3;         // per mm
constexpr double kContactRadius = 1.5;  // [mm]

enum Material { kBone, kCartilage, kLigament, kContact };

// Colours are linear light. Bone is translucent, so that the cartilage shows where the two meet; of
// closed bones only the outside is seen.
std::vector<GlbMaterial> materials(bool closed_bones) {
  return {{"bone", {0.79, 0.70, 0.56, 0.6}, 0.7, !closed_bones},
          {"cartilage", {0.42, 0.60, 0.78, 1}, 0.35, true},
          {"ligament", {0.80, 0.66, 0.34, 1}, 0.55, false},
          {"contact", {0.65, 0.05, 0.04, 1}, 0.4, false}};
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

/// Turned about y: a profile of rings (radius, height, normal's share outwards and upwards).
struct Ring {
  double radius, height, outward, upward;
};
GlbMesh turned(const std::string& name, int material, const std::vector<Ring>& rings) {
  constexpr std::uint32_t kSides = 16;
  GlbMesh mesh;
  mesh.name = name;
  mesh.material = material;
  for (const Ring& ring : rings) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides, c = std::cos(angle),
                   s = std::sin(angle);
      mesh.positions.push_back(
          Vector3d(ring.radius * s, ring.height, ring.radius * c).cast<float>());
      mesh.normals.push_back(
          Vector3d(ring.outward * s, ring.upward, ring.outward * c).normalized().cast<float>());
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = r * kSides + i, b = r * kSides + (i + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  }
  return mesh;
}

/// From y = 0 to y = 1, with ends.
GlbMesh unit_cylinder(double radius) {
  return turned("ligament", kLigament,
                {{0, 0, 0, -1},
                 {radius, 0, 0, -1},
                 {radius, 0, 1, 0},
                 {radius, 1, 1, 0},
                 {radius, 1, 0, 1},
                 {0, 1, 0, 1}});
}

GlbMesh ball(double radius) {
  std::vector<Ring> rings;
  for (int i = 0; i <= 10; ++i) {
    const double latitude = std::numbers::pi * (i / 10.0 - 0.5);
    const double out = i == 0 || i == 10 ? 0 : std::cos(latitude), up = std::sin(latitude);
    rings.push_back({radius * out, radius * up, out, up});
  }
  return turned("contact", kContact, rings);
}

/// Many strands of one ligament are drawn thinner [mm].
double ligament_radius(std::size_t ligaments) {
  return 1.5 *
         std::min(1.0, std::sqrt(20.0 / static_cast<double>(std::max<std::size_t>(1, ligaments))));
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
    out_.animation = scene_.simulation ? "motion" : "sweep";
    for (const ShownPose& shown : shown_) out_.times.push_back(shown.time);
    const ShownUnit unit = shown_unit(scene_);
    out_.words = {{"title", scene_.title}, {"unit", unit.name}};
    out_.words.emplace_back("varied", scene_.simulation ? "time"
                                      : scene_.sweep    ? scene_.sweep->vary
                                                        : "");
    out_.extras.push_back({"time_s", out_.times});
    out_.extras.push_back(
        {"value", of_poses([&](const PoseResult& p) { return unit.per_inside * p.value; })});
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

  /// A cylinder of unit length along y, stretched from end to end. It rolls as little as can be.
  [[nodiscard]] std::vector<GlbPlace> ligament_track(const LigamentDescription& ligament) const {
    std::vector<GlbPlace> track;
    Quaterniond turned = Quaterniond::Identity();
    for (const ShownPose& shown : shown_) {
      const Vector3d a = insertion(scene_, pose(shown), ligament.ends[0]);
      const Vector3d ab = insertion(scene_, pose(shown), ligament.ends[1]) - a;
      turned = (Quaterniond::FromTwoVectors(turned * Vector3d::UnitY(), ab) * turned).normalized();
      track.push_back({kMetre * a, turned, {1, kMetre * ab.norm(), 1}});
    }
    return track;
  }

  void add_ligaments() {
    if (scene_.ligaments.empty()) return;
    const int cylinder = add_mesh(unit_cylinder(kMetre * ligament_radius(scene_.ligaments.size())));
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i) {
      GlbNode node;
      node.name = "ligament " + scene_.ligaments[i].name;
      node.mesh = cylinder;
      node.track = ligament_track(scene_.ligaments[i]);
      node.moves_scale = true;
      const auto number = [&](double LigamentResult::*part) {
        return of_poses([&](const PoseResult& p) { return p.ligaments[i].*part; });
      };
      node.extras = {{"strain", number(&LigamentResult::strain)},
                     {"force_N", number(&LigamentResult::force)}};
      add_node(std::move(node), 0);
    }
  }

  /// Where it is open the ball is as small as nothing, and waits where the gap is smallest.
  [[nodiscard]] std::vector<GlbPlace> contact_track(std::size_t index) const {
    std::vector<GlbPlace> track;
    GlbPlace place;
    for (const ShownPose& shown : shown_) {
      const ContactResult& contact = pose(shown).contacts[index];
      const ContactPointResult* point = strongest_point(contact);
      if (point && point->point_ground.allFinite())
        place.translation = kMetre * point->point_ground;
      place.scale.setConstant(contact.closed && point ? 1 : 0);
      track.push_back(place);
    }
    return track;
  }

  void add_contacts() {
    if (scene_.contacts.empty()) return;
    const int sphere = add_mesh(ball(kMetre * kContactRadius));
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
      GlbNode node;
      node.name = "contact " + scene_.contacts[i].name;
      node.mesh = sphere;
      node.track = contact_track(i);
      node.moves_scale = node.scale_in_steps = true;
      node.extras = {
          {"force_N", of_poses([&](const PoseResult& p) { return p.contacts[i].force; })}};
      add_node(std::move(node), 0);
    }
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
