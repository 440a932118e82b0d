#include <fmt/format.h>

#include <cmath>

#include "condyle/scene/usable_number.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

Eigen::Vector3d read_direction(const Section& section, const std::string& key) {
  const Eigen::Vector3d direction = section.vector(key, "a direction");
  if (!(direction.norm() > 1e-12)) section.fail(key, "a direction of some length");
  return direction.normalized();
}

int read_whole_number(
    const Section& section, const std::string& key, const Value& value, int least, int most) {
  if (value.type != Value::Type::kInteger || value.number < least || value.number > most) {
    section.fail(key, value, fmt::format("a whole number from {} to {}", least, most));
  }
  return static_cast<int>(value.number);
}

bool is_auto(const Value& value) {
  return value.type == Value::Type::kText && value.text == "auto";
}

void read_control_points(const Section& fit, PatchDescription& patch) {
  const std::string expected = "\"auto\" or two numbers [along u, along v]";
  const Value& value = fit.value("control_points", expected);
  if (is_auto(value)) return;
  if (value.type != Value::Type::kArray || value.items.size() != 2)
    fit.fail("control_points", expected);
  constexpr int kMost = 500;
  std::array<int, 2>& counts = patch.control_points.emplace();
  for (std::size_t i = 0; i < 2; ++i) {
    counts[i] = read_whole_number(fit, "control_points", value.items[i], patch.degree + 1, kMost);
  }
}

void read_smoothing(const Section& fit, const Scene& scene, PatchDescription& patch) {
  const std::string expected = "\"auto\", \"position\" or a smoothing length >= 0";
  const Value& value = fit.value("smoothing", expected);
  if (is_auto(value)) return;
  patch.smooth_for_position = value.type == Value::Type::kText && value.text == "position";
  if (patch.smooth_for_position) return;
  if (!value.is_number()) fit.fail("smoothing", expected);
  patch.smoothing =
      scene.length_to_mm * fit.number("smoothing", "a smoothing length", Range::kNotNegative);
}

void read_fit(const Section& fit, const Scene& scene, PatchDescription& patch) {
  if (fit.has("degree"))
    patch.degree = read_whole_number(fit, "degree", fit.value("degree", "a degree"), 3, 5);
  if (fit.has("control_points")) read_control_points(fit, patch);
  if (fit.has("smoothing")) read_smoothing(fit, scene, patch);
  fit.finish();
}

void read_box(const Section& region, const Scene& scene, PatchDescription& patch) {
  const std::string expected = "two opposite corners [[x, y, z], [x, y, z]] of a box";
  const std::vector<Eigen::Vector3d> corners = region.vectors("box", expected);
  if (corners.size() != 2) region.fail("box", expected);
  if ((corners[1] - corners[0]).cwiseAbs().minCoeff() <= 0)
    region.fail("box", expected + " that encloses some volume");
  patch.region_box = {scene.length_to_mm * corners[0], scene.length_to_mm * corners[1]};
}

void read_angles(const Section& region, const Scene& scene, PatchDescription& patch) {
  const double turn = M_PI / scene.angle_to_rad;
  const std::string expected = fmt::format(
      "two angles [first, last] about the condylar axis, rising, from {:.4g} to {:.4g} (0 distal, "
      "+ "
      "posterior)",
      -turn, turn);
  const std::vector<double> angles = region.numbers("angles", expected);
  if (angles.size() != 2 || !(angles[0] < angles[1]) || angles[0] < -turn || angles[1] > turn)
    region.fail("angles", expected);
  patch.region_angles = {angles[0] * scene.angle_to_rad, angles[1] * scene.angle_to_rad};
}

/// A box alone, or the limits of a compartment.
void read_region(const Section& region,
                 const Scene& scene,
                 const SurfaceDescription& surface,
                 PatchDescription& patch) {
  if (!patch.compartment || region.has("box")) read_box(region, scene, patch);
  for (const char* key : {"angles", "least_cosine"})
    if (!patch.compartment && region.has(key)) region.fail(key, "a compartment beside it");
  if (region.has("angles")) {
    if (surface.body != scene.joint->femur.body)
      region.fail("angles", "angles of a condyle of the femur only");
    read_angles(region, scene, patch);
  }
  if (region.has("least_cosine")) {
    const std::string expected = "a cosine from 0 to 0.9";
    const double cosine = region.number("least_cosine", expected);
    if (cosine < 0 || cosine > 0.9) region.fail("least_cosine", expected);
    patch.region_least_cosine = cosine;
  }
  region.finish();
}

void read_patch(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  static const Choices<Compartment> compartments = {{"medial", Compartment::kMedial},
                                                    {"lateral", Compartment::kLateral}};
  PatchDescription& patch = surface.patch;
  patch.mesh = read_mesh_file(section, scene);
  const BodyDescription& body = scene.bodies[static_cast<std::size_t>(surface.body)];
  if (!patch.mesh && !body.mesh) {
    section.fail_with(
        fmt::format("no mesh to fit, expected a mesh here or on body \"{}\"", body.name));
  }
  if (section.has("compartment") || !section.has("region")) {
    patch.compartment = section.choice("compartment", compartments);
    const bool known = scene.joint && (surface.body == scene.joint->femur.body ||
                                       surface.body == scene.joint->tibia.body);
    if (!known)
      section.fail("compartment", "a body that [joint] describes, or a region in its place");
  }
  if (section.has("region"))
    read_region(section.table("region", "region = { box, angles, least_cosine }"), scene, surface,
                patch);
  if (section.has("offset"))
    patch.offset =
        scene.length_to_mm * section.number("offset", "a thickness", Range::kNotNegative);
  if (section.has("fit"))
    read_fit(section.table("fit", "fit = { control_points, smoothing }"), scene, patch);
}

void read_terms(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  const std::string expected = "terms [[i, j, a], ...] of the height a x^i y^j, |a| below 1e100";
  constexpr int kMostDegree = 20;
  const Value& list = section.value("coefficients", expected);
  if (list.type != Value::Type::kArray || list.items.empty())
    section.fail("coefficients", expected);
  for (const Value& item : list.items) {
    const bool fits = item.type == Value::Type::kArray && item.items.size() == 3 &&
                      item.items[2].is_number() && is_usable(item.items[2].number);
    if (!fits) section.fail("coefficients", item, expected);
    const int i = read_whole_number(section, "coefficients", item.items[0], 0, kMostDegree);
    const int j = read_whole_number(section, "coefficients", item.items[1], 0, kMostDegree);
    surface.terms.push_back({i, j, item.items[2].number * std::pow(scene.length_to_mm, 1 - i - j)});
  }
}

void read_known_radius(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  if (!section.has("radius")) return;
  surface.known_radius =
      scene.length_to_mm *
      section.number("radius", "a radius of the part that is known", Range::kPositive);
}

void read_polynomial(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  if (section.has("frame")) {
    const Section frame =
        section.table("frame", "frame = { origin = [x, y, z], axes = [[..], [..], [..]] }");
    if (frame.has("origin")) surface.point = scene.length_to_mm * frame.vector("origin", "a point");
    if (frame.has("axes")) surface.axes = read_axes(frame, "axes", scene);
    frame.finish();
  }
  read_terms(section, scene, surface);
  read_known_radius(section, scene, surface);
}

void read_torus(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  surface.direction = read_direction(section, "axis");
  surface.radius = scene.length_to_mm * section.number("major", "a radius", Range::kPositive);
  surface.minor_radius = scene.length_to_mm * section.number("minor", "a radius", Range::kPositive);
  if (surface.minor_radius >= surface.radius) section.fail("minor", "a radius less than major");
}

void read_ellipsoid(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  if (section.has("axes")) surface.axes = read_axes(section, "axes", scene);
  constexpr double kFlattest = 1e-6;  // below it closest points lose more digits than verify allows
  const std::string expected = "three lengths > 0, the least no less than 1e-6 of the greatest";
  const Eigen::Vector3d lengths = section.vector("semi_axes", expected);
  if (!(lengths.minCoeff() > 0 && lengths.minCoeff() >= kFlattest * lengths.maxCoeff()))
    section.fail("semi_axes", expected);
  surface.semi_axes = scene.length_to_mm * lengths;
}

}  // namespace

void read_shape(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  const auto point = [&](const std::string& key) {
    return Eigen::Vector3d(scene.length_to_mm * section.vector(key, "a point"));
  };
  const auto radius = [&] {
    return scene.length_to_mm * section.number("radius", "a radius", Range::kPositive);
  };
  switch (surface.kind) {
    case SurfaceKind::kPatch:
      return read_patch(section, scene, surface);
    case SurfaceKind::kPlane:
      surface.point = point("point");
      surface.direction = read_direction(section, "normal");
      return read_known_radius(section, scene, surface);
    case SurfaceKind::kSphere:
      surface.point = point("center");
      surface.radius = radius();
      return;
    case SurfaceKind::kCylinder:
      surface.point = point("point");
      surface.direction = read_direction(section, "axis");
      surface.radius = radius();
      if (section.has("length"))
        surface.length =
            scene.length_to_mm * section.number("length", "a length", Range::kPositive);
      return;
    case SurfaceKind::kEllipsoid:
      surface.point = point("center");
      return read_ellipsoid(section, scene, surface);
    case SurfaceKind::kTorus:
      surface.point = point("center");
      return read_torus(section, scene, surface);
    case SurfaceKind::kPolynomial:
      return read_polynomial(section, scene, surface);
  }
}

namespace {

void read_elastic(const Section& section, const Scene& scene, SurfaceDescription& surface) {
  if (!section.has("modulus")) {
    for (const char* key : {"poisson", "layer"})
      if (section.has(key)) section.fail(key, "a modulus beside it");
    return;
  }
  constexpr double kCartilage = 0.45;
  ElasticSurface& elastic = surface.elastic.emplace();
  elastic.modulus = section.number("modulus", "a modulus (force/length^2)", Range::kPositive) *
                    scene.force_to_n / (scene.length_to_mm * scene.length_to_mm);
  const std::string ratio = "Poisson's ratio, at least 0 and less than 0.5";
  elastic.poisson = section.number_or("poisson", kCartilage, ratio);
  if (elastic.poisson < 0 || elastic.poisson >= 0.5) section.fail("poisson", ratio);
  if (section.has("layer"))
    elastic.layer =
        scene.length_to_mm *
        section.number("layer", "a thickness (none: elastic throughout)", Range::kPositive);
}

SurfaceDescription read_surface(const Section& section, const Scene& scene) {
  static const Choices<SurfaceKind> kinds = {
      {"patch", SurfaceKind::kPatch},          {"plane", SurfaceKind::kPlane},
      {"sphere", SurfaceKind::kSphere},        {"cylinder", SurfaceKind::kCylinder},
      {"ellipsoid", SurfaceKind::kEllipsoid},  {"torus", SurfaceKind::kTorus},
      {"polynomial", SurfaceKind::kPolynomial}};
  static const Choices<bool> sides = {{"inside", true}, {"outside", false}};
  SurfaceDescription surface;
  surface.name = read_name(section, names_of(scene.surfaces));
  surface.line = section.line();
  surface.body = section.reference("body", "the name of a body", names_of(scene.bodies));
  surface.kind = section.choice("kind", kinds);
  if (section.has("solid")) surface.solid_inside = section.choice("solid", sides);
  const bool has_sides = surface.kind != SurfaceKind::kPatch && surface.kind != SurfaceKind::kPlane;
  if (!surface.solid_inside && !has_sides)
    section.fail("solid", "\"inside\": a patch or a plane has no outside");
  read_shape(section, scene, surface);
  read_elastic(section, scene, surface);
  section.finish();
  return surface;
}

bool same_surfaces(const ContactDescription& a, const ContactDescription& b) {
  return a.surfaces == b.surfaces ||
         (a.surfaces[0] == b.surfaces[1] && a.surfaces[1] == b.surfaces[0]);
}

bool has_bounds(const SurfaceDescription& surface) {
  switch (surface.kind) {
    case SurfaceKind::kPlane:
    case SurfaceKind::kPolynomial:
      return std::isfinite(surface.known_radius);
    case SurfaceKind::kCylinder:
      return std::isfinite(surface.length);
    default:
      return true;
  }
}

/// A pair of surfaces that go on for ever cannot be searched for contacts, nor can a layer on one
/// side and a bulk on the other be pressed together by either of the two formulas.
void check_pair(const Section& section,
                const SurfaceDescription& a,
                const SurfaceDescription& b,
                ContactState state) {
  if (state != ContactState::kOpen && !has_bounds(a) && !has_bounds(b)) {
    section.fail("surfaces",
                 fmt::format("bounds of \"{}\" or of \"{}\": radius of a plane or a polynomial, "
                             "length of a cylinder",
                             a.name, b.name));
  }
  if (!a.elastic || !b.elastic || (a.elastic->layer > 0) == (b.elastic->layer > 0)) return;
  const bool layer_on_a = a.elastic->layer > 0;
  section.fail("surfaces",
               fmt::format("layers on both or on neither (\"{}\" has a layer, \"{}\" is elastic "
                           "throughout)",
                           layer_on_a ? a.name : b.name, layer_on_a ? b.name : a.name));
}

ContactDescription read_contact(const Section& root, const Section& section, const Scene& scene) {
  static const Choices<ContactState> states = {{"auto", ContactState::kAuto},
                                               {"closed", ContactState::kClosed},
                                               {"open", ContactState::kOpen}};
  ContactDescription contact;
  contact.name = read_name(section, names_of(scene.contacts));
  const std::string expected = "the names of two surfaces";
  const Value& pair = section.value("surfaces", expected);
  if (pair.type != Value::Type::kArray || pair.items.size() != 2)
    section.fail("surfaces", expected);
  for (std::size_t i = 0; i < 2; ++i) {
    contact.surfaces[i] = section.reference("surfaces", pair.items[i], "the name of a surface",
                                            names_of(scene.surfaces));
  }
  const auto body = [&](std::size_t i) {
    return scene.surfaces[static_cast<std::size_t>(contact.surfaces[i])].body;
  };
  if (body(0) == body(1)) {
    section.fail("surfaces", fmt::format("surfaces of two bodies (both belong to \"{}\")",
                                         scene.bodies[static_cast<std::size_t>(body(0))].name));
  }
  for (const ContactDescription& other : scene.contacts) {
    if (same_surfaces(other, contact))
      section.fail("surfaces", fmt::format("two surfaces that are not yet in contact \"{}\": a "
                                           "contact finds all its points by itself",
                                           other.name));
  }
  if (section.has("state")) contact.state = section.choice("state", states);
  const auto surface = [&](std::size_t i) -> const SurfaceDescription& {
    return scene.surfaces[static_cast<std::size_t>(contact.surfaces[i])];
  };
  check_pair(section, surface(0), surface(1), contact.state);
  read_layers(root, section, scene, contact);
  if (section.has("start"))
    contact.start = section.vectors("start", "points [[x, y, z], ...] in the ground frame");
  for (Eigen::Vector3d& point : contact.start) point *= scene.length_to_mm;
  section.finish();
  return contact;
}

}  // namespace

void read_surfaces(const Section& root, Scene& scene) {
  for (const Section& section : root.sections("surface"))
    scene.surfaces.push_back(read_surface(section, scene));
}

void read_contacts(const Section& root, Scene& scene) {
  for (const Section& section : root.sections("contact"))
    scene.contacts.push_back(read_contact(root, section, scene));
}

}  // namespace condyle
