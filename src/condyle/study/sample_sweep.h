#pragma once

/// The sweep of one sample: from where the knee stands at its scene's own numbers to the poses at others.

#include <cstdint>
#include <vector>

#include "condyle/calibration/changed_knee.h"
#include "condyle/study/study_models.h"

namespace condyle {

/// The workspace of one thread for one model. What a sample's poses are depends on θ alone, to the last
/// bit.
class SampleSweep {
 public:
  /// Refers to all of them.
  SampleSweep(const StudyModel& model,
              const std::vector<FreeParameter>& parameters,
              const std::vector<double>& values,
              const std::vector<StudyOutput>& outputs);

  /// θ: of `parameters`, what follows is not read. status: one of each value; numbers: values times
  /// outputs, in the outputs' units, NaN where a pose did not converge. False, and nothing is computed,
  /// where no knee has such numbers. Allocates nothing once a pose was solved, but where one fails.
  bool solve(const std::vector<double>& theta, std::uint8_t* status, double* numbers);

 private:
  bool set(double part);
  const Drive& drive_at(std::size_t i);
  bool attempt(std::size_t i, Patience patience);
  bool follow(std::size_t i);
  bool find(std::size_t i, bool stands);
  void keep(std::size_t i, std::uint8_t* status, double* numbers) const;
  void mend_gap(std::size_t end, std::uint8_t* status, double* numbers);

  const StudyModel& model_;
  const std::vector<double>& values_;
  const std::vector<StudyOutput>& outputs_;
  ChangedKnee knee_;
  EquilibriumSolver solver_;
  Eigen::VectorXd theta_, on_the_way_;
  Drive nominal_, drive_;
  PoseResult result_;
  std::vector<bool> found_;  ///< by values, of this sample
};

}  // namespace condyle
