#include "condyle/study/sample_sweep.h"

#include <algorithm>

#include "condyle/math/no_number.h"

namespace condyle {

SampleSweep::SampleSweep(const StudyModel& model,
                         const std::vector<FreeParameter>& parameters,
                         const std::vector<double>& values,
                         const std::vector<StudyOutput>& outputs)
    : model_(model),
      values_(values),
      outputs_(outputs),
      knee_(*model.model, parameters),
      solver_(model.model, model.covers, study_options()),
      theta_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()))),
      on_the_way_(theta_),
      nominal_(drive_of(*model.model)),
      drive_(nominal_),
      found_(values.size()) {}

/// The ligaments at that part of the way to θ.
bool SampleSweep::set(double part) {
  on_the_way_ = part * theta_;
  if (!knee_.set(on_the_way_)) return false;
  solver_.set_parameters(knee_.parameters());
  return true;
}

/// With the loads that were set.
const Drive& SampleSweep::drive_at(std::size_t i) {
  drive_ = nominal_;
  model_.swept.in(drive_) = values_[i];
  for (std::size_t k = 0; k < drive_.scales.size(); ++k)
    drive_.scales[k] *= knee_.load_factors()[k];
  return drive_;
}

bool SampleSweep::attempt(std::size_t i, Patience patience) {
  solver_.solve(drive_at(i), result_, patience);
  return result_.converged();
}

/// From the nominal pose at that value over θ in parts, halved where one fails and doubled where it
/// succeeds, by Newton alone.
bool SampleSweep::follow(std::size_t i) {
  constexpr double kLongest = 0.5, kShortest = 1.0 / 16;
  if (!model_.nominal[i]) return false;
  EquilibriumSolver::Standing step = *model_.nominal[i];
  double t = 0;
  for (double part = kLongest; t < 1 && part >= kShortest;) {
    const double next = std::min(1.0, t + part);
    solver_.go_back(step);
    if (set(next) && attempt(i, Patience::kNone) && result_.trace.route == PoseRoute::kNewton) {
      step = solver_.standing();
      t = next;
      part = std::min(2 * part, kLongest);
    } else {
      part /= 2;
    }
  }
  if (t < 1) (void)set(1);
  return t == 1;
}

/// The pose at a value; where it is not found the solver stays where it stood.
bool SampleSweep::find(std::size_t i, bool stands) {
  if (attempt(i, stands ? Patience::kWay : Patience::kAll)) return true;
  const PoseStatus failed = result_.status;
  const EquilibriumSolver::Standing before = solver_.standing();
  if (follow(i)) return true;
  solver_.go_back(before);
  result_.status = failed;
  return false;
}

void SampleSweep::keep(std::size_t i, std::uint8_t* status, double* numbers) const {
  status[i] = static_cast<std::uint8_t>(result_.status);
  double* own = numbers + i * outputs_.size();
  for (std::size_t k = 0; k < outputs_.size(); ++k)
    own[k] = result_.converged() ? value_of(outputs_[k].output, result_) / outputs_[k].unit.factor
                                 : kNoNumber;
}

/// From the pose that was just found back over those before it that were not, as a sweep does.
void SampleSweep::mend_gap(std::size_t end, std::uint8_t* status, double* numbers) {
  if (end == 0 || found_[end - 1]) return;
  const EquilibriumSolver::Standing here = solver_.standing();
  for (std::size_t i = end; i-- > 0 && !found_[i];) {
    if (!attempt(i, Patience::kWay)) break;
    keep(i, status, numbers);
    found_[i] = true;
  }
  solver_.go_back(here);
}

bool SampleSweep::solve(const std::vector<double>& theta, std::uint8_t* status, double* numbers) {
  std::copy_n(theta.begin(), theta_.size(), theta_.data());
  solver_.reset(model_.searches);
  if (!set(1)) return false;
  bool stands = !model_.nominal.empty() && model_.nominal.front();
  if (stands) solver_.go_back(*model_.nominal.front());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    found_[i] = find(i, stands);
    keep(i, status, numbers);
    if (!found_[i]) continue;
    stands = true;
    mend_gap(i, status, numbers);
  }
  return true;
}

}  // namespace condyle
