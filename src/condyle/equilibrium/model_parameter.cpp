#include "condyle/equilibrium/model_parameter.h"

#include <fmt/format.h>

#include <stdexcept>

#include "condyle/elements/law_rates.h"

namespace condyle {
namespace {

enum class Owner { kElement, kLoad, kCondition, kPair };

Owner owner_of(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kLoadScale:
    case ParameterKind::kLoadVector:
    case ParameterKind::kLoadPoint:
      return Owner::kLoad;
    case ParameterKind::kConditionValue:
      return Owner::kCondition;
    case ParameterKind::kSurfaceShift:
    case ParameterKind::kLayerModulus:
      return Owner::kPair;
    default:
      return Owner::kElement;
  }
}

std::size_t count_of(Owner owner, const Model& model) {
  switch (owner) {
    case Owner::kElement:
      return model.elements.size();
    case Owner::kLoad:
      return model.loads.size();
    case Owner::kCondition:
      return model.conditions.size();
    default:
      return model.pairs.size();
  }
}

const char* plural(Owner owner) {
  constexpr const char* kWords[] = {"line elements", "loads", "conditions", "pairs of surfaces"};
  return kWords[static_cast<std::size_t>(owner)];
}

std::string owner_name(const ModelParameter& parameter, const Model& model) {
  const auto name = [&](const std::vector<std::string>& names) {
    return parameter.index < names.size() ? "\"" + names[parameter.index] + "\""
                                          : "number " + std::to_string(parameter.index);
  };
  switch (owner_of(parameter.kind)) {
    case Owner::kElement:
      return name(model.element_names);
    case Owner::kLoad:
      return name(model.load_names);
    case Owner::kCondition:
      return name(model.condition_names);
    default:
      return parameter.index < model.pairs.size() ? "\"" + model.pairs[parameter.index].name + "\""
                                                  : "number " + std::to_string(parameter.index);
  }
}

bool is_vector(ParameterKind kind) {
  return kind == ParameterKind::kInsertion || kind == ParameterKind::kLoadVector ||
         kind == ParameterKind::kLoadPoint || kind == ParameterKind::kSurfaceShift;
}

std::string law_objection(const ModelParameter& parameter, const ForceLaw& law) {
  const bool toe = std::holds_alternative<ToeLinearLaw>(law);
  const bool known = toe || std::holds_alternative<QuadraticLaw>(law);
  if (parameter.kind == ParameterKind::kTransitionStrain)
    return toe ? "" : "its law has none, expected toe-linear";
  const bool asks_law =
      parameter.kind != ParameterKind::kInsertion || parameter.held == Held::kReferenceStrain;
  return known || !asks_law ? "" : "its law has none, expected toe-linear or quadratic";
}

std::string load_objection(ParameterKind kind, const Load& load) {
  if (kind == ParameterKind::kLoadScale) return {};
  if (load.custom) return "the load computes itself";
  return kind == ParameterKind::kLoadPoint && load.moment ? "a moment has no point" : "";
}

std::string layer_objection(OfBody body, const ContactPair& pair) {
  if (!pair.law) return "its surfaces are rigid";
  const bool fixed = body != OfBody::kMoving && !pair.elastic_B;
  const bool moving = body != OfBody::kFixed && !pair.elastic_A;
  if (body == OfBody::kBoth) return fixed && moving ? "neither surface has a layer" : "";
  return fixed || moving ? "that surface has no layer" : "";
}

std::string objection(const ModelParameter& parameter,
                      const Model& model,
                      const Parameters& parameters) {
  const Owner owner = owner_of(parameter.kind);
  if (const std::size_t count = count_of(owner, model); parameter.index >= count)
    return fmt::format("the model has {} {}", count, plural(owner));
  if (is_vector(parameter.kind) && (parameter.component < 0 || parameter.component > 2))
    return fmt::format("its component is {}, expected 0, 1 or 2", parameter.component);
  if (parameter.body == OfBody::kBoth && parameter.kind != ParameterKind::kLayerModulus)
    return "expected one of the two bodies";
  switch (owner) {
    case Owner::kElement:
      return law_objection(parameter, parameters.elements[parameter.index].law);
    case Owner::kLoad:
      return load_objection(parameter.kind, parameters.loads[parameter.index]);
    case Owner::kPair:
      if (parameter.kind == ParameterKind::kLayerModulus)
        return layer_objection(parameter.body, model.pairs[parameter.index]);
      return {};
    default:
      return {};
  }
}

double start_length(const LineElement& element, const Model& model) {
  return line_element_state(element, model.start).length;
}

void change_stiffness(double by, ForceLaw& law) {
  if (auto* toe_linear = std::get_if<ToeLinearLaw>(&law)) toe_linear->stiffness += by;
  if (auto* quadratic = std::get_if<QuadraticLaw>(&law)) quadratic->stiffness += by;
}

void change_element(const ModelParameter& parameter,
                    double by,
                    const Model& model,
                    LineElement& element) {
  const double l0 = slack_length(element.law);
  switch (parameter.kind) {
    case ParameterKind::kSlackLength:
      return set_slack_length(element.law, l0 + by);
    case ParameterKind::kReferenceStrain: {
      const double length = start_length(element, model);
      return set_slack_length(element.law, length / (length / l0 + by));
    }
    case ParameterKind::kStiffness:
      return change_stiffness(by, element.law);
    case ParameterKind::kTransitionStrain:
      std::get<ToeLinearLaw>(element.law).transition_strain += by;
      return;
    default:
      break;
  }
  const bool held = parameter.held == Held::kReferenceStrain;
  const double before = held ? start_length(element, model) : 1;
  (parameter.body == OfBody::kFixed ? element.x_C : element.s_D)[parameter.component] += by;
  if (held) set_slack_length(element.law, l0 * start_length(element, model) / before);
}

}  // namespace

std::string name_of(const ModelParameter& parameter, const Model& model) {
  const std::string owner = owner_name(parameter, model);
  const char* body = parameter.body == OfBody::kFixed ? "fixed" : "moving";
  const char axis = "xyz?"[parameter.component >= 0 && parameter.component < 3
                               ? static_cast<std::size_t>(parameter.component)
                               : 3];
  switch (parameter.kind) {
    case ParameterKind::kReferenceStrain:
      return "reference strain of " + owner;
    case ParameterKind::kSlackLength:
      return "slack length of " + owner;
    case ParameterKind::kStiffness:
      return "stiffness of " + owner;
    case ParameterKind::kTransitionStrain:
      return "transition strain of " + owner;
    case ParameterKind::kInsertion:
      return fmt::format("insertion of {} on the {} body, {}", owner, body, axis);
    case ParameterKind::kLoadScale:
      return "scale of " + owner;
    case ParameterKind::kLoadVector:
      return fmt::format("vector of {}, {}", owner, axis);
    case ParameterKind::kLoadPoint:
      return fmt::format("point of {}, {}", owner, axis);
    case ParameterKind::kConditionValue:
      return "value of " + owner;
    case ParameterKind::kSurfaceShift:
      return fmt::format("surface of {} on the {} body, {}", owner, body, axis);
    case ParameterKind::kLayerModulus:
      break;
  }
  if (parameter.body == OfBody::kBoth) return "modulus of both layers of " + owner;
  return fmt::format("modulus of the layer of {} on the {} body", owner, body);
}

void check_parameter(const ModelParameter& parameter,
                     const Model& model,
                     const Parameters& parameters) {
  const std::string words = objection(parameter, model, parameters);
  if (!words.empty()) throw std::invalid_argument(name_of(parameter, model) + ": " + words);
}

void change(const ModelParameter& parameter,
            double by,
            const Model& model,
            Parameters& parameters,
            Drive& drive) {
  check_parameter(parameter, model, parameters);
  switch (owner_of(parameter.kind)) {
    case Owner::kElement:
      return change_element(parameter, by, model, parameters.elements[parameter.index]);
    case Owner::kCondition:
      drive.values.at(parameter.index) += by;
      return;
    case Owner::kPair:
      throw std::invalid_argument(name_of(parameter, model) + ": it is the model's own");
    case Owner::kLoad:
      break;
  }
  Load& load = parameters.loads[parameter.index];
  if (parameter.kind == ParameterKind::kLoadScale)
    drive.scales.at(parameter.index) += by;
  else
    (parameter.kind == ParameterKind::kLoadVector ? load.vector : load.at)[parameter.component] +=
        by;
}

}  // namespace condyle
