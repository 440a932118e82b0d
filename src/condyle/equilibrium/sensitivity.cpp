#include "condyle/equilibrium/sensitivity.h"

#include <stdexcept>

#include "condyle/equilibrium/contact_rules.h"

namespace condyle {

Sensitivity::Sensitivity(const Model& model) : rates_(model) {}

bool Sensitivity::set(const Linearization& at) {
  rates_.set(at);
  OutputRow right_side;
  size_ = at.system.fill(at.state, matrix_, right_side.data());
  if (!matrix_.factor(size_)) size_ = 0;
  return size_ > 0;
}

void Sensitivity::check_set() const {
  if (size_ == 0) throw std::logic_error("derivatives are asked for where there are none");
}

double Sensitivity::product(const OutputRow& row, const OutputRow& with) const {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size_); ++i) sum += row[i] * with[i];
  return sum;
}

/// dx/dp as the matrix has it: (da, L dπ, dp, dσ/w).
void Sensitivity::find_step(const ModelParameter& parameter) {
  find_effect(parameter, rates_, effect_);
  for (std::size_t i = 0; i < step_.size(); ++i) step_[i] = -effect_.column[i];
  matrix_.solve(step_.data());
}

StateRate Sensitivity::state_rate(const ModelParameter& parameter) {
  check_set();
  find_step(parameter);
  const Linearization& at = rates_.at();
  const double L = at.model.length;
  StateRate rate;
  rate.da = {step_[0], step_[1], step_[2]};
  rate.dpi = Eigen::Vector3d(step_[3], step_[4], step_[5]) / L;
  const std::size_t n = at.contacts().size();
  for (std::size_t k = 0; k < n; ++k) rate.p[k] = step_[6 + k];
  for (std::size_t k = 0; k < at.conditions().size(); ++k)
    rate.sigma[k] = condition_weight(at.model, k) * step_[6 + n + k];
  return rate;
}

double Sensitivity::derivative(const PoseOutput& output, const ModelParameter& parameter) {
  check_set();
  OutputRow row;
  find_row(output, rates_, row);
  find_step(parameter);
  return product(row, step_) + explicit_part(output, rates_, effect_);
}

void Sensitivity::derivatives(std::span<const PoseOutput> outputs,
                              std::span<const ModelParameter> parameters,
                              Eigen::MatrixXd& J,
                              Way way) {
  check_set();
  const bool adjoint =
      way == Way::kAdjoint || (way == Way::kCheaper && outputs.size() < parameters.size());
  rows_.resize(outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    find_row(outputs[i], rates_, rows_[i]);
    if (adjoint) matrix_.solve_transposed(rows_[i].data());
  }
  J.resize(static_cast<Eigen::Index>(outputs.size()), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    if (adjoint)
      find_effect(parameters[j], rates_, effect_);
    else
      find_step(parameters[j]);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const double through_state =
          adjoint ? -product(rows_[i], effect_.column) : product(rows_[i], step_);
      J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          through_state + explicit_part(outputs[i], rates_, effect_);
    }
  }
}

std::vector<OneSidedContact> one_sided_contacts(const Linearization& at, const PoseResult& pose) {
  constexpr double kNoForce = 1e-9;  // of the sum of all
  const double no_gap = 1e-6 * at.model.length / 30;
  std::vector<OneSidedContact> found;
  for (std::size_t k = 0; k < at.contacts().size(); ++k)
    if (may_open(at, k) && at.state.contacts[k].p < kNoForce * at.force_scale())
      found.push_back({static_cast<std::size_t>(at.state.contacts[k].pair), true});
  for (std::size_t pair = 0; pair < pose.contacts.size(); ++pair) {
    const ContactResult& contact = pose.contacts[pair];
    if (at.model.pairs[pair].mode == ContactMode::kAuto && !contact.closed &&
        !contact.points.empty() && contact.points[0].gap < no_gap)
      found.push_back({pair, false});
  }
  return found;
}

}  // namespace condyle
