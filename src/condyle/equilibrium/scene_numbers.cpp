#include "condyle/equilibrium/scene_numbers.h"

#include <numbers>

namespace condyle {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

bool is_vector(const SceneNumber& number) {
  return number.kind == ParameterKind::kInsertion || number.kind == ParameterKind::kLoadVector ||
         number.kind == ParameterKind::kLoadPoint || number.kind == ParameterKind::kSurfaceShift;
}

Unit unit_of(const Scene& scene, const SceneNumber& number) {
  switch (number.kind) {
    case ParameterKind::kReferenceStrain:
    case ParameterKind::kTransitionStrain:
    case ParameterKind::kLoadScale:
    case ParameterKind::kLayerModulus:
      return {"1", 1};
    case ParameterKind::kStiffness:
      return {std::holds_alternative<QuadraticLaw>(scene.ligaments[at(number.index)].law) ? "N/mm^2"
                                                                                          : "N",
              1};
    case ParameterKind::kLoadVector:
      return {scene.loads[at(number.index)].moment ? "N mm" : "N", 1};
    case ParameterKind::kConditionValue:
      if (is_angle(scene.conditions[at(number.index)].kind)) return {"deg", std::numbers::pi / 180};
      break;
    default:
      break;
  }
  return {"mm", 1};
}

OfBody of_body(const Scene& scene, int body) {
  return body == scene.fixed_body() ? OfBody::kFixed : OfBody::kMoving;
}

/// Of a surface: the first pair that it belongs to stands for all where it is moved; its layer is
/// one in each.
std::vector<ModelParameter> parts_of_surface(const Scene& scene,
                                             const SceneNumber& number,
                                             int component) {
  std::vector<ModelParameter> parts;
  const OfBody body = of_body(scene, scene.surfaces[at(number.index)].body);
  const bool layer = number.kind == ParameterKind::kLayerModulus;
  for (std::size_t pair = 0; pair < scene.contacts.size(); ++pair) {
    const ContactDescription& contact = scene.contacts[pair];
    const bool here = contact.surfaces[0] == number.index || contact.surfaces[1] == number.index;
    if (!here || (layer && !contact.layer) || (!layer && !parts.empty())) continue;
    parts.push_back({number.kind, pair, body, component});
  }
  return parts;
}

std::vector<ModelParameter> parts_of(const Scene& scene, const SceneNumber& number, int component) {
  switch (number.kind) {
    case ParameterKind::kSurfaceShift:
    case ParameterKind::kLayerModulus:
      return parts_of_surface(scene, number, component);
    case ParameterKind::kInsertion: {
      const bool by_strain = scene.ligaments[at(number.index)].reference_strain.has_value();
      return {{number.kind, at(number.index), of_body(scene, number.body), component,
               by_strain ? Held::kReferenceStrain : Held::kSlackLength}};
    }
    default:
      return {{number.kind, at(number.index), OfBody::kFixed, component}};
  }
}

}  // namespace

std::vector<SceneParameter> scene_parameters(const Scene& scene,
                                             const std::vector<SceneNumber>& numbers) {
  std::vector<SceneParameter> parameters;
  for (const SceneNumber& number : numbers) {
    const bool vector = is_vector(number);
    for (int component = 0; component < (vector ? 3 : 1); ++component) {
      std::string name = number.name;
      if (vector) name += std::string(".") + "xyz"[component];
      parameters.push_back(
          {name, unit_of(scene, number), number, component, parts_of(scene, number, component)});
    }
  }
  return parameters;
}

}  // namespace condyle
