#include "random/random_knee.h"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/math/rotation.h"
#include "condyle/scene/start_pose.h"
#include "random/scene_text.h"

namespace condyle::random_knees {
namespace {

constexpr const char* kFamilies[] = {"no contact", "exact surfaces",    "patches",
                                     "layers",     "layers on patches", "rigid and layers"};
constexpr const char* kIlls[] = {"",
                                 "stiffness 1e-9 to 1e9",
                                 "a line of no length",
                                 "start 20 mm off",
                                 "start 5 to 20 mm inside",
                                 "all slack",
                                 "contact out of reach",
                                 "pulled apart",
                                 "conforming",
                                 "conditions twice",
                                 "known part of 1 to 4 mm",
                                 "loads of any size"};
static_assert(std::size(kFamilies) == kFamilyCount && std::size(kIlls) == kIllCount);

/// The start pose lies beside the closed joint, in the frame of body 0: of body 1.
RigidTransform displacement(Draws& draws, Ill ill) {
  RigidTransform X;
  X.p = draws.within(1.5);
  X.R = exp_rotation(draws.within(0.08));
  switch (ill) {
    case Ill::kFarStart:
      X.p += 20 * draws.direction();
      X.p.z() = std::abs(X.p.z());
      X.R = exp_rotation(draws.within(0.5));
      break;
    case Ill::kDeepStart:
      X.p.z() -= draws.between(5, 20);
      break;
    case Ill::kOutOfReach:
      X.p.z() += draws.between(100, 300);
      break;
    default:
      break;
  }
  return X;
}

/// Where the frame of a file stands: q_file = Q q.
RigidTransform file_frame(Draws& draws) {
  if (draws.chance(0.3)) return {};
  RigidTransform Q;
  Q.R = draws.rotation();
  Q.p = draws.within(draws.chance(0.5) ? 3000 : 100);
  return Q;
}

void move(AnatomicalFrame& frame, const RigidTransform& Q) {
  frame.origin = Q * frame.origin;
  for (Eigen::Vector3d* axis : {&frame.lateral, &frame.anterior, &frame.proximal})
    *axis = Q.R * *axis;
}

void move(std::array<Attachment, 2>& ends, const std::array<RigidTransform, 2>& Q) {
  for (Attachment& end : ends) end.at = Q[static_cast<std::size_t>(end.body)] * end.at;
}

/// The bodies' boxes, for patches: any that holds the control points.
std::array<Eigen::Vector3d, 2> box_of(const PatchData& patch) {
  std::array<Eigen::Vector3d, 2> box = {patch.control_points[0], patch.control_points[0]};
  for (const Eigen::Vector3d& p : patch.control_points) {
    box[0] = box[0].cwiseMin(p);
    box[1] = box[1].cwiseMax(p);
  }
  return {box[0].array() - 1, box[1].array() + 1};
}

}  // namespace

std::string kind_of(const RandomKnee& knee) {
  if (knee.ill != Ill::kNothing) return kIlls[static_cast<std::size_t>(knee.ill)];
  const std::string family = kFamilies[static_cast<std::size_t>(knee.family)];
  return knee.scene.wraps.empty() ? family : family + ", wraps";
}

bool has_layers(const RandomKnee& knee) {
  return std::any_of(knee.scene.contacts.begin(), knee.scene.contacts.end(),
                     [](const ContactDescription& contact) { return contact.layer.has_value(); });
}

void add_bodies(Draws& draws, RandomKnee& knee) {
  static constexpr double kLengths[] = {1, 1, 1, 10, 1000};
  Scene& scene = knee.scene;
  scene.length_to_mm = kLengths[draws.below(5)];
  scene.angle_to_rad = draws.chance(0.5) ? M_PI / 180 : 1;
  scene.bodies.resize(2);
  scene.bodies[0].name = "tibia";
  scene.bodies[1].name = "femur";
  scene.bodies[static_cast<std::size_t>(draws.below(2))].fixed = true;
  if (draws.chance(0.2)) return;
  JointDescription& joint = scene.joint.emplace();
  joint.side = draws.chance(0.5) ? Side::kRight : Side::kLeft;
  const double side = joint.side == Side::kRight ? 1 : -1;
  for (AnatomicalFrame* frame : {&joint.femur, &joint.tibia}) {
    *frame = {frame == &joint.femur ? 1 : 0, draws.within(10), side * Eigen::Vector3d::UnitX(),
              Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  }
}

void move_frames(Draws& draws, RandomKnee& knee) {
  Scene& scene = knee.scene;
  const std::array<RigidTransform, 2> Q = {file_frame(draws), file_frame(draws)};
  const auto B = static_cast<std::size_t>(scene.fixed_body()),
             A = static_cast<std::size_t>(scene.moving_body());
  const RigidTransform start = displacement(draws, knee.ill);
  const RigidTransform X = Q[B] * (A == 1 ? start : start.inverse()) * Q[A].inverse();
  scene.bodies[A].start_translation = X.p;
  scene.bodies[A].start_rotation = log_rotation(X.R);
  if (scene.joint) {
    move(scene.joint->femur, Q[1]);
    move(scene.joint->tibia, Q[0]);
  }
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    SurfaceDescription& surface = scene.surfaces[i];
    const RigidTransform& own = Q[static_cast<std::size_t>(surface.body)];
    surface.point = own * surface.point;
    surface.direction = own.R * surface.direction;
    surface.axes = own.R * surface.axes;
    if (!knee.patches[i]) continue;
    for (Eigen::Vector3d& p : knee.patches[i]->control_points) p = own * p;
    surface.patch.region_box = box_of(*knee.patches[i]);
  }
  for (WrapDescription& wrap : scene.wraps)
    wrap.placement = Q[static_cast<std::size_t>(wrap.body)] * wrap.placement;
  for (LigamentDescription& ligament : scene.ligaments) move(ligament.ends, Q);
  for (LoadDescription& load : scene.loads) {
    load.vector = Q[load.follows_body ? A : B].R * load.vector;
    load.at = Q[A] * load.at;
  }
}

RandomKnee random_knee(std::uint64_t seed, std::uint64_t k) {
  Draws draws(seed, k);
  RandomKnee knee;
  // Half of the scenes are sound.
  if (draws.chance(0.5)) knee.ill = static_cast<Ill>(1 + draws.below(kIllCount - 1));
  knee.family = static_cast<Family>(draws.below(kFamilyCount));
  if (draws.chance(0.3)) knee.family = Family::kExact;
  knee.scene.title = fmt::format("Random knee {} of seed {}", k, seed);
  knee.scene.file = fmt::format("knee-{}.toml", k);
  add_bodies(draws, knee);
  add_surfaces(draws, knee);
  add_lines(draws, knee);
  add_wraps(draws, knee);
  add_loads(draws, knee);
  move_frames(draws, knee);
  add_motions(draws, knee);
  knee.text = scene_text(knee.scene);
  return knee;
}

}  // namespace condyle::random_knees
