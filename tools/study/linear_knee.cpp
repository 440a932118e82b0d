#include "study/linear_knee.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "condyle/equilibrium/sweep.h"
#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/study/study_worker.h"
#include "condyle/study/summarise.h"

namespace condyle::study {
namespace {

constexpr double kSd = 1e-6;
constexpr const char* kOutput = "joint.anterior_drawer";

/// Squares of the derivatives of the drawer over their sum: by parameters and poses.
std::vector<std::vector<double>> shares(Scene scene, const std::vector<FittedSurface>& surfaces) {
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    scene.sweep->sensitivities.push_back({.kind = ParameterKind::kReferenceStrain,
                                          .index = static_cast<int>(i),
                                          .name = scene.ligaments[i].name});
  const SweepResult poses = sweep(scene, surfaces);
  const auto rates = sweep_sensitivities(scene, surfaces, poses.poses);
  const auto drawer = std::find_if(
      rates->outputs.begin(), rates->outputs.end(),
      [](const SensitivityOutput& output) { return output.place.ends_with("anterior_drawer"); });
  if (drawer == rates->outputs.end()) throw std::logic_error("no drawer among the outputs");
  const auto row = drawer - rates->outputs.begin();
  std::vector<std::vector<double>> shares(scene.ligaments.size());
  for (const Eigen::MatrixXd& at : rates->by_pose)
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const double rate = at(row, static_cast<Eigen::Index>(j));
      shares[j].push_back(rate * rate / at.row(row).squaredNorm());
    }
  return shares;
}

}  // namespace

LinearKnee linear_knee(const std::filesystem::path& scene, long points) {
  ReadStudy read;
  read.study.file = scene;
  read.study.design = DesignKind::kSaltelli;
  read.study.samples = points;
  read.study.outputs = {kOutput};
  read.scenes.push_back(read_scene(scene));
  VariedNumber strains;
  strains.number.what = ParameterKind::kReferenceStrain;
  strains.number.prior_sd = kSd;
  for (std::size_t i = 0; i < read.scenes[0].ligaments.size(); ++i)
    strains.number.of.push_back(static_cast<int>(i));
  read.varied.push_back({strains});
  LinearKnee knee{study_plan(std::move(read)), {}};
  knee.closed = shares(knee.plan.knees[0].scene, knee.plan.knees[0].surfaces);
  return knee;
}

StudyEffects effects_of(const LinearKnee& knee) {
  const StudyPlan& plan = knee.plan;
  StudyWorker worker(plan, study_models(plan));
  std::vector<std::uint8_t> status(plan.values.size());
  std::vector<double> values(plan.samples() * plan.numbers());
  std::vector<std::vector<double>> theta(plan.parameters.size());
  std::vector<double> point;
  for (std::uint64_t k = 0; k < plan.samples(); ++k) {
    worker.evaluate(k, status.data(), values.data() + k * plan.numbers());
    plan.theta(k, point);
    for (std::size_t j = 0; j < theta.size(); ++j) theta[j].push_back(point[j]);
  }
  return study_effects({values, plan.values.size()}, theta, true);
}

}  // namespace condyle::study
