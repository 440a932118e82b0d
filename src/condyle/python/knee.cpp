#include "condyle/python/knee.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/results/make_run.h"
#include "condyle/specimen/check_layers.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"

namespace condyle::python {
namespace {

/// From the frames of the files to those of the model: with q = R A the files' origin lies at -q from the model's, so
/// da = da' + [q]x dπ and m' = m - q x f.
OwnLoad in_model_frames(OwnLoad load, const BodyOrigins& origins) {
  return [load = std::move(load), origins](const RigidTransform& X_BA, Wrench& wrench) {
    Wrench own;
    load(origins.out_of_model(X_BA), own);
    const Eigen::Matrix3d q = skew(X_BA.R * origins.A);
    wrench.f = own.f;
    wrench.m = own.m - q * own.f;
    wrench.F1 = own.F1;
    wrench.F2 = own.F2 + own.F1 * q;
    wrench.M1 = own.M1 - q * own.F1;
    wrench.M2 = own.M2 + own.M1 * q - skew(own.f) * q - q * wrench.F2;
  };
}

std::map<std::string, DrivenNumber, std::less<>> driven_numbers(const Scene& scene) {
  std::map<std::string, DrivenNumber, std::less<>> driven;
  for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
    const ConditionDescription& condition = scene.conditions[i];
    driven[condition.name] = {condition_value(i),
                              is_angle(condition.kind) ? scene.angle_to_rad : scene.length_to_mm};
  }
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    driven.try_emplace(scene.loads[i].name + ".scale", DrivenNumber{load_scale(i)});
    driven.try_emplace(scene.loads[i].name, DrivenNumber{load_scale(i)});
  }
  return driven;
}

}  // namespace

void KneeScene::expect_writable(const std::string& what) const {
  if (!own_function.empty())
    throw InputError(own_function + " is a function, expected none: " + what + " cannot hold it");
}

std::shared_ptr<const FittedKnee> fit_knee(const KneeScene& scene, const OnProgress& on_patch) {
  auto fitted = std::make_shared<FittedKnee>(FittedKnee{scene, {}, mesh_files(scene.scene)});
  fitted->surfaces = fit_surfaces(fitted->knee.scene, on_patch);
  fit_wraps(fitted->knee.scene, fitted->surfaces);
  return fitted;
}

namespace {

auto numbers_of(const PatchDescription& p) {
  return std::tie(p.compartment, p.region_box, p.region_angles, p.region_least_cosine, p.offset,
                  p.control_points, p.smoothing, p.smooth_for_position, p.degree);
}

auto numbers_of(const SurfaceDescription& s) {
  return std::tie(s.name, s.body, s.kind, s.solid_inside, s.point, s.direction, s.radius,
                  s.minor_radius, s.length, s.known_radius, s.semi_axes, s.axes);
}

auto numbers_of(const AnatomicalFrame& f) {
  return std::tie(f.body, f.origin, f.lateral, f.anterior, f.proximal);
}

/// All that a surface is made from but its mesh.
bool same_shape(const SurfaceDescription& a, const SurfaceDescription& b) {
  const auto same_term = [](const PolynomialTerm& t, const PolynomialTerm& u) {
    return t.i == u.i && t.j == u.j && t.a == u.a;
  };
  return numbers_of(a) == numbers_of(b) && numbers_of(a.patch) == numbers_of(b.patch) &&
         std::equal(a.terms.begin(), a.terms.end(), b.terms.begin(), b.terms.end(), same_term);
}

bool same_mesh(const MeshFile* a, const MeshFile* b) {
  return a == nullptr || b == nullptr ? a == b : a->is(*b);
}

/// Compartments are found by its frames.
bool same_joint(const std::optional<JointDescription>& a,
                const std::optional<JointDescription>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->side == b->side && numbers_of(a->femur) == numbers_of(b->femur) &&
         numbers_of(a->tibia) == numbers_of(b->tibia);
}

}  // namespace

std::shared_ptr<const FittedKnee> with_surfaces_of(const FittedKnee& fitted,
                                                   const KneeScene& scene) {
  const std::vector<SurfaceDescription>& known = fitted.knee.scene.surfaces;
  const std::vector<SurfaceDescription>& asked = scene.scene.surfaces;
  const auto same = [&](const SurfaceDescription& a, const SurfaceDescription& b) {
    return same_shape(a, b) && same_mesh(fitted.knee.scene.mesh_of(a), scene.scene.mesh_of(b));
  };
  const auto same_layers = [&] {  // a patch under a layer is fitted to its very edge
    for (int i = 0; i < static_cast<int>(asked.size()); ++i)
      if (carries_layer(fitted.knee.scene, i) != carries_layer(scene.scene, i)) return false;
    return true;
  };
  const bool by_joint = std::any_of(asked.begin(), asked.end(), [](const auto& surface) {
    return surface.patch.compartment.has_value();
  });
  if (!std::equal(known.begin(), known.end(), asked.begin(), asked.end(), same) || !same_layers() ||
      (by_joint && !same_joint(fitted.knee.scene.joint, scene.scene.joint)))
    throw InputError("surfaces: fitted for another scene, expected those of condyle.fit(scene)");
  auto knee = std::make_shared<FittedKnee>(FittedKnee{scene, fitted.surfaces, fitted.meshes});
  check_layers(knee->knee.scene, knee->surfaces);
  fit_wraps(knee->knee.scene, knee->surfaces);
  return knee;
}

KneeModel::KneeModel(std::shared_ptr<const FittedKnee> fitted)
    : fitted_(std::move(fitted)), driven_(driven_numbers(fitted_->knee.scene)) {
  Model model = build_model(scene(), fitted_->surfaces);
  for (const auto& [index, load] : fitted_->knee.loads)
    model.loads.at(index).custom = in_model_frames(load, model.origins);
  model_ = std::make_shared<const Model>(std::move(model));
  covers_ = cover_pairs(*model_);
}

const Run& KneeModel::empty_run() const {
  const std::lock_guard lock(making_run_);
  if (!empty_run_) {
    Run run = make_run(scene(), fitted_->surfaces);
    expect_same(fitted_->meshes, run.inputs);
    empty_run_ = std::make_unique<const Run>(std::move(run));
  }
  return *empty_run_;
}

PoseResult KneeModel::solve_anew(const Drive& drive) const {
  std::unique_ptr<EquilibriumSolver> solver;
  {
    const std::lock_guard lock(lending_);
    if (!idle_.empty()) {
      solver = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!solver)
    solver = std::make_unique<EquilibriumSolver>(model_, covers_, equilibrium_options(scene()));
  PoseResult pose = solver->solve(drive);
  solver->reset();
  const std::lock_guard lock(lending_);
  idle_.push_back(std::move(solver));
  return pose;
}

}  // namespace condyle::python
