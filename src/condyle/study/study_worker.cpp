#include "condyle/study/study_worker.h"

#include "condyle/study/sample_sweep.h"
#include "condyle/study/study_models.h"

namespace condyle {

struct StudyWorker::Parts {
  const StudyPlan& plan;
  std::shared_ptr<const StudyModels> models;
  std::vector<std::unique_ptr<SampleSweep>> sweeps;  ///< by knees, made where they are needed
  std::vector<double> theta;

  SampleSweep& sweep(std::size_t knee) {
    std::unique_ptr<SampleSweep>& own = sweeps[knee];
    if (!own)
      own = std::make_unique<SampleSweep>(models->knee(knee), plan.knees[knee].parameters,
                                          plan.values, plan.outputs);
    return *own;
  }
};

StudyWorker::StudyWorker(const StudyPlan& plan, std::shared_ptr<const StudyModels> models)
    : parts_(std::make_unique<Parts>(Parts{plan, std::move(models), {}, {}})) {
  parts_->sweeps.resize(plan.knees.size());
}

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
  parts_->sweep(knee).solve(theta, status, values);
}

}  // namespace condyle
