#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

constexpr const char* kLigaments = "names of ligaments [\"...\", ...] that wrap on it";

/// A right-handed triad whose third direction is given.
Eigen::Matrix3d about(const Eigen::Vector3d& axis) {
  Eigen::Matrix3d axes;
  axes.col(2) = axis;
  axes.col(0) = axis.unitOrthogonal();
  axes.col(1) = axis.cross(axes.col(0));
  return axes;
}

WrapDescription wrap_of(const SurfaceDescription& surface) {
  WrapDescription wrap{surface.name, surface.line, surface.body, WrapSphere{surface.radius}, {}};
  wrap.placement.p = surface.point;
  if (surface.kind == SurfaceKind::kEllipsoid) {
    wrap.shape = WrapEllipsoid{surface.semi_axes};
    wrap.placement.R = surface.axes;
  } else if (surface.kind == SurfaceKind::kCylinder) {
    wrap.shape = WrapCylinder{surface.radius};
    wrap.placement.R = about(surface.direction);
  } else if (surface.kind == SurfaceKind::kTorus) {
    wrap.shape = WrapTorus{surface.radius, surface.minor_radius};
    wrap.placement.R = about(surface.direction);
  }
  return wrap;
}

/// An ellipsoid that is to be fitted to the mesh of its body; its ligaments are known later.
BoneFit read_fit(const Section& section, const Scene& scene, const SurfaceDescription& surface) {
  static const Choices<bool> sources = {{"bone", true}};
  (void)section.choice("fit", sources);
  if (surface.kind != SurfaceKind::kEllipsoid)
    section.fail("kind", "\"ellipsoid\", which can be fitted to a bone");
  const BodyDescription& body = scene.bodies[static_cast<std::size_t>(surface.body)];
  if (!body.mesh)
    section.fail("fit", fmt::format("a mesh of body \"{}\", which names none", body.name));
  for (const char* key : {"center", "axes", "semi_axes"})
    if (section.has(key)) section.fail(key, "none where fit = \"bone\" finds it");
  if (section.has("ligaments")) (void)section.value("ligaments", kLigaments);
  return {};
}

WrapDescription read_wrap(const Section& section, const Scene& scene) {
  static const Choices<SurfaceKind> kinds = {{"sphere", SurfaceKind::kSphere},
                                             {"cylinder", SurfaceKind::kCylinder},
                                             {"ellipsoid", SurfaceKind::kEllipsoid},
                                             {"torus", SurfaceKind::kTorus}};
  SurfaceDescription surface;
  surface.name = read_name(section, names_of(scene.wraps));
  surface.line = section.line();
  surface.body = section.reference("body", "the name of a body", names_of(scene.bodies));
  surface.kind = section.choice("kind", kinds);
  std::optional<BoneFit> fit;
  if (section.has("fit"))
    fit = read_fit(section, scene, surface);
  else
    read_shape(section, scene, surface);
  if (std::isfinite(surface.length))
    section.fail("length", "no length: a cylinder that ligaments wrap on has no ends");
  section.finish();
  WrapDescription wrap = wrap_of(surface);
  wrap.fit = std::move(fit);
  if (wrap.fit) wrap.shape = WrapEllipsoid{Eigen::Vector3d::Zero()};
  return wrap;
}

void read_names_of_wraps(const Section& section, const Scene& scene, LigamentWraps& path) {
  const std::string expected = "names of wraps [\"...\", ...], from the first end to the second";
  const Value& names = section.value("wraps", expected);
  if (names.type != Value::Type::kArray || names.items.empty()) section.fail("wraps", expected);
  if (names.items.size() > static_cast<std::size_t>(kMostWraps))
    section.fail("wraps", fmt::format("at most {} names", kMostWraps));
  for (const Value& name : names.items) {
    const int wrap = section.reference("wraps", name, "the name of a wrap", names_of(scene.wraps));
    if (std::find(path.wraps.begin(), path.wraps.end(), wrap) != path.wraps.end())
      section.fail("wraps", name, "each wrap once");
    path.wraps.push_back(wrap);
  }
}

/// All that lies on the first end's body comes before what lies on the second's.
void check_order(const Section& section, const Scene& scene, const LigamentDescription& ligament) {
  bool second = false;
  for (const int index : ligament.path.wraps) {
    const WrapDescription& wrap = scene.wraps[static_cast<std::size_t>(index)];
    const bool here = wrap.body == ligament.ends[1].body;
    if (!here && wrap.body != ligament.ends[0].body)
      section.fail("wraps", fmt::format("wraps on the ligament's two bodies (\"{}\" is on neither)",
                                        wrap.name));
    if (second && !here)
      section.fail("wraps",
                   fmt::format("wraps in order from the first end (\"{}\" is on that end's body)",
                               wrap.name));
    second = here;
  }
}

void read_sides(const Section& section, const Scene& scene, LigamentWraps& path) {
  const std::string expected =
      path.wraps.size() == 1 ? "a point [x, y, z] on the side that is passed"
                             : "a point on the side that is passed for each wrap [[x, y, z], ...]";
  const Value& value = section.value("side", expected);
  const bool one =
      value.type == Value::Type::kArray && !value.items.empty() && value.items.front().is_number();
  if (one)
    path.sides = {section.vector("side", expected)};
  else
    path.sides = section.vectors("side", expected);
  if (path.sides.size() != path.wraps.size()) section.fail("side", expected);
  for (Eigen::Vector3d& side : path.sides) side *= scene.length_to_mm;
}

/// Half of it is added to the radii of what it wraps on: a ring keeps a hole.
void read_thickness(const Section& section, const Scene& scene, LigamentWraps& path) {
  path.thickness =
      scene.length_to_mm * section.number("thickness", "a thickness", Range::kNotNegative);
  for (const int index : path.wraps) {
    const WrapDescription& wrap = scene.wraps[static_cast<std::size_t>(index)];
    const auto* torus = std::get_if<WrapTorus>(&wrap.shape);
    if (wrap.fit || torus == nullptr || torus->tube + path.thickness / 2 < torus->ring) continue;
    section.fail("thickness",
                 fmt::format("less than {:.6g}, with which wrap \"{}\" has no hole left",
                             2 * (torus->ring - torus->tube) / scene.length_to_mm, wrap.name));
  }
}

std::vector<int> ligaments_on(const Scene& scene, int wrap) {
  std::vector<int> ligaments;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const std::vector<int>& wraps = scene.ligaments[i].path.wraps;
    if (std::find(wraps.begin(), wraps.end(), wrap) != wraps.end())
      ligaments.push_back(static_cast<int>(i));
  }
  return ligaments;
}

/// The ligaments whose strings lead a fit: those that are named, else all on the wrap.
std::vector<int> leading(const Section& section,
                         const Scene& scene,
                         const std::vector<int>& users) {
  if (!section.has("ligaments")) return users;
  const Value& names = section.value("ligaments", kLigaments);
  if (names.type != Value::Type::kArray || names.items.empty())
    section.fail("ligaments", kLigaments);
  std::vector<int> ligaments;
  for (const Value& name : names.items) {
    const int ligament =
        section.reference("ligaments", name, "the name of a ligament", names_of(scene.ligaments));
    if (std::find(users.begin(), users.end(), ligament) == users.end())
      section.fail("ligaments", name, kLigaments);
    if (std::find(ligaments.begin(), ligaments.end(), ligament) != ligaments.end())
      section.fail("ligaments", name, "each ligament once");
    ligaments.push_back(ligament);
  }
  return ligaments;
}

}  // namespace

void read_wraps(const Section& root, Scene& scene) {
  for (const Section& section : root.sections("wrap"))
    scene.wraps.push_back(read_wrap(section, scene));
}

void read_path(const Section& section, const Scene& scene, LigamentDescription& ligament) {
  LigamentWraps& path = ligament.path;
  if (!section.has("wraps")) {
    for (const char* key : {"side", "inside", "thickness"})
      if (section.has(key)) section.fail(key, "wraps beside it");
    return;
  }
  read_names_of_wraps(section, scene, path);
  check_order(section, scene, ligament);
  if (section.has("side")) read_sides(section, scene, path);
  static const Choices<bool> rules = {{"anchor", true}, {"straight", false}};
  if (section.has("inside")) path.anchors_inside = section.choice("inside", rules);
  if (section.has("thickness")) read_thickness(section, scene, path);
}

double start_length_of(const Section& section,
                       const Scene& scene,
                       const LigamentDescription& ligament) {
  if (!has_known_path(scene, ligament))
    return distance_between(scene, ligament.ends, start_pose(scene));
  const StartPath start = start_path(scene, ligament);
  if (!start.key.empty()) section.fail(start.key, start.expected);
  return start.length;
}

void check_wraps_used(const Section& root, Scene& scene) {
  const std::vector<Section> sections = root.sections("wrap");
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::vector<int> users = ligaments_on(scene, static_cast<int>(i));
    if (users.empty())
      sections[i].fail_with(
          "no ligament wraps on it, expected wraps = [..] of a ligament to name it");
    if (scene.wraps[i].fit) scene.wraps[i].fit->ligaments = leading(sections[i], scene, users);
  }
}

}  // namespace condyle
