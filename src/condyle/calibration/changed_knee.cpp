#include "condyle/calibration/changed_knee.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "condyle/elements/law_rates.h"

namespace condyle {
namespace {

bool is_of_law(ParameterKind kind) {
  return kind == ParameterKind::kReferenceStrain || kind == ParameterKind::kSlackLength ||
         kind == ParameterKind::kStiffness || kind == ParameterKind::kTransitionStrain;
}

double* stiffness_of(ForceLaw& law) {
  if (auto* toe_linear = std::get_if<ToeLinearLaw>(&law)) return &toe_linear->stiffness;
  if (auto* quadratic = std::get_if<QuadraticLaw>(&law)) return &quadratic->stiffness;
  return nullptr;
}

void check_move(const FreeParameter& parameter, const ModelParameter& number) {
  const bool known = is_of_law(number.kind) || number.kind == ParameterKind::kInsertion ||
                     number.kind == ParameterKind::kLoadScale;
  const bool may_be_zero =
      number.kind == ParameterKind::kReferenceStrain || number.kind == ParameterKind::kInsertion;
  if (!known || (parameter.logarithmic && may_be_zero))
    throw std::invalid_argument(parameter.name + ": no number of a knee that a fit can change so");
}

}  // namespace

ChangedKnee::ChangedKnee(const Model& model, const std::vector<FreeParameter>& parameters)
    : model_(model),
      nominal_(parameters_of(model)),
      changed_(nominal_),
      start_length_(model.elements.size(), 0.0),
      moved_(model.elements.size(), false),
      strain_held_(model.elements.size(), false),
      factors_(model.loads.size(), 1.0) {
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    for (const auto& [number, factor] : parameters[j].moves) {
      check_parameter(number, model, nominal_);
      check_move(parameters[j], number);
      const auto found = std::find(numbers_.begin(), numbers_.end(), number);
      const auto at = static_cast<std::size_t>(found - numbers_.begin());
      if (found == numbers_.end()) numbers_.push_back(number);
      moves_.push_back({at, j, factor, parameters[j].logarithmic});
      links_.push_back({at, j, 0});
      if (number.kind == ParameterKind::kLoadScale) continue;
      if (std::find(elements_.begin(), elements_.end(), number.index) == elements_.end())
        elements_.push_back(number.index);
      if (number.kind != ParameterKind::kInsertion) continue;
      moved_[number.index] = true;
      if (number.held == Held::kReferenceStrain) strain_held_[number.index] = true;
    }
  }
  for (const std::size_t i : elements_)
    start_length_[i] = line_element_state(model.elements[i], model.start).length;
}

double ChangedKnee::change_of(const Move& move, double number, double theta) const {
  return move.logarithmic ? number * std::expm1(theta) : move.factor * theta;
}

double ChangedKnee::rate_of(const Move& move, double number, double theta) const {
  return move.logarithmic ? number * std::exp(theta) : move.factor;
}

bool ChangedKnee::set(const Eigen::VectorXd& theta) {
  for (const std::size_t i : elements_) changed_.elements[i] = nominal_.elements[i];
  set_laws(theta);
  set_insertions(theta);
  set_loads(theta);
  return check();
}

void ChangedKnee::set_laws(const Eigen::VectorXd& theta) {
  for (std::size_t m = 0; m < moves_.size(); ++m) {
    const ModelParameter& number = numbers_[moves_[m].number];
    if (!is_of_law(number.kind)) continue;
    ForceLaw& law = changed_.elements[number.index].law;
    const double by = theta[static_cast<Eigen::Index>(moves_[m].parameter)];
    double& rate = links_[m].by;
    const auto move = [&](double& value) {
      rate = rate_of(moves_[m], value, by);
      value += change_of(moves_[m], value, by);
    };
    if (number.kind == ParameterKind::kStiffness) {
      move(*stiffness_of(law));
    } else if (number.kind == ParameterKind::kTransitionStrain) {
      move(std::get<ToeLinearLaw>(law).transition_strain);
    } else {
      const double length = start_length_[number.index], l0 = slack_length(law);
      const bool strain = number.kind == ParameterKind::kReferenceStrain;
      double value = strain ? length / l0 : l0;
      move(value);
      set_slack_length(law, strain ? length / value : value);
    }
  }
}

/// Insertions come after the laws: the slack length of one whose strain is held goes with the length.
void ChangedKnee::set_insertions(const Eigen::VectorXd& theta) {
  for (std::size_t m = 0; m < moves_.size(); ++m) {
    const ModelParameter& number = numbers_[moves_[m].number];
    if (number.kind != ParameterKind::kInsertion) continue;
    LineElement& element = changed_.elements[number.index];
    const double by = theta[static_cast<Eigen::Index>(moves_[m].parameter)];
    Eigen::Vector3d& end = number.body == OfBody::kFixed ? element.x_C : element.s_D;
    end[number.component] += change_of(moves_[m], 0, by);
    links_[m].by = rate_of(moves_[m], 0, by);
  }
  for (std::size_t m = 0; m < moves_.size(); ++m) {
    const ModelParameter& number = numbers_[moves_[m].number];
    if (number.kind != ParameterKind::kSlackLength || !strain_held_[number.index]) continue;
    const LineElement& element = changed_.elements[number.index];
    links_[m].by *= line_element_state(element, model_.start).length / start_length_[number.index];
  }
  for (const std::size_t i : elements_) {
    if (!moved_[i] || !strain_held_[i]) continue;
    LineElement& element = changed_.elements[i];
    const double length = line_element_state(element, model_.start).length;
    set_slack_length(element.law, slack_length(element.law) * length / start_length_[i]);
  }
}

void ChangedKnee::set_loads(const Eigen::VectorXd& theta) {
  std::fill(factors_.begin(), factors_.end(), 1.0);
  for (std::size_t m = 0; m < moves_.size(); ++m) {
    const ModelParameter& number = numbers_[moves_[m].number];
    if (number.kind != ParameterKind::kLoadScale) continue;
    const double by = theta[static_cast<Eigen::Index>(moves_[m].parameter)];
    factors_[number.index] += change_of(moves_[m], 1, by);
    links_[m].by = rate_of(moves_[m], 1, by);
  }
}

bool ChangedKnee::check() {
  objection_.clear();
  const auto expect = [&](double value, const char* what, std::size_t element) {
    if (!(value > 0) || !std::isfinite(value))
      objection_ =
          std::string(what) + " of \"" + model_.element_names[element] + "\" is not positive";
  };
  for (const std::size_t i : elements_) {
    if (moved_[i] && strain_held_[i]) {
      const std::string words = path_objection(changed_.elements[i], model_.start);
      if (!words.empty())
        objection_ = "\"" + model_.element_names[i] + "\" at the start pose: " + words;
    }
    ForceLaw& law = changed_.elements[i].law;
    const double* stiffness = stiffness_of(law);
    if (stiffness == nullptr) continue;  // only its ends move
    expect(slack_length(law), "the slack length", i);
    if (*stiffness != 0) expect(*stiffness, "the stiffness", i);  // 0: a strand that is cut
    if (const auto* toe = std::get_if<ToeLinearLaw>(&law))
      expect(toe->transition_strain, "the transition strain", i);
  }
  return objection_.empty();
}

}  // namespace condyle
