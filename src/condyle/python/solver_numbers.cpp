#include "condyle/python/solver_numbers.h"

#include <cmath>

#include "condyle/elements/law_rates.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene_numbers.h"

namespace condyle::python {
namespace {

/// What one unit of the scene is inside.
double unit_factor(const NumberPlace& place) {
  const Scene& scene = place.knee.scene();
  const SceneNumber& number = place.number.number;
  const double length = scene.length_to_mm, force = scene.force_to_n;
  switch (number.kind) {
    case ParameterKind::kSlackLength:
    case ParameterKind::kInsertion:
    case ParameterKind::kLoadPoint:
      return length;
    case ParameterKind::kStiffness: {
      const ForceLaw& law = scene.ligaments[static_cast<std::size_t>(number.index)].law;
      return std::holds_alternative<QuadraticLaw>(law) ? force / (length * length) : force;
    }
    case ParameterKind::kLoadVector:
      return scene.loads[static_cast<std::size_t>(number.index)].moment ? force * length : force;
    case ParameterKind::kConditionValue:
      return is_angle(scene.conditions[static_cast<std::size_t>(number.index)].kind)
                 ? scene.angle_to_rad
                 : length;
    default:
      return 1;
  }
}

const ModelParameter& part(const NumberPlace& place) {
  const ModelParameter& parameter = place.number.parts.at(0);
  if (parameter.kind == ParameterKind::kSurfaceShift ||
      parameter.kind == ParameterKind::kLayerModulus)
    throw InputError(place.number.name +
                     ": surfaces and layers are the model's own, expected a number of a "
                     "ligament, a load or a condition");
  return parameter;
}

double stiffness_of(const ForceLaw& law) {
  if (const auto* toe_linear = std::get_if<ToeLinearLaw>(&law)) return toe_linear->stiffness;
  return std::get<QuadraticLaw>(law).stiffness;
}

void set_stiffness(ForceLaw& law, double stiffness) {
  if (auto* toe_linear = std::get_if<ToeLinearLaw>(&law))
    toe_linear->stiffness = stiffness;
  else
    std::get<QuadraticLaw>(law).stiffness = stiffness;
}

double inside(const ModelParameter& p,
              const Model& model,
              const Parameters& parameters,
              const Drive& drive) {
  switch (p.kind) {
    case ParameterKind::kLoadScale:
      return drive.scales.at(p.index);
    case ParameterKind::kConditionValue:
      return drive.values.at(p.index);
    case ParameterKind::kLoadVector:
      return parameters.loads.at(p.index).vector[p.component];
    case ParameterKind::kLoadPoint:
      return parameters.loads.at(p.index).at[p.component] + model.origins.A[p.component];
    default:
      break;
  }
  const LineElement& element = parameters.elements.at(p.index);
  switch (p.kind) {
    case ParameterKind::kReferenceStrain:
      return line_element_state(element, model.start).length / slack_length(element.law) - 1;
    case ParameterKind::kSlackLength:
      return slack_length(element.law);
    case ParameterKind::kStiffness:
      return stiffness_of(element.law);
    case ParameterKind::kTransitionStrain:
      return std::get<ToeLinearLaw>(element.law).transition_strain;
    default:
      return p.body == OfBody::kFixed ? element.x_C[p.component] + model.origins.B[p.component]
                                      : element.s_D[p.component] + model.origins.A[p.component];
  }
}

void check(const std::string& name, ParameterKind kind, double value) {
  const bool positive =
      kind == ParameterKind::kSlackLength || kind == ParameterKind::kTransitionStrain;
  if (kind == ParameterKind::kStiffness && !(value >= 0))
    throw InputError(name + " = " + std::to_string(value) + ", expected a number >= 0");
  if (positive && !(value > 0))
    throw InputError(name + " = " + std::to_string(value) + ", expected a number > 0");
  if (kind == ParameterKind::kReferenceStrain && !(value > -1))
    throw InputError(name + " = " + std::to_string(value) + ", expected a strain > -1");
}

}  // namespace

std::vector<SceneParameter> numbers_named(const std::string& name, const Scene& scene) {
  const Source source{"solver", {}, false};
  Value word, list, table;
  word.type = Value::Type::kText;
  word.text = name;
  list.type = Value::Type::kArray;
  list.items = {word};
  table.keys = {"name"};
  table.items = {list};
  return scene_parameters(scene, read_scene_numbers(Section(table, source, ""), "name", scene));
}

double get(const NumberPlace& place, const Parameters& parameters, const Drive& drive) {
  return inside(part(place), *place.knee.model(), parameters, drive) / unit_factor(place);
}

void set(const NumberPlace& place, double value, Parameters& parameters, Drive& drive) {
  const ModelParameter& p = part(place);
  const Model& model = *place.knee.model();
  check(place.number.name, p.kind, value);
  try {
    check_parameter(p, model, parameters);
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  }
  const double to = value * unit_factor(place);
  switch (p.kind) {  // as given, to the last digit
    case ParameterKind::kSlackLength:
      return set_slack_length(parameters.elements[p.index].law, to);
    case ParameterKind::kStiffness:
      return set_stiffness(parameters.elements[p.index].law, to);
    case ParameterKind::kTransitionStrain:
      std::get<ToeLinearLaw>(parameters.elements[p.index].law).transition_strain = to;
      return;
    case ParameterKind::kLoadVector:
      parameters.loads[p.index].vector[p.component] = to;
      return;
    case ParameterKind::kLoadScale:
      drive.scales[p.index] = to;
      return;
    case ParameterKind::kConditionValue:
      drive.values[p.index] = to;
      return;
    default:
      return change(p, to - inside(p, model, parameters, drive), model, parameters, drive);
  }
}

}  // namespace condyle::python
