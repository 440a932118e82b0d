#include "condyle/study/study_worker.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "condyle/input_error.h"
#include "condyle/math/no_number.h"
#include "condyle/study/rough_mesh.h"
#include "condyle/study/sample_sweep.h"
#include "condyle/study/study_models.h"

namespace condyle {
namespace {

void fail_all(const StudyPlan& plan, std::uint8_t* status, double* values) {
  std::fill_n(status, plan.values.size(), static_cast<std::uint8_t>(PoseStatus::kNotComputed));
  std::fill_n(values, plan.numbers(), kNoNumber);
}

}  // namespace

struct StudyWorker::Parts {
  const StudyPlan& plan;
  std::shared_ptr<const StudyModels> models;
  std::unique_ptr<SampleSweep> own = {};  ///< of the knee of the last sample: they go knee by knee
  std::size_t knee_of_own = 0;
  std::vector<double> theta = {};

  SampleSweep& sweep(std::size_t knee) {
    if (own && knee_of_own == knee) return *own;
    own.reset();
    own = std::make_unique<SampleSweep>(models->knee(knee), plan.knees[knee].parameters,
                                        plan.values, plan.knees[knee].outputs);
    knee_of_own = knee;
    return *own;
  }

  /// On surfaces of its own, the last number of θ being the seed.
  void solve_rough(std::size_t k,
                   const std::vector<double>& theta_of_sample,
                   std::uint8_t* status,
                   double* values) const {
    const StudyKnee& knee = plan.knees[k];
    const VariedRoughness& rough = *plan.study.roughness;
    const MeshRoughness roughness{rough.rms, rough.correlation,
                                  std::bit_cast<std::uint64_t>(theta_of_sample.back())};
    std::optional<StudyModel> model;
    try {
      model = study_model(
          knee.scene, roughened_surfaces(knee.scene, knee.surfaces, models->meshes(k), roughness),
          plan.values, models->nominal(k));
    } catch (const InputError&) {  // no surface can be fitted to that mesh
      return fail_all(plan, status, values);
    }
    SampleSweep sample(*model, knee.parameters, plan.values, knee.outputs);
    if (!sample.solve(theta_of_sample, status, values)) fail_all(plan, status, values);
  }
};

std::shared_ptr<const StudyModels> study_models(const StudyPlan& plan) {
  return std::make_shared<const StudyModels>(plan);
}

const SweepResult& nominal_sweep(const StudyModels& models, std::size_t knee) {
  return models.nominal(knee);
}

StudyWorker::StudyWorker(const StudyPlan& plan, std::shared_ptr<const StudyModels> models)
    : parts_(std::make_unique<Parts>(Parts{plan, std::move(models)})) {}

StudyWorker::~StudyWorker() = default;

void StudyWorker::evaluate(std::uint64_t sample, std::uint8_t* status, double* values) {
  const StudyPlan& plan = parts_->plan;
  plan.theta(sample, parts_->theta);
  evaluate(plan.knee_of(sample), parts_->theta, status, values);
}

void StudyWorker::evaluate(std::size_t knee,
                           const std::vector<double>& theta,
                           std::uint8_t* status,
                           double* values) {
  if (parts_->plan.study.roughness) return parts_->solve_rough(knee, theta, status, values);
  if (!parts_->sweep(knee).solve(theta, status, values)) fail_all(parts_->plan, status, values);
}

}  // namespace condyle
