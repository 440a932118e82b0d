#include "condyle/network/simulate.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/input_error.h"
#include "condyle/math/degree.h"
#include "condyle/network/contact_detection.h"
#include "condyle/network/drive.h"
#include "condyle/network/integrate.h"
#include "condyle/network/knee_network.h"
#include "condyle/network/motion_lattices.h"
#include "condyle/network/motion_poses.h"
#include "condyle/network/network_equations.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

[[noreturn]] void fail(const Scene& scene, const std::string& message) {
  throw InputError(scene.file.string() + ": [simulate]: " + message);
}

KinematicCondition flexion_condition(const Model& model, double value) {
  KinematicCondition condition;
  condition.kind = ConditionKind::kFlexion;
  condition.frames = *model.joint;
  condition.value = value;
  return condition;
}

/// The model as it is held before the release: with its weight, the loads as they are just before the start (a pulse that
/// starts then is a blow), and the flexion prescribed; returns which condition that is, or -1.
int hold_for_start(const Scene& scene, const MassProperties& mass, Model& model) {
  const SimulationDescription& simulation = *scene.simulation;
  Load weight;
  weight.vector = mass.mass * simulation.gravity;
  weight.at = mass.center;
  model.loads.push_back(weight);
  model.load_names.emplace_back("weight");
  const double before = std::nextafter(0.0, -1.0);
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    model.loads[i].scale =
        load_scale_at(simulation.drives, static_cast<int>(i), before, scene.loads[i].scale);
  if (!simulation.flexion) return -1;
  for (std::size_t i = 0; i < model.conditions.size(); ++i)
    if (model.conditions[i].kind == ConditionKind::kFlexion) return static_cast<int>(i);
  model.conditions.push_back(flexion_condition(model, 0));
  model.condition_names.emplace_back("flexion at the start");
  return static_cast<int>(model.conditions.size()) - 1;
}

/// Equilibrium at the start: first where the scene's start pose is, then where it is wanted.
EquilibriumState find_start(const Scene& scene,
                            const MassProperties& mass,
                            const Model& model,
                            const ContactCovers& covers) {
  Model held = model;
  const int flexion = hold_for_start(scene, mass, held);
  if (flexion >= 0)
    held.conditions[flexion].value = joint_coordinates(*model.joint, model.start).flexion;
  EquilibriumSolver solver(std::make_shared<const Model>(std::move(held)), covers);
  PoseResult pose = solver.solve();
  if (flexion >= 0) {
    const Swept angle = condition_value(static_cast<std::size_t>(flexion));
    pose = solver.solve(angle.with(drive_of(solver.model()), *scene.simulation->flexion));
  }
  if (!pose.converged())
    fail(scene, fmt::format("the knee has no position of equilibrium to start from{}: {}",
                            flexion >= 0 ? fmt::format(" at flexion = {:g} deg",
                                                       *scene.simulation->flexion / kDegree)
                                         : "",
                            pose.reason.empty() ? name(pose.status) : pose.reason));
  return solver.state();
}

/// What is released is left out; loads get their course in time, ligaments their viscosity.
void complete(const Scene& scene, const BodyOrigins& origins, KneeNetwork& knee) {
  const SimulationDescription& simulation = *scene.simulation;
  Network& network = knee.network;
  network.gravity = simulation.gravity;
  std::vector<ConditionComponent> held;
  for (const int i : simulation.hold) {
    held.push_back(network.conditions[i]);
    if (held.back().condition.kind == ConditionKind::kFlexion && simulation.flexion)
      held.back().condition.value = *simulation.flexion;
  }
  network.conditions = std::move(held);
  for (std::size_t i = 0; i < network.forces.size(); ++i)
    network.forces[i].scale = [drives = simulation.drives, i,
                               otherwise =
                                   i < scene.loads.size() ? scene.loads[i].scale : 1](double t) {
      return load_scale_at(drives, static_cast<int>(i), t, otherwise);
    };
  for (LineComponent& line : network.lines) line.viscous_time = simulation.viscous_time;
  for (const DamperDescription& damper : simulation.dampers) {
    const auto [fixed_end, moving_end] = fixed_then_moving(scene, damper.ends);
    LineComponent line;
    line.name = damper.name;
    line.from = add_port(network, damper.name + ": fixed end", kGround, fixed_end - origins.B);
    line.to = add_port(network, damper.name + ": moving end", 0, moving_end - origins.A);
    line.damping = damper.coefficient;
    network.lines.push_back(line);
  }
}

/// Rigid contacts where layers are pressed most.
void keep_depths(const Model& model,
                 const KneeNetwork& knee,
                 Network& network,
                 NetworkState& state) {
  const RigidTransform& X = state.bodies[0].X;
  for (std::size_t i = 0; i < knee.potentials.size(); ++i) {
    const ContactPair& pair = model.pairs[knee.potentials[i]];
    ContactResult contact;
    knee.network.potentials[i].potential->describe(X, contact);
    if (!contact.closed) continue;
    const ContactPointResult& deepest = contact.points.front();
    network.contacts.push_back({pair.name, 0, pair.on_B, pair.on_A, false, false});
    const auto place = [](const Surface& surface, const Eigen::Vector3d& p) {
      return surface.closest(p, surface.seed(p));
    };
    state.contacts.push_back(
        {{place(*pair.on_B, deepest.point_ground), place(*pair.on_A, deepest.point_moving)}, true});
  }
}

/// The motion of least energy that has the wanted flexion velocity and keeps the contacts, of layers
/// the depth where it is greatest.
void set_velocity(const Scene& scene,
                  const Model& model,
                  const KneeNetwork& knee,
                  NetworkState& start) {
  const double velocity = scene.simulation->flexion_velocity;
  if (velocity == 0) return;
  Network network = knee.network;
  NetworkState state = start;
  network.conditions.push_back(
      {"flexion velocity", 0, flexion_condition(model, *scene.simulation->flexion), {}});
  keep_depths(model, knee, network, state);
  NetworkEquations equations(network);
  if (!equations.assemble(state)) fail(scene, "a contact has no place at the start");
  Eigen::VectorXd after = Eigen::VectorXd::Zero(equations.jacobian().rows()), impulse;
  after[after.size() - 1] = velocity;
  const Eigen::VectorXd twist = equations.impact(after, impulse);
  start.bodies[0].v = twist.head<3>();
  start.bodies[0].omega = twist.tail<3>();
}

/// The motion, again on finer lattices as long as one is too coarse.
Motion integrate_on_lattices(const Model& model,
                             const ContactCovers& covers,
                             KneeNetwork& knee,
                             const NetworkState& start,
                             const IntegrationOptions& options,
                             const SimulationKeeping& keeping) {
  for (const LatticeRefinement& refinement : keeping.refinements)
    refine_lattice(refinement, knee.network);
  MotionKeeping stretches{keeping.stretches, keeping.on_stretch, {}};
  for (;;) {
    forget_places(knee.network);
    KneeContactDetection detect(model, covers, knee);
    stretches.forget = [&detect] { detect.forget(); };
    Motion motion = integrate(knee.network, start, options, std::ref(detect), stretches);
    const std::vector<LatticeRefinement> refined = refine_lattices(motion, knee.network);
    if (refined.empty()) return motion;
    for (const LatticeRefinement& refinement : refined)
      if (keeping.on_refinement) keeping.on_refinement(refinement);
    stretches.earlier.clear();
  }
}

}  // namespace

MassProperties moving_mass(const Scene& scene) {
  const BodyDescription& body = scene.bodies[scene.moving_body()];
  const std::string what = fmt::format("{}: [[body]] \"{}\"", scene.file.string(), body.name);
  if (body.mass) return {*body.mass, *body.center, *body.inertia};
  if (!body.density)
    throw InputError(what +
                     ": has no mass, expected density, or mass, center and inertia, for "
                     "simulate");
  if (!body.mesh) throw InputError(what + ": density, expected a mesh beside it");
  return mass_of_solid(load_body_mesh(body), *body.density, what);
}

void check_simulated_scene(const Scene& scene) {
  if (!scene.simulation)
    throw InputError(scene.file.string() +
                     ": [simulate] is missing, expected time, rate and gravity");
}

Simulation simulate(const Scene& scene,
                    const std::vector<FittedSurface>& surfaces,
                    const OnProgress& on_frame,
                    const SimulationKeeping& keeping) {
  Simulation result;
  result.mass = moving_mass(scene);
  const Model model = build_model(scene, surfaces);
  MassProperties mass = result.mass;
  mass.center -= model.origins.A;
  const ContactCovers covers = cover_pairs(model);
  const EquilibriumState start = find_start(scene, mass, model, covers);
  KneeNetwork knee = make_knee_network(model, mass);
  choose_lattices(start.X, knee.network);
  complete(scene, model.origins, knee);
  NetworkState state = state_at_rest(model, covers, knee, start);
  set_velocity(scene, model, knee, state);

  const SimulationDescription& simulation = *scene.simulation;
  IntegrationOptions options;
  options.end = simulation.time;
  options.interval = 1 / simulation.rate;
  options.tolerance = simulation.tolerance;
  options.restitution = simulation.restitution;
  options.breaks = drive_breaks(simulation.drives);
  options.on_frame = on_frame;
  const auto begin = std::chrono::steady_clock::now();
  result.motion = integrate_on_lattices(model, covers, knee, state, options, keeping);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const MotionStretch& stretch : keeping.stretches) result.seconds += stretch.seconds;
  result.contact_of = knee.places;
  result.poses = motion_poses(scene, model, covers, knee, result.motion);
  if (!result.motion.completed && model.joint && !result.poses.empty())
    result.motion.reason += fmt::format(", {:.4g} deg of flexion at the frame before",
                                        result.poses.back().joint.flexion * 180 / M_PI);
  return result;
}

}  // namespace condyle
