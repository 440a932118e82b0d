#include <fmt/format.h>

#include <Eigen/LU>

#include "condyle/math/decompositions.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

constexpr double kKilogram = 1e-3;  // tonne

Eigen::Matrix3d read_inertia(const Section& section, const Scene& scene) {
  const std::string expected =
      "[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] in kg times the length unit squared";
  const std::vector<Eigen::Vector3d> rows = section.vectors("inertia", expected);
  if (rows.size() != 3) section.fail("inertia", expected);
  Eigen::Matrix3d inertia;
  for (int i = 0; i < 3; ++i) inertia.row(i) = rows[static_cast<std::size_t>(i)].transpose();
  const double size = inertia.cwiseAbs().maxCoeff();
  const Eigen::Vector3d principal = symmetric_eigenvalues(inertia).values;
  if (!inertia.isApprox(inertia.transpose(), 1e-9) || principal[0] <= 1e-12 * size)
    section.fail("inertia", "a symmetric positive definite matrix");
  if (principal[2] > (1 + 1e-6) * (principal[0] + principal[1]))
    section.fail("inertia", "no principal moment above the sum of the two others: no body has one");
  return kKilogram * scene.length_to_mm * scene.length_to_mm * inertia;
}

void read_mass(const Section& section, const Scene& scene, BodyDescription& body) {
  const double volume = scene.length_to_mm * scene.length_to_mm * scene.length_to_mm;
  if (section.has("density")) {
    if (section.has("mass")) section.fail("mass", "either density or mass, not both");
    body.density = kKilogram / volume * section.number("density", "a density", Range::kPositive);
    return;
  }
  if (!section.has("mass") && !section.has("center") && !section.has("inertia")) return;
  body.mass = kKilogram * section.number("mass", "a mass in kg", Range::kPositive);
  body.center = scene.length_to_mm * section.vector("center", "the mass centre");
  body.inertia = read_inertia(section, scene);
}

void read_start(const Section& start, const Scene& scene, BodyDescription& body) {
  if (start.has("translation"))
    body.start_translation = scene.length_to_mm * start.vector("translation", "a point");
  const bool angles =
      start.has("flexion") || start.has("adduction") || start.has("internal_rotation");
  if (start.has("rotation")) {
    if (angles) start.fail("rotation", "either a rotation vector or joint angles, not both");
    body.start_rotation = read_rotation(start, "rotation", scene);
  }
  if (angles) {
    const auto angle = [&](const char* key) {
      return start.has(key) ? read_angle(start, key, scene) : 0;
    };
    body.start_joint_angles = {angle("flexion"), angle("adduction"), angle("internal_rotation")};
  }
  start.finish();
}

BodyDescription read_body(const Section& section, const Scene& scene) {
  BodyDescription body;
  body.name = read_name(section, names_of(scene.bodies));
  body.fixed = section.has("fixed") && section.boolean("fixed");
  if (body.fixed && scene.fixed_body() >= 0) {
    const std::string& first = scene.bodies[static_cast<std::size_t>(scene.fixed_body())].name;
    section.fail("fixed", fmt::format("one fixed body (\"{}\" is fixed already)", first));
  }
  body.mesh = read_mesh_file(section, scene);
  if (section.has("start")) {
    if (body.fixed)
      section.fail("start", "no start pose on the fixed body: its frame is the ground frame");
    read_start(section.table("start", "a start pose: start.translation, start.rotation"), scene,
               body);
  }
  read_mass(section, scene, body);
  section.finish();
  return body;
}

AnatomicalFrame read_frame(const Section& joint,
                           const std::string& key,
                           Side side,
                           const Scene& scene) {
  const Section section = joint.table(key, "{ body, origin, lateral, anterior, proximal }");
  AnatomicalFrame frame;
  frame.body = section.reference("body", "the name of a body", names_of(scene.bodies));
  frame.origin = scene.length_to_mm * section.vector("origin", "a point in the frame of the body");
  Eigen::Matrix3d axes;
  const std::array<std::string, 3> names = {"lateral", "anterior", "proximal"};
  constexpr double kRounding = 1e-3;  // directions written with four digits
  for (int i = 0; i < 3; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    axes.col(i) = section.vector(name, "a unit vector");
    if (std::abs(axes.col(i).norm() - 1) > kRounding) {
      section.fail(name, fmt::format("a unit vector (its length is {:.6g})", axes.col(i).norm()));
    }
    for (int j = 0; j < i; ++j) {
      if (std::abs(axes.col(i).dot(axes.col(j))) > kRounding) {
        section.fail(name, fmt::format("a vector at right angles to {}",
                                       names[static_cast<std::size_t>(j)]));
      }
    }
  }
  const bool right_handed = axes.determinant() > 0;
  if (right_handed != (side == Side::kRight)) {
    joint.fail(key, side == Side::kRight
                        ? "a right-handed triad (lateral, anterior, proximal) for side = \"right\""
                        : "a left-handed triad (lateral, anterior, proximal) for side = \"left\"");
  }
  const double hand = right_handed ? 1 : -1;
  axes.col(0) *= hand;
  axes = orthonormalized(axes);
  frame.lateral = hand * axes.col(0);
  frame.anterior = axes.col(1);
  frame.proximal = axes.col(2);
  section.finish();
  return frame;
}

}  // namespace

void read_bodies(const Section& root, Scene& scene) {
  int moving = 0;
  for (const Section& section : root.sections("body")) {
    scene.bodies.push_back(read_body(section, scene));
    if (!scene.bodies.back().fixed && ++moving > 1) {
      section.fail_with(
          "a second moving body, expected one fixed and one moving body (is fixed = true "
          "missing?)");
    }
  }
  if (scene.fixed_body() < 0)
    root.fail_with("no fixed body, expected one [[body]] with fixed = true");
  if (scene.moving_body() < 0)
    root.fail_with("no moving body, expected a [[body]] without fixed = true");
}

void read_joint(const Section& root, Scene& scene) {
  static const Choices<Side> sides = {{"right", Side::kRight}, {"left", Side::kLeft}};
  const auto moving = static_cast<std::size_t>(scene.moving_body());
  if (!root.has("joint")) {
    if (scene.bodies[moving].start_joint_angles) {
      root.fail_with(fmt::format(
          "[joint] is missing, expected the frames that the start angles of body \"{}\" refer to",
          scene.bodies[moving].name));
    }
    return;
  }
  const Section section = root.table("joint", "a table [joint] with side, femur and tibia");
  JointDescription joint;
  joint.side = section.choice("side", sides);
  joint.femur = read_frame(section, "femur", joint.side, scene);
  joint.tibia = read_frame(section, "tibia", joint.side, scene);
  if (joint.femur.body == joint.tibia.body) {
    section.fail_with(fmt::format("femur and tibia name the same body \"{}\", expected two bodies",
                                  scene.bodies[static_cast<std::size_t>(joint.femur.body)].name));
  }
  section.finish();
  scene.joint = joint;
}

}  // namespace condyle
