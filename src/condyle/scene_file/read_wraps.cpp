#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

constexpr std::size_t kMostWraps = 7;

/// A right-handed triad whose third direction is given.
Eigen::Matrix3d about(const Eigen::Vector3d& axis) {
  Eigen::Matrix3d axes;
  axes.col(2) = axis;
  axes.col(0) = axis.unitOrthogonal();
  axes.col(1) = axis.cross(axes.col(0));
  return axes;
}

WrapDescription wrap_of(const SurfaceDescription& surface) {
  WrapDescription wrap{surface.name, surface.body, WrapSphere{surface.radius}, {}};
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

WrapDescription read_wrap(const Section& section, const Scene& scene) {
  static const Choices<SurfaceKind> kinds = {{"sphere", SurfaceKind::kSphere},
                                             {"cylinder", SurfaceKind::kCylinder},
                                             {"ellipsoid", SurfaceKind::kEllipsoid},
                                             {"torus", SurfaceKind::kTorus}};
  SurfaceDescription surface;
  surface.name = read_name(section, names_of(scene.wraps));
  surface.body = section.reference("body", "the name of a body", names_of(scene.bodies));
  surface.kind = section.choice("kind", kinds);
  read_shape(section, scene, surface);
  if (std::isfinite(surface.length))
    section.fail("length", "no length: a cylinder that ligaments wrap on has no ends");
  section.finish();
  return wrap_of(surface);
}

void read_names_of_wraps(const Section& section, const Scene& scene, LigamentWraps& path) {
  const std::string expected = "names of wraps [\"...\", ...], from the first end to the second";
  const Value& names = section.value("wraps", expected);
  if (names.type != Value::Type::kArray || names.items.empty()) section.fail("wraps", expected);
  if (names.items.size() > kMostWraps)
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

/// Deepest that an end may lie in a surface for its path to begin at the closest point of it: half
/// of the least radius.
double most_depth(const WrapShape& shape) {
  struct Least {
    double operator()(const WrapSphere& s) const { return s.radius; }
    double operator()(const WrapCylinder& s) const { return s.radius; }
    double operator()(const WrapEllipsoid& s) const { return s.semi_axes.minCoeff(); }
    double operator()(const WrapTorus& s) const { return s.tube; }
  };
  return std::visit(Least{}, shape) / 2;
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
  if (section.has("thickness"))
    path.thickness =
        scene.length_to_mm * section.number("thickness", "a thickness", Range::kNotNegative);
}

double start_length_of(const Section& section,
                       const Scene& scene,
                       const LigamentDescription& ligament) {
  const RigidTransform start = start_pose(scene);
  if (ligament.path.wraps.empty()) return distance_between(scene, ligament.ends, start);
  const std::vector<PathWrap> wraps = path_wraps(scene, ligament);
  const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
  if (ligament.path.anchors_inside)
    for (const InsideEnd& end : inside_ends(wraps, x_C, s_D)) {
      if (end.wrap < 0) continue;
      const PathWrap& wrap = wraps[static_cast<std::size_t>(end.wrap)];
      if (end.depth > most_depth(wrap.shape))
        section.fail("ends",
                     fmt::format("an end outside wrap \"{}\" or close under its surface (it "
                                 "lies {:.3g} mm inside)",
                                 wrap.name, end.depth));
    }
  const double length = ligament_length(scene, ligament, start);
  if (!(length > 0))
    section.fail("wraps", "wraps around which there is a shortest path at the start pose");
  return length;
}

void check_wraps_used(const Section& root, const Scene& scene) {
  const std::vector<Section> sections = root.sections("wrap");
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const bool used = std::any_of(
        scene.ligaments.begin(), scene.ligaments.end(), [&](const LigamentDescription& ligament) {
          const std::vector<int>& wraps = ligament.path.wraps;
          return std::find(wraps.begin(), wraps.end(), static_cast<int>(i)) != wraps.end();
        });
    if (!used)
      sections[i].fail_with(
          "no ligament wraps on it, expected wraps = [..] of a ligament to name it");
  }
}

}  // namespace condyle
