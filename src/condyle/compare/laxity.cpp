#include "condyle/compare/laxity.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>

#include "condyle/elements/joint_table.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/math/degree.h"
#include "condyle/math/no_number.h"
#include "condyle/reference/wismans_solver.h"
#include "condyle/scene/start_pose.h"

namespace condyle {
namespace {

constexpr double kFlexionStep = 5 * kDegree;
constexpr double kLoadStep = 0.1;  // of the greatest load of the test

/// From one value to another in steps of at most `step`, both ends included.
std::vector<double> way(double from, double to, double step) {
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / step)));
  std::vector<double> values;
  for (int i = 0; i <= parts; ++i) values.push_back(from + (to - from) * i / parts);
  return values;
}

double greatest(const std::vector<double>& values) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size > 0 ? size : 1;
}

/// What all curves of one knee share.
struct PreparedKnee {
  std::shared_ptr<const Model> model;
  ContactCovers covers;
  PreparedKnee(const Scene& scene, const std::vector<FittedSurface>& surfaces)
      : model(std::make_shared<const Model>(build_model(scene, surfaces))),
        covers(cover_pairs(*model)) {}
};

/// The ways to each flexion of the test, and there to the first value of the load.
struct Ways {
  double start;  ///< flexion that the scene describes
  std::vector<double> to_load, loads;
  explicit Ways(const Scene& scene)
      : start(scene.conditions[scene.laxity->condition].value),
        to_load(way(0, scene.sweep->values.front(), kLoadStep * greatest(scene.sweep->values))),
        loads(scene.sweep->values) {}
};

SweepResult by_engine(const Scene& scene,
                      const PreparedKnee& knee,
                      const Ways& ways,
                      double flexion) {
  EquilibriumOptions options;
  options.description.stability = false;
  EquilibriumSolver solver(knee.model, knee.covers, options);
  SweepOptions plain;
  plain.stability = plain.events = false;
  const Swept angle = condition_value(static_cast<std::size_t>(scene.laxity->condition));
  const Swept load = swept_of(*scene.sweep);
  plain.drive = load.with(drive_of(solver.model()), 0);
  (void)sweep(solver, angle, way(ways.start, flexion, kFlexionStep), plain);
  plain.drive = angle.with(*plain.drive, flexion);
  (void)sweep(solver, load, ways.to_load, plain);
  return sweep(solver, load, ways.loads, plain);
}

/// Each way starts where the one before it ended.
SweepResult by_reference(WismansModel model,
                         const Scene& scene,
                         const Ways& ways,
                         double flexion,
                         const std::vector<RigidTransform>& other_starts) {
  const auto load = static_cast<std::size_t>(scene.sweep->index);
  const auto follow = [&](std::optional<std::size_t> swept, const std::vector<double>& values) {
    const SweepResult result = sweep(model, swept, values, other_starts);
    if (result.poses.back().converged()) model.start = result.poses.back().X_BA;
  };
  model.loads[load].scale = 0;
  follow(std::nullopt, way(ways.start, flexion, kFlexionStep));
  model.flexion = flexion;
  follow(load, ways.to_load);
  return sweep(model, load, ways.loads, other_starts);
}

Scene without(Scene scene, const std::vector<int>& cut) {
  for (const int i : cut) scene.ligaments[i].law = PolynomialLaw{{0.0}, true};
  return scene;
}

bool wismans_can_hold(const Scene& scene) {
  try {
    check_wismans_scene(scene);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::size_t least_load(const std::vector<PoseResult>& poses) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (std::abs(poses[i].value) < std::abs(poses[best].value)) best = i;
  }
  return best;
}

double coordinate(const Scene& scene, const PoseResult& pose) {
  const std::size_t k = loaded_coordinate(scene);
  return pose.converged() ? pose.joint.*kJointCoordinates[k].member / (k < 3 ? kDegree : 1)
                          : kNoNumber;
}

/// The condition that holds a joint coordinate; null where it is free.
const ConditionDescription* holding(const Scene& scene, std::size_t coordinate) {
  const auto found = std::find_if(scene.conditions.begin(), scene.conditions.end(),
                                  [&](const ConditionDescription& condition) {
                                    return static_cast<std::size_t>(condition.kind) == coordinate;
                                  });
  return found == scene.conditions.end() ? nullptr : &*found;
}

double shown_flexion(const LaxityCurve& curve) {
  return std::round(1e6 * curve.flexion / kDegree) / 1e6;
}

/// The load at a pose by joint coordinates: moments [N mm], then forces [N]; a moment about the anterior axis adducts,
/// one about the proximal axis rotates. A force has moments about the origin of its bone's frame, too: divided by kArm
/// to compare with forces, those about held coordinates left out. A load that is a moment is taken as it is.
Eigen::Matrix<double, 6, 1> generalized_load(const Scene& scene, const RigidTransform& X_BA) {
  constexpr double kArm = 100;  // [mm]
  const LoadDescription& load = scene.loads.at(scene.sweep->index);
  const AnatomicalFrame& bone =
      scene.joint->tibia.body == load.body ? scene.joint->tibia : scene.joint->femur;
  // A dead load stands in the ground frame.
  const Eigen::Vector3d vector = load.follows_body || load.body == scene.fixed_body()
                                     ? load.vector
                                     : X_BA.R.transpose() * load.vector;
  const auto along_axes = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(v.dot(bone.lateral), v.dot(bone.anterior), v.dot(bone.proximal));
  };
  Eigen::Matrix<double, 6, 1> all = Eigen::Matrix<double, 6, 1>::Zero();
  if (load.moment) {
    all.head<3>() = along_axes(vector);
    return all;
  }
  all.head<3>() = along_axes((load.at - bone.origin).cross(vector)) / kArm;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (holding(scene, static_cast<std::size_t>(k)) != nullptr) all[k] = 0;
  all.tail<3>() = along_axes(vector);
  return all;
}

std::size_t loaded_coordinate(const Scene& scene, const RigidTransform& X_BA) {
  Eigen::Index k = 0;
  generalized_load(scene, X_BA).cwiseAbs().maxCoeff(&k);
  return static_cast<std::size_t>(k);
}

/// Where a dead load acts along another coordinate than the one that is told.
std::vector<std::string> turned_load_lines(const Scene& scene, const LaxityResult& result) {
  const std::size_t told = loaded_coordinate(scene);
  std::vector<std::string> lines;
  for (const LaxityCurve& curve : result.curves) {
    if (curve.cut || curve.ours.poses.empty()) continue;
    const PoseResult& pose = curve.ours.poses[least_load(curve.ours.poses)];
    if (!pose.converged()) continue;
    const std::size_t here = loaded_coordinate(scene, pose.X_BA);
    if (here != told)
      lines.push_back(fmt::format(
          "at {:g} degrees {} acts on {} and not on {}: it keeps its direction in space",
          shown_flexion(curve), scene.loads[scene.sweep->index].name, kJointCoordinates[here].words,
          kJointCoordinates[told].words));
  }
  return lines;
}

}  // namespace

std::size_t loaded_coordinate(const Scene& scene) {
  return loaded_coordinate(scene, start_pose(scene));
}

void check_laxity_scene(const Scene& scene) {
  if (!scene.laxity)
    throw InputError(scene.file.string() +
                     ": [laxity] is missing, expected the angles of flexion of the test");
  if (scene.sweep && scene.sweep->arc_length)
    throw InputError(scene.file.string() +
                     ": [sweep]: path = \"arc length\", expected \"steps\" for a test of laxity");
  const std::size_t along = loaded_coordinate(scene);
  if (const ConditionDescription* held = holding(scene, along))
    throw InputError(fmt::format(
        "{}: [laxity]: load \"{}\" acts along {}, which condition \"{}\" holds, expected a load "
        "along a coordinate that is free",
        scene.file.string(), scene.loads.at(scene.sweep->index).name,
        kJointCoordinates[along].words, held->name));
}

LaxityResult test_laxity(const Scene& scene,
                         const std::vector<FittedSurface>& surfaces,
                         const CompareOptions& options,
                         const OnProgress& on_curve,
                         const SweepKeeping& keeping) {
  const Ways ways(scene);
  const int total =
      static_cast<int>(scene.laxity->flexions.size()) * (scene.laxity->cut.empty() ? 1 : 2);
  LaxityResult result;
  const bool by_both = wismans_can_hold(scene);
  const std::vector<HeightFit> heights =
      by_both ? fit_heights(scene, surfaces, options.degree) : std::vector<HeightFit>{};
  for (const bool cut : {false, true}) {
    if (cut && scene.laxity->cut.empty()) continue;
    const Scene knee = cut ? without(scene, scene.laxity->cut) : scene;
    std::optional<PreparedKnee> prepared;  // for the first curve that is not known
    for (const double flexion : scene.laxity->flexions) {
      const int number = 2 * static_cast<int>(result.curves.size());
      LaxityCurve curve{flexion,
                        cut,
                        keeping.get(number,
                                    [&] {
                                      if (!prepared) prepared.emplace(knee, surfaces);
                                      return by_engine(knee, *prepared, ways, flexion);
                                    }),
                        {}};
      if (by_both) {
        std::vector<RigidTransform> starts;
        const PoseResult& middle = curve.ours.poses[least_load(curve.ours.poses)];
        if (middle.converged()) starts.push_back(middle.X_BA);
        curve.reference = keeping.get(number + 1, [&] {
          const Scene quadratic = with_quadratic_springs(knee, options.strain);
          return by_reference(build_wismans_model(quadratic, heights), knee, ways, flexion, starts);
        });
      }
      result.curves.push_back(std::move(curve));
      if (on_curve) on_curve(static_cast<int>(result.curves.size()), total);
    }
  }
  return result;
}

std::vector<double> displacements(const Scene& scene, const SweepResult& sweep) {
  std::vector<double> values;
  if (sweep.poses.empty()) return values;
  const double zero = coordinate(scene, sweep.poses[least_load(sweep.poses)]);
  for (const PoseResult& pose : sweep.poses) values.push_back(coordinate(scene, pose) - zero);
  return values;
}

double laxity_of(const Scene& scene, const SweepResult& sweep) {
  if (sweep.poses.empty() || sweep.poses.back().value == sweep.poses.front().value)
    return kNoNumber;
  return coordinate(scene, sweep.poses.back()) - coordinate(scene, sweep.poses.front());
}

std::vector<std::string> laxity_lines(const Scene& scene, const LaxityResult& result) {
  const std::size_t k = loaded_coordinate(scene);
  const LoadDescription& load = scene.loads[scene.sweep->index];
  const double size = load.vector.norm();
  std::vector<std::string> lines = {
      fmt::format("{} [{}] from {:g} to {:g} {} of {}", kJointCoordinates[k].words,
                  k < 3 ? "deg" : "mm", size * scene.sweep->values.front(),
                  size * scene.sweep->values.back(), load.moment ? "N mm" : "N", load.name),
      fmt::format("{:<10}{:<10}{:>10}{:>12}{:>12}", "knee", "flexion", "ours", "reference",
                  "poses")};
  const auto told = [&](const SweepResult& sweep) {
    const double laxity = laxity_of(scene, sweep);
    return std::isfinite(laxity) ? fmt::format("{:.2f}", laxity) : "-";
  };
  for (const LaxityCurve& curve : result.curves) {
    const bool lost = curve.reference && curve.reference->count_converged() <
                                             static_cast<int>(curve.reference->poses.size());
    lines.push_back(fmt::format(
        "{:<10}{:<10g}{:>10}{:>12}{:>8} of {}{}", curve.cut ? "cut" : "intact",
        shown_flexion(curve), told(curve.ours), curve.reference ? told(*curve.reference) : "-",
        curve.ours.count_converged(), curve.ours.poses.size(),
        lost ? fmt::format(", reference {} of {}", curve.reference->count_converged(),
                           curve.reference->poses.size())
             : std::string()));
  }
  for (std::string& line : turned_load_lines(scene, result)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace condyle
