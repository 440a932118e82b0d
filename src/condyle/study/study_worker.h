#pragma once

/// The workspace of one thread: a solver of the knee whose samples are computed, and the way from a
/// sample's numbers to its poses.
///
/// The ligaments and loads are set in place; where the mesh is rough anew its surfaces are fitted and a
/// solver is made. A sweep then goes from the stored nominal pose at its first value, each pose from the
/// one before it as in a sweep of its own; one that fails is tried again from the nominal pose at its
/// value, followed over θ in parts (as TestBench::solve). All is bounded by counted iterations, never
/// by time; nothing of a sample's depends on the sample before.

#include <cstdint>
#include <memory>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/study/study_plan.h"

namespace condyle {

/// What threads share of a plan: models, covers of contacts, nominal poses. Made once.
class StudyModels;
[[nodiscard]] std::shared_ptr<const StudyModels> study_models(const StudyPlan& plan);
/// The sweep of a knee at its scene's own numbers.
[[nodiscard]] const SweepResult& nominal_sweep(const StudyModels& models, std::size_t knee);

class StudyWorker {
 public:
  /// Refers to the plan.
  StudyWorker(const StudyPlan& plan, std::shared_ptr<const StudyModels> models);
  ~StudyWorker();

  /// status: poses; values: poses times outputs, NaN where a pose did not
  /// converge (one beyond a known surface has a status too).
  void evaluate(std::uint64_t sample, std::uint8_t* status, double* values);
  /// The same at any θ of a knee.
  void evaluate(std::size_t knee,
                const std::vector<double>& theta,
                std::uint8_t* status,
                double* values);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
